"""Charging at a dock, in time of its own."""

from __future__ import annotations

import math

import pytest
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.tasks.behaviours.charge import LOST_TIMEOUT, QUIET_TIME, SILENCE_TIMEOUT, Charge
from tests.robotside.tasks.behaviours.stage import Stage


@pytest.fixture
def stage() -> Stage:
    made = Stage()
    made.situation.charging, made.situation.power, made.situation.charge = True, 1, 0.5
    return made


def make(stage: Stage, until: float = 0.8) -> Charge:
    return Charge(until, "Dock", stage.navigator, stage.situation, stage.say)


def fill(stage: Stage, tree: Charge, seconds: float, per_second: float) -> Status:
    for _ in range(round(seconds)):
        stage.situation.charge += per_second
        if stage.tick(tree, 1.0) is not Status.RUNNING:
            break
    return tree.status


def test_it_stays_until_the_charge_that_is_wanted_and_tells_how_long_that_takes(stage: Stage) -> None:
    tree = make(stage)
    assert stage.tick(tree) is Status.RUNNING
    assert stage.phase == "charging"
    assert stage.situation.doing.text == "Charging at Dock, 50%, goes on at 80%."
    assert math.isnan(stage.situation.still)
    assert fill(stage, tree, 100, 0.0004) is Status.RUNNING
    # 26 % at 4 hundredths of a percent a second
    assert stage.situation.still == pytest.approx(0.26 / 0.0004, rel=0.02)
    assert stage.situation.doing.text == "Charging at Dock, 54%, goes on at 80% in about 11 min."
    assert fill(stage, tree, 700, 0.0004) is Status.SUCCESS
    assert stage.situation.charge == pytest.approx(0.8, abs=0.001)
    assert stage.robot.at_rest


def test_a_full_battery_is_enough_whatever_it_says_of_its_charge(stage: Stage) -> None:
    tree = make(stage, until=1.0)
    stage.situation.charge = 0.97
    assert stage.tick(tree) is Status.RUNNING
    stage.situation.power = 4
    assert stage.tick(tree) is Status.SUCCESS


def test_an_operator_has_it_go_on_before(stage: Stage) -> None:
    tree = make(stage)
    stage.tick(tree)
    stage.situation.confirmed_by = "Anna"
    assert stage.tick(tree) is Status.SUCCESS
    assert stage.said == ["Anna had it go on at 50%."]


def test_with_too_little_nobody_has_it_go_on(stage: Stage) -> None:
    stage.situation.charge = 0.12
    tree = make(stage)
    stage.tick(tree)
    stage.situation.confirmed_by = "Anna"
    assert stage.tick(tree) is Status.RUNNING
    assert stage.said == ["Charging goes on: 12% is too little to go on with; 20% is needed."]


def test_who_said_so_before_it_charged_does_not_count(stage: Stage) -> None:
    stage.situation.confirmed_by = "Anna"
    assert stage.tick(make(stage)) is Status.RUNNING


def test_a_dock_that_gives_nothing_any_more_ends_it(stage: Stage) -> None:
    tree = make(stage)
    stage.tick(tree, 5.0)
    stage.situation.charging = False
    assert stage.tick(tree, LOST_TIMEOUT - 1.0) is Status.RUNNING
    assert stage.tick(tree, 2.0) is Status.FAILURE
    assert stage.navigator.reason == "Dock charges no more at 50%; the robot stands there."


def test_a_pause_is_not_a_dock_that_gives_nothing(stage: Stage) -> None:
    tree = make(stage)
    stage.tick(tree, 5.0)
    stage.pause(60.0)
    assert stage.tick(tree) is Status.RUNNING


def test_a_battery_that_does_not_say_how_full_it_is_is_waited_for_until_it_is_full(stage: Stage) -> None:
    stage.situation.charge = math.nan
    tree = make(stage)
    assert stage.tick(tree, 5.0) is Status.RUNNING
    assert stage.situation.doing.text == "Charging at Dock, until it is full."
    stage.situation.power = 4
    assert stage.tick(tree) is Status.SUCCESS


def test_a_battery_that_falls_silent_is_told_and_ends_it(stage: Stage) -> None:
    tree = make(stage)
    stage.tick(tree, 5.0)
    stage.mute = True
    assert stage.tick(tree, QUIET_TIME + 2.0) is Status.RUNNING
    said = stage.situation.doing.text
    assert said.startswith("Dock: the battery has been silent for ")
    assert said.endswith(" s, so nobody knows whether it charges.")
    assert stage.tick(tree, SILENCE_TIMEOUT) is Status.FAILURE
    assert stage.navigator.reason == (
        "Dock: the battery has been silent for 30 s, so nobody knows whether it charges; the robot stands there."
    )
    assert stage.robot.at_rest


def test_a_battery_that_is_heard_again_charges_on(stage: Stage) -> None:
    tree = make(stage)
    stage.mute = True
    stage.tick(tree, QUIET_TIME + 2.0)
    stage.mute = False
    assert stage.tick(tree, 2.0) is Status.RUNNING
    assert stage.situation.doing.text == "Charging at Dock, 50%, goes on at 80%."


def test_one_that_nothing_holds_leans_on_its_contacts_at_its_depth_and_others_do_nothing(
    stage: Stage,
) -> None:
    stage.tick(make(stage))
    orders: list[Manoeuvre] = []
    stage.navigator.command = orders.append  # type: ignore[method-assign]
    stage.tick(make(stage))
    assert not orders
    stage.navigator.measured(-1.5)
    tree = Charge(0.8, "Cage", stage.navigator, stage.situation, stage.say, 0.05)
    stage.tick(tree)
    stage.navigator.measured(-1.2)
    stage.tick(tree)
    assert {(order.kind, order.speed, order.height) for order in orders} == {("course", 0.05, -1.5)}
