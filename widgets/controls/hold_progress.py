"""Progress of a press that has to be held: time counts once the finger is known to have been there, however seldom the glass is drawn.

class Release(Hold, QuietButton): ...
release.bind(on_held_long=lambda _: unlatch())
"""

from __future__ import annotations

from collections import deque
from typing import Any

from kivy.clock import Clock
from kivy.event import EventDispatcher
from kivy.properties import NumericProperty

__all__ = ["HOLD_DURATION", "Hold"]

HOLD_DURATION = 1.0
"""How long the finger must stay by default [s]."""
MAX_FRAME = 0.1
"""A frame counts for no more of a hold at once [s]: a finger that left while it was drawn is only heard of after it."""
LOOKS = 2
"""Frames after one that took longer until the rest of it counts: a finger that left while it was drawn is heard of by then."""


class Hold(EventDispatcher):
    """Dispatches `on_held_long` once `hold` was called and `rest` was not for as long as it takes."""

    __events__: tuple[str, ...] = ("on_held_long",)

    held = NumericProperty(0.0)
    """How much of the hold is over, 0 to 1."""

    def __init__(self, **kwargs: Any) -> None:
        self._takes = HOLD_DURATION
        self._unread: deque[float] = deque()
        """Of the latest frames, what does not count yet [s]."""
        self._begun = False
        """No frame has passed since the finger came."""
        self._counting = Clock.create_trigger(self._pass, 0, interval=True)
        super().__init__(**kwargs)

    def hold(self, takes: float = HOLD_DURATION) -> None:
        """A finger is there; it must stay for `takes` [s]."""
        self._takes = takes
        self._begun = self._begun or not self._counting.is_triggered
        self._counting()

    def rest(self) -> None:
        """Forget a hold that has begun."""
        self._counting.cancel()
        self._begun = False
        self._unread.clear()
        self.held = 0.0

    def _pass(self, elapsed: float) -> None:
        """A frame is over; how much of the first one was before the finger came is not known."""
        begun, self._begun = self._begun, False
        self._count(0.0 if begun else elapsed)

    def _count(self, elapsed: float) -> None:
        self._unread.append(max(0.0, elapsed - MAX_FRAME))
        seen = self._unread.popleft() if len(self._unread) > LOOKS else 0.0
        self.held = min(1.0, self.held + (min(elapsed, MAX_FRAME) + seen) / self._takes)
        if self.held >= 1.0 - 1e-9 and self.is_over():
            self.rest()
            self.dispatch("on_held_long")

    def is_over(self) -> bool:
        """A hold that has lasted as long as it takes ends with this frame; else it is asked again with the next."""
        return True

    def on_held_long(self) -> None:
        """It was held long enough."""
