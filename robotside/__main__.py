"""`python -m robotside serve`: the robot side alone, of one robot or of several in one simulated world."""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import random
import signal
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from typing import Any

from bridge.client.credentials import Credentials
from bridge.core.address import BadAddress, host_and_port
from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from bridge.core.toml_files import FileFault
from bridge.msgs import Msg
from robotside import options as said
from robotside.bringing_up.announcement import news, qr_code, ready
from robotside.bringing_up.dialogue import NotAnswered, Simulated, ask
from robotside.bringing_up.settling import blamed
from robotside.commands.pairing_display import shown
from robotside.core.clock import RobotClock
from robotside.core.config import BadConfig, Config
from robotside.core.robot import Robot
from robotside.core.worker_thread import WorkerThread
from robotside.foreign.foreign_link import ForeignLink
from robotside.foreign.foreign_robot import ForeignRobot
from robotside.foreign.robot_keys import key_for, read_keys
from robotside.gateway_options import for_robot, keeper, required
from robotside.kinds.registry import kind_of
from robotside.options import OTHER, One, UserMistake
from robotside.records.landmarks import take_over
from robotside.records.opening import open_records
from robotside.serving.fleet_server import FleetServer
from robotside.serving.garbage import set_aside
from robotside.serving.gateway_board import Keep
from robotside.serving.malloc_trim import trim
from robotside.serving.station_keys import StationKeys
from robotside.serving.station_server import Addresses, StationServer
from robotside.station.station import Station
from robotside.tasks.schedule import local_zone
from robotside.trust.certificate import BadCertificate, Certificate, own_certificate, users_certificate
from robotside.trust.pairing import Offer

__all__ = ["main"]

SETTLED = 2.0
"""A start has freed all that it frees after this [s]."""

NOT_ANSWERED = 130
"""Exit status of who ends the dialogue, as of Ctrl-C in a shell."""

_ENDING = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
"""What ends it in order, the robot at rest: SIGHUP is that its terminal was closed."""

_HERE = ("127.0.0.1", "localhost", "::1")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; returns 0 when done, 2 for the user's mistake, 1 for a fault."""
    parent, options = os.getppid(), argparse.Namespace()
    try:
        options = said.read(argv, _ask)
        if options.command == "offer":
            print(_offer(_catalogue(), as_json=options.json))
            return 0
        if "run" in options:
            return int(options.run(options))
        return _serve(options, lambda: not options.with_parent or os.getppid() == parent)
    except (UserMistake, BadConfig, BadCertificate, BridgeError, FileFault) as problem:
        again = " `serve --ask` asks again." if getattr(options, "from_kept", False) else ""
        print(f"robotside: {problem}{again}", file=sys.stderr)
        return 2
    except NotAnswered:
        print("robotside: Nothing is served, and nothing was kept.", file=sys.stderr)
        return NOT_ANSWERED


def _ask(file: Path) -> None:
    """Ask a user at a terminal what to serve, and keep it in `file`."""
    try:
        catalogue = _catalogue()
    except UserMistake:
        catalogue = {"robots": (), "worlds": ()}  # others than simulated ones can be served
    ask(file, Simulated(tuple(catalogue["robots"]), tuple(catalogue["worlds"])))
    print(f"Kept in {file}; `python -m robotside serve --ask` asks again.", flush=True)


def _serve(options: argparse.Namespace, wanted: Callable[[], bool]) -> int:
    ones = said.robots(options)
    configs = said.configs(options, len(ones))
    ports = [said.ports(options, number) for number in range(len(ones))]
    robots, world = _robots(options, ones)
    trim()
    names = [one.name for one in ones]
    states = [said.state(options, names, number, world) for number in range(len(ones))]
    began, steady = time.time(), time.monotonic()
    try:
        said.check_reach(options, states)
        fleet = _Fleet(options, lambda: began + time.monotonic() - steady)
        asyncio.run(fleet.run(list(zip(ones, robots, configs, states, ports, strict=True)), wanted))
    finally:
        for robot in robots:
            robot.close()
    return 0


