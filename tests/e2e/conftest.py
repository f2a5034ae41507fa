"""One simulated robot for all tests of a file, started as a user starts it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from examples.demo.robot import RobotProcess
from examples.demo.witness import Witness

if TYPE_CHECKING:
    from tests.e2e.handheld import Cable


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RobotProcess]:
    folder = tmp_path_factory.mktemp("robot")
    options = ("--robot", "sim:patrol", "--world", "parking_lot", "--state", str(folder / "state"))
    with RobotProcess(*options, log=folder / "robot.log") as process:
        yield process


@pytest.fixture
def witness(robot: RobotProcess) -> Iterator[Witness]:
    witness = Witness(robot.url)
    yield witness
    witness.close()


@pytest.fixture
def cable(robot: RobotProcess) -> Iterator[Cable]:
    from tests.e2e.handheld import Cable  # Kivy: not before tests/conftest.py has prepared it

    cable = Cable(int(robot.url.rsplit(":", 1)[1]))
    yield cable
    cable.close()
