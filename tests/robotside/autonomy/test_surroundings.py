"""What stands round the robot: kept in mind for the way of a task, and forgotten when it is seen to be gone."""

from __future__ import annotations

import numpy as np

from tests.fakes import Pillar
from tests.robotside.scene import Scene


def remembered(scene: Scene) -> np.ndarray:
    return scene.station.autonomy.navigator.obstacles.points(scene.now)


def test_what_is_taken_away_is_forgotten_as_soon_as_the_laser_sees_through_where_it_was(scene: Scene) -> None:
    scene.robot.pillars.append(Pillar(2.0, 1.0))
    scene.go_to(6.0, -3.0)
    scene.until(lambda: len(remembered(scene)) > 0, 2.0)
    scene.robot.pillars.clear()
    scene.run(0.5)
    assert not len(remembered(scene))


def test_what_stays_is_kept_in_mind_while_the_robot_drives_by(scene: Scene) -> None:
    scene.robot.pillars.append(Pillar(2.0, 1.0))
    scene.go_to(6.0, 0.0)
    scene.until(lambda: len(remembered(scene)) > 0, 2.0)
    for _ in range(40):
        scene.run(0.2)
        assert len(remembered(scene))
