"""The directory of what a robot keeps, as a command finds it."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from robotside.commands.user_mistake import UserMistake

__all__ = ["add_state", "base", "state_of"]

MAX_SHOWN = 5
"""Directories that are named in a sentence."""


def base() -> Path:
    """Where robots keep their things, each in a directory of its own, when `--state` names none."""
    kept = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    return Path(kept) / "pilothouse"


def add_state(parser: argparse.ArgumentParser) -> None:
    """Add `--state` to a command about one robot."""
    parser.add_argument(
        "--state",
        type=Path,
        default=None,
        metavar="DIR",
        help="directory of what the robot keeps, as of serve; by default that of the only robot of this computer",
    )


def state_of(options: argparse.Namespace) -> Path:
    """The directory that `--state` names, else the only one there is; UserMistake when it is not clear which."""
    if options.state is not None:
        if not options.state.is_dir():
            raise UserMistake(f"There is no directory {str(options.state)!r}; --state names that of a robot.")
        return Path(options.state)
    kept = base()
    found = sorted(each for each in kept.iterdir() if each.is_dir()) if kept.is_dir() else []
    if not found:
        raise UserMistake(
            f"No robot has kept anything in {str(kept)!r} yet; --state names another directory."
        )
    if len(found) > 1:
        named = ", ".join(each.name for each in found[:MAX_SHOWN]) + (", …" if found[MAX_SHOWN:] else "")
        raise UserMistake(f"{len(found)} robots keep things in {str(kept)!r} ({named}); name one by --state.")
    return found[0]
