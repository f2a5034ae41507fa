"""Diagnostics of a robot's parts as a tree that a finger folds: the worst first, with their readings and their age.

tree = DiagnosticsTree()
robot.on("/diagnostics", tree.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.recycleview.views import RecycleDataViewBehavior
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the rows
from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus, KeyValue
from widgets.core.base import RobotWidget, age_text
from widgets.core.language import tr, trn
from widgets.status.diagnostics import ERROR, OK, STALE, WARN, DiagnosticRow, DiagnosticsModel

__all__ = ["DiagnosticsTree"]

WRITE_PERIOD = 0.25
"""Between two drawings of what came [s]."""
AGE_PERIOD = 1.0
"""Between two looks at what became silent [s]."""
_SIGNS = {
    OK: ("check_circle", "ok"),
    WARN: ("warning_fill", "warn"),
    STALE: ("schedule", "muted"),
    ERROR: ("error_fill", "danger"),
}
"""Level to its icon and the role of its colour."""

Builder.load_string("""
<DiagnosticLine>:
    padding: dp(10) + self.depth * dp(18), 0, dp(10), 0
    spacing: dp(8)
    canvas.before:
        Rounded:
            rgba: theme.raised if self.foldable else (0, 0, 0, 0)
            pos: self.x + dp(2) + self.depth * dp(18), self.y + dp(2)
            size: self.width - dp(4) - self.depth * dp(18), self.height - dp(4)
            radius: [theme.corner * .7]
        Rounded:
            rgba: theme.text[:3] + [.14 if root.state == 'down' else 0]
            pos: self.x + dp(2) + self.depth * dp(18), self.y + dp(2)
            size: self.width - dp(4) - self.depth * dp(18), self.height - dp(4)
            radius: [theme.corner * .7]
    Icon:
        name: 'expand_less' if root.open else 'expand_more'
        role: 'muted'
        font_size: sp(20)
        width: dp(20) if root.foldable else dp(2)
        opacity: 1 if root.foldable else 0
        pos_hint: {'center_y': .5}
    Icon:
        name: root.icon
        role: root.role
        font_size: sp(20)
        width: dp(22) if root.leveled else dp(2)
        opacity: 1 if root.leveled else 0
        pos_hint: {'center_y': .5}
    Label:
        text: root.name
        font_name: theme.font
        font_size: sp(15)
        bold: root.leveled
        color: theme.text if root.leveled else theme.muted
        disabled_color: self.color
        size_hint_x: None if root.text else 1
        width: min(self.texture_size[0], root.width * .55) if root.text else self.width
        text_size: (None if self.texture_size[0] < root.width * .55 else root.width * .55) if root.text else self.width, self.height
        shorten: True
        shorten_from: 'right'
        halign: 'left'
        valign: 'middle'
    Label:
        text: root.text
        font_name: theme.font
        font_size: sp(14)
        bold: not root.leveled
        color: theme.text if not root.leveled else theme.muted
        disabled_color: self.color
        size_hint_x: 1 if root.text else None
        width: 0
        text_size: self.size
        shorten: True
        shorten_from: 'right'
        halign: 'right'
        valign: 'middle'

<DiagnosticsTree>:
    orientation: 'vertical'
    padding: dp(8)
    spacing: dp(6)
    BoxLayout:
        size_hint_y: None
        height: dp(28)
        spacing: dp(8)
        padding: dp(6), 0, dp(26), 0
        Icon:
            name: root.sign
            role: root.role
            font_size: sp(22)
            pos_hint: {'center_y': .5}
        Label:
            text: root.summary
            font_name: theme.font
            font_size: sp(15)
            bold: True
            color: theme.text
            disabled_color: self.color
            text_size: self.size
            shorten: True
            shorten_from: 'right'
            halign: 'left'
            valign: 'middle'
    RecycleView:
        id: view
        viewclass: 'DiagnosticLine'
        bar_width: dp(3)
        bar_color: theme.muted
        bar_inactive_color: theme.line
        scroll_type: ['bars', 'content']
        do_scroll_x: False
        RecycleBoxLayout:
            orientation: 'vertical'
            size_hint_y: None
            height: self.minimum_height
            default_size: None, max(theme.target, dp(44))
            default_size_hint: 1, None
