"""All types that a run of the generator knows: those from the given texts and those that bridge.msgs has."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from bridge.generate.extras import EXTENDS
from bridge.generate.model import Definition, Part, TextError
from bridge.msgs import TYPES

__all__ = ["Library", "known"]

_LIST = re.compile(r"(?!(?:uint8|char|byte)\b).*\]")


def known(rosname: str) -> bool:
    """Whether a module of bridge.msgs has a class called `rosname`."""
    return rosname in set(TYPES)


class Library:
    """The parts of all texts of one run, by their ROS names."""

    def __init__(self, definitions: Iterable[Definition]) -> None:
        """TextError when two texts define the same name."""
        self.parts: dict[str, Part] = {}
        sources: dict[str, str] = {}
        for definition in definitions:
            for part in definition.parts:
                first = sources.setdefault(part.rosname, definition.source)
                if part.rosname in self.parts:
                    raise TextError(f"{first} and {definition.source} both define {part.rosname}.")
                self.parts[part.rosname] = part

    @property
    def packages(self) -> list[str]:
        """The packages of the given texts, by alphabet."""
        return sorted({part.package for part in self.parts.values()})

    def rostypes(self, rosname: str) -> tuple[str, ...]:
        """The types of its fields."""
        part = self.parts.get(rosname)
        return tuple(each.kind.rostype for each in part.fields) if part else TYPES[rosname].ROSTYPES

    def holds_list(self, rosname: str) -> bool:
        """Whether a value of it holds something that can be changed, so that messages must not share it."""
        return rosname not in ("time", "duration") and any(
            _LIST.fullmatch(each) or ("/" in each and "[" not in each and self.holds_list(each))
            for each in self.rostypes(rosname)
        )

    def ancestor(self, part: Part) -> Part | None:
        """The part whose fields `part` begins with, where its class is a subclass of that one's."""
        parent = self.parts.get(EXTENDS.get(part.rosname, ""))
        if parent is None:
            return None
        first = part.fields[: len(parent.fields)]
        if [(each.name, each.kind) for each in first] != [(each.name, each.kind) for each in parent.fields]:
            raise TextError(f"{part.rosname} does not begin with the fields of {parent.rosname}.")
        return parent

    def ordered(self, package: str) -> list[Part]:
        """The parts of `package` in alphabetical order, but each behind its own parts; TextError for a circle."""
        done: dict[str, Part] = {}
        for name in sorted(name for name, part in self.parts.items() if part.package == package):
            self._place(name, package, done, ())
        return list(done.values())

    def _place(self, name: str, package: str, done: dict[str, Part], way: tuple[str, ...]) -> None:
        if name in way:
            raise TextError(f"{' holds '.join([*way[way.index(name) :], name])}, which cannot be.")
        if name in done or name not in self.parts:
            return
        part = self.parts[name]
        for need in self._needs(part):
            self._place(need, package, done, (*way, name))
        if part.package == package:
            done[name] = part

    def _needs(self, part: Part) -> Iterator[str]:
        yield from sorted(part.needs)
        if parent := self.ancestor(part):
            yield parent.rosname
