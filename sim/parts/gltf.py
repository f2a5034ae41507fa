"""Parts in glTF 2.0 files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from sim.core.shapes import Colour, Shape
from sim.parts.errors import PartError
from sim.parts.gltf_faults import check_gltf
from sim.parts.pieces import Triangles, boxes, check, surface

__all__ = ["read_gltf", "read_triangles"]

_TO_OURS = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""From glTF's frame, in which y is up and a thing faces z, to one in which z is up and it faces x (REP 103)."""
GREY: Colour = (0.6, 0.6, 0.6)
"""Of what has no colour."""


def read_gltf(path: Path, scale: float) -> tuple[tuple[Shape, ...], tuple[Shape, ...]]:
    """Solids and visuals of the thing in the file; PartError with the reason when it is none. Each colour is a surface; textures count as their mean."""
    pieces = [(corners @ _TO_OURS.T * scale, colour) for corners, colour in read_triangles(path)]
    every = np.concatenate([corners for corners, _ in pieces]) if pieces else np.zeros((0, 3, 3))
    check(path.name, every)
    return (
        boxes(every, pieces[0][1]),
        tuple(surface(corners, colour) for corners, colour in pieces if len(corners)),
    )


def read_triangles(path: Path) -> list[tuple[Triangles, Colour]]:
    """Triangles of each piece in the file's own frame and units, (n, 3, 3), with its colour; PartError when it has none."""
    if path.suffix.lower() in (".glb", ".gltf"):
        check_gltf(path)
    try:
        scene: Any = trimesh.load(path, force="scene")
        found = [mesh for mesh in scene.dump() if isinstance(mesh, trimesh.Trimesh)]
    except Exception as fault:
        # the library raises whatever its parsers do
        raise PartError(f"{path.name} cannot be read as a {path.suffix[1:]} file") from fault
    return [(np.asarray(mesh.triangles, dtype=np.float64), _colour(mesh)) for mesh in found]


def _colour(mesh: trimesh.Trimesh) -> Colour:
    """The mean colour of a piece; glTF's factors are linear light, colours here are as a screen shows them."""
    visual: Any = mesh.visual
    material = getattr(visual, "material", None)
    factor = getattr(material, "baseColorFactor", None)
    texture = getattr(material, "baseColorTexture", None)
    seen = np.ones(3)
    if material is None and visual.kind in ("vertex", "face"):
        seen = np.asarray(visual.main_color[:3], dtype=np.float64) / 255
    elif material is None or (factor is None and texture is None):
        return GREY
    if texture is not None:
        seen = np.asarray(texture.convert("RGB"), dtype=np.float64).reshape(-1, 3).mean(axis=0) / 255
    if factor is not None:
        light = np.asarray(factor[:3], dtype=np.float64)
        light = light / 255 if np.asarray(factor).dtype.kind in "ui" else light
        seen = seen * light ** (1 / 2.2)
    red, green, blue = (float(part) for part in np.clip(seen, 0.0, 1.0))
    return red, green, blue
