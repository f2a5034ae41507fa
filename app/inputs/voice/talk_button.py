"""The button to talk: held in the window, by a key or by a button of a gamepad, or tapped for one command."""

from __future__ import annotations

import math
from collections.abc import Callable

__all__ = ["MAX_HOLD", "TAP_TIMEOUT", "TalkButton"]

MAX_TAP = 0.4
"""A shorter press is a tap: the microphone stays open for one command [s]."""
TAP_TIMEOUT = 6.0
"""The microphone stays open at most so long after a tap [s]."""
MAX_HOLD = 30.0
"""Something lies on the button: it counts as released after so long [s]."""


class TalkButton:
    """Who holds it, and until when a tap counts. Everything in the UI thread."""

    def __init__(self, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._now = now
        self._holders: set[str] = set()
        """Who holds it: `glass`, `key`."""
        self._since = self._until = math.nan
        """Since when it is held; until when a tap keeps the microphone open [s]."""

    @property
    def is_held(self) -> bool:
        """Somebody holds it."""
        return bool(self._holders)

    @property
    def is_tapped(self) -> bool:
        """A tap waits for its command."""
        return not math.isnan(self._until)

    def hold(self, holder: str, *, down: bool) -> None:
        """`holder` presses it, or lets go."""
        if down and not self._holders:
            self._since = self._now()
        (self._holders.add if down else self._holders.discard)(holder)

    def press(self) -> None:
        """A finger is on it."""
        self.end_tap()
        self.hold("glass", down=True)

    def release(self) -> None:
        """The finger is up; where that was a tap, it counts for a while."""
        if "glass" in self._holders and self._now() - self._since < MAX_TAP:
            self._until = self._now() + TAP_TIMEOUT
        self.hold("glass", down=False)

    def end_tap(self) -> None:
        """No tap counts any more."""
        self._until = math.nan

    def clear(self) -> None:
        """Nobody holds it, and no tap counts."""
        self._holders.clear()
        self.end_tap()

    def is_over(self, now: float) -> bool:
        """A tap has waited long enough, or the button has been held longer than any command takes."""
        return now >= self._until or (self.is_held and now - self._since > MAX_HOLD)
