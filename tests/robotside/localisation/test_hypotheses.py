"""Places that are followed in parallel."""

from __future__ import annotations

import numpy as np
import pytest

from robotside.core.pose2 import Pose2
from robotside.localisation.explanation import Explanation, Look
from robotside.localisation.field import Field
from robotside.localisation.hypotheses import LATE, MAX_FOLLOWED, Hypotheses, shares
from robotside.localisation.place_search import Found
from robotside.localisation.scan_matching import Localiser
from robotside.mapping.occupancy_grid import Grid

WALLED = Field(Grid(np.pad(np.zeros((60, 80), dtype=np.bool_), 10, constant_values=True), 0.1, -5.0, -4.0))
"""From -4 to 4 along x and from -3 to 3 along y."""


def corners(pose: Pose2) -> np.ndarray:
    """What a laser sees at `pose` of the walls, as in `base_link`."""
    x, y = np.linspace(-3.9, 3.9, 40), np.linspace(-2.9, 2.9, 30)
    walls = [np.column_stack([x, np.full(40, side)]) for side in (-3.05, 3.05)]
    walls += [np.column_stack([np.full(30, side), y]) for side in (-4.05, 4.05)]
    return pose.inverse().apply(np.concatenate(walls))


def following(*poses: Pose2, weight: float = 0.0) -> Hypotheses:
    made = Hypotheses()
    for pose in poses:
        localiser = Localiser(WALLED)
        localiser.place(pose, spread=0.1, turn=0.05)
        localiser.predict(Pose2(0.0, 0.0, 0.0))
        made.take_in(localiser, Found(pose, Explanation(-1.0, 0.9, 0.0)), weight)
    return made


def test_shares_are_of_one_whole_and_in_the_ratio_of_the_likelihoods() -> None:
    assert shares([0.0, 0.0]) == [0.5, 0.5]
    assert shares([np.log(3.0) - 900.0, -900.0]) == pytest.approx([0.75, 0.25])
    assert shares([]) == []


def test_the_same_place_is_followed_once_and_no_more_than_some() -> None:
    same = following(Pose2(0.0, 0.0, 0.0), Pose2(0.1, 0.1, 0.05))
    assert len(same.all) == 1
    many = following(*(Pose2(n * 0.7 - 3.5, 0.0, 0.0) for n in range(12)))
    assert len(many.all) == MAX_FOLLOWED
    assert len({each.number for each in many.all}) == MAX_FOLLOWED


def test_who_stands_learns_nothing_by_looking_again_and_who_drives_does() -> None:
    right, wrong = Pose2(0.0, 0.5, 0.0), Pose2(1.5, -1.0, 0.0)
    both = following(right, wrong)
    for _ in range(50):
        points = corners(right)
        both.look(points, Look.of(points), Pose2(0.0, 0.0, 0.0))
    assert both.shares == pytest.approx([0.5, 0.5])
    for n in range(1, 6):
        odom = Pose2(0.2 * n, 0.0, 0.0)
        both.predict(odom)
        points = corners(right.then(odom))
        both.look(points, Look.of(points), odom)
    assert both.all[0].pose.distance(right.x + 1.0, right.y) < 0.1
    assert both.shares[0] > 0.95


def test_one_that_moved_into_another_is_dropped_with_the_rest_that_is_hardly_believed() -> None:
    three = following(Pose2(0.0, 0.0, 0.0), Pose2(2.0, 0.0, 0.0), Pose2(-2.0, 0.0, 0.0))
    three.all[1].localiser.pose = Pose2(0.05, 0.0, 0.0)
    three.all[2].weight = -20.0
    points = corners(Pose2(0.0, 0.0, 0.0))
    three.look(points, Look.of(points), Pose2(0.0, 0.0, 0.0))
    three.look(points, Look.of(points), Pose2(0.3, 0.0, 0.0))
    assert len(three.all) == 1


def test_a_place_that_is_found_late_must_fit_better_than_those_that_were_followed() -> None:
    followed = following(Pose2(0.0, 0.0, 0.0), weight=2.0)
    alike = followed.all[0].explanation
    assert followed.late_weight(alike, 0.0) == pytest.approx(2.0 - LATE)
    assert followed.late_weight(Explanation(alike.evidence + 5.0, 1.0, 0.0), -1.0) == pytest.approx(
        2.0 + 5.0 - 1.0 - LATE
    )
