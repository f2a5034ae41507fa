"""Deliveries, ticked by hand."""

from __future__ import annotations

import pytest
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Place
from robotside.tasks.behaviours.deliver import deliver
from tests.fakes import Box
from tests.robotside.tasks.behaviours.stage import Stage

SHOP = Place(1, "Office 12", x=2.0, y=0.0, tag="card-12")
LAB = Place(2, "Lab", x=2.0, y=2.0, tag="card-lab")
HOME = Place(3, "Home", x=0.0, y=0.0)


def until_asked(stage: Stage, tree: Behaviour, limit: float = 60.0) -> None:
    end = stage.situation.now + limit
    while not stage.situation.doing.asks and stage.situation.now < end:
        assert stage.tick(tree) is Status.RUNNING


def test_a_delivery_asks_at_both_places_waits_for_a_tap_and_comes_back() -> None:
    stage = Stage()
    course, tree = deliver([SHOP, LAB, HOME], "Two books", "", stage.navigator, stage.situation, stage.say)
    until_asked(stage, tree)
    doing = stage.situation.doing
    assert (doing.phase, doing.place) == ("waiting", "Office 12")
    assert doing.asks == "Has it been picked up at Office 12?"
    assert doing.text == "Waiting at Office 12: Two books"
    assert stage.tick(tree, 30.0) is Status.RUNNING
    assert stage.robot.at_rest
    assert course.visited == 0
    stage.situation.confirmed_by = "Anna"
    stage.tick(tree, 0.1)
    assert (stage.phase, course.visited) == ("driving", 1)
    until_asked(stage, tree)
    assert stage.situation.doing.asks == "Has it been taken at Lab?"
    stage.situation.confirmed_by = "Bert"
    assert stage.tick(tree, 60.0) is Status.SUCCESS
    assert abs(stage.robot.pose[0]) < 0.15
    assert stage.said == [
        "Office 12 reached.",
        "At Office 12: Two books",
        "Picked up at Office 12, confirmed by Anna.",
        "Lab reached.",
        "At Lab: Two books",
        "Delivered at Lab, confirmed by Bert.",
        "Home reached.",
    ]


@pytest.mark.parametrize(
    ("recipient", "card", "answers"),
    [("", "card-lab", True), ("", "card-12", False), ("boss", "boss", True), ("boss", "card-lab", False)],
)
def test_the_card_of_the_addressee_answers_and_another_one_is_told_of_once(
    recipient: str, card: str, answers: bool
) -> None:
    stage = Stage()
    course, tree = deliver([SHOP, LAB], "", recipient, stage.navigator, stage.situation, stage.say)
    until_asked(stage, tree)
    stage.situation.tag = "card-12"
    stage.tick(tree, 0.1)
    until_asked(stage, tree)
    for _ in range(3):
        stage.situation.tag = card
        stage.tick(tree)
    assert (course.visited == 2) is answers
    said = "Delivered at Lab, confirmed by the card."
    refusal = "This is not the right card for Lab."
    assert stage.said.count(said if answers else refusal) == 1


def test_an_answer_from_before_it_was_asked_does_not_count() -> None:
    stage = Stage()
    course, tree = deliver([SHOP, LAB], "", "", stage.navigator, stage.situation, stage.say)
    while not stage.situation.doing.asks:
        stage.situation.confirmed_by, stage.situation.tag = "Anna", "card-12"
        assert stage.tick(tree) is Status.RUNNING
    assert stage.tick(tree, 1.0) is Status.RUNNING
    assert course.visited == 0


def test_a_place_without_a_card_says_that_only_a_tap_answers() -> None:
    stage = Stage()
    shop = Place(1, "Office 12", x=2.0, y=0.0)
    _, tree = deliver([shop, LAB], "", "", stage.navigator, stage.situation, stage.say)
    until_asked(stage, tree)
    stage.situation.tag = "card"
    stage.tick(tree)
    assert stage.said[-1] == "No card is known for Office 12; confirm by a tap."


def test_a_delivery_fails_at_rest_where_there_is_no_way() -> None:
    stage = Stage(Box(1.0, -6.0, 1.3, 6.0))
    course, tree = deliver([SHOP, LAB], "", "", stage.navigator, stage.situation, stage.say)
    assert stage.tick(tree, 10.0) is Status.FAILURE
    assert stage.navigator.reason == "There is no way to Office 12 at (2.0, 0.0)."
    assert stage.robot.at_rest
    assert course.visited == 0


def test_a_delivery_goes_on_after_a_pause_on_the_way_and_at_the_question() -> None:
    stage = Stage()
    course, tree = deliver([SHOP, LAB], "", "", stage.navigator, stage.situation, stage.say)
    stage.tick(tree, 2.0)
    stage.pause(100.0)
    until_asked(stage, tree)
    stage.pause(100.0)
    stage.situation.confirmed_by = "Anna"
    stage.tick(tree)
    assert course.visited == 1


def test_a_delivery_that_is_taken_up_again_heads_for_the_place_that_it_headed_for() -> None:
    stage = Stage()
    first, _ = deliver([SHOP, LAB], "", "", stage.navigator, stage.situation, stage.say)
    first.advance()
    first.reached()
    first.advance()
    course, tree = deliver([SHOP, LAB], "", "", stage.navigator, stage.situation, stage.say)
    course.take_up(first.noted())
    until_asked(stage, tree)
    assert stage.situation.doing.asks == "Has it been taken at Lab?"
    assert course.visited == 1
