"""Any message as a tree of its fields: names, values with their units, types; a tap folds a branch.

view = FieldView(type=Imu)
robot.on("/imu/data", view.show)
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable
from dataclasses import replace
from itertools import accumulate
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    DictProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
)
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the rows
from bridge.msgs import Msg
from widgets.core.base import RobotWidget, age_text
from widgets.core.field_paths import written
from widgets.core.language import tr
from widgets.core.theme import theme
from widgets.fields.field_row import FieldRow, line_width, text_width, whole_height
from widgets.fields.message_fields import ARRAY, BRANCH, DASH, LEAF, Path, Row, describe, rows, unit

__all__ = ["FieldView"]

WRITE_PERIOD = 0.1
"""Between two looks at the newest message [s]: figures that change faster cannot be read."""
NARROW = 560.0
"""A tree narrower than this leaves a little less room before each level [dp]."""

Builder.load_string("""
<FieldView>:
    ScrollView:
        id: scroll
        size_hint: None, None
        size: root.width - 2 * root.margin, root.height - 2 * root.margin - root.strip
        pos: root.x + root.margin, root.y + root.margin
        do_scroll_x: False
        bar_width: dp(3)
        bar_color: theme.muted
        bar_inactive_color: theme.line
        Widget:
            id: sheet
            size_hint: None, None
            width: scroll.width - dp(6)  # the bar beside the rows
            height: root.length
    BoxLayout:
        size_hint: 1, None
        height: note.height
        spacing: dp(8)
        padding: dp(8), 0, dp(8), 0
        opacity: 1 if root.notice else 0
        pos_hint: {'x': 0, 'top': 1}
        Icon:
            name: 'info'
            role: 'muted'
            font_size: sp(20)
            pos_hint: {'center_y': .5}
        Text:
            id: note
            text: root.notice
            role: 'muted'
            font_size: sp(15)
            pos_hint: {'center_y': .5}
