"""Which way a tag is turned, of two that look alike."""

from __future__ import annotations

import math

import pytest

from robotside.core.pose2 import Pose2
from robotside.perception.cage_finder import CageSighting
from robotside.tasks.berthing.tag_mirror import NEAR_TURN, TURN, unmirrored

AHEAD = 0.25
SIGHT = math.atan2(0.8, 4.0)


def seen(yaw: float, x: float = 4.25, y: float = 0.8, turn: float = 0.5) -> CageSighting:
    return CageSighting(Pose2(x, y, yaw), 0.2, 0.05, turn)


@pytest.mark.parametrize("off", [0.4, -0.4])
def test_from_afar_a_tag_on_the_wrong_side_of_the_line_of_sight_is_turned_to_the_other(off: float) -> None:
    for read in (SIGHT + off, SIGHT - off):
        told = unmirrored(seen(read), AHEAD, SIGHT + 0.7 * off)
        assert told.pose.yaw == pytest.approx(SIGHT + off)
        assert told.pose[:2] == (4.25, 0.8)


def test_from_near_it_is_as_it_was_read() -> None:
    told = unmirrored(seen(0.3, 1.25, 0.0), AHEAD, -0.3)
    assert told.pose.yaw == 0.3
    assert told.turn == NEAR_TURN


@pytest.mark.parametrize(("turn", "told"), [(0.5, TURN), (0.05, 0.05)])
def test_with_the_side_known_it_is_surer(turn: float, told: float) -> None:
    assert unmirrored(seen(0.0, turn=turn), AHEAD, 0.0).turn == told
