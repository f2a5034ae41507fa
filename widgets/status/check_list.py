"""Checks before a robot first moves: what is not good yet and what to do about it; folded, how many are good.

checks = CheckList(open=True)
robot.on("/checklist", checks.show)
checks.bind(on_fold=lambda _, unfold: setattr(checks, "open", unfold))
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.rows  # noqa: F401 - its rules draw what scrolls here
from bridge.core.codes import Code
from bridge.core.units import quantity_of
from bridge.msgs.pilothouse_msgs import Check, Checklist
from widgets.core.base import RobotWidget
from widgets.core.language import language, mark, tr
from widgets.core.quantities import quantity_words
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme

__all__ = ["SENTENCES", "CheckHead", "CheckLine", "CheckList", "words_of"]

LOOKS = {"ok": ("check_circle", "ok"), "bad": ("error", "danger"), "unknown": ("help", "warn")}
"""State of a check to its icon and role."""
SENTENCES: Mapping[str, str] = {
    Code.CHECK_BATTERY_UNKNOWN: mark("The battery has not reported its charge yet."),
    Code.CHECK_BATTERY_LOW: mark("The battery is below {needed}; charge it first."),
    Code.CHECK_BATTERY_GOOD: mark("The battery is charged."),
    Code.CHECK_SENSORS_SILENT: mark("No data from: {sensors}."),
    Code.CHECK_SENSORS_GOOD: mark("All sensors are alive."),
    Code.CHECK_POSITION_UNKNOWN: mark("The robot's position is unknown; place the robot on the map."),
    Code.CHECK_POSITION_UNSURE: mark(
        "The robot is not sure of its place: choose where it is, or place it on the map."
    ),
    Code.CHECK_POSITION_GOOD: mark("The robot knows where it is."),
    Code.CHECK_STOP_GOOD: mark("STOP was tested."),
    Code.CHECK_STOP_UNTESTED: mark("STOP was not tested since the start; press it once."),
    Code.CHECK_CLOCK_UNKNOWN: mark("No handheld has sent its clock yet."),
    Code.CHECK_CLOCK_AHEAD: mark(
        "The handheld's clock is {seconds} ahead of the robot's; connect it anew, or check the link."
    ),
    Code.CHECK_CLOCK_BEHIND: mark(
        "The handheld's clock is {seconds} behind the robot's; connect it anew, or check the link."
    ),
    Code.CHECK_CLOCK_GOOD: mark("The clocks agree."),
}
"""Codes of what a robot finds, to what they say."""

Builder.load_string("""
<CheckHead>:
    size_hint: None, None
    height: theme.target
    spacing: dp(9)
    Icon:
        name: root.icon
        role: root.role
        font_size: sp(22)
        pos_hint: {'center_y': .5}
    FittedLabel:
        id: words
        text: root.text
        bold: True
        largest: sp(15)
        room: root.room
        color: theme.text
        size_hint: None, None
        size: self.texture_size
        pos_hint: {'center_y': .5}
    Widget:
    Icon:
        name: root.arrow
        role: 'muted'
        font_size: sp(22)
        pos_hint: {'center_y': .5}

<CheckLine>:
    size_hint_y: None
    height: max(sentence.height, dp(22))
    spacing: dp(9)
    Icon:
        name: root.icon
        role: root.role
        font_size: sp(20)
        pos_hint: {'top': 1}
    Text:
        id: sentence
        text: root.text
        role: root.ink
        font_size: sp(14.5)
        pos_hint: {'top': 1}

<CheckList>:
    orientation: 'vertical'
    size_hint: None, None
    width: root.shown_width
    height: head.height + root.unfolded if root.total else 0
    padding: 0
    veil_radius: theme.corner
    rim: root.border if root.total else ''
    ground: 'surface' if root.total else ''
    rim_width: root.edge
    CheckHead:
        id: head
        icon: root.icon
        role: root.role
        text: root.title
        arrow: 'expand_less' if root.open else 'expand_more'
        padding: dp(13), 0, dp(10), 0
        room: max(root.wide - self.padding[0] - self.padding[2] - 2 * sp(22) - 3 * self.spacing, 1)
        width: root.width
        height: theme.target if root.total else 0
        opacity: 1 if root.total else 0
        disabled: not root.total
        on_release: root.dispatch('on_fold', not root.open)
    Roll:
        id: roll
        size_hint_y: None
        height: root.unfolded
        opacity: 1 if root.unfolded else 0
        bar_margin: dp(4)
        Column:
            id: lines
            spacing: dp(8)
            padding: dp(13), 0, dp(12), dp(12)
