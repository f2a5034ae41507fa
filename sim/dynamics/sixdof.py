"""A free body in water or air: from forces to the motion that they cause, the water that it carries along included.

The physics engine knows the body's own mass only. So the accelerations come from here, by Kirchhoff's equations with
the added mass on the left side, and the engine is given the force and torque that make its bare body accelerate just
so. Nothing is fed back from accelerations, which keeps any ratio of added mass stable; and what the body touches acts
on it as on any other.

Frames: the body's, x ahead, y left, z up, origin in `base_link`. Plain floats, for a small array costs more than a
whole model.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.core.constants import GRAVITY
from sim.core.shapes import Vec3
from sim.physics.backend_bullet import Bullet

__all__ = ["Inertia", "SixDof"]

Matrix = NDArray[np.float64]
Block = tuple[float, float, float, float, float, float, float, float, float]


class Inertia(NamedTuple):
    """Inertia of a body, with the added mass of the medium."""

    mass: float
    """[kg]"""
    centre: Vec3
    """Of mass, in the body's frame [m]; on its plane of symmetry, y = 0."""
    moments: Vec3
    """About axes through the centre of mass [kg m2]."""
    product: float = 0.0
    """The element xz of the tensor of inertia there [kg m2]."""
    added_mass: Vec3 = (0.0, 0.0, 0.0)
    """Along x, y and z [kg]."""
    added_moments: Vec3 = (0.0, 0.0, 0.0)
    """About x, y and z through the origin [kg m2]."""


