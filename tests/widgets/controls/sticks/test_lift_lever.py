"""The lever for up and down: it commands a climb and nothing else, and springs back."""

from __future__ import annotations

from typing import Any

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from tests.headless import Stage
from widgets.controls.sticks.lift_lever import LiftLever


@pytest.fixture
def lever(stage: Stage) -> Any:
    lever = stage.show(LiftLever(max_climb=0.4), (84, 200))
    lever.heard = []
    lever.bind(on_command=lambda _, twist: lever.heard.append(twist))
    return lever


def test_a_finger_at_the_upper_end_climbs_as_fast_as_it_can_and_let_go_it_rests(
    stage: Stage, lever: Any
) -> None:
    touch = stage.touch(42, 100)
    touch.touch_down()
    touch.touch_move(42, 199)
    assert lever.heard[-1] == Twist(Vector3(0.0, 0.0, 0.4), Vector3())
    touch.touch_up()
    assert lever.heard[-1] == Twist()


def test_what_goes_aside_counts_for_nothing(stage: Stage, lever: Any) -> None:
    stage.drag([(42, 100), (80, 101)])
    assert lever.heard == []


def test_a_gamepad_pushes_it_down(lever: Any) -> None:
    assert lever.lean(-0.5, 0.9)
    assert lever.heard == [Twist(Vector3(0.0, 0.0, -0.2), Vector3())]


def test_disabled_it_lets_go(lever: Any) -> None:
    lever.lean(1.0, 0.0)
    lever.state = "disabled"
    assert lever.heard[-1] == Twist()
