"""A robot on a real socket, and the app in front of it."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.app.fakes import FakeRobot
from tests.app.glass import Glass, running
from tests.headless import Stage


@pytest.fixture
def robot() -> Iterator[FakeRobot]:
    robot = FakeRobot()
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
def glass(
    request: pytest.FixtureRequest, stage: Stage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Glass]:
    # Kivy: where this folder is named, this file is read before tests/conftest.py prepares it
    from app.garbage_collector import Collector

    if "collecting" not in request.fixturenames:  # a look at all that an app is takes as long as half a test
        monkeypatch.setattr(Collector, "step", lambda _, **__: None)

    with running(stage, tmp_path) as glass:
        yield glass


@pytest.fixture
def driving(glass: Glass, robot: FakeRobot) -> Glass:
    """Connected, in control, on the drive screen."""
    glass.app.open(robot.url)
    glass.until(lambda: glass.app.shell is not None, "no screens")
    glass.until(lambda: glass.app.session.control == "mine", "no control")
    glass.app.show("drive")
    glass.until(lambda: glass.app.screens["drive"].stick.state == "live", "no stick")
    return glass
