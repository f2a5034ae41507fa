"""Who may import whom: the table of docs/architecture.md, read off every source file."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
HANDHELD = {"kivy", "kivy_garden", "numpy", "plyer", "jnius", "android", "mcap"}
ROBOT = {"numpy", "scipy", "skimage", "PIL", "py_trees", "starlette", "uvicorn", "msgspec"}
SIM = {"numpy", "PIL", "pybullet", "pybullet_data", "moderngl", "scipy", "msgspec"}
MAY_IMPORT = {
    "bridge": {"msgspec", "cbor2", "numpy"},
    "widgets": {"bridge", "kivy", "kivy_garden", "numpy"},
    "app": {"widgets", "bridge", "msgspec", *HANDHELD},
    "robotside": {"bridge", *ROBOT},
    "sim": {"bridge", *SIM},
}
ALSO = {
    "bridge/server.py": {"websockets"},
    "bridge/client.py": {"websockets"},
    "robotside/__main__.py": {"sim"},
}
WIDGETS_USE = ("bridge.msgs", "bridge.units", "bridge.geo")


def imports(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


SOURCES = [path for folder in MAY_IMPORT for path in sorted((ROOT / folder).rglob("*.py"))]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_arrows_never_point_outward(path):
    name = path.relative_to(ROOT).as_posix()
    folder = name.split("/")[0]
    allowed = MAY_IMPORT[folder] | ALSO.get(name, set()) | {folder} | sys.stdlib_module_names
    found = list(imports(path))
    assert not [module for module in found if module.split(".")[0] not in allowed]
    if folder == "widgets":
        assert not [m for m in found if m.startswith("bridge") and not m.startswith(WIDGETS_USE)]
        assert not [m for m in found if m.split(".")[0] in {"asyncio", "socket", "threading"}]
        assert "kivy.app.App" not in found or path.name in {"__main__.py", "gallery.py"}


def test_pybullet_stays_in_one_backend_file():
    users = {p for p in SOURCES if any(m.split(".")[0] == "pybullet" for m in imports(p))}
    assert len(users) <= 1, users
