"""`robotside people`: list, remove and rename those whom a robot knows."""

from __future__ import annotations

import argparse
import time
from datetime import UTC, datetime

from robotside.commands.state_directory import add_state, state_of
from robotside.commands.user_mistake import UserMistake
from robotside.core.refusal import Refusal
from robotside.trust.people import Person, removed, renamed
from robotside.trust.people_file import PeopleFile, Unkept

__all__ = ["add", "run"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    people = commands.add_parser("people", help="list, remove or rename those whom a robot knows")
    people.add_argument("what", nargs="?", choices=("list", "remove", "rename"), default="list")
    people.add_argument("who", nargs="?", default="", help="name or id of the person to remove or rename")
    people.add_argument("name", nargs="?", default="", help="its new name")
    add_state(people)
    people.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Do it; a robot that runs notices within a second."""
    file = PeopleFile(state_of(options))
    if (options.what != "list") != bool(options.who) or (options.what == "rename") != bool(options.name):
        raise UserMistake("Write people, people remove NAME, or people rename NAME NEW-NAME.")
    try:
        if options.what == "remove":
            print(_removed(file, options.who))
        elif options.what == "rename":
            print(_renamed(file, options.who, options.name))
        else:
            print(_listed(file.read(), time.time()))
    except (Refusal, Unkept) as problem:
        raise UserMistake(str(problem)) from problem
    if file.problem:
        raise UserMistake(file.problem)
    return 0


def _removed(file: PeopleFile, who: str) -> str:
    gone: list[Person] = []

    def remove(people: tuple[Person, ...]) -> tuple[Person, ...]:
        left, person = removed(people, who)
        gone.append(person)
        return left

    file.change(lambda people: remove(tuple(people)))
    return f"{gone[0].name} was removed: its key opens nothing any more."


def _renamed(file: PeopleFile, who: str, name: str) -> str:
    file.change(lambda people: renamed(people, who, name)[0])
    return f"{who} is called {name.strip()} now."


def _listed(people: tuple[Person, ...], now: float) -> str:
    if not people:
        return "This robot knows nobody: pair a handheld with serve --pair, or make a token."
    rows = [("name", "role", "kind", "last seen", "ends", "id")]
    rows += [
        (each.name, each.role, each.kind, _when(each.last_seen, "never"), _end(each, now), each.id)
        for each in people
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = ("  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)


def _end(person: Person, now: float) -> str:
    return "has ended" if person.end <= now else _when(person.ends, "")


def _when(moment: float | None, otherwise: str) -> str:
    """Local time."""
    if moment is None:
        return otherwise
    try:
        return datetime.fromtimestamp(moment, UTC).astimezone().strftime("%Y-%m-%d %H:%M")
    except (ValueError, OverflowError, OSError):
        return "?"