""")


class FieldView(RobotWidget, FloatLayout):
    """The fields of the newest message. Only what is in sight has widgets, and they are brought up to date ten times a second."""

    accepts = (Msg,)

    __events__ = ("on_pick",)
    grid_size: ClassVar = (4, 5)

    message: ObjectProperty[Msg | None] = ObjectProperty(
        None, allownone=True, comparator=lambda one, other: one is other
    )
    """The newest; None before the first."""
    type = ObjectProperty(None, allownone=True)
    """Class of what is awaited: before the first message its fields are shown with dashes. None for any."""
    now = NumericProperty(math.nan)
    """The robot's clock [s]; NaN leaves ages away."""
    picks = BooleanProperty(False)
    """A finger chooses numbers: dispatches `on_pick(path, unit)`."""
    picked: ListProperty[str] = ListProperty()
    """Ways of those that are chosen."""
    folds = DictProperty()
    """Paths that a finger has opened (True) or folded (False)."""
    lines: ListProperty[Row] = ListProperty()
    """Rows of the tree, as `widgets.fields.message_fields.rows` gives them."""
    edges: ListProperty[float] = ListProperty([0.0])
    """Where each row begins from the top, and where the last one ends [px]."""

    def _length(self) -> float:
        return float(self.edges[-1])

    length = AliasProperty(_length, bind=["edges"], cache=True)
    """Height of the whole tree [px]."""

    def _margin(self) -> float:
        return float(dp(6)) if self.state == "alarm" else 0.0

    margin = AliasProperty(_margin, bind=["state"], cache=True)
    """Between the tree and the outline of an alarm [px]."""

    def _strip(self) -> float:
        return float(dp(28)) if self.state == "alarm" or self.badge else 0.0

    strip = AliasProperty(_strip, bind=["state", "badge"], cache=True)
    """Room above the tree for its age or the sign of an alarm [px], so that they hide nothing."""

    aged = BooleanProperty(True)
    """Shows its age; False where a widget beside it does."""

    def _badge(self) -> str:
        return age_text(self.age) if self.aged and self.state == "stale" else ""

    badge = AliasProperty(_badge, bind=["state", "age", "aged"], cache=True)

    def _badge_pos(self) -> tuple[float, float]:
        width, height = self.badge_size
        return self.right - width - dp(6), self.top - dp(14) - height / 2

    badge_pos = AliasProperty(_badge_pos, bind=["badge_size", "pos", "size"], cache=True)

    veils: ClassVar = {"stale": 0.3, "disabled": 0.5}
    """Thin: what is old is still to be read."""

    def _notice(self) -> str:
        if self.message is None:
            return "" if self.lines else tr("No message received yet.")
        return "" if self.lines else tr("This message has no fields.")

    notice = AliasProperty(_notice, bind=["message", "lines"], cache=True)

    def __init__(self, **kwargs: Any) -> None:
        self._pool: list[FieldRow] = []
        self._soon = Clock.create_trigger(self._renew, WRITE_PERIOD)
        self._at_once = Clock.create_trigger(self._renew, -1)
        self._place_soon = Clock.create_trigger(self._place, -1)
        self._write_soon = Clock.create_trigger(self._place, WRITE_PERIOD)
        super().__init__(**kwargs)
        self.fbind("message", self._on_news)
        for name in ("type", "folds", "size", "picks", "picked"):
            self.fbind(name, self._at_once)
        self.fbind("now", self._write_soon)
        theme.bind(target=self._follow_target)
        self.ids.scroll.bind(scroll_y=self._place_soon)
        self.ids.sheet.bind(pos=self._place_soon, size=self._place_soon)
        self._at_once()

    def _follow_target(self, *_: object) -> None:
        self._at_once()

    def show(self, msg: Msg) -> None:
        """Take over a message of any type."""
        self.message = msg

    def _on_news(self, *_: object) -> None:
        if not self.lines or self.message is None:
            self._at_once()
        else:
            self._soon()

    def fold(self, path: Path) -> None:
        """Open what is folded at `path`, or fold it: what has parts, and a text that is too long for its line."""
        row = next((row for row in self.lines if row.path == path), None)
        if row is not None and self._foldable(row):
            self.folds[path] = not row.open

    def _press(self, row: FieldRow) -> None:
        if row.picks:
            self.dispatch("on_pick", written(tuple(row.path)), row.unit)
        else:
            self.fold(row.path)

    def on_pick(self, path: str, unit: str) -> None:
        """A finger chose a number, by its way as of `widgets.core.field_paths`."""

    def _renew(self, *_: object) -> None:
        """Bring tree and figures up to the newest message."""
        message = self.message if self.message is not None else self.type() if self.type else None
        found = rows(message, self.folds) if message is not None else []
        if self.message is None:  # what has not come needs no second line
            found = [replace(row, kind=LEAF) if row.kind == ARRAY else row for row in found]
        heights = [self._height(row) for row in found]
        edges = [0.0, *accumulate(heights)]
        self.lines = found
        if edges != list(self.edges):
            self.edges = edges
        self._place()

    def _height(self, row: Row) -> float:
        if row.kind == BRANCH:
            return float(theme.target)
        if row.kind != ARRAY:
            return float(dp(38))
        if not self._foldable(row):
            return float(dp(60))
        room = self._room(row) - dp(22)
        whole = whole_height(describe(row)[1], sp(14), theme.font, room) if row.open else 0.0
        return max(float(theme.target), dp(60), dp(40) + whole)

    def _room(self, row: Row) -> float:
        """For the second line of a row that has no sign of folding before it [px]."""
        return float(self.ids.sheet.width - dp(10) - row.depth * self._step() - dp(12))

    def _step(self) -> float:
        return float(dp(16 if self.width > dp(NARROW) else 12))

    def _foldable(self, row: Row) -> bool:
        if row.kind == BRANCH or not row.long_text:
            return row.kind == BRANCH
        line = describe(replace(row, open=False))[1]
        whole = describe(replace(row, open=True))[1]
        return row.open or line != whole or line_width(line, sp(14), theme.font) > self._room(row)

    def _place(self, *_: object) -> None:
        """Lay rows where the eye is; those beyond the edges have no widget."""
        sheet, edges = self.ids.sheet, list(self.edges)
        over = max(0.0, edges[-1] - self.ids.scroll.height) * (1.0 - self.ids.scroll.scroll_y)
        first = max(0, bisect_right(edges, over) - 1)
        last = min(len(self.lines), bisect_left(edges, over + self.ids.scroll.height))
        shown = self.lines[first:last]
        self._fill_pool(len(shown))
        for widget, index in zip(self._pool, range(first, last), strict=False):
            widget.size = sheet.width, edges[index + 1] - edges[index]
            widget.pos = sheet.x, sheet.top - edges[index + 1]
            self._write(widget, self.lines[index])

    def _fill_pool(self, count: int) -> None:
        sheet = self.ids.sheet
        while len(self._pool) < count:
            row = FieldRow()
            row.bind(on_release=self._press)
            self._pool.append(row)
        for index, row in enumerate(self._pool):
            if index < count and row.parent is None:
                sheet.add_widget(row)
            elif index >= count and row.parent is not None:
                sheet.remove_widget(row)

    def _write(self, widget: FieldRow, row: Row) -> None:
        value, second = describe(row, self.now)
        if self.message is None and row.kind != BRANCH:
            value, second = DASH, ""
        if widget.path != row.path:
            widget.path, widget.widest = row.path, 0.0
        widget.kind, widget.depth = row.kind, row.depth
        widget.step = self._step()
        widget.foldable, widget.open = self._foldable(row), row.open
        widget.picks = self.picks and _is_number(row) and not widget.foldable
        widget.picked = widget.picks and written(tuple(row.path)) in self.picked
        widget.name, widget.type = row.name, row.type
        widget.value, widget.second, widget.unit = value, second, unit(row)
        widget.widest = max(widget.widest, text_width(value, sp(15), bold=True))


def _is_number(row: Row) -> bool:
    return row.kind == LEAF and isinstance(row.value, int | float)


def samples() -> dict[str, Callable[[], Widget]]:
    """Small and large messages, a type made at run time, every state."""
    from widgets.fields.field_samples import battery, cells, diagnostics, imu, log, nothing, picture, scan

    def make(message: Msg | None = None, size: tuple[str, str] = ("388dp", "560dp"), **kwargs: Any) -> Any:
        def build() -> Widget:
            view = FieldView(size_hint=(None, None), size=size, **kwargs)
            if message is not None:
                view.show(message)
            return view

        return build

    return {
        "imu": make(imu(), state="live", now=1763719271.2),
        "scan": make(scan(), state="live"),
        "diagnostics": make(diagnostics(), state="live", folds={("status", 0): True}),
        "learned": make(cells(), ("388dp", "300dp"), state="live"),
        "picture": make(picture(), ("388dp", "180dp"), state="live"),
        "text": make(log(), ("388dp", "420dp"), state="live", folds={("msg",): True}),
        "no fields": make(nothing(), ("388dp", "60dp"), state="live"),
        "wide": make(imu(), ("700dp", "420dp"), state="live"),
        "never": make(type=type(battery()), size=("388dp", "300dp")),
        "nothing known": make(size=("388dp", "120dp")),
        "stale": make(battery(), ("388dp", "300dp"), state="stale", age=12.0),
        "alarm": make(battery(), ("388dp", "300dp"), state="alarm"),
        "disabled": make(battery(), ("388dp", "300dp"), state="disabled"),
    }
