"""Where a swimmer believes to be while it charges."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from bridge.msgs.pilothouse_msgs import Place
from robotside.autonomy.mooring import Mooring
from robotside.core.pose2 import Pose2

PLACES = [
    Place(1, "Lab", "lab", x=1.0),
    Place(2, "Cage", "dock", x=4.0, y=1.0, yaw=0.5),
    Place(3, "Far cage", "dock", x=40.0),
]


def believed(at: Pose2, kind: str = "hexapod", *, charging: bool = True) -> Pose2:
    """What it believes after the battery was heard."""
    estimator = SimpleNamespace(pose=at)
    estimator.place = lambda pose: setattr(estimator, "pose", pose)
    Mooring(kind, lambda: PLACES, estimator).update(charging=charging)  # type: ignore[arg-type]  # what it calls of an estimator
    pose = estimator.pose
    assert isinstance(pose, Pose2)
    return pose


@pytest.mark.parametrize(("kind", "charging"), [("wheels", True), ("boat", True), ("hexapod", False)])
def test_what_knows_its_place_otherwise_or_does_not_charge_is_left_where_it_is(
    kind: str, charging: bool
) -> None:
    assert believed(Pose2(1.0, 1.0, 0.7), kind, charging=charging) == (1.0, 1.0, 0.7)


def test_carried_off_by_its_log_it_is_put_back_to_its_cage_with_its_own_direction() -> None:
    assert believed(Pose2(1.0, 3.0, 0.7)) == (4.0, 1.0, 0.7)


def test_as_far_off_as_the_dock_itself_may_be_it_stays() -> None:
    assert believed(Pose2(4.2, 1.1, 0.7)) == (4.2, 1.1, 0.7)
