"""Forces of water and wind on a hull that floats: buoyancy on waves, damping, drag across, windage."""

from __future__ import annotations

from collections.abc import Sequence

from sim.core.constants import GRAVITY
from sim.core.parameters import Positive, Table
from sim.core.shapes import Vec3
from sim.dynamics.sixdof import Inertia, SixDof
from sim.world.weather import Weather

__all__ = ["Hull", "HullParameters", "inertia_of"]

AIR = 1.225
"""Density of air [kg/m3]."""
_GAUSS = ((0.1127016653792583, 5 / 18), (0.5, 8 / 18), (0.8872983346207417, 5 / 18))
"""Places and weights that integrate a polynomial over [0, 1] exactly up to the fifth power."""


class HullParameters(Table, frozen=True, kw_only=True):
    """The hull; its origin lies in the waterline at half its length. Linear damping is what a unit of speed costs."""

    mass: Positive
    """With all that it carries [kg]."""
    load: float = 0.0
    """Of that, what it carries: its draft, stability and damping are those without [kg]."""
    load_at: Vec3 = (0.0, 0.0, 0.0)
    """Its place [m]."""
    length: Positive
    """[m]"""
    beam: Positive
    """Over all [m]."""
    draft: Positive
    """[m]"""
    depth: Positive
    """From keel to deck [m]."""
    centre_of_mass: tuple[float, float, float]
    """[m]"""
    inertia: tuple[Positive, Positive, Positive]
    """About x, y and z through the centre of mass [kg m2]."""
    product: float = 0.0
    """Its element xz [kg m2]."""
    added_mass: tuple[Positive, Positive, Positive]
    """[kg]"""
    added_inertia: tuple[Positive, Positive, Positive]
    """[kg m2]"""
    waterplane: Positive
    """Area at the waterline [m2]."""
    flotation: float = 0.0
    """Its middle, ahead of the origin [m]."""
    metacentric: tuple[Positive, Positive]
    """Heights across and along [m]."""
    damping: tuple[float, float, float]
    """Along x, y, z [N s/m]."""
    rotary_damping: tuple[float, float, float]
    """About x, y, z [N m s]."""
    yaw_quadratic: float
    """About z, growing with the square [N m s2]."""
    cross_drag: Positive
    """Coefficient of the drag across."""
    friction: Positive
    """Against what it bumps into."""
    windage: tuple[Positive, Positive]
    """Area above the water, seen from ahead and from the side [m2]."""
    wind_drag: Positive
    """Its coefficient."""


def inertia_of(hull: HullParameters) -> Inertia:
    """Inertia of the hull."""
    return Inertia(
        hull.mass, hull.centre_of_mass, hull.inertia, hull.product, hull.added_mass, hull.added_inertia
    )


class Hull:
    """A hull in the weather of a world: the forces on it, reckoned of how it lies and moves."""

    def __init__(
        self,
        parameters: HullParameters,
        weather: Weather,
        stations: Sequence[tuple[float, float]] | None = None,
    ) -> None:
        """A hull at its waterline. `stations` are where the drag across is taken, ahead of the middle, and for what length [m]."""
        self._parameters, self._weather = parameters, weather
        water = weather.density * GRAVITY
        self._stiffness = water * parameters.waterplane
        across, along = parameters.metacentric
        own = parameters.mass - parameters.load
        self._righting = (own * GRAVITY * across, own * GRAVITY * along)
        half = parameters.length / 2
        gauss = [(side * half * at, half * weight) for side in (-1, 1) for at, weight in _GAUSS]
        drag = weather.density / 2 * parameters.draft * parameters.cross_drag
        self._stations = [(at, drag * length) for at, length in stations or gauss]
        self._sink = own * GRAVITY / self._stiffness
        self._load = parameters.load * GRAVITY
        deeper = self._load / self._stiffness
        self._drag = parameters.damping[0] * (1 + deeper / parameters.draft)
        self.wet = 1.0
        """Part of it in the water, from 0 out of it to 1 as it floats."""

    def forces(self, body: SixDof) -> tuple[Vec3, Vec3]:
        """Force [N] and torque [N m] about the origin along the body's axes, weight and buoyancy included."""
        u, v, w = body.through
        p, q, r = body.turning
        lift, k, m = self._buoyancy(body)
        wet, parameters = self.wet, self._parameters
        dx, (_, dy, dz) = self._drag, parameters.damping
        dp, dq, dr = parameters.rotary_damping
        y = n = 0.0
        for station, strength in self._stations:
            across = v + station * r
            drag = strength * across * abs(across)
            y -= drag
            n -= station * drag
        windy, blow = self._wind(body)
        ux, uy, uz = body.axes[6:]
        n -= dr * r + parameters.yaw_quadratic * abs(r) * r
        load, (ax, ay, az) = self._load, parameters.load_at
        force = (
            (lift - load) * ux - wet * dx * u + windy,
            (lift - load) * uy + wet * (y - dy * v) + blow,
            (lift - load) * uz - wet * dz * w,
        )
        k, m, n = k - load * (ay * uz - az * uy), m - load * (az * ux - ax * uz), wet * n
        n -= load * (ax * uy - ay * ux)
        return force, (k - wet * dp * p, m - lift * parameters.flotation * uz - wet * dq * q, n)

    def _buoyancy(self, body: SixDof) -> tuple[float, float, float]:
        """Buoyancy less weight [N], upward, and the righting moments [N m] on the sea as it is round the hull."""
        parameters, weather = self._parameters, self._weather
        x, y, z = body.position
        a, b, _, d, e, _, ux, uy, _ = body.axes
        level = slope_x = slope_y = 0.0
        if weather.waves:
            half, side = parameters.length / 3, parameters.beam / 3
            bow, stern = (weather.surface(x + a * s, y + d * s) for s in (half, -half))
            left, right = (weather.surface(x - d * s, y + a * s) for s in (side, -side))
            level = (bow + stern + left + right) / 4
            along, across = (bow - stern) / 2 / half, (left - right) / 2 / side
            slope_x, slope_y = a * along - d * across, d * along + a * across
        sink = self._sink + level - (z + ux * parameters.flotation)
        under = min(max(sink, 0.0), parameters.depth / parameters.draft * self._sink)
        self.wet = min(1.0, under / self._sink)
        # the sea's normal, seen from the body
        nx, ny = ux - a * slope_x - d * slope_y, uy - b * slope_x - e * slope_y
        roll, pitch = self._righting
        return self._stiffness * (under - self._sink), -roll * ny * self.wet, pitch * nx * self.wet

    def _wind(self, body: SixDof) -> tuple[float, float]:
        """Force of the air on the part above the water, ahead and to the left [N]."""
        wx, wy, _ = self._weather.wind
        cx, cy, _ = self._weather.current
        a, b, _, d, e, _, _, _, _ = body.axes
        wx, wy = wx - cx, wy - cy
        ahead, left = a * wx + d * wy - body.through[0], b * wx + e * wy - body.through[1]
        strength = AIR / 2 * self._parameters.wind_drag * (ahead * ahead + left * left) ** 0.5
        front, side = self._parameters.windage
        return strength * front * ahead, strength * side * left
