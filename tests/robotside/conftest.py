"""What the tests of the robot side share."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fakes import FakeRobot
from tests.robotside.scene import Scene


@pytest.fixture
def scene(tmp_path: Path) -> Iterator[Scene]:
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(4.0)
    yield scene
    scene.station.close()
