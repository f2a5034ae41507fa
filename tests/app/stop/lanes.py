"""Lanes of STOP ALL that do what a test tells them, and the session beside them."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from app.discovery.known_robots import Entry
from app.stop.fleet import Fleet
from app.stop.stop_lane import Report
from bridge.client.credentials import Credentials
from bridge.msgs.pilothouse_msgs import ControlStatus, RobotInfo

__all__ = ["PATIENCE", "A", "B", "C", "Lane", "Lanes", "Link", "heard", "phases", "until"]

PATIENCE = 10.0
"""A fault, not a delay, uses this up [s]."""
A, B, C = "ws://10.0.0.1:9090", "ws://10.0.0.2:9090", "ws://10.0.0.3:9090"


def until(condition: Callable[[], Any], what: str) -> None:
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.005)


class Lanes:
    """Lanes that do what a test tells them, by address."""

    def __init__(self) -> None:
        self.reports: dict[str, Report] = {}
        self.open: dict[str, Lane] = {}
        self.pressed: dict[str, int] = {}
        self.pinned: dict[str, Credentials | None] = {}
        self.may_end = threading.Event()
        self.may_end.set()

    def __call__(self, url: str, credentials: Credentials | None = None) -> Lane:
        self.pinned[url] = credentials
        self.pressed[url] = self.pressed.get(url, 0) + 1
        return Lane(self, url)


class Lane:
    """One of them."""

    def __init__(self, lanes: Lanes, url: str) -> None:
        self._lanes, self._url = lanes, url

    @property
    def report(self) -> Report:
        return self._lanes.reports.get(self._url, Report("sent"))

    def press(self) -> None:
        self._lanes.pressed[self._url] += 1

    async def run(self) -> None:
        self._lanes.open[self._url] = self
        try:
            await asyncio.Event().wait()
        finally:
            if not self._lanes.may_end.is_set():
                await asyncio.to_thread(self._lanes.may_end.wait)
            del self._lanes.open[self._url]


class LinkStop:
    """STOP of the robot that is connected."""

    def __init__(self) -> None:
        self.phase, self.sentence = "ready", ""

    @property
    def owed(self) -> bool:
        return self.phase in ("sent", "no_answer", "moves")


class Link:
    """The session with the robot that is connected."""

    def __init__(self, url: str, *, foreign: bool = False) -> None:
        info = RobotInfo(name="Linked", model="patrol")
        self.robot = SimpleNamespace(url=url, name="Linked", foreign=foreign, info=info)
        self.boot, self.fingerprint, self.control_status = "", "", ControlStatus()
        self.link, self.connected, self.ever_connected = object(), True, True
        self.robot_stop = LinkStop()
        self.stops = 0

    def stop(self) -> None:
        self.stops += 1
        self.robot_stop.phase = "sent"


def heard(url: str, name: str = "", silent: float = 0.2) -> Entry:
    return Entry(url, name, silent=silent)


def phases(fleet: Fleet, connected: Any = None) -> dict[str, str]:
    fleet.update(connected)
    return {row.name: row.phase for row in fleet.rows}
