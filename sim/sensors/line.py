"""A row of cells under the bow that measure how bright the ground is."""

from __future__ import annotations

from typing import Annotated

import msgspec
import numpy as np

from bridge.msgs.arrays import Float32Array
from bridge.msgs.pilothouse_msgs import LineSensor
from bridge.msgs.std_msgs import Header, Time
from sim.core.noise import Noise
from sim.core.shapes import place, rotate
from sim.physics.backend_bullet import State
from sim.world.paint import Paint

__all__ = ["LineCells", "LineParameters"]


class LineParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The `[line]` table of a vehicle's file."""

    rate: Annotated[float, msgspec.Meta(gt=0)]
    cells: Annotated[int, msgspec.Meta(ge=1, le=64)]
    spacing: float
    ahead: float
    spot: Annotated[float, msgspec.Meta(gt=0)]
    dark: float
    bright: float
    mismatch: float
    noise: float


class LineCells:
    """Reads the paint under each cell; it has a light of its own, so that shadows are nothing to it."""

    def __init__(self, parameters: LineParameters, paint: Paint, noise: Noise) -> None:
        """Cells of slightly different strength, one draw a run."""
        self._parameters, self._paint, self._noise = parameters, paint, noise
        middle = (parameters.cells - 1) / 2
        self._lefts = (middle - np.arange(parameters.cells)) * parameters.spacing
        self._strengths = 1 + noise.normals(parameters.mismatch, parameters.cells)

    def measure(self, state: State, stamp: float) -> LineSensor:
        """Measurement of the cells of a body in `state` at `stamp` [s]."""
        parameters = self._parameters
        centre = place((parameters.ahead, 0.0, 0.0), state.position, state.rotation)
        left = rotate(state.rotation, (0.0, 1.0, 0.0))
        spots = np.array(centre[:2]) + self._lefts[:, None] * left[:2]
        painted = self._paint.share(spots, parameters.spot)
        light = parameters.dark + (parameters.bright - parameters.dark) * painted
        light = light * self._strengths + self._noise.normals(parameters.noise, len(light))
        values = Float32Array(np.clip(light, 0.0, 1.0).astype("<f4").tobytes())
        return LineSensor(Header(Time.at(stamp), "line_sensor"), values, parameters.spacing)
