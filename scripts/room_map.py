"""Rooms of each package, drawn from the imports: the tables and maps of docs/architecture.md.

`python scripts/room_map.py` writes them anew. The order of the rows is kept, sentences come from each room: a row's place says which floor its
room is on, and imports go to lower floors only. tests/test_architecture.py holds the page and every import to that.
"""

from __future__ import annotations

import ast
import functools
import re
import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

__all__ = [
    "PACKAGES",
    "PAGE",
    "circles",
    "floors",
    "module_imports",
    "outer_imports",
    "room_imports",
    "room_of",
    "with_maps",
]

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "architecture.md"
PACKAGES = ("app", "widgets", "robotside", "sim", "bridge")

_SECTION = re.compile(r"(<!-- rooms of (\w+) -->\n)(.*?)(<!-- end of rooms -->)", re.DOTALL)
_ROW = re.compile(r"^\| `([\w/.*]+)` \|", re.MULTILINE)

Graph = Mapping[str, frozenset[str]]
"""What each node imports."""


def module_name(path: Path) -> str:
    """Dotted name of the module in `path`, as it is imported."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@functools.cache
def sources(package: str) -> Mapping[str, Path]:
    """Every module of a package by its dotted name."""
    return {module_name(path): path for path in sorted((ROOT / package).rglob("*.py"))}


@functools.cache
def imported_names(path: Path) -> tuple[str, ...]:
    """Dotted names that a file imports, anywhere in it: `from a import b` gives `a.b`."""
    found: list[str] = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found += (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            found += (f"{node.module}.{alias.name}" for alias in node.names)
    return tuple(found)


def _module(name: str, known: Mapping[str, Path]) -> str:
    while name and name not in known:
        name = name.rpartition(".")[0]
    return name


@functools.cache
def module_imports(package: str) -> Graph:
    """Which modules of its own package each module imports."""
    known = sources(package)
    return {
        module: frozenset(_module(name, known) for name in imported_names(path)) - {module, "", package}
        for module, path in known.items()
    }


def room_of(path: Path) -> str:
    """The room that a file stands in, as `app/link`; what `bridge/generate` makes is one room."""
    folder = path.relative_to(ROOT).parent.as_posix()
    return "bridge/msgs" if folder.startswith("bridge/msgs/") else folder


@functools.cache
def room_imports(package: str) -> Graph:
    """Which rooms of its own package each room imports."""
    known = sources(package)
    found: dict[str, set[str]] = defaultdict(set)
    for module, imports in module_imports(package).items():
        room = room_of(known[module])
        found[room] |= {room_of(known[name]) for name in imports} - {room}
    return {room: frozenset(imports) for room, imports in found.items()}


def circles(graph: Graph) -> list[list[str]]:
    """Groups of nodes that import each other, directly or through others (Tarjan's strongly connected components)."""
    numbers: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(node: str) -> None:
        numbers[node] = lowest[node] = len(numbers)
        stack.append(node)
        for target in graph.get(node, ()):
            if target not in numbers:
                visit(target)
                lowest[node] = min(lowest[node], lowest[target])
            elif target in stack:
                lowest[node] = min(lowest[node], numbers[target])
        if lowest[node] == numbers[node]:
            at = stack.index(node)
            if len(stack) - at > 1:
                found.append(sorted(stack[at:]))
            del stack[at:]

    for node in graph:
        if node not in numbers:
            visit(node)
    return found


def _reach(graph: Graph, node: str) -> frozenset[str]:
    seen: set[str] = set()
    left = list(graph.get(node, ()))
    while left:
        target = left.pop()
        if target not in seen:
            seen.add(target)
            left += graph.get(target, ())
    return frozenset(seen)


def direct(graph: Graph) -> Graph:
    """The same graph without the arrows that others imply."""
    return {
        node: frozenset(
            target
            for target in targets
            if not any(target in _reach(graph, other) for other in targets if other != target)
        )
        for node, targets in graph.items()
    }


def floors(package: str, text: str) -> list[str]:
    """The rooms of a package as its table on the page has them, top floor first."""
    for match in _SECTION.finditer(text):
        if match[2] == package:
            return _ROW.findall(match[3])
    return []


def _order(package: str, text: str) -> list[str]:
    """Rooms on the floors that the page gives them; a room that is new stands right above the highest that it imports."""
    graph = room_imports(package)
    order = [room for room in floors(package, text) if room in graph]
    for room in sorted(set(graph) - set(order), key=lambda room: (len(_reach(graph, room)), room)):
        below = [order.index(target) for target in graph[room] if target in order]
        order.insert(min(below, default=len(order)), room)
    return order


def idea(room: str) -> str:
    """The first sentence of a room's own docstring."""
    said = ast.get_docstring(ast.parse((ROOT / room / "__init__.py").read_text(encoding="utf-8"))) or ""
    return said.partition("\n\n")[0].replace("\n", " ")


def _rows(package: str, order: Iterable[str]) -> Iterator[str]:
    graph, known = room_imports(package), sources(package)
    yield "| room | what it is | modules | imports |"
    yield "|---|---|---|---|"
    for room in order:
        count = sum(room_of(path) == room and path.name != "__init__.py" for path in known.values())
        targets = ", ".join(target.removeprefix(f"{package}/") for target in order if target in graph[room])
        yield f"| `{room}` | {idea(room)} | {count} | {targets or '–'} |"


def outer_imports(package: str) -> Graph:
    """The same for the outer rooms: a room within another one counts as that."""
    outer: dict[str, set[str]] = defaultdict(set)
    for room, targets in room_imports(package).items():
        name = _outer(room)
        outer[name] |= {_outer(target) for target in targets} - {name}
    return {room: frozenset(targets) for room, targets in outer.items()}


def _map(package: str) -> Iterator[str]:
    """The outer rooms of a package as a Mermaid flow chart, arrows that others imply left out."""
    graph = direct(outer_imports(package))
    yield "```mermaid"
    yield "flowchart TD"
    for room in sorted(graph):
        yield f'    {_id(room)}["{room.partition("/")[2] or package}"]'
    for room in sorted(graph):
        for target in sorted(graph[room]):
            yield f"    {_id(room)} --> {_id(target)}"
    yield "```"


def _outer(room: str) -> str:
    return "/".join(room.split("/")[:2])


def _id(room: str) -> str:
    return room.replace("/", "_")


def with_maps(text: str) -> str:
    """The page with the table and map of each package as the imports have them now."""

    def anew(match: re.Match[str]) -> str:
        lines = [*_rows(match[2], _order(match[2], text)), "", *_map(match[2])]
        return match[1] + "\n".join(lines) + "\n" + match[4]

    return _SECTION.sub(anew, text)


if __name__ == "__main__":
    for package in PACKAGES:
        for circle in circles(room_imports(package)):
            print(f"circle of rooms: {', '.join(circle)}", file=sys.stderr)
    PAGE.write_text(with_maps(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
