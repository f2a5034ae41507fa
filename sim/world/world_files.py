"""World files: the worlds that come with the simulator, and the reading of one from its TOML file."""

from __future__ import annotations

from pathlib import Path

from msgspec import structs

from bridge.core.toml_files import FileFault, fault, read, text_of
from sim.world.world import World
from sim.world.world_faults import faults

__all__ = ["WORLDS", "WorldError", "load", "parse"]

_FOLDER = Path(__file__).parents[1] / "worlds"


WORLDS: tuple[str, ...] = tuple(sorted(path.stem for path in _FOLDER.glob("*.toml")))
"""The names of the worlds that come with the simulation."""


class WorldError(ValueError):
    """A world that is not there or whose file is wrong; the text names the file, the line, the key and the reason."""


def load(world: str | Path) -> World:
    """The world of that name, or of that TOML file.

    Raises WorldError when there is no such world, or naming the line, the key and the reason when its file is wrong.
    """
    path = Path(world) if str(world).endswith(".toml") else _FOLDER / f"{world}.toml"
    if path.parent != _FOLDER and Path(world).is_dir():
        raise WorldError(f"{world} is a directory; a world is one file, as in {Path(world, 'lake.toml')}.")
    if path.parent == _FOLDER and path.stem not in WORLDS:
        raise WorldError(f"There is no world {str(world)!r}; there is {', '.join(WORLDS)}.")
    try:
        return parse(text_of(path), path.name, path.parent)
    except FileFault as problem:
        raise WorldError(str(problem)) from problem


def parse(text: str, source: str, folder: Path | None = None) -> World:
    """The world that a TOML `text` describes; `source` is what a fault calls it, `folder` where the files of its models are."""
    try:
        world = read(text, World, source)
        if world.models:
            here = (folder or Path()).resolve()
            placed = tuple(structs.replace(entry, file=str(here / entry.file)) for entry in world.models)
            world = structs.replace(world, models=placed)
        for where, reason in faults(world):
            raise fault(text, source, where, reason)
    except FileFault as problem:
        raise WorldError(str(problem)) from problem
    return world