class _Fleet:
    """The robots of one robot side, each with a station, records and addresses of its own."""

    def __init__(self, options: argparse.Namespace, wall: Callable[[], float]) -> None:
        self._options, self._wall = options, wall
        given = options.certificate is not None
        self._certificate = users_certificate(options.certificate, options.key) if given else None
        self._clock = RobotClock(wall(), options.speed)
        self._keep: Keep | None = None

    async def run(
        self,
        robots: Sequence[tuple[One, Robot, Config, Path, tuple[int, int]]],
        wanted: Callable[[], bool],
    ) -> None:
        """Serve all of them until told to end, or no longer `wanted`."""
        self._keep = keeper(self._options.config, len(robots))
        with ExitStack() as kept:
            servings = [self._serving(number, *each, kept) for number, each in enumerate(robots)]
            for serving in servings:
                serving.belong(servings)
            together = FleetServer(servings, self._clock, self._wall, wanted=wanted)
            loop = asyncio.get_running_loop()
            for signal_number in _ENDING:
                if signal.getsignal(signal_number) is not signal.SIG_IGN:  # as nohup has it
                    loop.add_signal_handler(signal_number, together.end)
            # what the maps were made of is freed by the first steps
            later = loop.call_later(SETTLED, trim)
            set_aside()
            await together.run(self._say_ready)
            later.cancel()

    def _serving(
        self,
        number: int,
        one: One,
        robot: Robot,
        config: Config,
        state: Path,
        ports: tuple[int, int],
        kept: ExitStack,
    ) -> StationServer:
        station = self._station(number, one, robot, config, state, kept)
        addresses = Addresses(self._options.host, *ports)
        return StationServer(
            station,
            self._clock,
            self._wall,
            addresses,
            keys=self._keys(state, station, config),
            origins=self._options.allow_origin,
            gateways=for_robot(self._options.gateways, number),
            required=required(self._options),
            mdns=self._options.mdns,
            without=self._options.without,
            keep=self._keep,
        )

    def _station(
        self, number: int, one: One, robot: Robot, config: Config, state: Path, kept: ExitStack
    ) -> Station:
        call_soon = asyncio.get_running_loop().call_soon_threadsafe
        records = open_records(state, config.database.url, call_soon, backups=config.database.backups)
        kept.callback(records.close)
        station = Station(
            robot,
            records,
            now=self._clock.now,
            clock=self._wall,
            rng=random.Random(self._options.seed + number),
            name=one.called,
            config=config,
            civil=time.time,
            zone=local_zone(),
            worker=kept.enter_context(WorkerThread(f"planning {number}")),
            looker=kept.enter_context(WorkerThread(f"looking {number}")),
        )
        take_over(robot, records, station.events.say)
        station.bus.subscribe("/events", partial(_tell_news, station), replay=False)
        return station

    def _keys(self, state: Path, station: Station, config: Config) -> StationKeys:
        plain = Role.read(self._options.plain) if self._options.plain else None
        certificate = self._certificate or _own_certificate(state)
        return StationKeys(state, station, certificate, config.trust, plain=plain)

    def _say_ready(self, serving: StationServer) -> None:
        if self._options.plain:
            where, role = serving.addresses, self._options.plain
            said = f"everybody who reaches ports {where.port} and {where.http_port} may {role} without a key, and read along"
            print(f"robotside: plain: {said}", file=sys.stderr, flush=True)
        if self._options.pair and serving.keys is not None:
            pairing = serving.keys.pairing
            offer = pairing.open(Role.read(self._options.pair))
            print(f"robotside: pair {pairing.link(offer)}", flush=True)
            serving.keys.on_offer = partial(_show_offer, serving)
            _show_offer(serving, offer)
        else:
            _show_address(serving)
        _say_ready(serving)


def _own_certificate(state: Path) -> Certificate:
    own = own_certificate(state)
    if own.problem:
        print(f"robotside: {own.problem}", file=sys.stderr, flush=True)
    return own


def _show_offer(serving: StationServer, offer: Offer) -> None:
    """Show how to pair where a person reads it; only who is at the robot's own terminal does."""
    if serving.keys is None or not sys.stderr.isatty():
        return
    name, pairing = serving.station.info.name, serving.keys.pairing
    left = offer.open_until - serving.station.clock()
    with suppress(OSError):
        print(shown(name, pairing.link(offer), offer.code, left), file=sys.stderr, flush=True)


