"""Which simulated robots can be chosen together, and where they are put."""

from __future__ import annotations

import json

import pytest

from app.discovery.simulator_options import SimulationChoice, SimulatorOptions
from sim.catalogue import catalogue

OFFERED = SimulatorOptions.read(json.dumps(catalogue()))


def test_everything_that_can_be_simulated_is_offered_by_name_and_title() -> None:
    assert [robot.title for robot in OFFERED.robots][:2] == ["Patrol", "Scout"]
    assert [world.title for world in OFFERED.worlds] == ["Lake", "Office", "Orchard", "Parking lot", "Tank"]


@pytest.mark.parametrize(
    "text", ["", "[]", '{"robots": []}', '{"robots": [], "worlds": []}', '{"robots": 3}']
)
def test_what_is_not_to_be_understood_is_a_value_error(text: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        SimulatorOptions.read(text)


def test_a_robot_alone_is_put_into_its_home() -> None:
    home = {robot.name: SimulationChoice((robot.name,)).within(OFFERED).world for robot in OFFERED.robots}
    assert home == {robot.name: robot.home for robot in OFFERED.robots}


def test_another_robot_of_the_same_world_comes_along() -> None:
    choice = SimulationChoice(("patrol",), "parking_lot").tapped("scout", OFFERED)
    assert choice == SimulationChoice(("patrol", "scout"), "parking_lot")
    assert choice.tapped("patrol", OFFERED) == SimulationChoice(("scout",), "parking_lot")


def test_robots_that_cannot_meet_the_new_one_are_let_go() -> None:
    choice = SimulationChoice(("patrol", "ardrone"), "office").tapped("minnow", OFFERED)
    assert choice == SimulationChoice(("minnow", "ardrone"), "lake")


def test_the_last_robot_stays() -> None:
    choice = SimulationChoice(("patrol",), "office")
    assert choice.tapped("patrol", OFFERED) == choice


def test_a_world_that_does_not_suit_them_is_not_taken() -> None:
    choice = SimulationChoice(("patrol",), "parking_lot")
    assert choice.moved("lake", OFFERED) == choice
    assert choice.moved("orchard", OFFERED).world == "orchard"
    assert choice.moved("moon", OFFERED) == choice


def test_what_is_remembered_of_another_version_becomes_what_there_is() -> None:
    assert SimulationChoice(("rover", "scout"), "moon").within(OFFERED) == SimulationChoice(
        ("scout",), "office"
    )
    assert SimulationChoice(("rover",), "").within(OFFERED) == SimulationChoice(("patrol",), "parking_lot")
    assert SimulationChoice(("patrol", "minnow"), "lake").within(OFFERED) == SimulationChoice(
        ("patrol",), "parking_lot"
    )


def test_a_choice_is_remembered() -> None:
    choice = SimulationChoice(("patrol", "scout"), "office")
    assert SimulationChoice.remembered(json.loads(json.dumps(choice.kept))) == choice


@pytest.mark.parametrize(
    "value", [None, 3, "patrol", {}, {"robots": [], "world": ""}, {"robots": [1], "world": ""}]
)
def test_nonsense_that_is_remembered_is_the_usual_choice(value: object) -> None:
    assert SimulationChoice.remembered(value) == SimulationChoice()
