"""What happened, newest first: an icon, one sentence, how long ago.

log = EventLog()
robot.on("/events", log.show)
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import lru_cache
from typing import Any

from kivy.core.text import Label as CoreLabel
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.recycleview.views import RecycleDataViewBehavior
from kivy.uix.widget import Widget

import widgets.labels  # noqa: F401 - its rules draw the rows
from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time
from widgets.base import RobotWidget

__all__ = ["EventLog", "EventRow", "ago", "look"]

MOST = 200
"""Events that are kept."""

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

WORDS = {
    "started": "play_arrow",
    "resumed": "play_arrow",
    "paused": "pause",
    "stopped": "pan_tool",
    "released": "lock_open",
    "home": "home",
    "ended": "stop",
    "cancelled": "stop",
    "canceled": "stop",
    "finished": "check_circle",
    "done": "check_circle",
}
"""Words in a sentence about a task or about STOP to the icon of what happened; the first one counts."""

LEVELS = {"warn": "warn", "alarm": "danger"}
"""Levels that bring their own role."""

Builder.load_string("""
<EventRow>:
    size_hint_y: None
    padding: 0, 0, dp(7), 0
    spacing: dp(8)
    Icon:
        name: root.icon
        role: root.role
        font_size: sp(20)
        pos_hint: {'center_y': .5}
    Text:
        text: root.text
        font_size: sp(14.5)
        pos_hint: {'center_y': .5}
    Label:
        text: root.when
        font_name: theme.font
        font_size: sp(13)
        color: theme.muted
        disabled_color: self.color
        size_hint_x: None
        width: dp(38)
        text_size: self.size
        halign: 'right'
        valign: 'middle'

<EventLog>:
    Text:
        text: root.notice
        role: 'muted'
        font_size: sp(15)
        pos_hint: {'x': 0, 'top': 1}
    RecycleView:
        id: view
        viewclass: 'EventRow'
        size_hint: None, None
        size: root.width - 2 * root.margin, root.height - root.margin - root.strip
        pos: root.x + root.margin, root.y + root.margin
        bar_width: dp(3)
        bar_color: theme.muted
        bar_inactive_color: theme.line
        scroll_type: ['bars', 'content']
        RecycleBoxLayout:
            orientation: 'vertical'
            size_hint_y: None
            height: self.minimum_height
            default_size: None, dp(30)
            default_size_hint: 1, None
            key_size: 'row_size'
""")


def look(event: Event) -> tuple[str, str]:
    """Icon and role of an event: by its kind and its words, the role by its level where that is grave."""
    name, role = KINDS.get(event.kind, ("info", "muted"))
    if event.kind in ("task", "stop"):
        said = (WORDS[word] for word in re.findall("[a-z]+", event.text.lower()) if word in WORDS)
        name = next(said, name)
    if event.kind == "stop" and event.level == "ok":
        role = "ok"
    if event.kind == "command" and event.level in LEVELS:
        name = "block"
    return name, LEVELS.get(event.level, role)


def ago(seconds: float) -> str:
    """How long ago: `now` for less than 2 s, minutes and seconds, then hours; empty for NaN."""
    if not math.isfinite(seconds):
        return ""
    whole = max(0, int(seconds))
    if whole < 2:
        return "now"
    return f"{whole // 60}:{whole % 60:02d}" if whole < 3600 else f"{whole // 3600} h"


@lru_cache(maxsize=2 * MOST)
def row_height(text: str, width: float, font_size: float) -> float:
    """Height of a row whose sentence is broken into lines `width` long; all in pixels."""
    label = CoreLabel(text=text, font_name="B612", font_size=font_size, text_size=(width, None))
    label.refresh()
    return max(dp(30), label.texture.height + dp(8))


class EventRow(RecycleDataViewBehavior, BoxLayout):
    """One event."""

    icon = StringProperty("info")
    role = StringProperty("muted")
    """Role of the icon's colour."""
    text = StringProperty("")
    when = StringProperty("")


