"""A robot on a real socket, and the app in front of it."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.app.fakes import FakeRobot
from tests.app.glass import Glass, running
from tests.app.sleeper import sleeper
from tests.headless import Stage

QUICK = 400_000
"""Blocks of memory that a look at all that a test has made may be for: more of them take longer than most tests."""


@pytest.fixture(autouse=True)
def left_open() -> Iterator[None]:
    """In a fork: what a test did not close complains while that test is the one that is told of."""
    before = sys.getallocatedblocks()
    yield
    if sleeper() and sys.getallocatedblocks() - before < QUICK:
        gc.collect()


@pytest.fixture
def stage() -> Iterator[Stage]:
    """An empty window, or the one with the app that slept, on a clock that only the test moves."""
    asleep = sleeper()
    stage = asleep.stage if asleep else Stage()
    yield stage
    stage.close()


@pytest.fixture
def port() -> int:
    """Where the robot has to serve; 0 for anywhere."""
    asleep = sleeper()
    return asleep.port if asleep else 0


@pytest.fixture
def robot(port: int) -> Iterator[FakeRobot]:
    robot = FakeRobot(port)
    yield robot
    robot.close()


@pytest.fixture
def collecting() -> Iterator[None]:
    """Before the app starts Python collects by itself, and again after the app's end; in between the app does."""
    from tests.thrown import automatic

    with automatic():
        yield
        assert gc.isenabled()


@pytest.fixture
def fresh() -> None:
    """The app starts in the test itself, and makes each screen when it is first looked at."""


@pytest.fixture
def glass(
    request: pytest.FixtureRequest, stage: Stage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Glass]:
    # Kivy: where this folder is named, this file is read before tests/conftest.py prepares it
    from app.garbage_collector import Collector

    if asleep := sleeper():
        asleep.move(tmp_path)
        yield asleep.glass
        asleep.glass.end()
        return
    if "collecting" not in request.fixturenames:  # a look at all that an app is takes as long as half a test
        monkeypatch.setattr(Collector, "step", lambda _, **__: None)

    with running(stage, tmp_path) as glass:
        yield glass


@pytest.fixture
def driving(glass: Glass, robot: FakeRobot) -> Glass:
    """Connected, in control, on the drive screen."""
    if asleep := sleeper():
        asleep.wake(robot)
    else:
        glass.app.open(robot.url)
    glass.drives()
    return glass