""")


class CheckHead(ButtonBehavior, BoxLayout):
    """The line that is always there; a finger folds and unfolds the rest."""

    icon = StringProperty("help")
    role = StringProperty("muted")
    text = StringProperty("")
    arrow = StringProperty("expand_more")
    room = NumericProperty(0)
    """How wide the words may be [px]."""


class CheckLine(BoxLayout):
    """One line of the list."""

    icon = StringProperty("help")
    role = StringProperty("muted")
    """Role of the icon's colour."""
    text = StringProperty("")
    ink = StringProperty("text")
    """Role of the sentence's colour."""


class CheckList(Outlined, RobotWidget, BoxLayout):
    """The list. A tap on its head dispatches `on_fold(unfold)`; the owner sets `open`."""

    accepts = (Checklist,)
    grid_size: ClassVar = (4, 4)
    __events__ = ("on_fold",)

    open = BooleanProperty(False)
    """Says each sentence; folded it is one line."""
    brief = BooleanProperty(False)
    """Only what is not good is listed, where there is little room."""
    checks: ListProperty[Check] = ListProperty()
    """As they came, of `Check`; empty before the first list, and then nothing is drawn."""
    wide = NumericProperty("330dp")
    """As wide as it is unfolded [px]; folded it is as wide as its words, so that fingers beside it reach what is below."""
    room = NumericProperty(0)
    """As high as it may be [px]: what is more scrolls; 0 for any height."""

    def _total(self) -> int:
        return len(self.checks)

    total = AliasProperty(_total, bind=["checks"], cache=True)

    def _good(self) -> int:
        return sum(check.state == "ok" for check in self.checks)

    good = AliasProperty(_good, bind=["checks"], cache=True)
    """How many are good."""

    def _ready(self) -> bool:
        return self.good == self.total > 0

    ready = AliasProperty(_ready, bind=["checks"], cache=True)
    """All is good."""

    def _appearance(self) -> tuple[str, str]:
        if self.ready:
            return LOOKS["ok"]
        return LOOKS["bad" if any(check.state == "bad" for check in self.checks) else "unknown"]

    icon = AliasProperty(lambda self: self._appearance()[0], bind=["checks"], cache=True)
    role = AliasProperty(lambda self: self._appearance()[1], bind=["checks"], cache=True)

    def _border(self) -> str:
        return "line" if self.ready else self.role

    border = AliasProperty(_border, bind=["checks"], cache=True)

    def _edge(self) -> float:
        return 1.0 if self.ready else 1.5

    edge = AliasProperty(_edge, bind=["checks"], cache=True)
    """Width of the border [px]."""

    def _title(self) -> str:
        if self.ready:
            return tr("Checks good") if self.open else tr("Checks")
        count = tr("{good} of {total}").format(good=self.good, total=self.total)
        return (
            tr("Before it moves: {count} good").format(count=count)
            if self.open and self.wide > dp(300)
            else tr("Checks: {count}").format(count=count)
        )

    title = AliasProperty(_title, bind=["checks", "open", "wide"], cache=True)

    def _unfolded(self) -> float:
        if not (self.open and self.total):
            return 0.0
        most = self.room - theme.target if self.room else self._lines_height
        return max(0.0, min(self._lines_height, most))

    _lines_height = NumericProperty(0)
    _folded_width = NumericProperty(0)
    unfolded = AliasProperty(_unfolded, bind=["open", "checks", "room", "_lines_height"], cache=True)
    """Height of the sentences [px]; 0 while folded."""

    def _shown_width(self) -> float:
        if not self.total:
            return 0.0
        return float(self.wide if self.open else min(self.wide, self._folded_width))

    shown_width = AliasProperty(_shown_width, bind=["open", "checks", "wide", "_folded_width"], cache=True)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.bind(checks=self._write, brief=self._write)
        self.ids.lines.bind(height=lambda _, height: setattr(self, "_lines_height", height))
        self.ids.head.ids.words.bind(width=self._widen)

    def _widen(self, _: object, width: float) -> None:
        head = self.ids.head
        self._folded_width = width + head.padding[0] + head.padding[2] + 2 * sp(22) + 3 * head.spacing

    def show(self, msg: Checklist) -> None:
        """Take over the list."""
        self.checks = list(msg.checks)

    def on_fold(self, unfold: bool) -> None:
        """A finger wants it unfolded, or folded."""

    def _write(self, *_: object) -> None:
        """What is not good by its sentence, the worst first; what is good by its name, or all of it where all is."""
        lines = self.ids.lines
        lines.clear_widgets()
        if self.ready:
            for check in self.checks:
                lines.add_widget(_line(check.state, words_of(check), "muted"))
            return
        for state in ("bad", "unknown"):
            for check in self.checks:
                if _state(check) == state:
                    lines.add_widget(
                        _line(
                            state,
                            words_of(check) or tr("The {name} is not good.").format(name=_name(check)),
                            "text",
                        )
                    )
        good = [_name(check) for check in self.checks if check.state == "ok"]
        if good and not self.brief:
            lines.add_widget(_line("ok", tr("Good: {good}.").format(good=", ".join(good)), "muted"))


