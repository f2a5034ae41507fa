"""A protocol from the app's Setup: brought up with a finger, used by a program, brought down, and nothing is left of it."""

from __future__ import annotations

import asyncio
import random
import socket
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.parse import urlsplit

import pytest

from bridge.core.network_thread import NetworkThread
from robotside.core.clock import RobotClock
from robotside.serving.station_server import Addresses, StationServer
from robotside.station.station import Station
from tests.e2e.handheld import Handheld, handheld
from tests.fakes import FakeRobot
from tests.robotside.gateways.mqtt.client import FRESH, client
from tests.robotside.scene import records_at

pytestmark = pytest.mark.slow

PATIENCE = 60.0
"""For what another thread or process brings about [s]."""
TURNS = 10
"""What has not changed for so many looks has settled."""


class Served:
    """A robot side in a thread of this process, so that its tasks can be counted."""

    def __init__(self, state: Path) -> None:
        self.network = NetworkThread("robot side")
        self.robot = FakeRobot()
        self.server: StationServer = self.network.start(self._make(state)).result(PATIENCE)
        self._running = self.network.start(self.server.run(lambda _: None))
        self._until(lambda: bool(self.server.addresses.bridge))

    async def _make(self, state: Path) -> StationServer:
        clock, began = RobotClock(time.time()), time.time() - time.monotonic()

        def wall() -> float:
            return began + time.monotonic()

        station = Station(self.robot, records_at(state), now=clock.now, clock=wall, rng=random.Random(1))
        return StationServer(station, clock, wall, Addresses("127.0.0.1", 0, 0))

    def _until(self, so: Any) -> None:
        end = time.monotonic() + PATIENCE
        while not so():
            assert time.monotonic() < end
            time.sleep(0.01)

    def tasks(self) -> Counter[str]:
        """What runs in the robot side, by its name."""

        async def count() -> Counter[str]:
            own = asyncio.current_task()
            return Counter(task.get_coro().__qualname__ for task in asyncio.all_tasks() if task is not own)

        return self.network.start(count()).result(PATIENCE)

    @property
    def stopped(self) -> bool:
        return self.server.station.controls.stopped

    def close(self) -> None:
        self.network.call(self.server.end)
        self._running.result(PATIENCE)
        self.network.close()


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    served = Served(tmp_path / "state")
    yield served
    served.close()


def listens(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def of(screen: Any, name: str) -> Any:
    return next((each for each in screen.robot.setup.gateways if each.name == name), None)


async def press_stop(port: int) -> bool:
    """Another program presses STOP by MQTT; whether it was answered that it did."""
    async with asyncio.timeout(PATIENCE), client(SimpleNamespace(port=port)) as other:  # type: ignore[arg-type]
        await other.told("state")
        answer = await other.ask("call/stop", expiry=FRESH)
        return bool(answer["success"])


def test_mqtt_is_brought_up_used_and_brought_down_from_the_setup_screen(
    served: Served, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.session.picture_feed.PictureFeed.watch", lambda *_: None)
    with handheld(tmp_path / "app", discover=False) as glass:
        glass.app.open(served.server.addresses.bridge)
        glass.until(lambda: glass.app.shell is not None, "the robot's screens")
        glass.tap("Setup", "NavButton")
        screen = glass.app.screens["setup"]
        glass.until(lambda: of(screen, "mqtt") is not None, "the robot's protocols")
        assert of(screen, "mqtt").state == "down"
        before = settled(glass, served)
        for again in (False, True):
            port = bring_up(glass, screen)
            assert listens(port)
            assert served.stopped == again
            assert asyncio.run(press_stop(port))
            assert served.stopped
            bring_down(glass, screen)
            assert not listens(port)
            glass.until(lambda: served.tasks() == before, f"only {before}")
    assert served.server.gateways.running == ()


def settled(glass: Handheld, served: Served) -> Counter[str]:
    """What runs in the robot side once that stays as it is: what begins with a link has begun."""
    before, same = served.tasks(), 0
    while same < TURNS:
        glass.run(0.1)
        now = served.tasks()
        before, same = now, same + 1 if now == before else 0
    return before


def bring_up(glass: Handheld, screen: Any) -> int:
    """Choose MQTT, take a free port, and press the button; the port, once the robot says that it is up."""
    screen.chosen = ("/gateways", "mqtt")
    pane = glass.until(lambda: screen.robot.panes.get(("/gateways", "mqtt")), "its pane")
    pane.form.fields["port"].text = "0"
    glass.tap("Bring up", "PrimaryButton")
    glass.until(lambda: of(screen, "mqtt").state == "up", "MQTT", PATIENCE)
    glass.until(lambda: pane.state.text == of(screen, "mqtt").endpoint, "its endpoint on the glass")
    assert (pane.own.parent, pane.qr.rows) == (pane.column, []), "no other machine reaches it by a code"
    return urlsplit(of(screen, "mqtt").endpoint).port or 0


def bring_down(glass: Handheld, screen: Any) -> None:
    glass.tap("Bring down", "QuietButton")
    glass.until(lambda: of(screen, "mqtt").state == "down", "the end of MQTT", PATIENCE)
