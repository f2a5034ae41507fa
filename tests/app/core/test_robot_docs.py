"""What a robot side of ours says of itself is known to the catalogues; the words of others stay theirs."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from app.core.robot_docs import DESCRIPTIONS, PAYLOADS, ROBOTS, ROLES, WORLDS, payload_title
from app.discovery.simulator_options import SimulatorOptions
from bridge.core.identity import Role
from robotside.gateways.discovery import adapters
from robotside.gateways.payloads import table
from robotside.serving import payload_switches
from widgets.core.language import language


@pytest.fixture
def german() -> Iterator[None]:
    language.name = "de"
    yield
    language.name = "en"


def test_each_payload_has_a_name_and_what_it_is_stands_here() -> None:
    assert {each.key for each in table.PAYLOADS} == set(PAYLOADS)
    assert {each.doc for each in table.PAYLOADS} <= set(DESCRIPTIONS)


def test_why_a_payload_stays_on_stands_here() -> None:
    reasons = {*payload_switches._NEEDED.values(), *payload_switches._INSTEAD_OF_LASER.values()}
    assert reasons <= set(DESCRIPTIONS)


def test_what_each_protocol_is_stands_here() -> None:
    assert {each.doc for each in adapters().values()} <= set(DESCRIPTIONS)


def test_each_role_of_the_bridge_has_a_word() -> None:
    assert {role.word for role in Role} == set(ROLES)


def test_each_robot_and_world_that_can_be_simulated_stands_here() -> None:
    import msgspec

    from sim.catalogue import catalogue

    found = catalogue()
    for robot in found["robots"]:
        robot["icon"] = ""
    offered = SimulatorOptions.read(msgspec.json.encode(found).decode())
    assert {robot.description for robot in offered.robots} == set(ROBOTS)
    assert {world.title for world in offered.worlds} == set(WORLDS)


@pytest.mark.usefixtures("german")
def test_a_payload_is_called_by_its_name_in_the_chosen_language_and_an_unknown_one_by_its_own() -> None:
    assert payload_title("line_sensor") == "Liniensensor"
    assert payload_title("water_cannon") == "water cannon"


def test_english_writes_the_name_of_a_payload_small() -> None:
    assert [payload_title(key) for key in ("line_sensor", "imu")] == ["line sensor", "IMU"]
