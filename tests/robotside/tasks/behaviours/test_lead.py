"""Guided tours, ticked by hand."""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Place
from robotside.tasks.behaviours.lead import FOLLOWER_TIMEOUT, SENSOR_TIMEOUT, STAY_TIME, lead
from tests.robotside.tasks.behaviours.stage import Stage

TOUR = [
    Place(1, "Reception", x=2.0, y=0.0, note="Here you get your badge."),
    Place(2, "Lab", x=2.0, y=2.0),
]


def go(stage: Stage, tree: Behaviour, seconds: float, follows: bool | None) -> Status:
    """As `Stage.tick`, with the sensor telling; None is a sensor that is silent."""
    for _ in range(round(seconds / 0.05)):
        if follows is not None:
            stage.situation.follows, stage.situation.follows_heard = follows, stage.situation.now
        if stage.tick(tree) is not Status.RUNNING:
            break
    return tree.status


def test_a_tour_visits_its_places_in_order_and_tells_what_is_there() -> None:
    stage = Stage()
    course, tree = lead(TOUR, "Please follow me.", stage.navigator, stage.situation, stage.say)
    assert go(stage, tree, 60.0, follows=True) is Status.SUCCESS
    assert stage.said == [
        "Please follow me.",
        "Reception reached: Here you get your badge.",
        "Lab reached.",
    ]
    assert course.visited == 2


def test_it_stays_while_the_note_is_told_and_only_there() -> None:
    stage = Stage()
    _, tree = lead(TOUR, "", stage.navigator, stage.situation, stage.say)
    while stage.phase != "dwelling":
        go(stage, tree, 0.05, follows=True)
    began = stage.situation.now
    assert stage.situation.doing.text == "At Reception: Here you get your badge."
    while stage.phase == "dwelling":
        go(stage, tree, 0.05, follows=True)
    assert abs(stage.situation.now - began - STAY_TIME) < 0.2


def test_it_waits_when_nobody_follows_and_goes_on_when_they_come() -> None:
    stage = Stage()
    _, tree = lead(TOUR, "", stage.navigator, stage.situation, stage.say)
    go(stage, tree, 1.0, follows=True)
    go(stage, tree, FOLLOWER_TIMEOUT - 0.2, follows=False)
    assert stage.phase == "driving"
    go(stage, tree, 20.0, follows=False)
    assert stage.phase == "waiting"
    assert stage.robot.at_rest
    assert stage.said == ["Waiting on the way to Reception: no one follows."]
    go(stage, tree, 0.5, follows=True)
    assert not stage.robot.at_rest
    assert stage.said[1:] == ["The person follows again; going on to Reception."]


def test_without_a_sensor_it_says_so_once_and_goes_on() -> None:
    stage = Stage()
    _, tree = lead(TOUR, "", stage.navigator, stage.situation, stage.say)
    assert go(stage, tree, 60.0, follows=None) is Status.SUCCESS
    said = "No sensor detects followers; the robot goes on without waiting."
    assert stage.said.count(said) == 1


def test_its_sentence_says_for_the_whole_way_that_it_does_not_wait() -> None:
    stage = Stage()
    _, tree = lead(TOUR, "", stage.navigator, stage.situation, stage.say)
    go(stage, tree, 0.5, follows=None)
    said = stage.situation.doing.text
    assert said == "Leading the way to Reception, without waiting: no sensor detects followers."
    go(stage, tree, 0.2, follows=True)
    assert stage.situation.doing.text == "Leading the way to Reception."


def test_a_sensor_that_falls_silent_while_it_waits_does_not_hold_it_for_ever() -> None:
    stage = Stage()
    _, tree = lead(TOUR, "", stage.navigator, stage.situation, stage.say)
    go(stage, tree, 4.0, follows=False)
    assert stage.phase == "waiting"
    go(stage, tree, SENSOR_TIMEOUT + 0.2, follows=None)
    assert stage.phase == "driving"


def test_a_tour_goes_on_after_a_pause_from_where_it_is() -> None:
    stage = Stage()
    course, tree = lead(TOUR, "", stage.navigator, stage.situation, stage.say)
    go(stage, tree, 2.0, follows=True)
    stage.pause(50.0)
    assert go(stage, tree, 60.0, follows=True) is Status.SUCCESS
    assert course.visited == 2
