"""Row of an event: an icon, one sentence, who acknowledged it, and its age."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import UTC, datetime
from functools import lru_cache
from typing import Any

from kivy.core.text import Label as CoreLabel
from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import BooleanProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.recycleview.views import RecycleDataViewBehavior
from kivy.uix.widget import Widget

import widgets.parts.buttons
import widgets.parts.column  # noqa: F401 - their rules draw a row
from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Event
from widgets.core.language import tr
from widgets.core.task_words import DAYS, MONTHS
from widgets.core.theme import theme
from widgets.parts.labels import Text

__all__ = ["EventHead", "EventRow", "ago", "is_open", "appearance", "note", "row_height", "when_words"]

KINDS = {
    "waypoint": ("flag", "plan"),
    "intruder": ("warning", "danger"),
    "task": ("play_arrow", "ok"),
    "command": ("check_circle", "ok"),
    "mission": ("edit_location_alt", "muted"),
    "contact": ("crisis_alert", "danger"),
    "battery": ("battery_alert", "warn"),
    "control": ("person", "accent"),
    "stop": ("pan_tool", "danger"),
    "localisation": ("my_location", "accent"),
}
"""Kind of an event to its icon and the role of its colour."""

_PAUSES = (
    Code.TASK_PAUSED,
    Code.TASK_STAYS,
    Code.TASK_TAKEN_OVER,
    Code.TASK_LINK_LOST,
    Code.TASK_OVERTURNED,
    Code.TASK_SENSOR_SILENT,
    Code.TASK_HELD_FAST,
    Code.TASK_BUMPED,
    Code.TASK_INTRUDER,
    Code.TASK_ROBOT_LOST,
)
_ENDS = (
    Code.TASK_REPLACED,
    Code.TASK_CANCELED,
    Code.TASK_DISCARDED,
    Code.TASK_ASKER_GONE,
    Code.TASK_RESET,
    Code.TASK_ROBOT_ENDS,
    Code.TASK_FAULT,
)
CODES: dict[str, str] = {
    Code.TASK_STARTED: "play_arrow",
    Code.TASK_RESUMED: "play_arrow",
    Code.TASK_GOES_ON: "play_arrow",
    Code.TASK_STOPPED: "pan_tool",
    Code.TASK_DONE: "check_circle",
    **dict.fromkeys(_PAUSES, "pause"),
    **dict.fromkeys(_ENDS, "stop"),
    Code.STOP_RELEASED: "lock_open",
}
"""Code of an event to the icon of what happened, where its kind says less."""

_GOES_HOME = KeyValue("task", "go_home")

LEVELS = {"warn": "warn", "alarm": "danger"}
"""Levels that bring their own role."""

BUTTON = 78
"""Width of the button of a row that needs an acknowledgement [dp]."""
PICTURE = 60
"""Width of a picture and its margin [dp]."""
BESIDE = 81
"""Of a row beside its sentence, its icon and its button [dp]."""

Builder.load_string("""
<EventRow>:
    size_hint_y: None
    padding: dp(8), 0, dp(7), 0
    spacing: dp(8)
    canvas.before:
        Rounded:
            rgba: theme.accent if root.missed else (0, 0, 0, 0)
            pos: self.x, self.y + dp(3)
            size: dp(4), max(dp(8), self.height - dp(6))
            radius: [dp(2)]
    Icon:
        name: root.icon
        role: root.role
        font_size: sp(20)
        pos_hint: {'center_y': .5}
    Image:
        texture: root.texture
        size_hint: None, None
        size: (dp(52), dp(46)) if root.texture else (0, 0)
        opacity: 1 if root.texture else 0
        fit_mode: 'contain'
        pos_hint: {'center_y': .5}
    Column:
        pos_hint: {'center_y': .5}
        Text:
            text: root.text
            bold: root.open
            font_size: sp(14.5)
        Remark:
            text: root.note
            font_size: sp(12.5)
            shorten: True
            shorten_from: 'right'
    Label:
        text: root.when
        font_name: theme.font
        font_size: sp(13)
        color: theme.muted
        disabled_color: self.color
        size_hint_x: None
        width: dp(50)
        text_size: self.size
        halign: 'right'
        valign: 'middle'
    QuietButton:
        text: tr('Seen') if root.act else ''
        icon: ''
        size_hint_x: None
        width: dp(70) if root.act else 0
        opacity: 1 if root.act else 0
        disabled: not root.act
        pos_hint: {'center_y': .5}
        on_release: root.acknowledge()

<EventHead>:
    role: 'accent'
    bold: True
    font_size: sp(14)
    size_hint_y: None
    shorten: True
    shorten_from: 'right'
    valign: 'middle'
    text_size: self.size