class EventLog(RobotWidget, FloatLayout):
    """A list of the newest events. An event that is shown twice, by its run and number, is one."""

    accepts = (Event,)

    now = NumericProperty(math.nan)
    """The robot's clock [s]; NaN leaves the times away."""
    count = NumericProperty(0)
    """Events in the list."""

    def _notice(self) -> str:
        return "" if self.count else "Nothing has happened yet."

    notice = AliasProperty(_notice, bind=["count"], cache=True)

    def _strip(self) -> float:
        return float(dp(34)) if self.state in ("stale", "alarm") else 0.0

    strip = AliasProperty(_strip, bind=["state"], cache=True)
    """Room above the list for the age or the sign of an alarm [px], so that they hide nothing."""

    def _margin(self) -> float:
        return float(dp(8)) if self.state == "alarm" else 0.0

    margin = AliasProperty(_margin, bind=["state"], cache=True)
    """Between the list and the outline of an alarm [px]."""

    def _badge_pos(self) -> tuple[float, float]:
        width, height = self.badge_size
        return self.right - width - dp(2), self.top - self.strip / 2 - height / 2

    badge_pos = AliasProperty(_badge_pos, bind=["badge_size", "strip", "pos", "size"], cache=True)
    """The age stands in the strip above the list."""

    def __init__(self, **kwargs: Any) -> None:
        self._events: list[Event] = []
        super().__init__(**kwargs)
        self.bind(now=self._write_times, width=self._rewrite, margin=self._rewrite)

    def show(self, msg: Event) -> None:
        """Put an event where it belongs: newest first."""
        if any(msg.id == event.id and msg.boot == event.boot for event in self._events):
            return
        place = next(
            (i for i, event in enumerate(self._events) if _order(event) <= _order(msg)), len(self._events)
        )
        self._events.insert(place, msg)
        del self._events[MOST:]
        self.count = len(self._events)
        self._write()

    def clear(self) -> None:
        """Forget everything, as when another robot is connected."""
        self._events.clear()
        self.count = 0
        self._write()

    @property
    def events(self) -> tuple[Event, ...]:
        """What is in the list, newest first."""
        return tuple(self._events)

    def _rewrite(self, *_: object) -> None:
        self._write()

    def _row(self, event: Event) -> dict[str, Any]:
        name, role = look(event)
        height = row_height(event.text, max(dp(60), self.width - 2 * self.margin - sp(20) - dp(61)), sp(14.5))
        when = ago(self.now - event.stamp.seconds)
        return {"icon": name, "role": role, "text": event.text, "when": when, "row_size": (None, height)}

    def _write(self) -> None:
        self.ids.view.data = [self._row(event) for event in self._events]

    def _write_times(self, *_: object) -> None:
        rows = self.ids.view.data
        fresh = [ago(self.now - event.stamp.seconds) for event in self._events]
        if fresh != [row["when"] for row in rows]:
            self._write()


def _order(event: Event) -> tuple[float, int]:
    return event.stamp.seconds, event.id


def samples() -> dict[str, Callable[[], Widget]]:
    """Empty, and a patrol's events in every state."""
    story = [
        (100, "info", "mission", "6 waypoints sent, stored on robot"),
        (138, "ok", "command", "Accepted: start patrol (18 ms)"),
        (138, "info", "task", "Patrol started · loop · 6 points"),
        (179, "info", "waypoint", "Waypoint 2 reached"),
        (196, "warn", "battery", "Battery at 34 %, enough for about 51 min"),
        (199, "alarm", "intruder", "Intruder at 12.4 m, bearing 131°"),
    ]

    words = [
        (150, "info", "task", "Patrol resumed."),
        (152, "info", "task", "Paused by tablet-B."),
        (154, "alarm", "stop", "STOP pressed by tablet-B."),
        (156, "ok", "stop", "STOP released by tablet-B."),
        (158, "info", "task", "Going home."),
        (160, "info", "task", "Patrol ended: go home was asked for instead."),
    ]

    def make(story: list[tuple[int, str, str, str]] = story, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            log = EventLog(size_hint=(None, None), size=("330dp", "190dp"), **kwargs)
            if log.state != "never":
                for number, (stamp, level, kind, text) in enumerate(story):
                    log.show(Event(id=number + 1, stamp=Time(stamp), level=level, kind=kind, text=text))
                log.now = 200.0
            return log

        return build

    return {
        "never": make(),
        "live": make(state="live"),
        "orders": make(words, state="live"),
        "stale": make(state="stale", age=65.0),
        "alarm": make(state="alarm"),
        "disabled": make(state="disabled"),
    }
