"""A cage's tag in pictures that are drawn by geometry, against where it was put."""

from __future__ import annotations

import math

import pytest

from robotside.core.pose2 import Pose2
from robotside.perception.cage_finder import CageFinder, FrontView
from tests.lacking import lacking
from tests.robotside.perception.test_tag_finder import AHEAD, FIELD, picture


@pytest.fixture
def finder() -> CageFinder:
    made = CageFinder(FIELD, AHEAD)
    if not made.able:
        lacking("pupil_apriltags")
    return made


@pytest.mark.parametrize("at", [Pose2(2.0, 0.0, 0.0), Pose2(1.5, 0.3, 0.3), Pose2(1.0, -0.2, -0.4)])
def test_it_is_ahead_aside_and_above_as_it_was_put(finder: CageFinder, at: Pose2) -> None:
    (seen,) = finder.find(FrontView(picture(at, above=0.22)))
    assert seen.pose.x == pytest.approx(AHEAD + at.x, abs=0.05)
    assert seen.pose.y == pytest.approx(at.y, abs=0.03)
    assert seen.pose.yaw == pytest.approx(at.yaw, abs=0.12)
    assert seen.up == pytest.approx(0.22, abs=0.02)


def test_the_nearer_it_is_the_surer_is_its_direction(finder: CageFinder) -> None:
    far, near = (finder.find(FrontView(picture(Pose2(x, 0.0, 0.2), above=0.1)))[0] for x in (2.0, 0.8))
    assert near.turn < far.turn / 4
    assert near.spread <= far.spread


def test_nose_down_it_lies_as_high_as_it_does(finder: CageFinder) -> None:
    (seen,) = finder.find(FrontView(picture(Pose2(2.0, 0.0, 0.0), above=0.5), pitch=0.15))
    assert seen.up == pytest.approx(0.5 * math.cos(0.15) - (2.0 + AHEAD) * math.sin(0.15), abs=0.03)


def test_leaning_to_the_right_its_height_is_no_way_aside(finder: CageFinder) -> None:
    (seen,) = finder.find(FrontView(picture(Pose2(2.0, 0.0, 0.0), above=0.5), roll=0.2))
    assert seen.pose.y == pytest.approx(-0.5 * math.sin(0.2), abs=0.03)
    assert seen.up == pytest.approx(0.5 * math.cos(0.2), abs=0.03)


def test_what_is_no_picture_shows_no_cage(finder: CageFinder) -> None:
    assert finder.find(FrontView(b"no picture")) == []
