"""What the tests of the robot side share."""

from __future__ import annotations

from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

import pytest

from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import Work
from robotside.localisation import whereabouts
from robotside.localisation.explanation import Look
from robotside.localisation.field import Field
from robotside.localisation.place_search import Found
from robotside.localisation.scan_matching import Localiser
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene


@pytest.fixture(scope="session", autouse=True)
def same_search_once() -> Iterator[None]:
    """Some 400 scenes begin with the same sweep in the same hall: where that fits is searched for once, with the same result."""
    search, found = Localiser._best_near, dict[tuple[object, ...], Pose2]()

    def remembered(
        it: Localiser, points: Points, guess: Pose2, step: float, reach: float, turn: float
    ) -> Pose2:
        grid = it._field._grid
        place = (grid.x, grid.y, grid.resolution, grid.occupied.shape)
        key = (sha256(grid.occupied.tobytes()).digest(), place, points.tobytes(), guess, step, reach, turn)
        if key not in found:
            found[key] = search(it, points, guess, step, reach, turn)
        return found[key]

    everywhere, places = whereabouts.search, dict[tuple[object, ...], list[Found]]()

    def remembered_search(field: Field, look: Look) -> Work[list[Found]]:
        grid = field.grid
        place = (grid.x, grid.y, grid.resolution, grid.occupied.shape)
        key = (sha256(grid.occupied.tobytes()).digest(), place, look.ends.tobytes(), look.ahead)
        if key not in places:
            places[key] = yield from everywhere(field, look)
        return places[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Localiser, "_best_near", remembered)
        patch.setattr(whereabouts, "search", remembered_search)
        yield


@pytest.fixture
def scene(tmp_path: Path) -> Iterator[Scene]:
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(4.0)
    yield scene
    scene.station.close()
