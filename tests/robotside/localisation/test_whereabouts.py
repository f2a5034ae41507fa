"""The judge of a place: proven against all others, doubted, found anew."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Twist
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.core.worker import InLoopWorker
from robotside.localisation import whereabouts
from robotside.localisation.explanation import Explanation, Look
from robotside.localisation.field import Field
from robotside.localisation.hypotheses import Hypotheses, Hypothesis
from robotside.localisation.place_search import Found
from robotside.localisation.scan_matching import Localiser
from robotside.localisation.whereabouts import (
    BEYOND_DOUBT,
    CONFIRM_DISTANCE,
    FOLLOW_PERIOD,
    MAX_TAKEN_THROUGH,
    MAX_THROUGH,
    MAX_UNEXPLAINED,
    MIN_FIT,
    MIN_TAKEN_FIT,
    SURE_SHARE,
    Whereabouts,
    anywhere,
    said_to_be,
)
from robotside.mapping.occupancy_grid import Grid
from tests.fakes import Box, FakeRobot, Pillar
from tests.robotside.localisation.ride import FLOOR, Ride, equal_rooms

CUPBOARD = Box(-8.0, -1.2, -7.0, 1.2)


def standing(x: float, *more: Box) -> FakeRobot:
    return FakeRobot(start=(x, 0.0, 0.0), hall=FLOOR, boxes=[*equal_rooms(), *more], beams=120)


def test_an_operator_errs_by_a_door_sooner_than_by_the_whole_floor_and_seldom_by_half_a_turn() -> None:
    prior = said_to_be(Pose2(1.0, 2.0, 0.1), 1.0)
    here, door, far = prior(Pose2(1.5, 2.0, 0.3)), prior(Pose2(5.0, 2.0, 0.1)), prior(Pose2(15.0, 2.0, 0.1))
    turned = prior(Pose2(1.0, 2.0, 0.1 + math.pi))
    assert here == 0.0
    assert 0.0 > door > far
    assert turned < door
    assert said_to_be(Pose2(1.0, 2.0, 0.1), 1.0, otherwise=8.0)(Pose2(5.0, 2.0, 0.1)) == pytest.approx(
        door - 8.0
    )
    assert anywhere(Pose2(9.0, 9.0, 1.0)) == 0.0


def test_a_place_is_not_believed_before_it_has_been_checked_against_all_others() -> None:
    ride = Ride(standing(-2.0, CUPBOARD), Pose2(-2.0, 0.0, 0.0))
    ride.run(0.1)
    assert not ride.estimator.sure
    ride.run(1.5)
    assert ride.estimator.sure
    assert ride.codes == []  # that it had to be checked first is no event


def test_who_stands_and_is_carried_to_an_unlike_place_is_unsure_and_then_there() -> None:
    ride = Ride(standing(-4.0, CUPBOARD, Box(6.0, -4.0, 7.0, -3.0)), Pose2(-4.0, 0.0, 0.0))
    ride.run(2.0)
    assert ride.estimator.sure
    ride.robot.pose = (5.0, -2.8, -2.0)
    ride.run(6.0)
    assert 0.0 < ride.wrong <= 1.5
    assert "position_unsure" in ride.codes
    assert not ride.estimator.sure or ride.error < 0.1
    assert ride.error < 0.1 or any(
        math.hypot(each.x - 5.0, each.y + 2.8) < 0.2 for each in ride.estimator.candidates
    )


def test_a_crowd_that_hides_the_walls_makes_it_unsure_and_no_other_place_is_taken() -> None:
    ride = Ride(standing(-4.0, CUPBOARD), Pose2(-4.0, 0.0, 0.0))
    ride.run(2.0)
    crowd = [Pillar(-4.0 + 0.8 * math.cos(a), 0.8 * math.sin(a), 0.3) for a in (0.4 * n for n in range(15))]
    ride.robot.pillars = crowd
    ride.run(4.0)
    assert not ride.estimator.sure
    assert ride.error < 0.3
    ride.robot.pillars = []
    ride.robot._seen_from = None
    ride.run(6.0)
    assert ride.estimator.sure or len(ride.estimator.candidates) > 1
    assert ride.wrong == 0.0
    assert ride.error < 0.1


BELIEVED, OTHER = Pose2(-2.0, 0.0, 0.0), Pose2(2.0, 0.0, 0.0)
OPEN = Field(Grid(np.pad(np.zeros((60, 80), dtype=np.bool_), 10, constant_values=True), 0.1, -5.0, -4.0))
NEARLY_SURE = (SURE_SHARE + BEYOND_DOUBT) / 2


class Doubt:
    """A judge that follows the believed place and another one; the search of the map never ends."""

    ends = np.column_stack([np.cos(np.arange(24)), np.sin(np.arange(24))]) * 3.0
    """Of a look that tells enough; how well they are explained is said by the test."""

    def __init__(
        self, monkeypatch: pytest.MonkeyPatch, best: Pose2, share: float, explanation: Explanation
    ) -> None:
        """The place `best` of the two has `share` of what is believed, and explains each look by `explanation`."""
        monkeypatch.setattr(Hypotheses, "look", lambda *_: None)
        self.taken: list[Hypothesis] = []
        self.judge = Whereabouts(InLoopWorker(0), self.taken.append)
        self.belief = Localiser(OPEN)
        self.belief.place(BELIEVED, spread=0.1, turn=0.05)
        self.belief.predict(ORIGIN)
        second = OTHER if best is BELIEVED else BELIEVED
        for pose, part in ((best, share), (second, 1.0 - share)):
            followed = Localiser(OPEN)
            followed.place(pose, spread=0.1, turn=0.05)
            followed.predict(ORIGIN)
            self.judge.hypotheses.take_in(followed, Found(pose, explanation), math.log(part))
        self._now = self._at = 0.0

    def drive(self, distance: float) -> bool:
        """Go on by `distance` [m], with a look at its end; whether the place is proven then."""
        self._now, self._at = self._now + FOLLOW_PERIOD, self._at + distance
        odom, nothing = Pose2(self._at, 0.0, 0.0), np.empty((0, 2))
        self.belief.predict(odom)
        self.judge.on_sweep(self.belief, nothing, Look(self.ends), odom, self._now, anywhere)
        return self.judge.proven


def test_another_place_than_the_believed_one_is_taken_only_where_it_explains_nearly_all(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    hardly = Doubt(monkeypatch, OTHER, NEARLY_SURE, Explanation(-1.0, MIN_TAKEN_FIT, MAX_TAKEN_THROUGH))
    assert [hardly.drive(0.0), hardly.drive(1.0)] == [False, True]
    assert [each.pose.x for each in hardly.taken] == [pytest.approx(OTHER.x + 1.0)]
    for explanation in (
        Explanation(-1.0, MIN_TAKEN_FIT - 0.01, 0.0),  # a row of cars that is gone
        Explanation(-1.0, 1.0, MAX_TAKEN_THROUGH + 0.01),
    ):
        for share in (NEARLY_SURE, 0.9999):
            poor = Doubt(monkeypatch, OTHER, share, explanation)
            assert not any(poor.drive(1.0) for _ in range(5))
            assert poor.taken == []
            assert poor.judge.hypotheses.all, "it goes on following them"


def test_the_believed_place_is_proven_by_less_but_must_explain_what_is_seen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    same = Doubt(monkeypatch, BELIEVED, NEARLY_SURE, Explanation(-1.0, MIN_FIT, MAX_THROUGH))
    assert [same.drive(0.0), same.drive(1.0)] == [False, True]
    assert same.taken == []
    for explanation in (Explanation(-1.0, MIN_FIT - 0.01, 0.0), Explanation(-1.0, 1.0, MAX_THROUGH + 0.01)):
        lost = Doubt(monkeypatch, BELIEVED, 0.9999, explanation)
        assert not any(lost.drive(1.0) for _ in range(5))


@pytest.mark.parametrize("best", [BELIEVED, OTHER])
def test_a_place_must_fit_over_a_distance_unless_it_is_beyond_doubt(
    monkeypatch: pytest.MonkeyPatch, best: Pose2
) -> None:
    fits = Explanation(-1.0, 1.0, 0.0)
    likely = Doubt(monkeypatch, best, NEARLY_SURE, fits)
    assert not any(likely.drive(0.0) for _ in range(20)), "who stands sees the same again"
    assert not likely.drive(CONFIRM_DISTANCE - 0.01)
    assert likely.drive(0.02)
    assert Doubt(monkeypatch, best, BEYOND_DOUBT + 0.001, fits).drive(0.0)
    unlikely = Doubt(monkeypatch, best, SURE_SHARE - 0.001, fits)
    assert not any(unlikely.drive(1.0) for _ in range(5))


def test_a_proven_place_that_explains_nothing_for_some_looks_in_a_row_is_doubted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    proven = Doubt(monkeypatch, BELIEVED, 0.9999, Explanation(-1.0, 1.0, 0.0))
    assert proven.drive(0.0)
    fits = [0.0, 0.0, 1.0, *[0.0] * MAX_UNEXPLAINED]
    seen = iter([Explanation(-1.0, fit, 0.0) for fit in fits])
    monkeypatch.setattr(whereabouts, "explained", lambda *_: next(seen))
    assert [proven.drive(0.0) for _ in fits] == [True] * (len(fits) - 1) + [False]


@pytest.mark.parametrize("right", [True, False])
def test_an_answer_is_doubted_when_what_is_seen_later_fits_another_place_better(right: bool) -> None:
    store = Box(5.0, -5.0, 7.0, -2.2)  # in the last room, seen through its door
    answer = Pose2(-2.0, 0.0, 0.0) if right else Pose2(2.0, 0.0, math.pi)  # the other end of the corridor
    ride = Ride(standing(-2.0, store), answer, certain=True)
    ride.run(2.0)
    assert ride.estimator.sure
    assert (ride.error < 0.1) is right
    ride.robot.drive(Twist.planar(0.4, 0.0))
    ride.run(20.0)
    ride.robot.drive(Twist())
    ride.run(2.0)
    assert ("position_unsure" not in ride.codes) is right
    assert ride.error < 0.2 or not ride.estimator.sure


def test_an_answer_that_nothing_contradicts_stays() -> None:
    ride = Ride(standing(-2.0), Pose2(-2.0, 0.0, 0.0), certain=True)
    ride.robot.drive(Twist.planar(0.4, 0.0))
    ride.run(20.0)
    assert ride.codes == []
    assert ride.estimator.sure
    assert ride.estimator.by_word, "all rooms are equal"


def test_an_answer_is_no_mere_word_once_a_look_tells_it_from_all_other_places() -> None:
    end = Box(6.5, -1.2, 8.0, 1.2)  # of the corridor, seen from where it stands
    ride = Ride(standing(-2.0, end), Pose2(-2.0, 0.0, 0.0), certain=True)
    ride.run(2.0)
    assert ride.estimator.sure
    assert not ride.estimator.by_word
