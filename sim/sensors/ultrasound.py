"""Ultrasonic rangers on four sides: the nearest thing in a narrow cone."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from bridge.msgs.sensor_msgs import Range
from bridge.msgs.std_msgs import Header, Time
from sim.core.noise import Noise
from sim.core.shapes import Vec3
from sim.physics.backend_bullet import Bullet

__all__ = ["SIDES", "UltrasoundParameters", "Ultrasounds"]

SIDES = {"front": 0.0, "left": math.pi / 2, "right": -math.pi / 2, "rear": math.pi}
"""Name of each ranger to where it looks in `base_link` [rad]."""

Positive = Annotated[float, msgspec.Meta(gt=0)]


class UltrasoundParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The `[ultrasound]` table of a vehicle's file."""

    rate: Positive
    rays: Annotated[int, msgspec.Meta(ge=1, le=99)]
    offset: float
    height: float
    field_of_view: Positive
    range_min: float
    range_max: Positive
    noise: float


class Ultrasounds:
    """Rays level through each cone: what stands on the ground echoes, the ground itself, grazed, does not."""

    def __init__(self, parameters: UltrasoundParameters, backend: Bullet, body: int, noise: Noise) -> None:
        """Rangers on `body`."""
        self._parameters, self._backend, self._body, self._noise = parameters, backend, body, noise
        pairs = [pair for yaw in SIDES.values() for pair in self._cone(yaw)]
        self._from = backend.ray_points(body, [start for start, _ in pairs])
        self._to = backend.ray_points(body, [end for _, end in pairs])
        self._blank = Range(
            radiation_type=Range.ULTRASOUND,
            field_of_view=parameters.field_of_view,
            min_range=parameters.range_min,
            max_range=parameters.range_max,
        )

    def measure(self, stamp: float) -> Iterator[tuple[str, Range]]:
        """Side and echo of each at `stamp` [s]; +inf where nothing is in range, -inf where it is too near (REP-117)."""
        parameters = self._parameters
        hits = self._backend.rays(self._body, self._from, self._to).reshape(len(SIDES), -1).min(axis=1)
        ranges = hits * parameters.range_max + self._noise.normals(parameters.noise, len(hits))
        ranges[ranges < parameters.range_min] = -np.inf
        ranges[(hits >= 1.0) | (ranges > parameters.range_max)] = np.inf
        for side, measured in zip(SIDES, ranges, strict=True):
            header = Header(Time.at(stamp), f"ultrasound_{side}")
            yield side, msgspec.structs.replace(self._blank, header=header, range=float(measured))

    def _cone(self, yaw: float) -> Iterator[tuple[Vec3, Vec3]]:
        """Start and end of each ray round the direction `yaw` [rad]."""
        parameters = self._parameters
        x, y = parameters.offset * math.cos(yaw), parameters.offset * math.sin(yaw)
        half = parameters.field_of_view / 2
        for aside in np.linspace(-half, half, parameters.rays) if parameters.rays > 1 else (0.0,):
            angle, reach = yaw + float(aside), parameters.range_max
            end = (x + reach * math.cos(angle), y + reach * math.sin(angle), parameters.height)
            yield (x, y, parameters.height), end
