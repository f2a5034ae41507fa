"""Questions about the robot are answered by what it tells, and by nothing where it does not."""

from __future__ import annotations

from typing import Any

import pytest

from bridge.client.client import LinkState, Phase
from bridge.msgs.pilothouse_msgs import LightState
from bridge.msgs.sensor_msgs import BatteryState
from tests.app.intents.test_intent_executor import Robot, robot

__all__ = ["robot"]


def test_an_unknown_charge_is_not_told(robot: Robot) -> None:
    assert robot.acting.why_not("tell_battery") == "This robot does not tell its charge."
    robot.tell("/battery_state", BatteryState(percentage=float("nan")))
    assert robot.acting.why_not("tell_battery") == "This robot does not tell its charge."


def test_the_charge_is_told(robot: Robot) -> None:
    robot.tell("/battery_state", BatteryState(percentage=0.82))
    assert robot.acting.why_not("tell_battery") == ""
    assert robot.acting.words("tell_battery") == "Battery: 82 %"


def test_what_was_told_before_the_link_broke_is_no_answer(robot: Robot) -> None:
    robot.tell("/battery_state", BatteryState(percentage=0.82))
    robot.session.link_state = LinkState(Phase.WAITING, "", 1, 1.0)
    for intent in ("tell_battery", "tell_task"):
        assert robot.acting.why_not(intent) == "There is no link to the robot."


@pytest.mark.parametrize(("state", "words"), [("PAUSED", "Patrol: paused"), ("RUNNING", "Patrol: runs")])
def test_the_task_is_told_with_its_state(robot: Robot, state: str, words: str) -> None:
    robot.task(state)
    assert robot.acting.words("tell_task") == words


@pytest.mark.parametrize(("lit", "intent", "brightness"), [(1.0, "lights_on", 1.0), (0.0, "lights_off", 0.0)])
def test_lights_that_are_asked_on_are_never_switched_off(
    robot: Any, lit: float, intent: str, brightness: float
) -> None:
    robot.tell("/lights", LightState(brightness=lit))
    robot.acting.do(intent)
    assert robot.commands[-1] == ("lights", {"brightness": brightness})
