"""`robotside token`: a key for a program, with a role, an end and a name."""

from __future__ import annotations

import argparse
import math
import sys
import time

from bridge.core.identity import Role
from robotside.commands.state_directory import add_state, state_of
from robotside.commands.user_mistake import UserMistake
from robotside.core.refusal import Refusal
from robotside.trust.people import TOKEN, added, make_person
from robotside.trust.people_file import PeopleFile, Unkept

__all__ = ["add", "run"]

MAX_DAYS = 36_500.0
"""How long a token may last [d]."""
_DAY = 86_400.0


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    token = commands.add_parser("token", help="make a key for a program; it is shown once and kept nowhere")
    token.add_argument("name", help="name of the program, for people")
    token.add_argument("--role", choices=("watch", "drive", "manage"), default="watch", help="default: watch")
    token.add_argument("--days", type=float, default=30.0, help="days until it ends, by default 30")
    add_state(token)
    token.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Make it and print it; a robot that runs takes it within a second."""
    if not (math.isfinite(options.days) and 0 < options.days <= MAX_DAYS):
        raise UserMistake(f"A token lasts more than 0 and at most {MAX_DAYS:g} days, not {options.days:g}.")
    now = time.time()
    role, ends = Role.read(options.role), now + options.days * _DAY
    try:
        made, token = make_person(options.name, role, TOKEN, now=now, ends=ends)
        PeopleFile(state_of(options)).change(lambda people: added(people, made))
    except (Refusal, Unkept) as problem:
        raise UserMistake(str(problem)) from problem
    said = f"{made.name} may {made.role} for {options.days:g} days with this key, which is shown only now:"
    print(said, file=sys.stderr)
    print(token)
    return 0
