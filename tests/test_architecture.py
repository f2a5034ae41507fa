"""Who may import whom: the tables of docs/architecture.md against every source file, by path."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from scripts.room_map import (
    PACKAGES,
    PAGE,
    ROOT,
    circles,
    floors,
    imported_names,
    module_imports,
    outer_imports,
    room_imports,
    room_of,
    sources,
    with_maps,
)
from tests.looped import looped

TEXT = PAGE.read_text(encoding="utf-8")
ROW = re.compile(r"^\| `([\w.]+)/?` \|.*\| ([^|]*`[^|]*) \|$", re.MULTILINE)
ONLY = re.compile(r"`([\w.]+)` in ([^;]+) only")
MAX_MODULES = 18
"""Of one room; what the generator of message types writes does not count."""


@dataclass(frozen=True)
class Row:
    """One line of the table of packages."""

    everywhere: frozenset[str]
    only: dict[str, frozenset[str]]
    """Of a library, the files and folders of the package that may import it."""

    def allows(self, module: str, path: str) -> bool:
        return any(_within(module, allowed) for allowed in self.everywhere) or any(
            _within(module, allowed) and any(_at(path, place) for place in places)
            for allowed, places in self.only.items()
        )


def _within(module: str, allowed: str) -> bool:
    return module == allowed or module.startswith(f"{allowed}.")


def _at(path: str, place: str) -> bool:
    return path == place or (place.endswith("/") and path.startswith(place))


def _quoted(text: str) -> frozenset[str]:
    return frozenset(re.findall(r"`([\w./]+)`", text))


def _table() -> dict[str, Row]:
    return {
        name: Row(
            _quoted(ONLY.sub("", cell)), {module: _quoted(files) for module, files in ONLY.findall(cell)}
        )
        for name, cell in ROW.findall(TEXT[: TEXT.index("<!-- rooms of")])
    }


TABLE = _table()


def _sources(name: str) -> list[Path]:
    place = ROOT / name
    return sorted(place.rglob("*.py")) if place.is_dir() else [place]


SOURCES = [(name, path) for name in TABLE for path in _sources(name)]


def _path(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def _foreign(name: str, path: Path) -> list[str]:
    return [m for m in imported_names(path) if m.split(".")[0] not in {name, *sys.stdlib_module_names}]


def test_the_table_has_a_row_for_each_part():
    assert set(TABLE) == {"main.py", *PACKAGES}


@pytest.mark.parametrize("name", TABLE)
def test_arrows_never_point_outward(name):
    wrong = {
        _path(p): [m for m in _foreign(name, p) if not TABLE[name].allows(m, _path(p))]
        for p in _sources(name)
    }
    assert not {path: modules for path, modules in wrong.items() if modules}


def test_a_permission_holds_for_its_path_and_not_for_a_file_of_the_same_name():
    row = Row(frozenset({"numpy"}), {"jnius": frozenset({"app/device/__init__.py", "app/phone/"})})
    assert row.allows("numpy.linalg", "app/x.py")
    assert row.allows("jnius", "app/device/__init__.py")
    assert row.allows("jnius", "app/phone/any.py")
    assert not row.allows("jnius", "app/screens/__init__.py")


@pytest.mark.parametrize("name", TABLE)
def test_the_table_allows_nothing_that_is_not_used(name):
    row = TABLE[name]
    used = {(module, _path(path)) for path in _sources(name) for module in _foreign(name, path)}
    idle = {a for a in row.everywhere if not any(_within(module, a) for module, _ in used)}
    for allowed, places in row.only.items():
        idle |= {(allowed, p) for p in places if not any(_within(m, allowed) and _at(n, p) for m, n in used)}
    assert not idle


@pytest.mark.parametrize("package", PACKAGES)
def test_tables_and_maps_of_the_rooms_are_those_of_the_imports(package):
    assert set(floors(package, TEXT)) == set(room_imports(package)), "run python scripts/room_map.py"
    assert with_maps(TEXT) == TEXT, "run python scripts/room_map.py"


def _upward(package: str) -> Iterator[str]:
    order = floors(package, TEXT)
    for room, targets in room_imports(package).items():
        for target in targets:
            if order.index(target) <= order.index(room):
                yield f"{room} imports {target}, which stands above it"


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_between_rooms_go_to_lower_floors_only(package):
    assert not list(_upward(package))


@pytest.mark.parametrize("package", PACKAGES)
def test_no_rooms_and_no_modules_import_each_other(package):
    assert not circles(room_imports(package))
    assert not circles(module_imports(package))


@pytest.mark.parametrize("package", PACKAGES)
def test_the_outer_rooms_of_the_map_import_each_other_in_no_circle(package):
    assert not circles(outer_imports(package))


def test_a_circle_is_found_through_others():
    graph = {"a": frozenset({"b"}), "b": frozenset({"c"}), "c": frozenset({"a", "d"}), "d": frozenset()}
    assert circles(graph) == [["a", "b", "c"]]
    assert circles({"a": frozenset({"b"}), "b": frozenset({"c"}), "c": frozenset()}) == []


@pytest.mark.parametrize("package", PACKAGES)
def test_no_room_is_too_full(package):
    rooms: dict[str, int] = {}
    for path in sources(package).values():
        if path.name != "__init__.py" and room_of(path) != "bridge/msgs":
            rooms[room_of(path)] = rooms.get(room_of(path), 0) + 1
    assert not {room: count for room, count in rooms.items() if count > MAX_MODULES}


THREADED_WIDGETS = {"widgets/map/tiles/tile_reader.py", "widgets/map/grid_worker.py"}
"""Decode files and prepare grids beside the loop that draws; no widget is called from their threads."""


@looped("path", _sources("widgets"))
def test_a_widget_knows_of_no_network_no_thread_and_no_app(path):
    found = set(imported_names(path))
    foreign = {module.split(".")[0] for module in found} & {"asyncio", "socket", "threading"}
    assert foreign == ({"threading"} if _path(path) in THREADED_WIDGETS else set())
    assert "kivy.app.App" not in found or _path(path) in {"widgets/__main__.py", "widgets/gallery.py"}
