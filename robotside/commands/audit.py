"""`python -m robotside audit`: who did what with a robot, from its database, also while it is served."""

from __future__ import annotations

import argparse
import sqlite3
import sys
from pathlib import Path

from robotside.commands.state_directory import add_state, state_of
from robotside.commands.user_mistake import UserMistake
from robotside.records.audit_export import csv_lines
from robotside.records.database.audit_rows import Audited, first_bad, read_file

__all__ = ["add", "run"]

ELSEWHERE = (
    "a robot that is served shows its audit log at /audit.csv of its web site, to those with the role manage"
)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command and its options."""
    parser = commands.add_parser(
        "audit", help="show who did what with a robot, or check that nothing was changed"
    )
    add_state(parser)
    parser.add_argument("--csv", type=Path, metavar="FILE", help="write all rows to this file instead")
    parser.add_argument(
        "--verify", action="store_true", help="check the chain of hashes; exit code 1 when it is broken"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print, write or check the audit log; 1 when rows were changed or are missing."""
    rows = _rows(state_of(options) / "records.sqlite3")
    if options.csv is not None:
        _write(options.csv, rows)
        print(f"{len(rows)} rows are in {options.csv}.")
    if options.verify:
        return _verified(rows)
    if options.csv is None:
        sys.stdout.writelines(csv_lines(rows))
    return 0


def _rows(path: Path) -> list[Audited]:
    if not path.is_file():
        raise UserMistake(f"There is no database {str(path)!r}; {ELSEWHERE}.")
    try:
        return list(read_file(path))
    except sqlite3.Error as error:
        raise UserMistake(f"The database {str(path)!r} cannot be read ({error}); {ELSEWHERE}.") from error


def _write(path: Path, rows: list[Audited]) -> None:
    try:
        with path.open("w", encoding="utf-8", newline="") as file:
            file.writelines(csv_lines(rows))
    except OSError as error:
        raise UserMistake(f"{str(path)!r} cannot be written: {error.strerror}.") from error


def _verified(rows: list[Audited]) -> int:
    bad = first_bad(rows)
    if bad is not None:
        print(f"Row {bad} is missing or not as it was written.")
        return 1
    if not rows:
        print("The audit log is empty.")
        return 0
    print(
        f"All {len(rows)} rows are as they were written; the last is {rows[-1].id} with the hash {rows[-1].hash}."
    )
    return 0
