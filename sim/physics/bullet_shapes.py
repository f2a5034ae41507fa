"""Collision shapes and visual shapes of the physics engine, made from the simulator's own shapes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sim.core.shapes import Shape, Vec3
from sim.physics.quiet_pybullet import p

__all__ = ["collision", "compound", "visual"]

_ORIGIN: Vec3 = (0.0, 0.0, 0.0)


def collision(client: int, shape: Shape, offset: Vec3 = _ORIGIN) -> int:
    """Number of a collision shape, its centre at `offset` [m] in the frame of its body."""
    geometry = _geometry(shape)
    if "radius" in geometry and "length" in geometry:
        geometry["height"] = geometry.pop("length")
    return int(p.createCollisionShape(**geometry, collisionFramePosition=offset, physicsClientId=client))


def compound(client: int, shapes: Sequence[Shape]) -> int:
    """Number of one collision shape made of boxes, straight cylinders and spheres, placed in the world's frame."""
    return int(
        p.createCollisionShapeArray(
            shapeTypes=[_geometry(shape)["shapeType"] for shape in shapes],
            radii=[shape.size[0] / 2 for shape in shapes],
            halfExtents=[[extent / 2 for extent in shape.size] for shape in shapes],
            lengths=[shape.size[2] for shape in shapes],
            collisionFramePositions=[shape.position for shape in shapes],
            collisionFrameOrientations=[shape.rotation for shape in shapes],
            physicsClientId=client,
        )
    )


def visual(client: int, shape: Shape, offset: Vec3 = _ORIGIN) -> int:
    """Number of a visual shape, its centre at `offset` [m] in the frame of its body."""
    geometry = _geometry(shape)
    if "vertices" in geometry:
        geometry |= _surface(geometry["vertices"])
    colour = (*shape.colour, 1.0)
    return int(
        p.createVisualShape(**geometry, rgbaColor=colour, visualFramePosition=offset, physicsClientId=client)
    )


def _geometry(shape: Shape) -> dict[str, Any]:
    """The arguments that make `shape` in its own frame."""
    if shape.kind in ("sphere", "leaves"):
        return {"shapeType": p.GEOM_SPHERE, "radius": shape.size[0] / 2}
    if shape.is_tapered:
        plain = Shape(shape.kind, shape.size, taper=shape.taper)
        return {"shapeType": p.GEOM_MESH, "vertices": plain.corners()}
    if shape.kind == "cylinder":
        return {"shapeType": p.GEOM_CYLINDER, "radius": shape.size[0] / 2, "length": shape.size[2]}
    return {"shapeType": p.GEOM_BOX, "halfExtents": [extent / 2 for extent in shape.size]}


def _surface(points: Sequence[Vec3]) -> dict[str, Any]:
    """Triangles of the hull that `Shape.corners` spans, with a normal a corner, for drawing."""
    ring = len(points) // 2
    corners: list[Vec3] = []
    normals: list[Vec3] = []
    for i in range(ring):
        j = (i + 1) % ring
        side = (points[i], points[j], points[ring + j], points[ring + i])
        middle = ((side[0][0] + side[1][0]) / 2, (side[0][1] + side[1][1]) / 2, 0.0)
        _quad(side, middle, corners, normals)
    for base, up in ((0, -1.0), (ring, 1.0)):
        for i in range(1, ring - 1):
            corners += [points[base], points[base + i], points[base + i + 1]]
            normals += [(0.0, 0.0, up)] * 3
    return {"vertices": corners, "normals": normals, "indices": list(range(len(corners)))}


def _quad(side: Sequence[Vec3], outward: Vec3, corners: list[Vec3], normals: list[Vec3]) -> None:
    a, b, c, d = side
    length = max((outward[0] ** 2 + outward[1] ** 2) ** 0.5, 1e-9)
    normal = (outward[0] / length, outward[1] / length, 0.0)
    corners += [a, b, c, a, c, d]
    normals += [normal] * 6