def _say_ready(serving: StationServer) -> None:
    where, name = serving.addresses, serving.station.info.name
    for line in ready(name, where.bridge, where.http, serving.gateways.endpoints, host=where.host):
        print(line, flush=True)


def _show_address(serving: StationServer) -> None:
    """Show a person at the terminal how the app comes to the robot."""
    shown_code = qr_code(serving.station.info.name, serving.addresses.bridge) if sys.stderr.isatty() else ""
    if shown_code:
        with suppress(OSError):
            print(shown_code, file=sys.stderr, flush=True)


def _tell_news(station: Station, _: str, event: Msg) -> None:
    """Tell in the terminal what happens to a gateway or payload; a terminal that is gone is no reason not to serve."""
    said_of_it = news(station.info.name, event)
    if said_of_it:
        with suppress(OSError):
            print(said_of_it, file=sys.stderr, flush=True)


def _robots(options: argparse.Namespace, ones: Sequence[One]) -> tuple[Sequence[Robot], str]:
    """The robots to serve, and the world of simulated ones."""
    if ones[0].name.startswith(OTHER):
        return _foreign([one.name.removeprefix(OTHER) for one in ones], options), ""
    try:
        from sim.robot import home_of, make_several
    except ImportError as missing:
        raise _no_simulation(missing) from missing
    except ValueError as fault:
        raise UserMistake(str(fault)) from fault  # in the file of a vehicle
    try:
        names = [one.name for one in ones]
        world = options.world or home_of(names)
        carried = [one.payloads for one in ones]
        made = make_several(
            names, world, seed=options.seed, gui=options.gui, payloads=carried, draws_beside=True
        )
    except (ValueError, RuntimeError) as problem:
        raise UserMistake(blamed(options, str(problem))) from problem
    return made, world


def _no_simulation(missing: ImportError) -> UserMistake:
    return UserMistake(f"The simulation is not installed ({missing.name} is missing).")


def _foreign(urls: Sequence[str], options: argparse.Namespace) -> Sequence[Robot]:
    """The robots behind rosbridge servers at these URLs; they are waited for together."""
    if options.speed != 1.0:
        raise UserMistake(f"A real robot moves in real time: --speed must be 1, not {options.speed:g}.")
    for url in urls:
        _check_other(url, range(options.port, options.port + len(urls)), (*_HERE, options.host))
    keys = read_keys(options.robot_keys) if options.robot_keys else {}
    with ThreadPoolExecutor(len(urls)) as together:
        robots = list(together.map(partial(_other, keys), urls))
    for robot in robots:
        if robot.trouble:
            print(f"robotside: {robot.trouble} It is served all the same.", file=sys.stderr, flush=True)
    return robots


def _other(keys: dict[str, Credentials], url: str) -> ForeignRobot:
    return ForeignRobot(url, connect=partial(ForeignLink, credentials=key_for(url, keys)))


def _check_other(url: str, own_ports: range, own_hosts: Sequence[str]) -> None:
    try:
        host, port = host_and_port(url)
    except BadAddress as problem:
        raise UserMistake(str(problem)) from problem
    if host in own_hosts and port in own_ports:
        raise UserMistake(f"The robot at {url} would be this program itself; --port names another port.")


def _catalogue() -> dict[str, Any]:
    """Which robots and worlds can be simulated."""
    try:
        from sim.catalogue import catalogue
    except ImportError as missing:
        raise _no_simulation(missing) from missing
    except ValueError as fault:
        raise UserMistake(str(fault)) from fault
    found = catalogue()
    for robot in found["robots"]:
        robot["icon"] = kind_of(robot["kind"]).icon
    return found


def _offer(catalogue: dict[str, Any], *, as_json: bool) -> str:
    if as_json:
        return json.dumps(catalogue)
    lines = [
        "Robots:",
        *(
            f"  {each['name']:<12} {each['description']}; at home in {each['home']}"
            for each in catalogue["robots"]
        ),
    ]
    lines += [
        "Worlds:",
        *(
            f"  {each['name']:<12} {each['description']}; for {', '.join(each['robots'])}"
            for each in catalogue["worlds"]
        ),
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
