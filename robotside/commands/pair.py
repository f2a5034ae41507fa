"""`robotside pair` and `robotside guest`: open pairing on a robot that runs."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from bridge.trust.pairing import BadPairing, PairLink
from robotside.commands.pairing_display import shown
from robotside.commands.state_directory import add_state, state_of
from robotside.commands.user_mistake import UserMistake
from robotside.trust.pair_requests import PairRequest, ask
from robotside.trust.qr import write_png

__all__ = ["add", "run"]

_HOUR = 3600.0


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add both commands."""
    pair = commands.add_parser(
        "pair", help="open pairing for a handheld on a robot that runs, for ten minutes"
    )
    pair.add_argument(
        "--role",
        choices=("watch", "drive", "manage"),
        default="drive",
        help="default: drive; where no handheld is known it has manage",
    )
    guest = commands.add_parser("guest", help="open pairing for a guest, whose role ends by itself")
    guest.add_argument("--role", choices=("watch", "drive"), default="watch", help="default: watch")
    guest.add_argument("--hours", type=float, default=1.0, help="hours until the role ends, by default 1")
    for command in (pair, guest):
        command.add_argument(
            "--png", type=Path, metavar="FILE", help="write the QR code there too, to print it"
        )
        add_state(command)
        command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Ask the robot and show what it answers."""
    state = state_of(options)
    duration = options.hours * _HOUR if options.command == "guest" else 0.0
    if options.command == "guest" and not duration > 0:
        raise UserMistake(f"A guest stays longer than {options.hours:g} hours.")
    answer = ask(state, PairRequest(options.role, duration))
    try:
        robot = PairLink.read(answer.link).name
    except BadPairing as problem:
        raise UserMistake(str(problem)) from problem
    if options.png is not None:
        try:
            write_png(answer.link, options.png)
        except OSError as error:
            why = (error.strerror or str(error)).lower()
            raise UserMistake(f"The picture cannot be written to {str(options.png)!r}: {why}.") from error
    print(shown(robot, answer.link, answer.code, answer.until - time.time()))
    return 0
