"""The greatest speed of the stick: a slider within what the robot may, with the limits that its owner set."""

from __future__ import annotations

import math

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, NumericProperty, StringProperty

from bridge.msgs.pilothouse_msgs import Limits, RobotInfo
from widgets.core.language import tr
from widgets.core.quantities import said
from widgets.parts.kit import Card
from widgets.parts.labels import heading_fits

__all__ = ["SPEED", "YAW_RATE", "SpeedCard", "allowed"]

SPEED, YAW_RATE = 0.5, 1.0
"""Greatest speeds of the stick until the robot tells its own [m/s, rad/s]."""

Builder.load_string("""
<SpeedCard>:
    floating: True
    padding: dp(6), dp(10)
    spacing: dp(4)
    SectionLabel:
        title: root.heading
        halign: 'center'
        height: self.texture_size[1] if root.titled else 0
        opacity: 1 if root.titled else 0
    Fader:
        id: fader
        size_hint_x: 1
        opacity: .4 if root.driven else 1
        on_change: root.maximum_speed = args[1]
    ValueUnit:
        value: root.told[0]
        unit: root.told[1]
        font_size: sp(18)
        unit_size: sp(14)
        room: root.width - dp(18)
        pos_hint: {'center_x': .5}
        opacity: .4 if root.driven else 1
    Remark:
        id: limits
        text: root.driven or root.limits
        role: 'plan' if root.driven else 'muted'
        font_size: sp(12)
        halign: 'center'
""")


class SpeedCard(Card):
    """How fast the stick may drive at its rim."""

    maximum_speed = NumericProperty(SPEED)
    """[m/s]"""
    speed_limit = NumericProperty(math.nan)
    """Greatest speed that the robot's configuration allows [m/s]; NaN for none."""
    turn_limit = NumericProperty(math.nan)
    """Greatest turn rate that it allows [rad/s]; NaN for none."""

    driven = StringProperty("")
    """What drives instead of the stick, and how fast, as in `task: 1.9 m/s`; empty while nothing does."""

    def _heading(self) -> str:
        whole = tr("Max speed")
        return whole if self.width > dp(90) and heading_fits(whole, self.width - dp(12)) else tr("Max")

    heading = AliasProperty(_heading, bind=["width"], cache=True)

    def _told(self) -> tuple[str, str]:
        return said(self.maximum_speed, "speed", 2)

    told = AliasProperty(_told, bind=["maximum_speed"], cache=True)
    """Figure and unit of `maximum_speed`, as the operator chose them."""

    def _limits(self) -> str:
        word = tr("limit") if self.width > dp(90) else "≤"
        limit = said(self.speed_limit, "speed", 2).words
        speed = f"{word} {limit}" if math.isfinite(self.speed_limit) else ""
        turning = tr("turn {rate:.0f}°/s").format(rate=math.degrees(self.turn_limit))
        turn = turning if math.isfinite(self.turn_limit) else ""
        return "\n".join(filter(None, (speed, turn)))

    limits = AliasProperty(_limits, bind=["speed_limit", "turn_limit", "width"], cache=True)
    """Both in words; empty for none."""

    def _titled(self) -> bool:
        return not self.limits or self.width > dp(90)

    titled = AliasProperty(_titled, bind=["limits", "width"], cache=True)
    """Has its name over it: where there is little room, the limit says what it is."""


def allowed(info: RobotInfo, limits: Limits | None) -> tuple[float, float]:
    """Greatest speed [m/s] and turn rate [rad/s] of the stick: the lower of what the robot can and what it may."""
    speed, turn = info.max_speed or SPEED, info.max_yaw_rate or YAW_RATE
    if limits is None:
        return speed, turn
    return _lower(speed, limits.max_speed), _lower(turn, limits.max_yaw_rate)


def _lower(value: float, limit: float) -> float:
    """NaN, and what is no limit to drive by, leaves `value`."""
    return min(value, limit) if limit > 0 else value
