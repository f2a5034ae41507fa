"""Diagnostics of a robot as a tree: parts by the `/` in their names, the worst first, silent ones stale. No Kivy.

tree = DiagnosticsModel()
tree.take(message, now)
for row in tree.rows(now): print(row.depth, row.name, row.level)
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus

__all__ = ["ERROR", "MAX_PARTS", "OK", "STALE", "STALE_TIMEOUT", "WARN", "DiagnosticRow", "DiagnosticsModel"]

OK, WARN, STALE, ERROR = "ok", "warn", "stale", "error"
"""Levels from the best to the worst: of a silent part nobody knows what it is."""
_ORDER = (OK, WARN, STALE, ERROR)
_LEVELS = {
    DiagnosticStatus.OK: OK,
    DiagnosticStatus.WARN: WARN,
    DiagnosticStatus.ERROR: ERROR,
    DiagnosticStatus.STALE: STALE,
}
STALE_TIMEOUT = 5.0
"""A part that was not told of for so long is stale [s]; publishers tell once a second."""
MAX_PARTS = 400
"""Parts that are kept; of more the one that was silent longest goes."""
MAX_DEPTH = 8
"""Levels of names; what is deeper is one name."""
MAX_NAME, MAX_MESSAGE, MAX_VALUES = 200, 400, 60
"""Letters of a name and of a sentence, and readings of a part, that are kept."""
MAX_ROWS = 600
_SEPARATOR = re.compile(r"/+")

Path = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DiagnosticRow:
    """One line of the tree."""

    path: Path
    depth: int
    name: str
    level: str = ""
    """One of the constants; empty for a reading."""
    text: str = ""
    """What the part says, or the reading; of a group how many of its parts are not well."""
    age: float = math.nan
    """Of a stale part, since it was told of [s]; NaN for any other."""
    foldable: bool = False
    open: bool = False
    value: bool = False
    """A reading of the part above it."""


@dataclass(slots=True)
class _Part:
    status: DiagnosticStatus
    heard: float


@dataclass(slots=True)
class _Node:
    """A part, a group of parts, or both."""

    part: _Part | None = None
    inner: dict[str, _Node] = field(default_factory=dict)
    level: str = OK
    bad: int = 0
    """Parts in it that are not well, itself included."""


class DiagnosticsModel:
    """What was told last of each part. A message need not tell of all of them."""

    def __init__(self) -> None:
        self._parts: dict[Path, _Part] = {}
        self.folds: dict[Path, bool] = {}
        """What a finger opened or closed; any other is open where something in it is not well."""

    def take(self, message: DiagnosticArray, now: float) -> None:
        """Take in a message that came at `now` [s]."""
        for status in message.status:
            path = _path(status.name)
            self._parts.pop(path, None)  # the newest last
            self._parts[path] = _Part(status, now)
        while len(self._parts) > MAX_PARTS:
            del self._parts[next(iter(self._parts))]
        if len(self.folds) > MAX_PARTS:
            self.folds = {path: opened for path, opened in self.folds.items() if path in self._parts}

    def clear(self) -> None:
        """Forget everything: it is another robot."""
        self._parts.clear()
        self.folds.clear()

    def fold(self, path: Path, now: float) -> None:
        """Open what is closed, and close what is open."""
        row = next((one for one in self.rows(now) if one.path == path and not one.value), None)
        if row is not None and row.foldable:
            self.folds[path] = not row.open

    def level(self, now: float) -> str:
        """The worst of all; OK without any."""
        return self._tree(now).level

    def counts(self, now: float) -> Mapping[str, int]:
        """How many parts are at each level."""
        found = dict.fromkeys(_ORDER, 0)
        for part in self._parts.values():
            found[_level(part, now)] += 1
        return found

    def rows(self, now: float) -> list[DiagnosticRow]:
        """The tree as lines from top to bottom at `now` [s], the worst first, at most 600."""
        found: list[DiagnosticRow] = []
        for row in self._rows(self._tree(now), (), now):
            found.append(row)
            if len(found) == MAX_ROWS:
                break
        return found

    def _tree(self, now: float) -> _Node:
        root = _Node()
        for path, part in self._parts.items():
            node = root
            for name in path:
                node = node.inner.setdefault(name, _Node())
            node.part = part
        _judge(root, now)
        return root

    def _rows(self, node: _Node, path: Path, now: float) -> Iterator[DiagnosticRow]:
        order = sorted(node.inner.items(), key=lambda item: (-_ORDER.index(item[1].level), item[0].lower()))
        for name, inner in order:
            where = (*path, name)
            yield (row := self._row(inner, where, now))
            if not row.open:
                continue
            if inner.part is not None:
                for place, each in enumerate(inner.part.status.values[:MAX_VALUES]):
                    reading = f"{where}#{place}"
                    yield DiagnosticRow(
                        (*where, reading), row.depth + 1, _line(each.key), text=_line(each.value), value=True
                    )
            yield from self._rows(inner, where, now)

    def _row(self, node: _Node, path: Path, now: float) -> DiagnosticRow:
        part, group = node.part, bool(node.inner)
        readings = bool(part is not None and part.status.values)
        opened = self.folds.get(path, group and node.level != OK) and (group or readings)
        own = _level(part, now) if part is not None else OK
        age = now - part.heard if part is not None and own == STALE else math.nan
        text = _line(part.status.message) if part is not None else ""
        if part is None and node.bad:
            text = f"{node.bad}"
        return DiagnosticRow(path, len(path) - 1, path[-1], node.level, text, age, group or readings, opened)


def _judge(node: _Node, now: float) -> None:
    """The worst of a node and of all in it."""
    own = _level(node.part, now) if node.part is not None else OK
    node.bad = int(own != OK)
    levels = [own]
    for inner in node.inner.values():
        _judge(inner, now)
        levels.append(inner.level)
        node.bad += inner.bad
    node.level = max(levels, key=_ORDER.index)


def _level(part: _Part, now: float) -> str:
    """Of a part itself: what it said, or stale. A level that the message does not know is an error."""
    told = _LEVELS.get(part.status.level, ERROR)
    return STALE if now - part.heard > STALE_TIMEOUT and told != ERROR else told


def _path(name: str) -> Path:
    parts = [part.strip() for part in _SEPARATOR.split(name[:MAX_NAME]) if part.strip()]
    if len(parts) > MAX_DEPTH:
        parts = [*parts[: MAX_DEPTH - 1], "/".join(parts[MAX_DEPTH - 1 :])]
    return tuple(parts) or ("?",)


def _line(text: str) -> str:
    return " ".join(text[:MAX_MESSAGE].split())
