"""Command line of `python -m robotside`: its options, checked, and the robots that they name."""

from __future__ import annotations

import argparse
import math
import os
import re
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Protocol

from bridge.core.errors import BridgeError
from bridge.discovery.domain import VARIABLE, check_domain, discovery_domain
from bridge.server.reception.pages import read_origin
from robotside.bringing_up import guide
from robotside.bringing_up.settling import NO_ASK, VARIABLES, Ask, blamed, settle
from robotside.commands import audit, erase, pair, people, token
from robotside.commands.state_directory import base
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import DEFAULT_CONFIG, Config, load
from robotside.core.installing import how_to_install
from robotside.gateway_options import add_options as add_gateways
from robotside.gateway_options import wishes, without
from robotside.gateways.addresses import is_here
from robotside.trust.people_file import PeopleFile, Unkept

__all__ = [
    "COMMANDS",
    "MAX_ROBOTS",
    "OTHER",
    "Command",
    "One",
    "UserMistake",
    "check_reach",
    "configs",
    "ports",
    "read",
    "robots",
    "state",
]

MAX_ROBOTS = 32
"""Robots of one robot side."""
OTHER = "ros:"
"""Begins the name of a robot behind a rosbridge server, with its URL."""


class Command(Protocol):
    """A module of a command, as those of `robotside.commands`."""

    def add(self, commands: argparse._SubParsersAction[Any]) -> None:
        """Add the command and its options, with its `run(options) -> int` as their default `run`."""


COMMANDS: tuple[Command, ...] = (guide, people, token, pair, audit, erase)
"""Those beside `serve` and `offer`, in the order of the help."""


@dataclass(frozen=True, slots=True)
class One:
    """One of the robots to serve."""

    name: str
    """Name of a simulated robot, as in `patrol`; `ros:URL` of another."""
    payloads: tuple[str, ...]
    """Its extra payloads."""
    called: str
    """Name for people; empty for that of the robot or its settings."""


_PRECEDENCE = (
    "An option counts before the environment, that before robot.toml, that before the default. The environment has "
    f"{', '.join(VARIABLES.values())}, PILOTHOUSE_GATEWAYS and PILOTHOUSE_CONFIG; {NO_ASK} is --no-ask. robot.toml is the file of "
    "--config (of several, the first), else the one that serve keeps in the directory of --state or of all robots, unless "
    "--robot names another robot."
)


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> None:  # type: ignore[override]
        raise UserMistake(f"{message[0].upper()}{message[1:]}; see {self.prog} --help.")


def read(argv: Sequence[str] | None, ask: Ask | None = None) -> argparse.Namespace:
    """The options; UserMistake with one sentence for a mistake. `ask` asks at a terminal where nothing says what to serve."""
    words = list(sys.argv[1:] if argv is None else argv)
    if words and words[0].startswith("-") and words[0] not in ("-h", "--help"):
        words.insert(0, "serve")
    about = "The robot's computer. `serve` is optional before options; `serve --help` lists them."
    parser = _Parser(prog="python -m robotside", description=about)
    commands: Any = parser.add_subparsers(dest="command", required=True)
    serve = commands.add_parser(
        "serve", help="serve one robot, or several in one simulated world", epilog=_PRECEDENCE
    )
    _add_serve(serve)
    _add_trust(serve)
    offer = commands.add_parser("offer", help="list the robots and worlds that can be simulated")
    offer.add_argument("--json", action="store_true", help="as JSON, for programs")
    for command in COMMANDS:
        command.add(commands)
    options = parser.parse_args(words)
    if options.command == "serve":
        settle(options, os.environ, ask)
        _check(options)
    return options


def _add_serve(serve: argparse.ArgumentParser) -> None:
    add = serve.add_argument
    add(
        "--robot",
        help="robots to serve, by default sim:patrol; several in one world with their payloads, as sim:patrol,scout+arm; "
        "or ros:ws://HOST:9090 for a robot behind a rosbridge server, several with commas between",
    )
    add(
        "--world",
        help="world of the simulated robots: a name or a TOML file; default: the robot's home",
    )
    add(
        "--host",
        help="address to listen on: by default this machine only; 0.0.0.0 lets a phone in",
    )
    add(
        "--port",
        type=int,
        help="port of the rosbridge socket, by default 9090, one more for each further robot; 0 takes free ports",
    )
    add("--http-port", type=int, help="port of the web site, by default 8080, likewise")
    add("--payloads", help="extra payloads of a simulated robot: arm,laser,…")
    add(
        "--without",
        help="payloads that are off from the start, of every robot: camera,line_sensor,…; what safety needs stays on",
    )
    _add_more(serve)


