"""Events, newest first: an icon, one sentence, their age, and who acknowledged them.

log = EventLog()
robot.on("/events", log.show)
log.bind(on_command=lambda _, event: print(f"somebody has seen to {event.text}"))
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    DictProperty,
    ListProperty,
    NumericProperty,
    StringProperty,
)
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.recycleview import RecycleView
from kivy.uix.widget import Widget

from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time
from widgets.core.base import RobotWidget
from widgets.core.language import tr
from widgets.status.event_row import ago, appearance, is_open, note, row_height

__all__ = ["EventLog", "ago", "appearance"]

MAX_EVENTS = 200
"""Events that are kept by default."""

Builder.load_string("""
<EventLog>:
    Text:
        text: root.notice
        role: 'muted'
        font_size: sp(15)
        pos_hint: {'x': 0, 'top': 1}
    EventView:
        id: view
        key_viewclass: 'viewclass'
        now: root.now
        size_hint: None, None
        size: root.width - 2 * root.margin, root.height - root.margin - root.strip
        pos: root.x + root.margin, root.y + root.margin
        bar_width: dp(3)
        bar_color: theme.muted
        bar_inactive_color: theme.line
        scroll_type: ['bars', 'content']
        RecycleBoxLayout:
            id: rows
            orientation: 'vertical'
            size_hint_y: None
            height: self.minimum_height
            default_size: None, dp(30)
            default_size_hint: 1, None
            key_size: 'row_size'
""")


class EventView(RecycleView):
    """The rows in sight."""

    now = NumericProperty(math.nan)
    """As of the log [s]."""


class EventLog(RobotWidget, FloatLayout):
    """A list of the newest events. An event that is shown twice, by its run and number, is one.

    With `acts` each one that needs an acknowledgement can be pressed: dispatches `on_command(event)`.
    """

    accepts = (Event,)
    grid_size: ClassVar = (6, 4)

    __events__ = ("on_command",)

    most = NumericProperty(MAX_EVENTS)
    """Events that are kept."""
    now = NumericProperty(math.nan)
    """The robot's clock [s]; NaN leaves the times away."""
    count = NumericProperty(0)
    """Events in the list."""
    acts = BooleanProperty(False)
    """A finger can say that one has been seen to."""
    asked: ListProperty[tuple[str, int]] = ListProperty()
    """Run and number of those whose acknowledgement is being sent to the robot."""
    missed: ListProperty[tuple[str, int]] = ListProperty()
    """Run and number of those that happened while this handheld was not connected."""
    pictures: DictProperty[tuple[str, int], Texture] = DictProperty({})
    """By run and number, the picture of what an event tells."""
    head = StringProperty("")
    """Words above the newest of those; empty for none."""

    def _notice(self) -> str:
        return "" if self.count else tr("No events yet.")

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
        self._events: dict[tuple[str, int], Event] = {}
        self._order: list[tuple[float, int, str]] = []
        """Newest first, by what `_place` says."""
        self._soon = Clock.create_trigger(self._write, -1)
        super().__init__(**kwargs)
        self.bind(now=self._write_times)
        for name in ("width", "margin", "acts", "asked", "missed", "head", "pictures"):
            self.fbind(name, self._soon)

    def show(self, msg: Event) -> None:
        """Put an event where it belongs: newest first. One that is there already is brought up to date."""
        key = msg.boot, msg.id
        before = self._events.get(key)
        if before == msg:
            return
        if before is None:
            place = _place(msg)
            self._order.insert(bisect_left(self._order, place), place)
        self._events[key] = msg
        while len(self._order) > self.most:
            _, number, boot = self._order.pop()
            del self._events[boot, -number]
        self.count = len(self._order)
        self._soon()

    def show_all(self, events: Iterable[Event]) -> None:
        """Show these, in any order."""
        for event in events:
            self.show(event)

    def clear(self) -> None:
        """Forget everything, as when another robot is connected."""
        self._events.clear()
        self._order.clear()
        self.count = 0
        self._soon()

    @property
    def events(self) -> tuple[Event, ...]:
        """What is in the list, newest first."""
        return tuple(self._events[boot, -number] for _, number, boot in self._order)

    def on_command(self, event: Event) -> None:
        """A finger acknowledges it."""

    def _row(self, event: Event, asked: set[tuple[str, int]], missed: set[tuple[str, int]]) -> dict[str, Any]:
        key, open = (event.boot, event.id), is_open(event)
        name, role = appearance(event)
        says, acts = note(event, asked=key in asked), self.acts and open and key not in asked
        picture = self.pictures.get(key)
        high = row_height(
            event, self.width - 2 * self.margin, says=says, acts=acts, pictured=picture is not None
        )
        return {
            "viewclass": "EventRow",
            "icon": name,
            "role": role,
            "text": event.text,
            "note": says,
            "stamp": event.stamp.seconds,
            "open": open,
            "missed": key in missed,
            "texture": picture,
            "act": partial(self.dispatch, "on_command", event) if acts else None,
            "row_size": (None, high),
        }

    def _write(self, *_: object) -> None:
        asked = {(run, number) for run, number in self.asked}
        missed = {(run, number) for run, number in self.missed}
        rows = [self._row(event, asked, missed) for event in self.events]
        first = next((index for index, row in enumerate(rows) if row["missed"]), None)
        if self.head and first is not None:
            rows.insert(first, {"viewclass": "EventHead", "text": self.head, "row_size": (None, dp(34))})
        self.ids.view.data = rows

    def _write_times(self, *_: object) -> None:
        for row in self.ids.rows.children:
            row.update(self.now)


