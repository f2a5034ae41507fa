"""The circle of a tablet, beside the stick of a layout that has none: it says what that stick would say."""

from __future__ import annotations

from collections.abc import Sequence

from app.layout.layout import SAYS, Control
from widgets import TiltCircle
from widgets.controls.sticks.stick import Stick
from widgets.core.language import mark, tr

__all__ = ["TILT", "TiltControl"]

TILT = mark("Tilt")
"""What it is called on the switch between it and the stick."""


class TiltControl:
    """Makes the circle when it is first wanted."""

    def __init__(self, sticks: Sequence[tuple[Stick, Control]]) -> None:
        """`sticks` are the controls of a layout that drive, with what each of them says."""
        first = next((one for _, one in sticks if one.slot == "stick"), None)
        own = any(isinstance(stick, TiltCircle) for stick, _ in sticks)
        self.control = None if first is None or own else _for(first)
        """What it says; None where the layout has a circle, or nothing that drives."""
        self.made: TiltCircle | None = None
        """None before it is first wanted."""

    @property
    def circle(self) -> TiltCircle:
        """Made now where it was not yet."""
        if self.made is None:
            self.made = TiltCircle(title=tr("Tilt"), needs_hold=True, in_shares=True)
        return self.made


def _for(stick: Control) -> Control:
    forward, left = SAYS.get(stick.widget, (stick.forward, stick.left))
    return Control(slot="stick", widget="Joystick", title=TILT, forward=forward, left=left, pad="")
