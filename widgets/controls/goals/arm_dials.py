"""Dials of an arm's panel: how its foot is turned, seen from above, and how its hand is rolled, seen from behind."""

from __future__ import annotations

import math
from collections.abc import Iterator

from kivy.metrics import dp, sp
from kivy.properties import ListProperty, NumericProperty, OptionProperty

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import ArmOrder
from widgets.controls.goals.arm_keys import ArmKeys
from widgets.controls.goals.arm_picture import Side, draw_turn, turn_words
from widgets.core.canvas_ink import Word
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["BENDING", "ROOMY", "ArmDials", "Dial"]

EXTENT = (-0.20, 0.42, -0.12, 0.44)
"""What the picture shows: behind and ahead of, below and above the foot [m]."""
BENDING = 4
"""Joints from the foot on that move the tip; the next one rolls the hand."""
ROOMY = 118
"""A picture of this height has room for words [dp]."""
_JOINTS = {"turn": 0, "roll": BENDING}

Dial = tuple[float, float, float]
"""Middle and radius [px]."""


class ArmDials(ArmKeys):
    """A finger turns the hand of a dial; the joint is sent there when it is lifted."""

    angles: ListProperty[float] = ListProperty()
    """Of the joints from the foot on [rad]; empty before the first, or while one is not known."""
    held = OptionProperty("", options=["", "tip", *_JOINTS])
    """What a finger drags; empty without one."""
    aim: ListProperty[float] = ListProperty()
    """Where the tip is wanted, ahead of and above the foot in the plane of the arm [m]; empty while no place is chosen."""
    bearing = NumericProperty(math.nan)
    """Where the joint of a dial is being turned to [rad]; NaN while no finger turns it."""
    _joints: list[float]
    """Where they go, or are while that is not known, unrounded [rad]."""

    @property
    def known(self) -> bool:
        """Every joint is known of an arm whose tip can be drawn and led."""
        return len(self.angles) in (BENDING, BENDING + 1)

    def turn(self, bearing: float) -> None:
        """Turn the foot to `bearing` [rad], to the left positive, as a finger would; the other joints stay as they are."""
        self._send("turn", bearing)

    def roll(self, bearing: float) -> None:
        """Turn the hand about its own length to `bearing` [rad], clockwise from behind positive, as a finger would."""
        self._send("roll", bearing)

    def _send(self, dial: str, bearing: float) -> None:
        self.aim = []
        joints = [*self._joints]
        joints[_JOINTS[dial]] = bearing
        self.dispatch("on_command", ArmOrder(angles=Float64Array(joints)))

    def follow_dial(self, x: float, y: float) -> None:
        """The finger that holds a dial is there [px]."""
        middle, high, _ = self.dials[self.held]
        across = middle - x if self.held == "turn" else x - middle
        self.bearing = math.atan2(across, y - high)

    # where they are

    @property
    def view(self) -> tuple[float, float, float, float]:
        """Left, low, width and height of the picture [px]."""
        left, low, width, height = self.inside
        if self.beside or self.stacked:
            return left, low, width - self._keys_wide(width) - dp(10), height
        foot = theme.target + dp(8)
        return left, low + foot, width, max(height - foot, 1.0)

    @property
    def side(self) -> Side:
        """How metres in the plane of the arm lie in the picture."""
        left, low, width, height = self.view
        roomy = height >= dp(ROOMY)
        foot = sp(18) if roomy else 0.0
        scale = min(
            width / (EXTENT[1] - EXTENT[0]),
            (height - foot) / (EXTENT[3] - EXTENT[2]),
        )
        x = left + (width - (EXTENT[1] - EXTENT[0]) * scale) / 2 - EXTENT[0] * scale
        if not roomy:
            x = left + width - dp(6) - EXTENT[1] * scale
        y = low + foot - EXTENT[2] * scale + max(0.0, height - foot - (EXTENT[3] - EXTENT[2]) * scale) / 2
        return Side(x, y, scale, (left, low + foot, left + width, low + height))

    @property
    def dials(self) -> dict[str, Dial]:
        """That of the foot above the arm and that of the hand below its deck, where there is room."""
        left, low, _, height = self.view
        if height < dp(62):
            return {}
        radius = dp(15 if height >= dp(ROOMY) else 12)
        dials = {"turn": (left + radius, low + height - radius - dp(1), radius)}
        high = self.side.y - radius - dp(5)
        if len(self.angles) > BENDING and high - radius >= low + sp(18):
            dials["roll"] = (left + radius, high, radius)
        return dials

    def dial_marks(self, shapes: Shapes, *, roomy: bool) -> Iterator[Word]:
        """The dials with what they show; the one that a finger holds with where it is turned to."""
        for name, dial in self.dials.items():
            bearing = self.bearing if self.held == name else math.nan
            angle = self.angles[_JOINTS[name]]
            yield draw_turn(shapes, dial, angle, bearing, roomy=roomy, rolls=name == "roll")
        if self.dials and "roll" not in self.dials and len(self.angles) > BENDING:
            yield self._hand_alone(roomy=roomy)

    def _hand_alone(self, *, roomy: bool) -> Word:
        """How the hand is rolled, where there is no room for its dial: below the deck, or between the foot's and the gripper's."""
        left, low, _, height = self.view
        words = turn_words(math.degrees(self.angles[BENDING]), roomy=roomy, rolls=True)
        if roomy:
            return Word(words, left, low + sp(23), sp(12.5), theme.muted, anchor=(0, 0.5))
        middle = (low + sp(28) + low + height - dp(26)) / 2
        return Word(words, left, middle, sp(11), theme.muted, anchor=(0, 0.5))
