"""A key that is held, and how it ends though nobody tells: SDL has it down no longer, its repeats stay away, it is held for too long."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.inputs.base.button_presses import Press

__all__ = ["REPEAT_TIMEOUT", "MAX_HOLD", "MIN_REPEATS", "HeldKey"]

REPEAT_TIMEOUT = 0.3
"""A key whose repeats have come and stay away for longer was let go, though nobody told [s]."""
MIN_REPEATS = 2
"""So many of them first: a system may repeat nothing."""
MAX_HOLD = 30.0
"""Nothing is held for longer: something may lie on it [s]."""


@dataclass(slots=True)
class HeldKey:
    """A key or a button that is down."""

    press: Press
    since: float
    """[s]"""
    heard: float
    """Its last repeat [s]."""
    repeats: int = 0
    stale: bool = False
    """It must be let go before it means anything again."""
    seen: bool = False
    """The system itself was seen to have it down."""

    def repeated(self, now: float) -> None:
        """The system says again that it is down."""
        self.repeats, self.heard = self.repeats + 1, now

    def up(self, is_down: Callable[[int], bool] | None) -> bool:
        """The system had it down and has it no longer, where it is asked by the place of the key."""
        if is_down is None or not self.press.scancode:
            return False
        down = is_down(self.press.scancode)
        up, self.seen = self.seen and not down, self.seen or down
        return up

    def silent(self, now: float) -> bool:
        """Its repeats stay away, which only the key that went down last can be judged by."""
        return self.repeats >= MIN_REPEATS and now - self.heard > REPEAT_TIMEOUT

    def too_long(self, now: float) -> bool:
        """No hand holds it for so long."""
        return now - self.since > MAX_HOLD
