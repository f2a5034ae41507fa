"""`python -m robotside serve`: the robot side alone."""

from __future__ import annotations

import argparse
import asyncio
import math
import os
import random
import re
import signal
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from bridge.address import BadAddress, host_and_port
from bridge.errors import BridgeError
from robotside.clock import RobotClock
from robotside.config import NOTHING_SET, BadConfig, Config, load
from robotside.database import Records
from robotside.database.opening import open_records
from robotside.foreign import ForeignRobot
from robotside.robot import Robot
from robotside.schedule import local_zone
from robotside.serving import Addresses, Serving
from robotside.station import Station

__all__ = ["main"]

_HERE = ("127.0.0.1", "localhost", "::1")


class UserMistake(Exception):
    """What was typed cannot be done; the text is one sentence."""


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> None:  # type: ignore[override]
        raise UserMistake(f"{message[0].upper()}{message[1:]}; see python -m robotside serve --help.")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; returns 0 when done, 2 for the user's mistake, 1 for a fault."""
    parent = os.getppid()
    try:
        options = _options(argv)
        return _serve(options, lambda: not options.with_parent or os.getppid() == parent)
    except (UserMistake, BadConfig, BridgeError) as problem:
        print(f"robotside: {problem}", file=sys.stderr)
        return 2


def _options(argv: Sequence[str] | None) -> argparse.Namespace:
    words = list(sys.argv[1:] if argv is None else argv)
    if words and words[0].startswith("-") and words[0] not in ("-h", "--help"):
        words.insert(0, "serve")
    about = "The robot's computer. Before options `serve` may be left out; `serve --help` tells them."
    parser = _Parser(prog="python -m robotside", description=about)
    serve = parser.add_subparsers(dest="command", required=True).add_parser("serve", help="serve one robot")
    add = serve.add_argument
    add(
        "--robot",
        default="sim:patrol",
        help="what to serve: sim:patrol, or ros:ws://HOST:9090 for one behind a rosbridge server",
    )
    add("--world", default="parking_lot", help="where a simulated robot is")
    add(
        "--host",
        default="127.0.0.1",
        help="where to listen: this machine alone, unless 0.0.0.0 lets a phone in",
    )
    add("--port", type=int, default=9090, help="of the rosbridge socket; 0 takes a free one")
    add("--http-port", type=int, default=8080, help="of the web site; 0 takes a free one")
    add("--payloads", default="", help="what a simulated robot carries besides: arm,laser,…")
    add("--protocols", default="", help="rosbridge and http, which are always up")
    add("--seed", type=int, default=0, help="of the simulation's and the patrol's random numbers")
    add("--speed", type=float, default=1.0, help="simulated seconds per second; commands expire in real time")
    add(
        "--config",
        type=Path,
        default=None,
        metavar="ROBOT.TOML",
        help="limits, fence, safe state, database, name; docs/robot.toml.example has every setting",
    )
    add("--state", type=Path, default=None, help="directory of the database")
    add("--name", default="", help="what people call the robot")
    add("--with-parent", action="store_true", help="end when the program that started it is gone")
    options = parser.parse_args(words)
    _check(options)
    return options


def _check(options: argparse.Namespace) -> None:
    for name in ("port", "http_port"):
        number = getattr(options, name)
        if not 0 <= number <= 65535:
            raise UserMistake(f"A port is 0 to 65535, not {number}.")
    if not (math.isfinite(options.speed) and 0 < options.speed <= 100):
        raise UserMistake(f"The speed must be above 0 and at most 100, not {options.speed}.")
    if options.payloads and options.robot.startswith("ros:"):
        raise UserMistake("--payloads is for simulated robots; a real one has what it has.")
    unknown = set(filter(None, options.protocols.split(","))) - {"rosbridge", "http"}
    if unknown:
        raise UserMistake(f"There is no protocol {', '.join(sorted(unknown))}; there are rosbridge and http.")


def _serve(options: argparse.Namespace, wanted: Callable[[], bool]) -> int:
    config = load(options.config) if options.config else NOTHING_SET
    robot = _robot(options)
    began, steady = time.time(), time.monotonic()
    try:
        return asyncio.run(_run(options, config, robot, lambda: began + time.monotonic() - steady, wanted))
    finally:
        robot.close()


async def _run(
    options: argparse.Namespace,
    config: Config,
    robot: Robot,
    wall: Callable[[], float],
    wanted: Callable[[], bool],
) -> int:
    clock = RobotClock(wall(), options.speed)
    loop = asyncio.get_running_loop()
    kept = config.database
    records = open_records(_state(options), kept.url, loop.call_soon_threadsafe, backups=kept.backups)
    try:
        return await _serve_station(options, config, robot, records, clock, wall, wanted)
    finally:
        records.close()


async def _serve_station(
    options: argparse.Namespace,
    config: Config,
    robot: Robot,
    records: Records,
    clock: RobotClock,
    wall: Callable[[], float],
    wanted: Callable[[], bool],
) -> int:
    station = Station(
        robot,
        records,
        now=clock.now,
        clock=wall,
        rng=random.Random(options.seed),
        name=options.name,
        config=config,
        civil=time.time,
        zone=local_zone(),
    )
    addresses = Addresses(options.host, options.port, options.http_port)
    serving = Serving(station, clock, wall, addresses, wanted=wanted)
    loop = asyncio.get_running_loop()
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, serving.end)
    await serving.run(lambda where: _say_ready(where, station))
    return 0


def _say_ready(where: Addresses, station: Station) -> None:
    name = station.info.name
    print(f"robotside: ready bridge={where.bridge} http={where.http} robot={name}", flush=True)


def _state(options: argparse.Namespace) -> Path:
    if options.state is not None:
        return Path(options.state)
    base = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    kind = re.sub(r"[^\w.-]+", "-", options.robot)
    place = "" if options.robot.startswith("ros:") else f"-{options.world}"
    return Path(base) / "pilothouse" / f"{kind}{place}"


def _robot(options: argparse.Namespace) -> Robot:
    port, _, model = options.robot.partition(":")
    if port == "ros" and model:
        return _foreign(model, options)
    if port != "sim" or not model:
        said = "simulated ones are written as sim:patrol, others as ros:ws://192.168.1.7:9090"
        raise UserMistake(f"There is no robot {options.robot!r}; {said}.")
    try:
        from sim.robot import make
    except ImportError as missing:
        raise UserMistake(f"The simulation is not installed ({missing.name} is missing).") from missing
    try:
        carried = [name for name in options.payloads.split(",") if name]
        return make(model, options.world, seed=options.seed, payloads=carried)
    except ValueError as problem:
        raise UserMistake(str(problem)) from problem


def _foreign(url: str, options: argparse.Namespace) -> Robot:
    if options.speed != 1.0:
        raise UserMistake(f"A real robot moves in real time: --speed must be 1, not {options.speed:g}.")
    try:
        if host_and_port(url) in {(host, options.port) for host in (*_HERE, options.host)}:
            raise UserMistake(f"The robot at {url} would be this program itself; --port names another port.")
        robot = ForeignRobot(url)
    except BadAddress as problem:
        raise UserMistake(str(problem)) from problem
    if robot.trouble:
        print(f"robotside: {robot.trouble} It is served all the same.", file=sys.stderr, flush=True)
    return robot


if __name__ == "__main__":
    sys.exit(main())