def _add_more(serve: argparse.ArgumentParser) -> None:
    add = serve.add_argument
    add_gateways(serve)
    add("--seed", type=int, default=0, help="seed of the random numbers of simulation and patrol")
    add("--speed", type=float, default=1.0, help="simulated seconds per second; commands expire in real time")
    add(
        "--config",
        type=Path,
        action="append",
        default=[],
        metavar="ROBOT.TOML",
        help="settings file: limits, fence, safe state, database, name, what is brought up; docs/robot.toml.example has all "
        "settings; for several robots one for all, or one each in their order",
    )
    add(
        "--ask",
        action=argparse.BooleanOptionalAction,
        help="ask what to bring up, with what robot.toml says as answers, and keep it there; without the option that is asked at a "
        "terminal only, when neither options, environment nor robot.toml say it; --no-ask never asks",
    )
    add(
        "--state",
        type=Path,
        default=None,
        help="directory of the database; each of several robots has its own in it",
    )
    add("--name", default="", help="name of the robot; names of several robots, separated by commas")
    add(
        "--domain",
        help="discovery domain: only handhelds of the same one find the robot; by default PILOTHOUSE_DOMAIN, else that of all",
    )
    add("--mdns", action="store_true", help="announce the robot by mDNS too, for networks without broadcast")
    add("--gui", action="store_true", help="show simulated robots in the physics engine's window")
    add("--with-parent", action="store_true", help="exit when the program that started it exits")


def _add_trust(serve: argparse.ArgumentParser) -> None:
    add, roles = serve.add_argument, ("watch", "drive", "manage")
    add(
        "--pair",
        nargs="?",
        const="drive",
        choices=roles,
        help="open pairing for ten minutes and one handheld, with this role, by default drive; where no "
        "handheld is known it has manage. Of several robots each shows a link of its own",
    )
    add(
        "--plain",
        nargs="?",
        const="drive",
        choices=roles,
        help="let programs of other computers in without encryption and without a key, with this role, by default drive; "
        "everybody in the network can be one of them",
    )
    add(
        "--allow-origin",
        action="append",
        default=[],
        metavar="URL",
        help="let web pages of this origin speak to the robot, as http://localhost:8000; may be given several times",
    )
    add(
        "--robot-keys",
        type=Path,
        metavar="FILE",
        help='keys for the robots of --robot ros:… that want one: a TOML file with fingerprint and token under each ["HOST:PORT"]',
    )
    add("--certificate", type=Path, metavar="FILE", help="a certificate of your own, in PEM, with --key")
    add("--key", type=Path, metavar="FILE", help="its private key, in PEM, without a password")


def _check(options: argparse.Namespace) -> None:
    _check_trust(options)
    _check_mdns(options)
    _check_domain(options)
    for name in ("port", "http_port"):
        number = getattr(options, name)
        if not 0 <= number <= 65535:
            raise UserMistake(f"A port is 0 to 65535, not {number}.")
    if not (math.isfinite(options.speed) and 0 < options.speed <= 100):
        raise UserMistake(f"The speed must be above 0 and at most 100, not {options.speed}.")
    if options.robot.startswith(OTHER):
        for given, option in ((options.payloads, "payloads"), (options.world, "world"), (options.gui, "gui")):
            if given:
                raise UserMistake(blamed(options, f"--{option} is for simulated robots only."))
    if options.gui and not os.environ.get("DISPLAY"):
        raise UserMistake("--gui needs a display, and DISPLAY is not set.")
    options.gateways = wishes(options)
    options.without = without(options)


def _check_mdns(options: argparse.Namespace) -> None:
    if options.mdns and find_spec("zeroconf") is None:
        raise UserMistake(
            f"--mdns needs zeroconf, which is not installed: {how_to_install('mdns')} brings it."
        )


def _check_domain(options: argparse.Namespace) -> None:
    """Have what the robot side announces, and what it starts, go by the option."""
    try:
        if options.domain is not None:
            os.environ[VARIABLE] = check_domain(options.domain)
        discovery_domain()
    except BridgeError as fault:
        raise UserMistake(str(fault)) from fault


def _check_trust(options: argparse.Namespace) -> None:
    if (options.certificate is None) != (options.key is None):
        raise UserMistake("--certificate and --key go together: give both, or none.")
    for origin in options.allow_origin:
        try:
            read_origin(origin)
        except ValueError as problem:
            raise UserMistake(f"--allow-origin: {problem}") from problem