""")


def is_open(event: Event) -> bool:
    """Whether it needs an acknowledgement and has none."""
    return event.level in LEVELS and not event.acknowledged_by


def appearance(event: Event) -> tuple[str, str]:
    """Icon and role of an event: by its kind and its code, the role by its level where that is grave."""
    name, role = KINDS.get(event.kind, ("info", "muted"))
    name = CODES.get(event.code, name)
    if event.code in (Code.TASK_STARTED, Code.TASK_DONE) and _GOES_HOME in event.parameters:
        name = "home"
    if event.kind == "stop" and event.level == "ok":
        role = "ok"
    if event.kind == "command" and event.level in LEVELS:
        name = "block"
    return name, LEVELS.get(event.level, role)


def ago(seconds: float) -> str:
    """How long ago, with its unit: `now` for less than 2 s, then `40 s`, `5 min`, `2 h`, `3 d`; empty for NaN."""
    if not math.isfinite(seconds):
        return ""
    whole = max(0, int(seconds))
    if whole < 2:
        return "now"
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min"
    return f"{whole // 3600} h" if whole < 48 * 3600 else f"{whole // 86400} d"


def when_words(stamp: float, now: float, *, brief: bool = False) -> str:
    """When it was: for an hour how long ago, then the time of day and the day before it when that is another one.

    As in `5 min`, `14:05`, `Mon 14:05` or `12 Nov 14:05`; of another day that alone where it is to be `brief`. Both are
    seconds since 1970; NaN for a `now` that is not known. Empty for a `stamp` of NaN.
    """
    if not math.isfinite(stamp):
        return ""
    if now - stamp < 3600:
        return ago(now - stamp)
    then = datetime.fromtimestamp(stamp, UTC).astimezone()
    if math.isnan(now) or datetime.fromtimestamp(now, UTC).astimezone().date() == then.date():
        return f"{then:%H:%M}"
    day = (
        tr(DAYS[then.weekday()])
        if now - stamp < 6 * 86400
        else tr("{day} {month}", "date").format(day=then.day, month=tr(MONTHS[then.month - 1]))
    )
    return day if brief else f"{day} {then:%H:%M}"


def note(event: Event, *, asked: bool = False) -> str:
    """Who acknowledged it and at what time of day; empty while no one has. `asked` while that is being sent to the robot."""
    if event.acknowledged_by:
        then = event.acknowledged.seconds
        clock = f", {datetime.fromtimestamp(then, UTC).astimezone():%H:%M}" if then > 0 else ""
        return tr("Seen by {acknowledged_by}{clock}").format(
            acknowledged_by=event.acknowledged_by, clock=clock
        )
    return tr("Sending to the robot …") if asked else ""


@lru_cache(maxsize=2000)
def _advance(letter: str, font_size: float, bold: bool) -> float:
    label = CoreLabel(font_name=theme.font, font_size=font_size, bold=bold)
    return float(label.get_extents(letter)[0])


@lru_cache(maxsize=12000)
def text_height(text: str, width: float, font_size: float, bold: bool) -> float:
    """Height of a sentence that is broken into lines `width` long; all in pixels."""
    if sum(_advance(letter, font_size, bold) for letter in text) < 0.94 * width:
        return float(dp(22))  # laying out thousands of short ones takes seconds
    label = CoreLabel(
        text=text, font_name=theme.font, font_size=font_size, bold=bold, text_size=(width, None)
    )
    label.refresh()
    return float(label.texture.height)


def row_height(
    event: Event, width: float, *, says: str = "", acts: bool = False, pictured: bool = False
) -> float:
    """Height of an event's row in a list of `width`; `says` is its second line, `acts` has a button. All in pixels."""
    open = is_open(event)
    beside = dp(BUTTON) if acts else dp(8)
    room = max(dp(60), width - sp(20) - dp(BESIDE) - beside - (dp(PICTURE) if pictured else 0))
    high = text_height(event.text, room, sp(14.5), open) + (sp(18) if says else 0) + dp(8)
    return float(max(dp(54 if pictured else 30), high, theme.target + dp(4) if acts else 0))


class EventRow(RecycleDataViewBehavior, BoxLayout):
    """One event."""

    icon = StringProperty("info")
    role = StringProperty("muted")
    """Role of the icon's colour."""
    text = StringProperty("")
    note = StringProperty("")
    """Who acknowledged it; empty for no one."""
    stamp = NumericProperty(math.nan)
    """When it happened [s]."""
    when = StringProperty("")
    open = BooleanProperty(False)
    """Somebody has to see to it."""
    missed = BooleanProperty(False)
    """It happened while this handheld was not connected."""
    texture: ObjectProperty[Texture | None] = ObjectProperty(None, allownone=True)
    """Picture of what it tells; None without one."""
    act: ObjectProperty[Callable[[], object] | None] = ObjectProperty(None, allownone=True)
    """Called when a finger acknowledges it; None where that is not possible."""

    def refresh_view_attrs(self, rv: Any, index: int, data: dict[str, Any]) -> None:
        """Take over a row of the list."""
        super().refresh_view_attrs(rv, index, data)
        self.update(rv.now)

    def update(self, now: float) -> None:
        """Say when it was, at `now` [s]; nothing while that is not known."""
        self.when = when_words(self.stamp, now, brief=True)

    def acknowledge(self) -> None:
        """A finger acknowledges it."""
        if self.act is not None:
            self.act()


class EventHead(RecycleDataViewBehavior, Text):
    """A line between events."""

    def update(self, now: float) -> None:
        """It has no time."""


def samples() -> dict[str, Callable[[], Widget]]:
    """An event without acknowledgement, an acknowledged one, a missed one."""

    def make(**kwargs: Any) -> Callable[[], Widget]:
        return lambda: EventRow(size_hint_x=None, width="340dp", height="60dp", when="12 s", **kwargs)

    grave = {"icon": "warning", "role": "danger", "text": "Intruder at 12.4 m, bearing 131°"}
    return {
        "event": make(icon="flag", role="plan", text="Waypoint 2 reached"),
        "event open": make(**grave, open=True, act=lambda: None),
        "event asked": make(**grave, open=True, note="Sending to the robot \u2026"),
        "event seen": make(**grave, note="Seen by Anna, 14:05"),
        "event missed": make(**grave, open=True, missed=True, act=lambda: None),
    }
