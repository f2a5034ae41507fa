"""A robot side under attack by a million hostile frames and a hundred thousand HTTP requests, while an honest client drives it.

The robot side is the process that users start, with the simulated patrol robot. Two processes attack its rosbridge socket and its
web site at the same time over 52 connections, each from an address of its own: garbage and half JSON, wrong types, numbers that are
none, deep and huge messages, floods of names, fragments, pictures that grow, bytes that claim to be CBOR, wrong tokens, broken frames and
handshakes (`bench/support/attack/`), in plain and by TLS. One process attacks as a stranger, the other with a key that lets it watch. A frame counts once the robot has read it, for a pong must come from behind it; a request
once it was answered or its connection was ended. None presses STOP or asks for control: whoever asks for STOP gets it, by choice.

The honest client is one more process with a key to drive, by TLS. It drives, watches /pose, presses STOP again and again, releases it and drives on. The other way is
the same client and robot before the attack begins. Attackers have a lower priority than the robot, as if they had a computer
of their own. Memory is the resident set of the robot side: *grown* is the median of the last tenth of the attack less that of
the tenth in its middle.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, TextIO
from urllib.parse import urlsplit

import psutil

from bench.support.child import Child, child
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.station import Serving, serving
from robotside.trust.certificate import own_certificate

__all__ = ["Attacked", "attacked"]

CALM = "the same without attack"
FIGURES = (
    Figure("frames", "", "hostile frames that the robot has read"),
    Figure("requests", "", "hostile HTTP requests"),
    Figure("connections", "", "connections of the attackers"),
    Figure("seconds", "s", "so long it took"),
    Figure("tracebacks", "", "tracebacks in the robot's log", 0),
    Figure("lines", "", "lines in its log"),
    Figure("stops", "", "STOPs that an honest client pressed meanwhile"),
    Figure("unanswered", "", "of them not answered with success", 0),
    Figure("stop_p50", "ms", "STOP to its answer, median", against=CALM),
    Figure("stop_p99", "ms", "the same, 99 of 100", 300, against=CALM),
    Figure("gap", "ms", "longest time without a /pose", 300, against=CALM),
    Figure("way", "m", "driven by the honest client meanwhile", better="more"),
    Figure("memory_before", "MB", "resident before"),
    Figure("memory_mid", "MB", "resident in the middle"),
    Figure("memory_end", "MB", "resident at the end"),
    Figure("grown", "MB", "grown from the middle to the end", 3),
)
REPEATS = 1

ATTACKERS = 2
"""Processes."""
ROUNDS = 2
"""Of the honest client, which lasts as long as the attack at least."""
ADDRESSES = 40
"""Of loopback that one process may use."""
NICENESS = 10
CALM_TIME = 60.0
"""As long nobody attacks [s]."""
SAMPLE_PERIOD = 0.5
"""[s]"""
SETTLING = 2.0
"""[s]"""


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """The calm is a part of the same run."""
    calm: dict[str, float] = {}

    def ours() -> Mapping[str, float]:
        found = attacked(int(context.count("frames")), int(context.count("requests")))
        before = _honest(found.calm)
        calm.update({name: before[name] for name in ("stop_p50", "stop_p99", "gap")})
        return _figures(found)

    yield Sides(ours, lambda: calm)


class Attacked:
    """What became of a robot side under attack."""

    def __init__(self) -> None:
        self.calm: Mapping[str, Any] = {}
        """Report of the honest client before."""
        self.meanwhile: dict[str, Any] = {}
        """Its report of the attack."""
        self.count: Counter[str] = Counter()
        """What the attackers did."""
        self.seconds = 0.0
        self.memory: list[float] = []
        """Resident set during the attack, again and again [MB]."""
        self.memory_before = 0.0
        self.log: list[str] = []
        """Lines of the robot side."""
        self.ended: int | None = None
        """Exit code, if it ended before it was told to."""

    @property
    def tracebacks(self) -> list[str]:
        """Lines of the log that begin one, or tell of one that nobody caught."""
        signs = ("Traceback (most recent call last)", "never retrieved", "Fatal Python error")
        return [line for line in self.log if any(sign in line for sign in signs)]


def attacked(frames: int, requests: int, *, calm: float = CALM_TIME, seed: int = 1) -> Attacked:
    """Attack a robot side by so many of them, `calm` [s] after an honest client began to drive it."""
    found = Attacked()
    with ExitStack() as stack:
        log = stack.enter_context(tempfile.TemporaryFile("w+"))
        state = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        driver, watcher = key(state, "honest", "drive"), key(state, "watcher", "watch")
        robot = stack.enter_context(serving("robotside", *strict(state), state=str(state), log=log))
        honest = stack.enter_context(child("bench.support.attack.honest"))
        pin = own_certificate(state).fingerprint
        honest.ask({"url": robot.url.replace("ws://", "wss://"), "pin": pin, "token": driver})
        time.sleep(SETTLING)
        honest.ask({})
        time.sleep(calm)
        found.calm = honest.ask({})
        _attack(found, robot, honest, (frames, requests, seed), ("", watcher))
        time.sleep(SETTLING)
        found.ended = robot.child.process.poll()
        found.log = _lines(log)
    return found


def key(state: Path, name: str, role: str) -> str:
    """A key of the robot that keeps its records in `state`, made as users do."""
    command = [sys.executable, "-m", "robotside", "token", name, "--role", role, "--state", str(state)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def strict(state: Path) -> tuple[str, str]:
    """Options of a robot side on which also programs of its own computer are strangers."""
    config = state / "robot.toml"
    config.write_text('[trust]\nlocal_role = "none"\n')
    return "--config", str(config)


def _lines(log: TextIO) -> list[str]:
    log.seek(0)
    return log.read().splitlines()


def _attack(
    found: Attacked, robot: Serving, honest: Child, attack: tuple[int, int, int], tokens: Sequence[str]
) -> None:
    frames, requests, seed = attack
    process = psutil.Process(robot.child.process.pid)
    found.memory_before = process.memory_info().rss / 1e6
    began = time.monotonic()
    with ExitStack() as stack:
        attackers = [
            stack.enter_context(child("bench.support.attack.attacker", niceness=NICENESS))
            for _ in range(ATTACKERS)
        ]
        for number, (attacker, token) in enumerate(zip(attackers, tokens, strict=True)):
            order = _order(robot, number, -(-frames // ATTACKERS), -(-requests // ATTACKERS), seed)
            attacker.send({**order, "token": token})
        counts: list[dict[str, int]] = [{} for _ in attackers]
        readers = [
            threading.Thread(target=_follow, args=each) for each in zip(attackers, counts, strict=True)
        ]
        for reader in readers:
            reader.start()
        rounds = 0
        while not (
            rounds >= ROUNDS and _total(counts)["frames"] >= frames and _total(counts)["requests"] >= requests
        ):
            time.sleep(SAMPLE_PERIOD)
            found.memory.append(process.memory_info().rss / 1e6)
            _add(found.meanwhile, honest.ask({}))
            rounds = found.meanwhile["rounds"]
        for attacker in attackers:
            attacker.send({})
        for reader in readers:
            reader.join()
    found.count = _total(counts)
    found.seconds = time.monotonic() - began


def _total(counts: Sequence[Mapping[str, int]]) -> Counter[str]:
    total: Counter[str] = Counter()
    for each in counts:
        total.update({name: value for name, value in each.items() if name != "done"})
    return total


def _add(report: dict[str, Any], more: Mapping[str, Any]) -> None:
    """Add what an honest client saw since the last report."""
    for name, value in more.items():
        if name == "gap":
            report[name] = max(report.get(name, 0.0), value)
        else:
            report[name] = report[name] + value if name in report else value


def _order(robot: Serving, number: int, frames: int, requests: int, seed: int) -> dict[str, Any]:
    bridge, site = urlsplit(robot.url), urlsplit(robot.site)
    return {
        "host": bridge.hostname,
        "bridge": bridge.port,
        "http": site.port,
        "frames": frames,
        "requests": requests,
        "seed": seed * ATTACKERS + number,
        "first": 10 + number * ADDRESSES,
    }


def _follow(attacker: Child, count: dict[str, int]) -> None:
    """Take in what an attacker says of itself until it is done."""
    while not count.get("done"):
        count.update(json.loads(attacker.line()))


def _honest(report: Mapping[str, Any]) -> dict[str, float]:
    stops = [float("inf") if each is None else each for each in report["stops"]]
    return {
        "stops": len(stops),
        "unanswered": sum(each is None for each in report["stops"]),
        "stop_p50": percentile(stops, 0.5) * 1e3,
        "stop_p99": percentile(stops, 0.99) * 1e3,
        "gap": report["gap"] * 1e3,
        "way": report["way"],
    }


def _figures(found: Attacked) -> dict[str, float]:
    if found.ended is not None:
        raise RuntimeError(f"The robot side ended with {found.ended} under attack: {found.log[-20:]}")
    for line in found.meanwhile["refused"][-5:]:
        print(f"  the honest client was refused: {line}")
    for line in found.tracebacks:
        print(f"  {line}")
    middle, end = _tenth(found.memory, 0.45), _tenth(found.memory, 0.9)
    return {
        **_honest(found.meanwhile),
        **{name: found.count[name] for name in ("frames", "requests", "connections")},
        "seconds": found.seconds,
        "tracebacks": len(found.tracebacks),
        "lines": len(found.log),
        "memory_before": found.memory_before,
        "memory_mid": middle,
        "memory_end": end,
        "grown": end - middle,
    }


def _tenth(values: Sequence[float], begin: float) -> float:
    """Median of the tenth of the values from the share `begin` on."""
    first = int(len(values) * begin)
    return statistics.median(values[first : first + max(1, len(values) // 10)])
