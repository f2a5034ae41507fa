"""What python-for-android makes of each requirement: a recipe that fits its pin, or a module that a phone can load.

Modules are put in by the pip of the machine that builds, without their dependencies as soon as one of them has no wheel; `bare_run`
shows that nothing is missing then.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NamedTuple

from scripts.android.failure import Failed, run

__all__ = ["Module", "Recipe", "Resolved", "check_recipes", "resolved"]

TOOLCHAIN = Path(__file__).parent / "toolchain"
GENERATED = "-any.whl"


class Recipe(NamedTuple):
    """What is built from its sources."""

    name: str
    version: str
    own: str
    """The version that the recipe was written for."""
    patches: int


class Module(NamedTuple):
    """What pip installs: names of files, empty where there is none."""

    name: str
    pin: str
    phone: str
    host: str
    source: str


class Resolved(NamedTuple):
    """Everything that goes into the package beside the app."""

    bootstrap: str
    python: str
    recipes: tuple[Recipe, ...]
    modules: tuple[Module, ...]


def resolved(python: Path, spec: Path) -> Resolved:
    """Asks python-for-android, by the Python that has it, and the package index; Failed where either does not answer."""
    told = run(str(python), str(TOOLCHAIN / "resolve.py"), str(spec), where=spec.parent, limit=600.0)
    answer: dict[str, Any] = json.loads(told.splitlines()[-1])
    recipes = tuple(Recipe(**one) for one in answer["recipes"])
    return Resolved(
        answer["bootstrap"], answer["python"], recipes, tuple(Module(**one) for one in answer["modules"])
    )


def check_recipes(found: Resolved) -> str:
    """Failed for what a real build would stop at; else what was found, in words."""
    for recipe in found.recipes:
        if recipe.patches and recipe.version != recipe.own:
            raise Failed(
                f"requirement {recipe.name}=={recipe.version}: its recipe's patches are for {recipe.own}. "
                "Drop the pin, or spell the name with an underscore if it is a pure module."
            )
    for module in found.modules:
        _check(module)
    return (
        f"recipes: {len(found.recipes)} of Python {found.python} ({found.bootstrap}), {len(found.modules)} modules, "
        "each with a file that a phone can load"
    )


def _check(module: Module) -> None:
    if "-" in module.name:
        raise Failed(
            f"requirement {module.name}: spelled with a hyphen it is added twice; write an underscore."
        )
    if not (module.phone or module.host or module.source):
        raise Failed(f"requirement {module.name}=={module.pin}: the package index has no such release.")
    if "-android_" in module.phone:
        raise Failed(
            f"requirement {module.name}: {module.phone} would be handed to the building machine's pip, which "
            "refuses it. Pin a release that is pure Python."
        )
    if not module.phone and not module.source:
        raise Failed(
            f"requirement {module.name}: {module.host} is of the building machine, and there is none for a phone."
        )
