"""Solid shapes, the one vocabulary that physics, laser, map and camera share, and the rotations that place them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

__all__ = [
    "Colour",
    "Quat",
    "Shape",
    "Vec3",
    "beside",
    "compose",
    "from_yaw",
    "place",
    "rotate",
    "rotate_back",
    "yaw_of",
]

Vec3 = tuple[float, float, float]
"""x, y, z [m] unless its user says otherwise."""
Quat = tuple[float, float, float, float]
"""A unit quaternion x, y, z, w."""
Colour = tuple[float, float, float]
"""Red, green, blue, 0 to 1."""


def from_yaw(yaw: float) -> Quat:
    """The rotation by `yaw` [rad] about z."""
    return (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


def compose(outer: Quat, inner: Quat) -> Quat:
    """The rotation that first does `inner`, then `outer`."""
    ax, ay, az, aw = outer
    bx, by, bz, bw = inner
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(q: Quat, v: Vec3) -> Vec3:
    """`v` turned by `q`: from the body's frame to the frame the body is placed in."""
    x, y, z, w = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (
        v[0] + w * tx + y * tz - z * ty,
        v[1] + w * ty + z * tx - x * tz,
        v[2] + w * tz + x * ty - y * tx,
    )


def rotate_back(q: Quat, v: Vec3) -> Vec3:
    """`v` turned by the inverse of `q`: from the outer frame to the body's."""
    return rotate((-q[0], -q[1], -q[2], q[3]), v)


@dataclass(frozen=True, slots=True)
class Shape:
    """One convex solid with its centre at `position`."""

    kind: str
    """`box`, `cylinder` (axis along z), `sphere`, or for pictures only `leaves`, a ragged ball of them."""
    size: Vec3
    """Full extents along its own axes before tapering [m]; a round shape's x and y are its diameter."""
    position: Vec3 = (0.0, 0.0, 0.0)
    rotation: Quat = (0.0, 0.0, 0.0, 1.0)
    colour: Colour = (0.6, 0.6, 0.6)
    taper: tuple[float, float] = (1.0, 1.0)
    """Extent of the top as a part of the bottom's, along x and y: (1, 1) is straight, (0, 0) comes to a point."""
    gloss: float = 0.0
    """Strength of the sun's reflection, 0 matt to 1 polished; for pictures only."""
    glow: float = 0.0
    """Part of the colour that shows without light, 0 to 1; of leaves, how much of the ball is gaps. For pictures only."""
    retro: bool = False
    """It throws a laser's light straight back; for lasers only."""

    def at(self, position: Vec3, rotation: Quat) -> Shape:
        """The same shape carried along when its frame is placed at `position` and turned by `rotation`."""
        turned = rotate(rotation, self.position)
        moved = (turned[0] + position[0], turned[1] + position[1], turned[2] + position[2])
        return replace(self, position=moved, rotation=compose(rotation, self.rotation))

    @property
    def is_tapered(self) -> bool:
        """Its top is not as large as its bottom."""
        return self.taper != (1.0, 1.0)

    @property
    def radius(self) -> float:
        """Of a sphere about its centre that it fits in [m]."""
        return math.hypot(*self.size) / 2

    def corners(self, facets: int = 16) -> list[Vec3]:
        """Points whose convex hull is the shape; a round one is approximated by `facets` sides."""
        sx, sy, sz = (extent / 2 for extent in self.size)
        if self.kind == "box":
            ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        else:
            turns = (math.tau * i / facets for i in range(facets))
            ring = [(math.cos(turn), math.sin(turn)) for turn in turns]
        tx, ty = self.taper
        local = [(x * sx, y * sy, -sz) for x, y in ring] + [(x * sx * tx, y * sy * ty, sz) for x, y in ring]
        return [place(point, self.position, self.rotation) for point in local]


def place(point: Vec3, position: Vec3, rotation: Quat) -> Vec3:
    """`point` of a frame that is turned by `rotation` and placed at `position`, seen from outside."""
    x, y, z = rotate(rotation, point)
    return (x + position[0], y + position[1], z + position[2])


def yaw_of(q: Quat) -> float:
    """The rotation about z [rad], -pi to pi, that `q` contains."""
    x, y, z, w = q
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def beside(solid: Shape, x: float, y: float) -> float:
    """From a point on the ground to an upright solid [m]; 0 within."""
    cosine, minus_sine, _ = rotate_back(solid.rotation, (1.0, 0.0, 0.0))
    dx, dy = x - solid.position[0], y - solid.position[1]
    along, across = cosine * dx - minus_sine * dy, minus_sine * dx + cosine * dy
    if solid.kind != "box":
        return max(0.0, math.hypot(along, across) - solid.size[0] / 2)
    return math.hypot(max(0.0, abs(along) - solid.size[0] / 2), max(0.0, abs(across) - solid.size[1] / 2))