def _name(check: Check) -> str:
    names = {
        "battery": tr("battery", context="check"),
        "sensors": tr("sensors", context="check"),
        "position": tr("position", context="check"),
        "stop": tr("stop", context="check"),
        "clock": tr("clock", context="check"),
    }
    return names.get(check.name, check.name)


def words_of(check: Check) -> str:
    """What a robot found, in the language of the glass; its own words where it gives no code, or one that is not known here."""
    words = SENTENCES.get(check.code, "")
    if not words or language.name == "en":
        return check.text
    values = {pair.key: pair.value for pair in check.parameters}
    try:
        return tr(words).format_map({key: _shown(check.code, key, values) for key in values})
    except (KeyError, IndexError, ValueError):  # a robot that leaves out what its code should name
        return check.text


def _shown(code: str, key: str, values: Mapping[str, str]) -> str:
    kind = quantity_of(code, key, values)
    return quantity_words(float(values[key]), kind) if kind else values[key]


def _state(check: Check) -> str:
    """An unknown state is not good."""
    return check.state if check.state in LOOKS else "unknown"


def _line(state: str, text: str, ink: str) -> CheckLine:
    icon, role = LOOKS[state]
    return CheckLine(icon=icon, role=role, text=text, ink=ink)


GOOD = (
    Check("battery", "ok", "The battery is charged."),
    Check("sensors", "ok", "All sensors are alive."),
    Check("position", "ok", "The robot knows where it is."),
    Check("stop", "ok", "STOP was tested."),
    Check("clock", "ok", "The clocks agree."),
)
"""A list on which all is good."""
UNTESTED = Check("stop", "unknown", "STOP was not tested since the start; press it once.")


def samples() -> dict[str, Callable[[], Widget]]:
    """One to be done, several bad, all good, each folded and unfolded; before the first list there is nothing to see."""
    bad = (
        Check("battery", "bad", "The battery is below 20%; charge it first."),
        Check("sensors", "bad", "No data from: /scan, /imu/data."),
        Check("position", "unknown", "The robot's position is unknown; place the robot on the map."),
        UNTESTED,
        GOOD[4],
    )

    def make(checks: Sequence[Check], *, open_: bool = True, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            made = CheckList(open=open_, **{"state": "live", **kwargs})
            made.show(Checklist(checks=list(checks)))
            return made

        return build

    untested = (*GOOD[:3], UNTESTED, GOOD[4])
    return {
        "live": make(untested),
        "live folded": make(untested, open_=False),
        "bad": make(bad),
        "bad narrow": make(bad, wide="214dp"),
        "bad brief": make(bad, brief=True),
        "bad folded": make(bad, open_=False),
        "good": make(GOOD),
        "good folded": make(GOOD, open_=False),
        "stale": make(untested, state="stale", age=12.0),
        "disabled": make(untested, state="disabled"),
    }