""")


class DiagnosticLine(RecycleDataViewBehavior, ButtonBehavior, BoxLayout):
    """One line of the tree. A finger presses it where there is something to fold."""

    name = StringProperty("")
    text = StringProperty("")
    icon = StringProperty("check_circle")
    role = StringProperty("ok")
    leveled = BooleanProperty(True)
    """It is a part or a group, and no reading."""
    depth = NumericProperty(0)
    foldable = BooleanProperty(False)
    open = BooleanProperty(False)
    path: ObjectProperty[tuple[str, ...]] = ObjectProperty(())
    fold: ObjectProperty[Any] = ObjectProperty(None, allownone=True)
    """Called with the path when a finger pressed it."""

    def on_touch_down(self, touch: Any) -> bool:
        """Leave the finger to the list where nothing can be folded."""
        return bool(self.foldable and super().on_touch_down(touch))

    def on_release(self) -> None:
        """Fold it."""
        if self.fold is not None:
            self.fold(self.path)


class DiagnosticsTree(RobotWidget, BoxLayout):
    """Parts by the `/` in their names. A group is as bad as the worst in it, and open while that is not well."""

    accepts: ClassVar = (DiagnosticArray,)
    grid_size: ClassVar = (5, 5)

    summary = StringProperty("—")
    """All of it in a few words."""
    sign = StringProperty("build")
    role = StringProperty("muted")

    def __init__(self, **kwargs: Any) -> None:
        self.model = DiagnosticsModel()
        self._rows: list[DiagnosticRow] = []
        self._write_later = Clock.create_trigger(self.refresh, WRITE_PERIOD)
        self._age_later = Clock.create_trigger(self.refresh, AGE_PERIOD)
        super().__init__(**kwargs)
        self.fbind("parent", self._on_parent)

    def show(self, msg: DiagnosticArray) -> None:
        """Take in what the message tells of; parts that it does not name stay, and grow old."""
        self.model.take(msg, Clock.get_time())
        self._write_later()

    def fold(self, path: tuple[str, ...]) -> None:
        """Open or close a part."""
        self.model.fold(path, Clock.get_time())
        self.refresh()

    def clear(self) -> None:
        """Forget everything: it is another robot."""
        self.model.clear()
        self.refresh()

    def _on_parent(self, *_: object) -> None:
        if self.parent is None:
            self._age_later.cancel()
        elif self._rows:
            self._age_later()

    def refresh(self, *_: object) -> None:
        """Bring the tree up to date now."""
        now = Clock.get_time()
        rows = self.model.rows(now)
        if rows != self._rows:
            self._rows = rows
            self.ids.view.data = [self._line(row) for row in rows]
        self._sum_up(now)
        if rows and self.parent is not None:
            self._age_later()

    def _line(self, row: DiagnosticRow) -> dict[str, Any]:
        sign, role = _SIGNS.get(row.level, ("", "muted"))
        text = trn("{count} not well", "{count} not well", int(row.text)) if _counts(row) else row.text
        if math.isfinite(row.age):
            old = age_text(row.age)
            text = f"{old} · {text}" if text else old
        return {
            "name": row.name, "text": text, "icon": sign or "check_circle", "role": role, "leveled": not row.value,
            "depth": row.depth, "foldable": row.foldable, "open": row.open, "path": row.path, "fold": self.fold,
        }  # fmt: skip

    def _sum_up(self, now: float) -> None:
        if not self._rows:
            self.summary, self.sign, self.role = tr("No diagnostics yet"), "build", "muted"
            return
        counts = self.model.counts(now)
        self.sign, self.role = _SIGNS[self.model.level(now)]
        words = {
            ERROR: trn("{count} error", "{count} errors", counts[ERROR]),
            STALE: trn("{count} silent", "{count} silent", counts[STALE]),
            WARN: trn("{count} warning", "{count} warnings", counts[WARN]),
        }
        told = [text for level, text in words.items() if counts[level]]
        self.summary = " · ".join(told) or trn(
            "{count} part is well", "All {count} parts are well", counts[OK]
        )


def _counts(row: DiagnosticRow) -> bool:
    """Its text is how many of a group are not well."""
    return row.foldable and row.text.isdigit()


def _told() -> DiagnosticArray:
    def part(name: str, level: int, message: str, *values: tuple[str, str]) -> DiagnosticStatus:
        return DiagnosticStatus(level, name, message, values=[KeyValue(*each) for each in values])

    return DiagnosticArray(
        status=[
            part("/motors/left", 0, "running", ("temperature", "41 °C"), ("current", "1.2 A")),
            part("/motors/right", 2, "over temperature", ("temperature", "93 °C"), ("current", "6.8 A")),
            part("/sensors/laser", 0, "10 Hz"),
            part("/sensors/camera/front", 1, "frames are late", ("rate", "7.4 Hz")),
            part("/battery", 0, "87 %"),
        ]
    )


def samples() -> dict[str, Callable[[], Widget]]:
    """Something wrong, all well, readings open, every state."""

    def make(
        state: str = "live", message: DiagnosticArray | None = None, opened: Any = (), **more: Any
    ) -> Any:
        def build() -> Widget:
            tree = DiagnosticsTree(size_hint=(None, None), size=(dp(400), dp(360)), state=state, **more)
            if state != "never":
                tree.show(message or _told())
            for path in opened:
                tree.model.folds[path] = True
            tree.refresh()
            return tree

        return build

    well = DiagnosticArray(status=_told().status[:1] + _told().status[2:3] + _told().status[4:])
    return {
        "never": make("never"),
        "live": make(opened=[("motors", "right")]),
        "all well": make(message=well),
        "stale": make("stale", age=7.0),
        "alarm": make("alarm"),
        "disabled": make("disabled"),
    }
