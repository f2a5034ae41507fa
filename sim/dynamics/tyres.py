"""Pneumatic tyres: what the ground gives to each of four, from how it rolls and slips.

The brush model (H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012, chapter 3; for slip to the side alone it is Fiala's of 1954),
isotropic, so that a tyre that slides as a whole is braked against its way as Coulomb says. A tyre with the load N on a ground of
the friction coefficient μ that slips by σ (to the side: the tangent of the slip angle) pulls by

    F = μ N (x - x²/3 + x³/27),  x = c σ / μ,  and F = μ N from x = 3 on,

with its stiffness c by load and slip. The slip follows within the relaxation length (chapter 7), and near standstill it is damped
(chapter 8), so that a tyre that stands is a spring with a damper.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.parameters import Positive, Table
from sim.core.shapes import Quat, Vec3

__all__ = ["Footing", "Ground", "TyreParameters", "Wheel", "pull"]

_STEP = 1 / STEPS_PER_SECOND
_LOW_SPEED = 1.5
"""Slower than this the slip is damped as well [m/s]."""
_DAMPING = 0.18
"""Slip for each m/s of the tread over the ground at standstill [s/m]: half of what keeps a vehicle from swinging on its tyres."""
_SLIDING = 3.0
"""The slip, in parts of that at which an ever linear tyre would slide, from which all of the tread slides."""


_TRACTION = 0.9
"""Share of the friction limit up to which a traction control lets a tyre be used."""
_LIFTED = 0.03
"""A wheel so far above the ground carries nothing [m]."""

Motion = tuple[Vec3, Quat, Vec3, Vec3]
"""Position, rotation, velocity and turning of a body's centre of mass, as `Bullet.motion` gives them."""


@dataclass(frozen=True, slots=True)
class Ground:
    """What wheels roll on, level."""

    height: float
    """[m]"""
    grip: float
    """Friction coefficient of a rubber tyre on it."""


class TyreParameters(Table, frozen=True, kw_only=True):
    """The `[tyres]` table of a vehicle's file."""

    front: Positive
    """Pull aside of a front tyre by its load and its slip angle [1/rad]."""
    rear: Positive
    """The same of a rear tyre [1/rad]: with more than in front the vehicle understeers."""
    relaxation: Positive
    """Way within which the slip follows [m]."""


def pull(slip: float, stiffness: float, grip: float) -> float:
    """Force of a tyre as a part of its load, at a `slip` of 0 or more."""
    x = min(stiffness * slip / grip, _SLIDING)
    return grip * (x - x * x / 3 + x * x * x / 27)


class Wheel:
    """One tyre and its rim."""

    __slots__ = (
        "_ahead",
        "_aside",
        "_relaxation",
        "_slides",
        "force",
        "left",
        "load",
        "rim",
        "side",
        "stiffness",
        "turned",
        "x",
    )

    def __init__(self, x: float, left: float, stiffness: float, relaxation: float) -> None:
        """At rest, `x` ahead of the centre of mass of the body that it is fixed to and so far to the `left` [m]."""
        self.x, self.left, self.stiffness = x, left, stiffness
        self._relaxation = relaxation
        self.turned = 0.0
        """Way of its tread round its axle so far [m]."""
        self.rest()

    def rest(self) -> None:
        """Stand still, unstrained."""
        self.rim = 0.0
        """Speed of its tread round its axle [m/s]."""
        self.force = self.side = self.load = 0.0
        """Pull along the rim and to its left, and the load [N]."""
        self._ahead = self._aside = 0.0
        self._slides = False

    def yields(self) -> float:
        """By how much it pulls more in a step for each m/s that its rim turns faster [N s/m]."""
        slip = 0.0 if self._slides else _STEP / self._relaxation + _DAMPING
        return self.load * self.stiffness * slip

    def spare(self, grip: float) -> float:
        """Pull along the rim that the tyre can give beside what it gives aside, with a reserve [N]."""
        held = _TRACTION * grip * self.load
        return math.sqrt(max(0.0, held * held - self.side * self.side))

    def grasp(self, u: float, v: float, angle: float, grip: float) -> tuple[float, float]:
        """Force on the body along its own axes [N] in this step, over which the axle goes `u` ahead and `v` to the left [m/s].

        The wheel is steered by `angle` [rad] on a ground of friction coefficient `grip`.
        """
        c, s = (math.cos(angle), math.sin(angle)) if angle else (1.0, 0.0)
        along, aside = c * u + s * v, c * v - s * u
        self.turned += self.rim * _STEP
        over, drift = self.rim - along, -aside
        speed = abs(along)
        fading = 1 + _STEP * speed / self._relaxation
        ahead, across = (self._ahead + _STEP * over) / fading, (self._aside + _STEP * drift) / fading
        most = _SLIDING * grip / self.stiffness
        bent = math.hypot(ahead, across) / self._relaxation
        if bent > most:  # the tread slides: it is bent no farther
            ahead, across = ahead * most / bent, across * most / bent
        self._ahead, self._aside = ahead, across
        damping = _DAMPING * (1 - speed / _LOW_SPEED) if speed < _LOW_SPEED else 0.0
        sx, sy = ahead / self._relaxation + damping * over, across / self._relaxation + damping * drift
        slip = math.hypot(sx, sy)
        if slip < 1e-12 or self.load == 0.0:
            self.force = self.side = 0.0
            return 0.0, 0.0
        self._slides = slip >= most
        force = self.load * pull(slip, self.stiffness, grip) / slip
        fx, fy = force * sx, force * sy
        self.force, self.side = fx, fy
        return c * fx - s * fy, s * fx + c * fy


