"""What brings a library that this installation lacks, in words."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

__all__ = ["how_to_install", "is_installed"]

ROOT = Path(__file__).parents[2]
_TARGETS = {"video": "make video"}
"""Extras that a command of the Makefile brings besides `make setup`."""


def is_installed(*packages: str) -> bool:
    """Whether all of them can be imported; imports none."""
    return all(find_spec(package) is not None for package in packages)


def how_to_install(extra: str, root: Path = ROOT) -> str:
    """The command that brings that extra: in a clone one of its Makefile, else pip in the folder of the sources.

    Never pip with the project's name alone: a registry may have something else by that name.
    """
    if (root / "Makefile").is_file():
        return _TARGETS.get(extra, "make setup")
    return f"pip install '.[{extra}]' in the folder of its sources"
