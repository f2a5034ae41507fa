"""The doubt about the robot's place: its ellipse, its hollow sign, and the candidates that a tap chooses."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
import pytest
from msgspec.structs import replace

from bridge.msgs.pilothouse_msgs import PlaceCandidate, PlaceCandidates
from tests.widgets.map.watched_map import near, pose
from widgets.core.shapes import Shapes
from widgets.map.map_candidates import UNSURE_SPREAD, ellipse_of

HERE, THERE = PlaceCandidate(1, 2.0, 1.0, 0.0, 0.6, 0.1), PlaceCandidate(2, -8.0, 4.0, 1.0, 0.4, 0.1)


@dataclass
class Chosen:
    numbers: list[int] = field(default_factory=list)


@pytest.fixture
def chosen(map_):
    noted = Chosen()
    map_.bind(on_choose_candidate=lambda _, number: noted.numbers.append(number))
    return noted


def spread(xx: float, xy: float, yy: float):
    told = pose(0.0, 0.0)
    covariance = list(told.pose.covariance)
    covariance[0], covariance[1], covariance[6], covariance[7] = xx, xy, xy, yy
    return replace(told, pose=replace(told.pose, covariance=covariance))


@pytest.mark.parametrize(("long", "short", "way"), [(2.0, 0.5, 0.6), (1.0, 1.0, 0.0), (3.0, 0.1, -1.2)])
def test_the_ellipse_is_that_of_the_eigenvectors(long: float, short: float, way: float) -> None:
    turn = np.array([[math.cos(way), -math.sin(way)], [math.sin(way), math.cos(way)]])
    variance = turn @ np.diag([(long / 2) ** 2, (short / 2) ** 2]) @ turn.T
    found = ellipse_of(variance[0, 0], variance[0, 1], variance[1, 1])
    assert found[:2] == near(long, short)
    if long > short:
        assert math.remainder(found[2] - way, math.pi) == pytest.approx(0.0, abs=1e-9)


def test_what_is_no_number_draws_no_ellipse() -> None:
    assert ellipse_of(math.nan, 0.0, 1.0) == (0.0, 0.0, 0.0)


def test_a_robot_that_may_be_a_metre_off_is_unsure_and_a_little_less_changes_nothing(map_) -> None:
    map_.show(spread(0.01, 0.0, 0.01))
    assert not map_.unsure
    before = map_.doubt
    map_.show(spread(0.0101, 0.0, 0.01))
    assert map_.doubt is before, "not drawn anew for each pose"
    map_.show(spread((UNSURE_SPREAD / 2) ** 2, 0.0, 0.01))
    assert map_.unsure
    assert map_.doubt == near(UNSURE_SPREAD, 0.2, 0.0)


def test_each_candidate_has_a_letter_of_its_own_and_its_share_in_words(map_) -> None:
    map_.show(pose(2.0, 1.0))
    map_.show(PlaceCandidates(candidates=[HERE, THERE]))
    words = [word.text for word in map_._candidate_marks(Shapes())]
    assert words == ["A", "60\u00a0%", "B", "40\u00a0%"]
    assert map_.unsure


def test_no_candidate_lies_under_the_robot_that_is_being_placed(map_) -> None:
    map_.show(pose(2.0, 1.0))
    map_.show(PlaceCandidates(candidates=[HERE, THERE]))
    map_.mode = "place_robot"
    assert map_.placed[:2] == near(2.0, 1.0)
    shapes = Shapes()
    assert [word.text for word in map_._candidate_marks(shapes)] == ["B", "40\u00a0%"]
    map_.placed = [-8.0, 4.0, 0.0]
    assert [word.text for word in map_._candidate_marks(Shapes())] == ["A", "60\u00a0%"]
    map_.mode = "view"
    assert len(list(map_._candidate_marks(Shapes()))) == 4


def test_a_tap_on_a_candidate_chooses_it_and_one_beside_it_does_not(map_, stage, chosen) -> None:
    map_.show(PlaceCandidates(candidates=[HERE, THERE]))
    stage.tap(*map_.view.to_screen(-8.0, 4.0))
    stage.tap(*map_.view.to_screen(12.0, -10.0))
    assert chosen.numbers == [2]


@pytest.mark.parametrize("mode", ["points", "home", "place", "place_robot", "measure"])
def test_a_finger_that_means_something_else_chooses_none(map_, stage, chosen, mode: str) -> None:
    map_.show(PlaceCandidates(candidates=[HERE, THERE]))
    map_.mode = mode
    stage.tap(*map_.view.to_screen(2.0, 1.0))
    assert chosen.numbers == []


def test_one_candidate_is_no_question_and_an_answered_one_is_gone(map_, stage, chosen) -> None:
    map_.show(PlaceCandidates(candidates=[HERE, THERE]))
    map_.show(PlaceCandidates(candidates=[HERE]))
    assert map_.candidates == []
    stage.tap(*map_.view.to_screen(2.0, 1.0))
    assert chosen.numbers == []


def test_a_candidate_at_no_place_is_none(map_) -> None:
    map_.show(PlaceCandidates(candidates=[HERE, THERE, replace(HERE, id=3, x=math.nan)]))
    assert [each.id for each in map_.candidates] == [1, 2]