def robots(options: argparse.Namespace) -> list[One]:
    """The robots to serve, in their order; UserMistake when it is not clear which."""
    text = options.robot
    kind, _, rest = text.partition(":")
    words = [word.strip().removeprefix(f"{kind}:") for word in rest.split(",")]
    if kind not in ("sim", "ros") or not all(words):
        said = "write simulated ones as sim:patrol or sim:patrol,scout, others as ros:ws://192.168.1.7:9090"
        raise UserMistake(blamed(options, f"There is no robot {text!r}; {said}."))
    if len(words) > MAX_ROBOTS:
        raise UserMistake(f"One robot side serves at most {MAX_ROBOTS} robots, not {len(words)}.")
    called = _names(options.name, len(words))
    if kind == "ros":
        return [_other(word, name, words) for word, name in zip(words, called, strict=True)]
    return [_one(word, name, options, len(words)) for word, name in zip(words, called, strict=True)]


def _one(word: str, called: str, options: argparse.Namespace, count: int) -> One:
    name, *carried = word.split("+")
    if options.payloads and count > 1:
        raise UserMistake(
            f"--payloads is for one robot. For {count} robots give each its payloads, as in sim:patrol+arm+lights,scout."
        )
    return One(name, (*carried, *filter(None, options.payloads.split(","))), called)


def _other(url: str, called: str, all_urls: Sequence[str]) -> One:
    if all_urls.count(url) > 1:
        raise UserMistake(f"--robot names {url} twice; a robot is served once.")
    return One(f"{OTHER}{url}", (), called)


def _names(text: str, count: int) -> list[str]:
    """One for each of the robots; empty ones when nothing was said."""
    if not text or count == 1:
        return [text] * count
    names = [name.strip() for name in text.split(",")]
    if len(names) != count:
        raise UserMistake(f"--name must have {count} names separated by commas, not {len(names)}: {text!r}.")
    for name, times in Counter(names).items():
        if times > 1:
            raise UserMistake(f"--name gives {name!r} to {times} robots; each robot needs its own name.")
    return names


def configs(options: argparse.Namespace, count: int) -> list[Config]:
    """The settings of each of the robots; BadConfig or UserMistake with one sentence."""
    files: list[Path] = options.config
    if len(files) not in (0, 1, count):
        raise UserMistake(f"Give --config once, or {count} times for {count} robots, not {len(files)} times.")
    read = [load(file) for file in files] or [DEFAULT_CONFIG]
    if len(read) == count:
        return read
    only = read[0]
    for what, given in (("name", only.robot.name), ("database", only.database.url)):
        if given is not None:
            raise UserMistake(
                f"{files[0]}: {count} robots cannot share its {what}; give each a --config of its own."
            )
    return read * count


def ports(options: argparse.Namespace, number: int) -> tuple[int, int]:
    """Of the rosbridge socket and of the web site of the robot of this number, from 0 on."""
    bridge, http = (port and port + number for port in (options.port, options.http_port))
    if max(bridge, http) > 65535:
        raise UserMistake(f"Robot {number + 1} would have port {max(bridge, http)}; a port is 0 to 65535.")
    return bridge, http


def state(options: argparse.Namespace, names: Sequence[str], number: int, world: str) -> Path:
    """The directory of what the robot of this number keeps; the same whether it is served alone or with others."""
    before = names[:number].count(names[number])
    name = f"{names[number]}-{before + 1}" if before else names[number]
    if options.state is not None:
        return Path(options.state) / name if len(names) > 1 else Path(options.state)
    if name.startswith(OTHER):
        return base() / _plain(name)
    where = str(Path(world).resolve()) if world.endswith(".toml") else world
    return base() / f"sim-{_plain(name)}-{_plain(where)}"


def _plain(name: str) -> str:
    return re.sub(r"[^\w.-]+", "-", name)


def check_reach(options: argparse.Namespace, states: Sequence[Path]) -> None:
    """UserMistake when other computers could reach a robot of one of these state directories that nobody is paired with.

    Where robot.toml wants it, pairing is opened instead.
    """
    if options.pair or options.plain or is_here(options.host):
        return
    for state in states:
        file = PeopleFile(state)
        try:
            known = file.read()
        except Unkept as problem:
            raise UserMistake(str(problem)) from problem
        if not known and not file.problem and options.settings.serve.pair:
            options.pair = "drive"
            return
        if not known:
            damaged = f"{file.problem} " if file.problem else ""
            raise UserMistake(
                f"{damaged}Nobody is paired with the robot in {state}, so nobody could use it from {options.host}: "
                "add --pair and scan the QR code with the app, or --plain to let everybody in the network drive."
            )
