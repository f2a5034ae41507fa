"""A cage over many pictures, against where it was put."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robotside.core.pose2 import ORIGIN, Pose2
from robotside.perception.cage_finder import CageSighting, FrontView
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.cage_sight import CageSight

CAGE = Pose2(2.0, 0.3, 0.2)


class Pictures:
    """A robot that lies still while its log drifts, with a cage before it."""

    def __init__(self, drift: tuple[float, float] = (0.0, 0.0)) -> None:
        self.situation, self.drift = Situation(), drift
        self.rng = np.random.default_rng(1)
        self.at: list[Pose2] = [CAGE]
        self.sight = CageSight(self.look, self.situation)

    def look(self, view: FrontView) -> list[CageSighting]:
        x, y, turn = self.rng.normal(0.0, (0.01, 0.01, 0.1))
        return [CageSighting(Pose2(at.x + x, at.y + y, at.yaw + turn), 0.3, 0.01, 0.1) for at in self.at]

    def go(self, seconds: float, guess: Pose2 = Pose2(2.2, 0.1, 0.37)) -> None:  # noqa: B008  # a tuple of numbers
        now = self.situation
        for _ in range(round(seconds / 0.05)):
            now.now += 0.05
            erred = Pose2(0.05 * self.drift[0], 0.05 * self.drift[1], 0.0)
            now.odom = here = now.odom.then(erred)
            now.ahead = FrontView(b"", now.now, here, 0.0, 0.0, -1.5)
            self.sight.take(guess)


def test_one_look_is_none_and_another_cage_far_away_is_not_it() -> None:
    shown = Pictures()
    shown.at = [Pose2(5.0, 1.0, 0.2), Pose2(2.0, 0.3, 2.0)]
    shown.go(3.0)
    assert shown.sight.pose() is None
    assert shown.sight.age == math.inf
    shown.at = [CAGE]
    shown.go(0.2)
    assert shown.sight.pose() is None
    shown.go(1.0)
    assert shown.sight.pose() is not None


def test_seen_often_it_is_where_it_is_whatever_the_map_says() -> None:
    shown = Pictures()
    shown.go(5.0)
    seen = shown.sight.pose()
    assert seen is not None
    assert seen == pytest.approx(CAGE, abs=0.05)
    assert shown.sight.height == pytest.approx(-1.2)


def test_out_of_sight_it_is_still_where_it_is_though_the_log_drifts() -> None:
    shown = Pictures((0.03, -0.02))
    shown.go(15.0)
    shown.at = []
    shown.go(6.0)
    seen = shown.sight.pose()
    assert seen is not None
    assert seen.distance(CAGE.x, CAGE.y) < 0.06
    assert shown.sight.age == pytest.approx(6.0, abs=0.2)
    assert shown.sight.error == pytest.approx((0.03, -0.02), abs=0.006)


def test_what_the_log_errs_turns_with_the_robot() -> None:
    shown = Pictures((0.03, 0.0))
    shown.go(15.0)
    shown.at = []
    shown.situation.odom = shown.situation.odom.then(Pose2(0.0, 0.0, 1.2))
    shown.go(6.0)
    seen = shown.sight.pose()
    assert seen is not None
    assert seen.distance(*Pose2(CAGE.x, CAGE.y, 0.0).since(Pose2(0.0, 0.0, 1.2))[:2]) < 0.06


def test_what_is_forgotten_is_looked_for_where_the_map_has_it() -> None:
    shown = Pictures()
    shown.go(3.0)
    shown.sight.forget()
    assert shown.sight.pose() is None
    assert math.isnan(shown.sight.height)
    shown.go(3.0, ORIGIN)
    assert shown.sight.pose() is None
