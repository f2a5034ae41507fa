"""`python -m robotside erase NAME`: a person's name leaves what a robot keeps."""

from __future__ import annotations

import argparse
import sqlite3
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import Any

from robotside.commands.state_directory import add_state, state_of
from robotside.commands.user_mistake import UserMistake
from robotside.records.database.files import DatabaseFiles
from robotside.records.opening import open_records

__all__ = ["add", "run"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command and its options."""
    said = "put `erased` in the place of a person's name in what a robot that is not served keeps"
    parser = commands.add_parser("erase", help=said)
    parser.add_argument("name", metavar="NAME", help="the whole name, as events and the audit log have it")
    add_state(parser)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Erase the name; CannotOpen or UserMistake with one sentence when that cannot be done."""
    if not options.name.strip():
        raise UserMistake("A name to erase has letters; it is empty.")
    state = state_of(options)
    if not (state / "records.sqlite3").is_file():
        raise UserMistake(f"There is no database in {str(state)!r}.")
    problem = _erased(state, options.name)
    if problem:
        raise UserMistake(f"Nothing was erased. {problem}")
    try:
        gone = _without_copies(state / "records.sqlite3")
    except (OSError, sqlite3.Error) as error:
        raise UserMistake(f"The name is erased, but older copies have it: {error}.") from error
    print(
        f"{options.name!r} is erased; {gone} older copies of the database were deleted and a new backup made."
    )
    return 0


def _erased(state: Path, name: str) -> str:
    """Erase it in the database; returns why that could not be done, empty when it is done."""
    told: deque[tuple[Callable[..., object], tuple[Any, ...]]] = deque()
    records = open_records(state, None, lambda call, *given: told.append((call, given)))
    job = records.erase(name)
    records.close()
    while told:  # the outcome, which the thread that writes has told
        call, given = told.popleft()
        call(*given)
        if job.done:
            break
    return job.trouble if job.done else "The database did not answer."


def _without_copies(path: Path) -> int:
    """Delete backups and what was moved aside, which have the name, and make a new backup; returns how many there were."""
    files = DatabaseFiles(path)
    older = [*files.backups(), *files.set_aside_before()]
    files.back_up()
    for copy in older:
        files.delete(copy)
    return len(older)
