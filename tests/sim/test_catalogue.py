"""What can be simulated: each payload that is offered for a robot can be mounted on it, and no other can."""

from __future__ import annotations

import pytest

from sim.catalogue import catalogue
from sim.payloads import PAYLOADS, laden, mount
from sim.robot import ROBOTS, model_of
from sim.simulation.simulation import Simulation
from sim.world.world_files import load

ROBOT_OFFERS = {each["name"]: each for each in catalogue()["robots"]}


def test_every_robot_is_offered_with_a_home_that_is_there() -> None:
    worlds = {each["name"]: each["robots"] for each in catalogue()["worlds"]}
    assert list(ROBOT_OFFERS) == list(ROBOTS)
    assert all(name in worlds[each["home"]] for name, each in ROBOT_OFFERS.items())


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_just_the_payloads_that_can_be_mounted_are_offered(name: str) -> None:
    model = model_of(name)
    simulation = Simulation(load(model.home), model)
    try:
        fitting = []
        for payload in PAYLOADS:
            try:
                laden(model, [payload])
                mount(simulation.vehicle, [payload])
            except ValueError:
                continue
            fitting.append(payload)
    finally:
        simulation.close()
    assert ROBOT_OFFERS[name]["payloads"] == fitting
