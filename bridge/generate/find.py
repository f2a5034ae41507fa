"""The input files of a run: those that are given, and those beside them that they need."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from bridge.generate.model import Definition, TextError
from bridge.generate.rostext import SUFFIXES, read

__all__ = ["definitions"]


def definitions(given: Iterable[Path], package: str | None, known: Callable[[str], bool]) -> list[Definition]:
    """The definitions in the `given` files, a folder standing for all in it, and the messages that they need.

    A message that is neither given nor `known` is searched for beside the file that needs it. TextError where it is
    not found.
    """
    found: dict[Path, Definition] = {path: read(path, package) for path in _files(given)}
    waiting = [(path, definition.parts[0].package) for path, definition in found.items()]
    names = {part.rosname for definition in found.values() for part in definition.parts}
    while waiting:
        path, owner = waiting.pop(0)
        for need in sorted({need for part in found[path].parts for need in part.needs}):
            if need in names or known(need):
                continue
            beside, other = _beside(path, owner, need), need.split("/")[0]
            found[beside] = read(beside, other)
            names.add(need)
            waiting.append((beside, other))
    return [found[path] for path in sorted(found)]


def _files(given: Iterable[Path]) -> Iterator[Path]:
    seen: set[Path] = set()
    for path in given:
        inside = (
            sorted(each for each in path.rglob("*") if each.suffix in SUFFIXES) if path.is_dir() else [path]
        )
        if not inside:
            raise TextError(f"{path} holds no .msg, .srv or .action file.")
        for each in inside:
            if each.resolve() not in seen:
                seen.add(each.resolve())
                yield each


def _beside(path: Path, owner: str, need: str) -> Path:
    """The file of the type `need` near `path`: in the same folder, in its package's, in that of a package beside it."""
    package, name = need.split("/")
    folder = path.parent
    places = [folder / package / "msg", folder.parent.parent / package / "msg", folder / package]
    if package == owner:
        places = [folder, folder.parent / "msg", *places]
    for place in places:
        if (place / f"{name}.msg").is_file():
            return place / f"{name}.msg"
    raise TextError(f"{path} needs {need}, of which nothing is known; give its .msg file as well.")