class SixDof:
    """One body that is moved by the forces that its model reckons, step by step: `update`, compute, `apply`."""

    def __init__(self, backend: Bullet, body: int, inertia: Inertia, *, munk: bool = False) -> None:
        """`munk` keeps the moment that turns a slender body athwart its way, which a skeg or fins would balance."""
        self._backend, self._body, self._inertia, self._munk = backend, body, inertia, munk
        self._even, self._odd = (_inverse(inertia, axes) for axes in ((0, 2, 4), (1, 3, 5)))
        self.update((0.0, 0.0, 0.0))

    def update(self, flow: Vec3) -> None:
        """Take in how the body lies and moves now, in a medium that moves with `flow` in the world [m/s]."""
        self._at, (x, y, z, w), (vx, vy, vz), (wx, wy, wz) = self._backend.motion(self._body)
        self.rotation = (x, y, z, w)
        xx, yy, zz, xy, xz, yz = 2 * x * x, 2 * y * y, 2 * z * z, 2 * x * y, 2 * x * z, 2 * y * z
        wx2, wy2, wz2 = 2 * w * x, 2 * w * y, 2 * w * z
        a, b, c = 1 - yy - zz, xy - wz2, xz + wy2
        d, e, f = xy + wz2, 1 - xx - zz, yz - wx2
        g, h, i = xz - wy2, yz + wx2, 1 - xx - yy
        self.axes = (a, b, c, d, e, f, g, h, i)
        """The rotation from the body's frame to the world's, row by row; the last row is the world's up in the body."""
        p, q, r = a * wx + d * wy + g * wz, b * wx + e * wy + h * wz, c * wx + f * wy + i * wz
        self.turning = (p, q, r)
        """About the body's axes [rad/s]."""
        self.velocity = (vx, vy, vz)
        """Of the centre of mass in the world [m/s]."""
        vx, vy, vz = vx - flow[0], vy - flow[1], vz - flow[2]
        cx, cy, cz = self._inertia.centre
        self.through = (
            a * vx + d * vy + g * vz - q * cz + r * cy,
            b * vx + e * vy + h * vz - r * cx + p * cz,
            c * vx + f * vy + i * vz - p * cy + q * cx,
        )
        """Velocity of the origin through the medium, along the body's axes [m/s]."""
        mx, my, mz = self._at
        self.position = (
            mx - a * cx - b * cy - c * cz,
            my - d * cx - e * cy - f * cz,
            mz - g * cx - h * cy - i * cz,
        )
        """Of the origin in the world [m]."""

    def apply(self, force: Vec3, torque: Vec3) -> None:
        """Let `force` [N] and `torque` about the origin [N m], along the body's axes, move it in the next step.

        They are all that acts on it: weight and buoyancy are among them, or cancel each other.
        """
        u, v, w = self.through
        p, q, r = self.turning
        inertia = self._inertia
        mass, (cx, cy, cz) = inertia.mass, inertia.centre
        (ix, iy, iz), ixz = inertia.moments, inertia.product
        (ax, ay, az), (ap, aq, ar) = inertia.added_mass, inertia.added_moments
        # velocity of the centre of mass, momenta of the body and of the water, the latter about the origin
        gu, gv, gw = u + q * cz - r * cy, v + r * cx - p * cz, w + p * cy - q * cx
        jx, jy, jz = mass * gu, mass * gv, mass * gw
        kx, ky, kz = ax * u, ay * v, az * w
        hx, hy, hz = ix * p + ixz * r, iy * q, iz * r + ixz * p
        lx, ly, lz = (
            hx + cy * jz - cz * jy + ap * p,
            hy + cz * jx - cx * jz + aq * q,
            hz + cx * jy - cy * jx + ar * r,
        )
        tx, ty, tz = jx + kx, jy + ky, jz + kz
        fx, fy, fz = force[0] - q * tz + r * ty, force[1] - r * tx + p * tz, force[2] - p * ty + q * tx
        if self._munk:
            jx, jy, jz = tx, ty, tz
        nx = torque[0] - q * lz + r * ly - v * jz + w * jy
        ny = torque[1] - r * lx + p * lz - w * jx + u * jz
        nz = torque[2] - p * ly + q * lx - u * jy + v * jx
        a, b, c, d, e, f, g, h, i = self._even
        du, dw, dq = a * fx + b * fz + c * ny, d * fx + e * fz + f * ny, g * fx + h * fz + i * ny
        a, b, c, d, e, f, g, h, i = self._odd
        dv, dp, dr = a * fy + b * nx + c * nz, d * fy + e * nx + f * nz, g * fy + h * nx + i * nz
        # what the bare body needs for that, at its centre of mass; it turns as if it had no product of inertia
        sx = mass * (du + dq * cz - dr * cy + q * gw - r * gv)
        sy = mass * (dv + dr * cx - dp * cz + r * gu - p * gw)
        sz = mass * (dw + dp * cy - dq * cx + p * gv - q * gu)
        mx = ix * dp + (iz - iy) * q * r
        my = iy * dq + (ix - iz) * r * p
        mz = iz * dr + (iy - ix) * p * q
        self._apply_bare((sx, sy, sz), (mx, my, mz))

    def _apply_bare(self, force: Vec3, torque: Vec3) -> None:
        (fx, fy, fz), (mx, my, mz) = force, torque
        a, b, c, d, e, f, g, h, i = self.axes
        weight = self._inertia.mass * GRAVITY
        self._backend.apply(
            self._body,
            self._at,
            (a * fx + b * fy + c * fz, d * fx + e * fy + f * fz, g * fx + h * fy + i * fz + weight),
            (a * mx + b * my + c * mz, d * mx + e * my + f * mz, g * mx + h * my + i * mz),
        )


def _inverse(inertia: Inertia, axes: tuple[int, int, int]) -> Block:
    """Of the part of the 6 x 6 mass matrix about the origin that couples these three axes, row by row.

    Symmetry parts surge, heave and pitch from sway, roll and yaw.
    """
    cx, cy, cz = inertia.centre
    cross = np.array([[0.0, -cz, cy], [cz, 0.0, -cx], [-cy, cx, 0.0]])
    moments = np.diag(inertia.moments)
    moments[0, 2] = moments[2, 0] = inertia.product
    matrix = np.zeros((6, 6))
    matrix[:3, :3] = inertia.mass * np.eye(3)
    matrix[:3, 3:] = -inertia.mass * cross
    matrix[3:, :3] = inertia.mass * cross
    matrix[3:, 3:] = moments - inertia.mass * cross @ cross
    matrix += np.diag((*inertia.added_mass, *inertia.added_moments))
    block = np.linalg.inv(matrix[np.ix_(axes, axes)])
    a, b, c, d, e, f, g, h, i = (float(value) for value in block.ravel())
    return (a, b, c, d, e, f, g, h, i)
