"""A thing from a file: what it looks like, and what bodies and lasers meet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from sim.core.shapes import Shape
from sim.parts.errors import PartError

__all__ = ["Part", "part"]

ENDINGS = (".glb", ".gltf", ".urdf")
"""Of the files of parts."""
MAX_FILE = 50_000_000
"""Of a file [bytes]."""


@dataclass(frozen=True, slots=True)
class Part:
    """A thing in its own frame."""

    solids: tuple[Shape, ...]
    """Shapes that bodies and lasers hit."""
    visuals: tuple[Shape, ...]
    """Shapes that cameras see."""


def part(path: Path, scale: float = 1.0) -> Part:
    """The thing in the file at `path`, `scale` times as large, in its own frame: x ahead, y left, z up [m].

    PartError with one sentence when there is none.
    """
    if path.suffix.lower() not in ENDINGS:
        raise PartError(f"a part is a file that ends with {', '.join(ENDINGS)}, not {path.name!r}")
    try:
        found = path.stat()
    except OSError as fault:
        raise PartError(f"{path.name} cannot be read ({fault.strerror})") from fault
    except ValueError as fault:
        raise PartError(f"{path.name!r} is no name of a file") from fault
    if found.st_size > MAX_FILE:
        raise PartError(f"{path.name} has {found.st_size} bytes; at most {MAX_FILE} can be")
    return _read(path, scale, found.st_mtime_ns)


@lru_cache(maxsize=64)
def _read(path: Path, scale: float, _changed: int) -> Part:
    solids, visuals = _reader(path)(path, scale)
    return Part(solids, visuals)


def _reader(path: Path) -> Callable[[Path, float], tuple[tuple[Shape, ...], tuple[Shape, ...]]]:
    # the library for meshes takes time and memory, and most worlds have none
    if path.suffix.lower() == ".urdf":
        from sim.parts.urdf import read_urdf

        return read_urdf
    from sim.parts.gltf import read_gltf

    return read_gltf
