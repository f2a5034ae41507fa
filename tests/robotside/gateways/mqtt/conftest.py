"""What the tests of the MQTT gateway share: a real broker, a scene, and patience on a busy computer."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Iterator
from pathlib import Path

import pytest

from robotside.gateways.broker import line
from robotside.gateways.mqtt import broker_line
from robotside.gateways.mqtt import gateway as mqtt_gateway
from tests.fakes import FakeRobot
from tests.robotside.gateways.mqtt.broker import Broker
from tests.robotside.scene import Scene


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Broker]:
    made = Broker(tmp_path)
    yield made
    made.thaw()
    made.kill()


@pytest.fixture(autouse=True)
async def no_pool_left() -> AsyncIterator[None]:
    """End the threads of the loop's own pool, in which connections are made."""
    yield
    await asyncio.get_running_loop().shutdown_default_executor()


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """A busy computer on which these tests are slow is no robot that stood still, and no client that is lost."""
    monkeypatch.setattr(line, "STALL_TIMEOUT", 60.0)
    monkeypatch.setattr(broker_line, "KEEPALIVE", 60)
    monkeypatch.setattr(broker_line, "PROBE_TIMEOUT", 60.0)
    monkeypatch.setattr(broker_line, "EARLY_TIME", 60.0)
    monkeypatch.setattr(line, "STANDING_TIME", 0.0)
    monkeypatch.setattr(mqtt_gateway, "_CHECK_PERIOD", 0.02)


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(1.0)
    return made
