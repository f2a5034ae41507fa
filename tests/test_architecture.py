"""Who may import whom: the table of docs/architecture.md against every source file."""

from __future__ import annotations

import ast
import functools
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ROW = re.compile(r"^\| `([\w.]+)/?` \|.*\| ([^|]*`[^|]*) \|$", re.MULTILINE)
ONLY = re.compile(r"`([\w.]+)` in ([^;]+) only")


@dataclass(frozen=True)
class Row:
    """One line of the table."""

    everywhere: frozenset[str]
    only: dict[str, frozenset[str]]
    """Of a module, the files that may import it."""

    def allows(self, module: str, path: Path) -> bool:
        return any(_within(module, allowed) for allowed in self.everywhere) or any(
            _within(module, allowed) and path.name in files for allowed, files in self.only.items()
        )


def _within(module: str, allowed: str) -> bool:
    return module == allowed or module.startswith(f"{allowed}.")


def _quoted(text: str) -> frozenset[str]:
    return frozenset(re.findall(r"`([\w.]+)`", text))


def _table() -> dict[str, Row]:
    text = (ROOT / "docs" / "architecture.md").read_text()
    return {
        name: Row(
            _quoted(ONLY.sub("", cell)), {module: _quoted(files) for module, files in ONLY.findall(cell)}
        )
        for name, cell in ROW.findall(text)
    }


TABLE = _table()


@functools.cache  # three tests ask for the same file
def imports(path: Path) -> tuple[str, ...]:
    found: list[str] = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found += (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            found += (f"{node.module}.{alias.name}" for alias in node.names)
    return tuple(found)


def _sources(name: str) -> list[Path]:
    place = ROOT / name
    return sorted(place.rglob("*.py")) if place.is_dir() else [place]


SOURCES = [(name, path) for name in TABLE for path in _sources(name)]


def _foreign(name: str, path: Path) -> list[str]:
    return [m for m in imports(path) if m.split(".")[0] not in {name, *sys.stdlib_module_names}]


def test_the_table_has_a_row_for_each_part():
    assert set(TABLE) == {"main.py", "bridge", "widgets", "app", "robotside", "sim"}


@pytest.mark.parametrize(
    ("name", "path"), SOURCES, ids=[path.relative_to(ROOT).as_posix() for _, path in SOURCES]
)
def test_arrows_never_point_outward(name, path):
    assert not [module for module in _foreign(name, path) if not TABLE[name].allows(module, path)]


@pytest.mark.parametrize("name", TABLE)
def test_the_table_allows_nothing_that_is_not_used(name):
    row = TABLE[name]
    used = {(module, path.name) for path in _sources(name) for module in _foreign(name, path)}
    idle = {a for a in row.everywhere if not any(_within(module, a) for module, _ in used)}
    for allowed, files in row.only.items():
        idle |= {(allowed, f) for f in files if not any(_within(m, allowed) and f == n for m, n in used)}
    assert not idle


@pytest.mark.parametrize("path", _sources("widgets"), ids=lambda path: path.name)
def test_a_widget_knows_of_no_network_no_thread_and_no_app(path):
    found = set(imports(path))
    assert not {module.split(".")[0] for module in found} & {"asyncio", "socket", "threading"}
    assert "kivy.app.App" not in found or path.name in {"__main__.py", "gallery.py"}
