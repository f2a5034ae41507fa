"""The steady turn of a vehicle with tyres, from the balance of forces alone: the single-track model of the textbooks.

Nothing here steps through time, and nothing is shared with the simulation but its parameters. Fiala's formula is inverted in
closed form, so that what remains is one equation for the turn rate.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from sim.core.constants import GRAVITY
from sim.vehicles.commander import CommanderParameters

__all__ = ["Turn", "closed_form", "steady", "understeer_gradient"]


class Turn(NamedTuple):
    """A steady turn."""

    rate: float
    """[rad/s]"""
    drift: float
    """Angle of the rear tyres to their way [rad]."""


def _balance(own: CommanderParameters) -> float:
    """Of all of the truck, ahead of the rear axle [m]."""
    body, axles = own.body, own.axles
    return (body.mass * body.centre_of_mass[0] + 2 * axles.mass * axles.base) / own.mass


def understeer_gradient(own: CommanderParameters) -> float:
    """K in r = v tan δ / (L + K v²) of small slip angles [s2]: slip of the front less that of the rear, by acceleration and base."""
    return (1 / own.tyres.front - 1 / own.tyres.rear) / GRAVITY


def closed_form(own: CommanderParameters, speed: float, steering: float) -> float:
    """Turn rate with linear tyres [rad/s]."""
    return speed * math.tan(steering) / (own.axles.base + understeer_gradient(own) * speed * speed)


def _slip(used: float, stiffness: float, grip: float) -> float:
    """Slip angle at which a tyre pulls aside by `used` of its load; Fiala inverted."""
    return math.atan(3 * grip / stiffness * (1 - (1 - used / grip) ** (1 / 3)))


def steady(own: CommanderParameters, speed: float, steering: float, grip: float) -> Turn:
    """The turn at `speed` of the rear axle along the body, below 0 backward, both angles to the left; NaN where no tyre can give it.

    Backward the tyres slip to the other side of the body, and it turns more than the geometry says, as any vehicle that understeers.
    """
    base, tyres = own.axles.base, own.tyres
    way, speed = math.copysign(1.0, speed), abs(speed)

    def miss(rate: float) -> tuple[float, float]:
        """By how much the body would have to turn more for this `rate`, and the drift of the rear axle."""
        rear = speed * rate / GRAVITY
        front = rear / math.cos(steering)
        back, ahead = _slip(rear, tyres.rear, grip), _slip(front, tyres.front, grip)
        return rate - speed * (math.tan(steering - way * ahead) + way * math.tan(back)) / base, back

    low, high = 0.0, grip * GRAVITY * math.cos(steering) / speed * (1 - 1e-9)
    if miss(high)[0] < 0:
        return Turn(math.nan, math.nan)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if miss(middle)[0] < 0 else (low, middle)
    return Turn(way * low, miss(low)[1])
