"""The small sensors of the drive screen: a card where there is room, elsewhere a strip that a tap unfolds."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from typing import Any

from kivy.metrics import dp
from kivy.properties import BooleanProperty

from app.layout.arrange import Rect
from app.link.feeds import Feeds
from app.screens.parts.placing import put
from bridge.msgs import Msg
from widgets.parts.kit import Card, Icon
from widgets.parts.sensor_card import Gauge

__all__ = ["SmallSensors"]

log = logging.getLogger(__name__)

LARGEST = 0.47
"""Share of the open card's width that the first sensor has."""
SECOND = 0.42
"""Share of the height that the upper one of two beside it has."""
MIN_WIDTH = 62
"""Width that a sensor needs on the strip; one that is too narrow shows the first ones only [dp]."""
ALIKE = 1.0
"""Ages that differ by less are the same [s]."""
HANDLE = 26
"""Width of the sign that says a strip unfolds [dp]."""


class SmallSensors(Card):
    """Shows those of its sensors that the robot has; without any there is nothing on the glass."""

    open = BooleanProperty(False)
    """Unfolded by a finger."""

    def __init__(self, feeds: Feeds, **kwargs: Any) -> None:
        super().__init__(**{"floating": True, "padding": 0, "size_hint": (None, None), **kwargs})
        self._feeds = feeds
        self._makers: list[tuple[Callable[[], Gauge], tuple[str, ...]]] = []
        """Of every sensor that the robot may have, with its topics; in the layout's order."""
        self._made: dict[int, Gauge] = {}
        """Those that it has told something of, by their places in `_makers`."""
        self._broken: set[int] = set()
        """Those that could not be made."""
        self.shown: tuple[Gauge, ...] = ()
        """What the robot has told something of, in the layout's order."""
        self._newest: dict[str, Msg] = {}
        """What is shown, by topic."""
        self._places: tuple[Rect, Rect] | None = None
        self._sign = Icon(name="expand_more", role="muted", size_hint=(None, None))
        self._finger: Any = None

    def add(self, make: Callable[[], Gauge], topics: tuple[str, ...]) -> None:
        """Have one more sensor, which shows what comes on `topics`; it is made when something has come."""
        self._makers.append((make, topics))

    @property
    def foldable(self) -> bool:
        """There is no room for it to be always open."""
        return self._places is not None and self._places[0] != self._places[1]

    @property
    def folded(self) -> bool:
        """It is a strip now."""
        return self.foldable and not self.open

    @property
    def covers(self) -> bool:
        """It is unfolded over something else."""
        return self.foldable and self.open and bool(self.shown)

    def place(self, folded: Rect, unfolded: Rect) -> None:
        """Take its place on the glass, the same twice where it is always open."""
        self._places = folded, unfolded
        self._arrange()

    def tick(self) -> None:
        """Bring up to date which sensors there are and how old each is."""
        for place, (_, topics) in enumerate(self._makers):
            if place not in self._made and place not in self._broken and any(map(self._heard, topics)):
                self._make(place)
        if len(self.shown) != len(self._made):
            self.shown = tuple(self._made[place] for place in sorted(self._made))
            self._arrange()
        for place, gauge in self._made.items():
            topics = self._makers[place][1]
            for topic in topics:
                self._show(gauge, topic)
            self._refresh(gauge, [topic for topic in topics if self._heard(topic)])
        self._say_once()

    def _make(self, place: int) -> None:
        """Make the sensor of this `place`; where that fails, the robot is driven without it."""
        make, topics = self._makers[place]
        try:
            gauge = make()
        except Exception:
            log.exception("The sensor of %s cannot be shown", topics[0])
            self._broken.add(place)
            return
        gauge.card, gauge.size_hint = False, (None, None)
        self._made[place] = gauge

    def _show(self, gauge: Gauge, topic: str) -> None:
        """Show what came since the last look: ten times a second are enough for figures."""
        message = self._feeds.latest(topic)
        if message is not None and message is not self._newest.get(topic):
            self._newest[topic] = message
            gauge.show(message)

    def _heard(self, topic: str) -> bool:
        return self._feeds.latest(topic) is not None

    def _refresh(self, gauge: Gauge, topics: list[str]) -> None:
        """One that still speaks keeps the whole live; what is silent in it says so itself."""
        states = {topic: self._feeds.state(topic) for topic in topics}
        gauge.state = "live" if "live" in states.values() else "stale"
        age = min((self._feeds.age(topic) for topic in topics), default=math.nan)
        if gauge.state == "stale" and not abs(age - gauge.age) < 0.5:
            gauge.age = age

    def _say_once(self) -> None:
        """Where all are as old as each other, the first one says so for all."""
        ages = [gauge.age for gauge in self.shown if gauge.state == "stale"]
        if len(ages) == len(self.shown) > 1 and max(ages) - min(ages) < ALIKE:
            for gauge in self.shown[1:]:
                gauge.says_age = False
        else:
            for gauge in self.shown:
                gauge.says_age = True

    def on_open(self, *_: object) -> None:
        """Fold or unfold."""
        self._arrange()

    def _arrange(self) -> None:
        self.clear_widgets()
        if self._places is None:
            return
        rect = self._places[0] if self.folded else self._places[1]
        if not self.shown:
            rect = Rect(rect.x, rect.y, 0, 0)
        put(self, rect)
        self.opacity = 1 if self.shown else 0
        self.floating = not self.covers
        handle = dp(HANDLE) if self.foldable else 0.0
        room = int((rect.width - handle) // dp(MIN_WIDTH)) if self.folded else len(self.shown)
        seen = self.shown[: max(1, room)]
        rects = (_strip if self.folded else _card)(rect, len(seen), handle)
        for gauge, there in zip(seen, rects, strict=True):
            put(gauge, there)
            self.add_widget(gauge)
        if self.foldable and self.shown:
            self._sign.name = "expand_more" if self.open else "expand_less"
            high = min(rect.height, dp(54))
            put(self._sign, Rect(rect.right - handle - dp(2), rect.top - high, handle, high))
            self.add_widget(self._sign)

    def do_layout(self, *_: object) -> None:
        """What is on the card is placed by hand."""

    # what the fingers do

    def on_touch_down(self, touch: Any) -> bool:
        """Take a finger on a strip, or on what it unfolded to."""
        if not (self.shown and self.foldable and self.collide_point(*touch.pos)):
            return bool(super().on_touch_down(touch))
        if self._finger is None:
            touch.grab(self)
            self._finger = touch
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """A tap folds and unfolds."""
        if touch.grab_current is not self:
            return bool(super().on_touch_up(touch))
        touch.ungrab(self)
        self._finger = None
        if self.collide_point(*touch.pos):
            self.open = not self.open
        return True


def _strip(room: Rect, count: int, handle: float) -> list[Rect]:
    """Side by side, with room for the sign at their right [px]."""
    edge, gap = dp(8), dp(8)
    width = (room.width - handle - 2 * edge - gap * (count - 1)) / max(count, 1)
    low, high = room.y + dp(3), room.height - dp(6)
    return [Rect(room.x + edge + number * (width + gap), low, width, high) for number in range(count)]


def _card(room: Rect, count: int, handle: float) -> list[Rect]:
    """The first at the left over the whole height, the others above each other beside it, clear of the sign [px]."""
    edge, gap = dp(8), dp(10)
    inner = Rect(room.x + edge, room.y + edge, room.width - 2 * edge, room.height - 2 * edge)
    if count < 2:
        return [Rect(inner.x, inner.y, inner.width - handle, inner.height)] * count
    first = Rect(inner.x, inner.y, inner.width * LARGEST - gap / 2, inner.height)
    left = first.right + gap
    if count == 2:
        return [first, Rect(left, inner.y, inner.right - left - handle, inner.height)]
    if count > 3:
        return [first, *_grid(Rect(left, inner.y, inner.right - left, inner.height), count - 1, gap, handle)]
    upper = (inner.height - gap) * SECOND
    lower = inner.height - gap - upper
    return [
        first,
        Rect(left, inner.top - upper, inner.right - left - handle, upper),
        Rect(left, inner.y, inner.right - left, lower),
    ]


def _grid(room: Rect, count: int, gap: float, handle: float) -> list[Rect]:
    """In two rows, the upper one clear of the sign [px]."""
    high, places = (room.height - gap) / 2, []
    for low, many, width in (
        (room.top - high, count // 2, room.width - handle),
        (room.y, count - count // 2, room.width),
    ):
        wide = (width - gap * (many - 1)) / many
        places += [Rect(room.x + n * (wide + gap), low, wide, high) for n in range(many)]
    return places
