"""The table of payloads against what a robot has: nothing is left out, nothing is invented, each example can be sent."""

from __future__ import annotations

import re
from pathlib import Path

import msgspec
import pytest

from bridge.codec.fields import fields_of
from bridge.core.topics import TOPICS
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Pose
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.payloads.table import ALWAYS, KEYS, PAYLOADS, key_of
from robotside.gateways.plain.strict_json import decode, read_message
from robotside.serving.gateway_board import GatewayBoard
from robotside.serving.gateway_owner import GatewayOwner
from robotside.serving.payload_switches import PayloadSwitches
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene

EXCHANGES = [exchange for payload in PAYLOADS for exchange in payload.exchanges]
UNIT = re.compile(r"([\w.]+) \[([^\]]+)\]")


class EquippedRobot(FakeRobot):
    """A robot with all that services are for."""

    def __init__(self) -> None:
        super().__init__()
        self.info = msgspec.structs.replace(self.info, payloads=["arm", "lights"])
        self.orders: list[tuple[str, Msg]] = []
        """Every order to a payload."""

    def command(self, payload: str, order: Msg) -> None:
        self.orders.append((payload, order))

    def hold_payloads(self) -> None:
        self.orders.append(("", Msg()))

    def reset(self) -> Pose:
        return Pose()


@pytest.fixture
def door(tmp_path: Path) -> StationDoor:
    scene = Scene(EquippedRobot(), tmp_path)
    owner = GatewayOwner(Surroundings(scene.door, scene.station.events.say))
    GatewayBoard(scene.door, scene.station, owner, dict)
    PayloadSwitches(scene.door, scene.station, owner.on_change)
    return scene.door


def _type(door: StationDoor, name: str) -> type[Msg]:
    if name in door.services:
        return door.services[name].request
    return door.actions[name].goal if name in door.actions else door.topics[name].type


def test_every_topic_service_and_action_is_of_one_payload(door: StationDoor) -> None:
    names = [exchange.name for exchange in EXCHANGES]
    assert len(names) == len(set(names))
    assert set(names) == {topic.name for topic in TOPICS} | set(door.services) | set(door.actions)


def test_each_key_is_there_once_and_a_sign_is_a_topic_of_its_payload() -> None:
    assert len(KEYS) == len(PAYLOADS)
    for payload in PAYLOADS:
        assert not payload.sign or key_of(payload.sign) == payload.key


def test_what_is_sent_to_the_robot_has_an_example_that_can_be_read(door: StationDoor) -> None:
    for each in EXCHANGES:
        topic = door.topics.get(each.name)
        if topic is not None and topic.to == "handheld":
            assert not each.example, each.name
        else:
            assert read_message(decode(each.example), _type(door, each.name)), each.name


def test_units_are_of_fields_that_there_are(door: StationDoor) -> None:
    for each in EXCHANGES:
        for path, _ in UNIT.findall(each.units):
            cls: type[Msg] | None = _type(door, each.name)
            for part in path.split("."):
                assert cls is not None, f"{each.name}: {path}"
                fields = {field.key: field for field in fields_of(cls)}
                assert part in fields, f"{each.name}: {path}"
                cls = fields[part].type


def test_services_say_what_they_do_and_topics_do_so_in_their_own_table(door: StationDoor) -> None:
    for each in EXCHANGES:
        assert bool(each.doc) != (each.name in door.topics), each.name


def test_a_topic_of_one_motor_is_of_the_wheels_and_a_stranger_of_nothing() -> None:
    assert key_of("/temperature/left") == "wheels"
    assert key_of("/stop") == ALWAYS
    assert not key_of("/people/list")
