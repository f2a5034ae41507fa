"""Ink of a laser sweep: free space as a fan and a dot for each return, by two floats to a beam.

ink = SweepInk()
ink.put(measured, angles, at=(x, y), scale=50.0, reach=6.0, look=Look(...))

The graphics card scales them, tints them by their distance and makes them round. A dot is a point of OpenGL: a beam has one vertex,
where a quad has four, and what Kivy does for a vertex is most of what a sweep costs.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from kivy.graphics import Callback, ChangeState, Mesh
from kivy.graphics.opengl import GL_VERSION, glEnable, glGetString
from numpy.typing import NDArray

from widgets.core.canvas_ink import Fading

__all__ = ["Look", "SweepInk"]

AHEAD = math.pi / 2
"""Where straight ahead is on the screen [rad]."""
MAX_BEAMS = 65_000
"""More have no room in a mesh of 16 bit indices; of a longer sweep every second, third … is drawn."""
_BEYOND = 1.001
"""Free space whose end is not seen is drawn to so many reaches: there its beam is known by to have no dot."""
_ROUNDING = 1e-4
"""What 32 bits may take from a distance [m]: a return at a bound is on its farther side."""
_FEATHER = 1.0
"""How far a dot is drawn beyond its own edge [px]."""
_SIZED_POINTS, _POINT_COORDINATES = 0x8642, 0x8861
"""GL_PROGRAM_POINT_SIZE and GL_POINT_SPRITE, which OpenGL ES has always on."""

DESKTOP = "#version 120\n"
"""Without it the language of a desktop's shaders has no places within a point."""

VERTEX = """
#ifdef GL_ES
precision highp float;
#endif
attribute vec2 at_place;
varying vec4 ink;
uniform float dotted;
uniform vec2 middle;
uniform float scale;
uniform float reach;
uniform float radius;
uniform vec2 bounds;
uniform vec4 free;
uniform vec4 close;
uniform vec4 near;
uniform vec4 farther;
uniform mat4 modelview_mat;
uniform mat4 projection_mat;
void main() {
    float away = length(at_place);
    bool shown = dotted < 0.5 || (away > 0.0 && away <= reach);
    vec4 place = projection_mat * modelview_mat * vec4(middle + at_place * scale, 0.0, 1.0);
    ink = dotted < 0.5 ? free : (away < bounds.x ? close : (away < bounds.y ? near : farther));
    gl_PointSize = 2.0 * (radius + 1.0);
    gl_Position = shown ? place : vec4(2.0, 2.0, 2.0, 1.0);
}
"""

FRAGMENT = """
#ifdef GL_ES
precision highp float;
#endif
varying vec4 ink;
uniform float dotted;
uniform float radius;
uniform float seen;
void main() {
    float inside = 1.0;
    if (dotted > 0.5) {
        inside = radius - length(gl_PointCoord - 0.5) * 2.0 * (radius + 1.0);
    }
    gl_FragColor = vec4(ink.rgb, ink.a * seen * clamp(inside + 0.5, 0.0, 1.0));
}
"""

FORMAT = [(b"at_place", 2, "float")]


@dataclass(frozen=True)
class Look:
    """Size and colours of what is drawn."""

    radius: float
    """Of a dot [px]."""
    free: Sequence[float]
    """Colour of free space."""
    levels: tuple[Sequence[float], Sequence[float], Sequence[float]]
    """Colours of returns that are too close, near, and farther."""
    bounds: tuple[float, float]
    """Up to where a return is too close, and up to where it is near [m]."""


class SweepInk(Fading):
    """A beam whose return is not known has neither dot nor free space: its place is that of the robot."""

    def __init__(self) -> None:
        dialect = "" if _on_es() else DESKTOP
        super().__init__(dialect + VERTEX, dialect + FRAGMENT)
        self.fan, self.dots = Mesh(fmt=FORMAT, mode="triangle_fan"), Mesh(fmt=FORMAT, mode="points")
        parts = (
            ChangeState(dotted=0.0),
            self.fan,
            Callback(_allow_points),
            ChangeState(dotted=1.0),
            self.dots,
        )
        for part in parts:
            self.add(part)
        self._made: tuple[object, ...] | None = None
        self._tinted: tuple[float, Look] | None = None
        self._units = np.zeros((0, 2), np.float32)
        self._ends = np.zeros((0, 1), np.float32)
        self._places = np.zeros((1, 2), np.float32)

    def put(
        self,
        measured: NDArray[np.float32],
        angles: NDArray[np.float64],
        at: tuple[float, float],
        scale: float,
        reach: float,
        look: Look,
    ) -> None:
        """Draw a sweep instead of that before: ranges [m], NaN for not known, in directions [rad] from straight ahead.

        The robot is `at` [px], with so many pixels to a metre; free space ends at `reach` [m], and so do the dots.
        """
        step = -(-len(measured) // MAX_BEAMS) if len(measured) else 1
        measured, angles = measured[::step], angles[::step]
        key = (len(measured), float(angles[0]), float(angles[-1])) if len(measured) else ()
        if key != self._made:
            self._make(angles)
            self._made = key
        if key:
            ends = self._ends[:, 0]
            np.minimum(measured, reach * _BEYOND, out=ends)
            if math.isnan(ends.min()):
                ends[np.isnan(ends)] = 0.0
            np.multiply(self._units, self._ends, out=self._places[1:])
        self.tell("middle", at)
        self.tell("scale", scale)
        if self._tinted != (reach, look):
            self._tinted = reach, look
            self._tint(reach, look)
        flat = self._places.reshape(-1)
        self.fan.vertices = self.dots.vertices = flat

    def _tint(self, reach: float, look: Look) -> None:
        self.tell("radius", look.radius)
        self.tell("reach", reach * (1 + _BEYOND) / 2)
        self.tell("bounds", tuple(bound - _ROUNDING for bound in look.bounds))
        for name, colour in zip(("free", "close", "near", "farther"), (look.free, *look.levels), strict=True):
            self.tell(name, colour)

    def _make(self, angles: NDArray[np.float64]) -> None:
        """All that stays the same while the beams do."""
        count = len(angles)
        turned = angles + AHEAD
        self._units = np.stack([np.cos(turned), np.sin(turned)], axis=1).astype(np.float32)
        self._ends = np.zeros((count, 1), np.float32)
        self._places = np.zeros((count + 1, 2), np.float32)
        order = np.arange(count + 1, dtype=np.uint16)
        self.fan.indices = np.append(order, order[1:2]) if _goes_round(angles) else order
        # Kivy's mesh cannot be emptied: the robot's own place has no dot
        self.dots.indices = order[1:] if count else order


@cache
def _on_es() -> bool:
    """OpenGL is that of phones."""
    return b"OpenGL ES" in (glGetString(GL_VERSION) or b"")


def _allow_points(_: object) -> None:
    """Let shaders say how large a point is and where in it they are."""
    if not _on_es():
        glEnable(_SIZED_POINTS)
        glEnable(_POINT_COORDINATES)


def _goes_round(angles: NDArray[np.float64]) -> bool:
    """The last beam has the first for its neighbour."""
    if len(angles) < 3:
        return False
    return bool(math.tau - abs(angles[-1] - angles[0]) < 1.5 * abs(angles[1] - angles[0]))