class Footing:
    """Four wheels under a level body: their loads, and what the ground gives to all of them together."""

    def __init__(
        self,
        axles: tuple[tuple[Wheel, Wheel], tuple[Wheel, Wheel]],
        *,
        mass: float,
        balance: tuple[float, float],
        below: float,
        rim: float,
    ) -> None:
        """The rear axle, then the front one, left wheels first.

        The whole vehicle has `mass` [kg] and balances so far ahead of the rear axle and above the ground [m]; the body's own centre
        of mass is so far above what is `below` it [m]. A rim resists being turned faster as `rim` does being pushed [kg].
        """
        self.axles, self._mass, self._below, self._rim = axles, mass, below, rim * STEPS_PER_SECOND
        (rear, _), (front, _) = axles
        base = front.x - rear.x
        self._shares = (1 - balance[0] / base, balance[0] / base)
        self._base, self._height = base, balance[1]
        self.accelerated = (0.0, 0.0)
        """By the ground, ahead and to the left [m/s2]."""

    def rest(self) -> None:
        """Stand still at once."""
        self.accelerated = (0.0, 0.0)
        for axle in self.axles:
            for wheel in axle:
                wheel.rest()

    def carry(self, motion: Motion, ground: Ground) -> None:
        """Spread the weight over the wheels, with what the acceleration moves backward and aside; a lifted one has none."""
        (_, _, z), (qx, qy, qz, qw), _, _ = motion
        tip, lean = 2 * (qx * qz - qw * qy), 2 * (qy * qz + qw * qx)
        lifted = _LIFTED - z + ground.height + self._below * (1 - 2 * (qx * qx + qy * qy))
        ahead, aside = self.accelerated
        weight = self._mass * GRAVITY
        back = self._mass * ahead * self._height / self._base
        for (left, right), share, more in zip(self.axles, self._shares, (back, -back), strict=True):
            half = (weight * share + more) / 2
            shift = self._mass * share * aside * self._height / (left.left - right.left)
            left.load, right.load = half - shift, half + shift
            for wheel in (left, right):
                if wheel.load < 0 or tip * wheel.x + lean * wheel.left > lifted:
                    wheel.load = 0.0

    def turn(self, axle: int, speed: float, most: float) -> float:
        """Turn the rims of an axle so that their mean comes to `speed` [m/s] in this step; what turns each, at its tread [N].

        Both are turned alike, as by a differential, and by no more than `most` [N].
        """
        mean, gives = 0.0, 0.0
        going = self.accelerated[0] * _STEP
        rims = []
        for wheel in self.axles[axle]:
            more = wheel.yields()
            resists = self._rim + more
            # the pull grows with how much faster the rim becomes than the axle
            left_alone = wheel.rim + (more * going - wheel.force) / resists
            rims.append((wheel, left_alone, resists))
            mean, gives = mean + left_alone / 2, gives + 1 / resists / 2
        force = max(-most, min(most, (speed - mean) / gives))
        for wheel, left_alone, resists in rims:
            wheel.rim = left_alone + force / resists
        return force

    def roll(self, motion: Motion, steering: tuple[float, float], grip: float) -> tuple[Vec3, Vec3]:
        """Force [N] of a ground of friction coefficient `grip` and its moment about the centre of mass [N m], in the world's frame.

        `steering` has the angles of the front wheels [rad]; the moment is that about the upright alone.
        """
        _, (qx, qy, qz, qw), (vx, vy, _), (_, _, turning) = motion
        c, s = 1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy + qw * qz)
        flat = math.hypot(c, s) or 1.0
        c, s = c / flat, s / flat
        u, v = c * vx + s * vy, c * vy - s * vx
        ahead = aside = moment = 0.0
        for axle, angles in zip(self.axles, ((0.0, 0.0), steering), strict=True):
            for wheel, angle in zip(axle, angles, strict=True):
                x, y = wheel.x, wheel.left
                fx, fy = wheel.grasp(u - turning * y, v + turning * x, angle, grip)
                ahead += fx
                aside += fy
                moment += x * fy - y * fx
        self.accelerated = ahead / self._mass, aside / self._mass
        return (c * ahead - s * aside, s * ahead + c * aside, 0.0), (0.0, 0.0, moment)