def _place(event: Event) -> tuple[float, int, str]:
    return -event.stamp.seconds, -event.id, event.boot


def _sample(
    number: int, stamp: int, level: str, kind: str, text: str, code: str = "", task: str = ""
) -> Event:
    parameters = [KeyValue("task", task)] if task else []
    return Event(
        id=number, stamp=Time(stamp), level=level, kind=kind, text=text, code=str(code), parameters=parameters
    )


STORY = [
    _sample(1, 100, "info", "mission", "6 waypoints sent, stored on robot"),
    _sample(2, 138, "ok", "command", "Accepted: start patrol (18 ms)"),
    _sample(3, 138, "info", "task", "Patrol started · loop · 6 points", Code.TASK_STARTED),
    _sample(4, 179, "info", "waypoint", "Waypoint 2 reached"),
    _sample(5, 196, "warn", "battery", "Battery at 34 %, enough for about 51 min"),
    _sample(6, 199, "alarm", "intruder", "Intruder at 12.4 m, bearing 131°"),
]

ORDERS = [
    _sample(1, 150, "info", "task", "Patrol resumed.", Code.TASK_RESUMED),
    _sample(2, 152, "info", "task", "Paused by tablet-B.", Code.TASK_PAUSED),
    _sample(3, 154, "alarm", "stop", "STOP pressed by tablet-B.", Code.STOP_PRESSED),
    _sample(4, 156, "ok", "stop", "STOP released by tablet-B.", Code.STOP_RELEASED),
    _sample(5, 158, "info", "task", "Going home.", Code.TASK_STARTED, task="go_home"),
    _sample(6, 160, "info", "task", "Patrol ended: go home was requested instead.", Code.TASK_REPLACED),
]
"""Events of the samples, oldest first."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Empty, and a patrol's events in every state."""

    def make(story: list[Event] = STORY, high: str = "190dp", **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            log = EventLog(size_hint=(None, None), size=("330dp", high), **kwargs)
            if log.state != "never":
                for event in story:
                    log.show(event)
                log.now = 200.0
            return log

        return build

    return {
        "never": make(),
        "live": make(state="live"),
        "orders": make(ORDERS, state="live"),
        "to be seen": make(high="280dp", state="live", acts=True),
        "missed": make(
            high="280dp",
            state="live",
            acts=True,
            missed=[("", 5), ("", 6)],
            asked=[("", 5)],
            head="2 while you were away",
        ),
        "stale": make(state="stale", age=65.0),
        "alarm": make(state="alarm"),
        "disabled": make(state="disabled"),
    }
