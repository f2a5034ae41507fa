"""Which hand holds STOP: everything that is arranged by hand follows it when it is next arranged."""

from __future__ import annotations

from widgets.core.language import mark

__all__ = ["HANDS", "Hand", "hand"]

HANDS = {"right": mark("Right hand"), "left": mark("Left hand")}
"""By name, what it is called in English."""


class Hand:
    """What is chosen holds from `take_up` on, when every control has let go and is made anew: none moves under a finger."""

    chosen = "right"
    """One of `HANDS`."""
    left = False
    """STOP is in the lower left corner, and what is arranged by hand is mirrored."""

    def take_up(self) -> None:
        """Have what is chosen hold; whoever calls this arranges everything anew."""
        self.left = self.chosen == "left"


hand = Hand()
"""The one of this process."""
