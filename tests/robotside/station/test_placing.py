"""Placing the robot on its map: by a pose, and by one of the candidates that it has itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import ChoosePlaceRequest, CommandRequest, PlaceCandidate, PlaceCandidates
from robotside.core.pose2 import Pose2
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene

HERE, THERE = PlaceCandidate(1, 0.0, 0.0, 0.0, 0.6, 0.1), PlaceCandidate(2, 3.0, 2.5, 0.5, 0.4, 0.1)


@pytest.fixture
def asking(tmp_path: Path) -> Scene:
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(0.5)
    scene.station.autonomy.pose_estimator._candidates.all = (HERE, THERE)
    return scene


def test_a_robot_that_asks_nothing_has_no_candidates(tmp_path: Path) -> None:
    said = Scene(FakeRobot(), tmp_path).station.bus.last("/localisation/candidates")
    assert isinstance(said, PlaceCandidates)
    assert (said.candidates, said.reason) == ([], "")


def test_the_candidate_that_an_operator_chooses_is_where_the_robot_is(asking: Scene) -> None:
    assert asking.ask("/localisation/choose", ChoosePlaceRequest(id=2, client_name="Anna")).success
    pose = asking.station.autonomy.pose_estimator.pose
    assert pose is not None
    assert pose == pytest.approx(Pose2(3.0, 2.5, 0.5))
    assert asking.control.driver == "Anna"
    assert "Anna placed the robot at (3.0, 2.5)." in asking.events("localisation")


def test_what_the_operator_chose_needs_no_more_asking_but_counts_as_said_and_not_as_seen(
    asking: Scene,
) -> None:
    whereabouts, elsewhere = asking.station.autonomy.pose_estimator._whereabouts, Pose2(20.0, 2.5, 0.5)
    asking.ask("/localisation/choose", ChoosePlaceRequest(id=2))
    assert whereabouts.by_word
    chosen = whereabouts._prior(elsewhere)
    asking.station.autonomy.place(Pose2(3.0, 2.5, 0.5))
    assert not whereabouts.by_word
    assert chosen < whereabouts._prior(elsewhere) - 5.0, "no other place comes into question"


def test_a_candidate_that_there_is_not_is_refused_with_those_that_there_are(asking: Scene) -> None:
    before = asking.station.autonomy.pose_estimator.pose
    answer = asking.ask("/localisation/choose", ChoosePlaceRequest(id=7))
    assert (answer.success, answer.code) == (False, "position_candidate_unknown")
    assert answer.message == "The robot has no candidate 7 for its place; it has 1, 2."
    missing = asking.ask("/localisation/choose", ChoosePlaceRequest())
    assert (missing.success, missing.code) == (False, "position_candidate_unknown")
    assert (
        missing.message
        == "The request lacks `id`, the number of a candidate for the robot's place; it has 1, 2."
    )
    assert asking.station.autonomy.pose_estimator.pose == before


def test_only_who_has_control_may_choose(asking: Scene) -> None:
    asking.ask("/control/acquire", CommandRequest(client_name="Anna"))
    before = asking.station.autonomy.pose_estimator.pose
    said = asking.refused("/localisation/choose", ChoosePlaceRequest(id=2), asking.client("bert"))
    assert said.startswith("Anna has control")
    assert asking.station.autonomy.pose_estimator.pose == before
