"""What the tests of the Kafka gateway share: a cluster, a scene, and patience on a busy computer."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from robotside.gateways.broker import line
from robotside.gateways.kafka import gateway as kafka_gateway
from robotside.gateways.kafka import kafka_line
from tests.fakes import FakeRobot
from tests.robotside.gateways.kafka.cluster import Cluster
from tests.robotside.scene import Scene


@pytest.fixture
def cluster() -> Iterator[Cluster]:
    made = Cluster()
    yield made
    made.close()


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """A busy computer on which these tests are slow is no robot that stood still, and no broker that is lost."""
    monkeypatch.setattr(line, "STALL_TIMEOUT", 60.0)
    monkeypatch.setattr(line, "STANDING_TIME", 0.0)
    monkeypatch.setattr(kafka_line, "ANSWER_TIMEOUT", 30.0)
    monkeypatch.setattr(kafka_line, "MAX_DEAF", 1000)
    monkeypatch.setattr(kafka_line, "BEAT_PERIOD", 0.05)
    monkeypatch.setattr(kafka_gateway, "_CHECK_PERIOD", 0.02)


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(1.0)
    return made
