"""Tests mirror the sources: a module has a test at the same place, or tests/mirror.toml says which test holds it, or why none does."""

from __future__ import annotations

import tomllib
from pathlib import Path

from scripts.room_map import PACKAGES, ROOT, imported_names, module_name, sources
from tests.looped import looped

HELD = tomllib.loads((ROOT / "tests" / "mirror.toml").read_text(encoding="utf-8"))
"""By module, the test file that holds it, or one sentence that says why it has none."""

GENERATED = "bridge.msgs"


def own_test(path: Path) -> Path:
    relative = path.relative_to(ROOT)
    return ROOT / "tests" / relative.parent / f"test_{relative.name}"


def needs_a_test(module: str, path: Path) -> bool:
    return path.name not in {"__init__.py", "__main__.py"} and not module.startswith(GENERATED)


WITHOUT = {
    module: path
    for package in PACKAGES
    for module, path in sources(package).items()
    if needs_a_test(module, path) and not own_test(path).exists()
}


def reaches(test: Path, module: str) -> bool:
    """A test file imports the module, or something out of its room that does."""
    names = imported_names(test)
    return any(name == module or name.startswith(f"{module}.") for name in names)


def test_each_module_has_a_test_of_its_own_or_is_held_by_another():
    assert sorted(WITHOUT) == sorted(HELD)


@looped("module", sorted(HELD))
def test_what_holds_a_module_is_a_test_that_imports_it_or_a_reason(module):
    held_by = HELD[module]
    if held_by.startswith("tests/"):
        assert reaches(ROOT / held_by, module)
    else:
        assert held_by.endswith(".")
        assert len(held_by.split()) > 3


def test_a_mirrored_test_has_a_module():
    """A test that stands in a room's folder and is named after a module that went would hide that."""
    known = {name for package in PACKAGES for name in sources(package)}
    assert all(module in known for module in HELD)
    assert module_name(ROOT / "app" / "link" / "feeds.py") in known
