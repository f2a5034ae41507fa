"""Clients that a broker passes on: their number is bounded, the silent leave, and a robot that one of them drove rests."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import Identity, Role, public_id
from bridge.core.link_state import CONTROL_TIMEOUT
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads.table import KEYS
from robotside.gateways.plain.known_clients import IDLE_TIMEOUT, MAX_VISITORS
from robotside.gateways.plain.visitor import TIME, VALID_TIME, Visitor
from robotside.gateways.plain.visitors import SHARE_OF_HOST, Visitors
from tests.fakes import FakeRobot
from tests.looped import looped
from tests.robotside.scene import Scene

AHEAD = b'{"linear": {"x": 0.2}}'
GOAL = b'{"header": {"frame_id": "map"}, "pose": {"position": {"x": 2.0}, "orientation": {"w": 1.0}}}'


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(5.0)
    return made


@pytest.fixture
def visitors(scene: Scene) -> Visitors:
    return Visitors(scene.door, "broker", "192.0.2.7:1883", KEYS, role=Role.DRIVE, secure=False)


def drive(visitor: Visitor, stamp: float) -> None:
    visitor.call(TIME, b"")
    visitor.publish("/cmd_vel", AHEAD, stamp)


def test_a_driver_whose_broker_is_gone_leaves_a_robot_at_rest(scene: Scene, visitors: Visitors) -> None:
    drive(visitors.visit("anna"), scene.clock)
    assert not scene.robot.at_rest
    visitors.leave_all()
    assert scene.robot.at_rest
    assert not len(visitors)


def test_without_a_stamp_nothing_moves_however_new_the_client_is(scene: Scene, visitors: Visitors) -> None:
    visitor = visitors.visit("anna")
    visitor.call(TIME, b"")
    with pytest.raises(Refused, match="it has no stamp, and nothing else says"):
        visitor.publish("/cmd_vel", AHEAD)
    assert scene.robot.at_rest
    said = (
        "A drive command was dropped: it has no stamp, and nothing else says how old it is; 0.7 s is allowed."
    )
    assert said in scene.events()


def test_clients_of_one_name_are_another_one_at_each_host(scene: Scene, visitors: Visitors) -> None:
    anna = visitors.visit("anna", address="192.0.2.1:5000")
    assert visitors.visit("anna", address="192.0.2.1:6000") is anna
    assert visitors.visit("anna", address="192.0.2.2:5000") is not anna
    assert anna.operator.address == "192.0.2.1:5000"
    visitors.leave_name("anna", address="192.0.2.2:5000")
    assert len(visitors) == 1


def test_a_stamp_counts_only_of_a_clock_that_was_compared(scene: Scene, visitors: Visitors) -> None:
    with pytest.raises(Refused) as refused:
        visitors.visit("anna").publish("/cmd_vel", AHEAD, scene.clock)
    assert refused.value.args[0].code == Code.DRIVE_CLOCK_UNKNOWN
    assert scene.robot.at_rest


def test_a_goal_is_as_fresh_as_a_call_or_is_not_driven_to(scene: Scene, visitors: Visitors) -> None:
    visitor = visitors.visit("anna")
    for stamp, code in (
        (math.nan, Code.GATEWAY_UNDATED),
        (scene.clock - VALID_TIME - 0.1, Code.COMMAND_LATE),
        (scene.clock + 60, Code.COMMAND_AHEAD),
    ):
        with pytest.raises(Refused) as refused:
            visitor.publish("/goal_pose", GOAL, stamp, dated=False)
        assert refused.value.args[0].code == code
        assert scene.task.task == ""
    visitor.publish("/goal_pose", GOAL, scene.clock, dated=False)
    assert scene.task.task == "go_to"


def test_the_silent_leave_and_the_others_stay(scene: Scene, visitors: Visitors) -> None:
    visitors.visit("anna")
    scene.run(IDLE_TIMEOUT / 2)
    visitors.visit("bert")
    scene.run(IDLE_TIMEOUT / 2 + 0.1)
    visitors.leave_silent()
    assert len(visitors) == 1


def test_places_are_bounded_and_the_quietest_yields_when_it_is_silent(
    scene: Scene, visitors: Visitors
) -> None:
    for number in range(MAX_VISITORS):
        visitors.visit(f"client {number}")
    with pytest.raises(Refused, match=f"{MAX_VISITORS} clients use this gateway"):
        visitors.visit("one more")
    scene.run(5.1)
    visitors.visit("one more")
    assert len(visitors) == MAX_VISITORS


def test_a_name_is_one_client_and_another_token_is_another(visitors: Visitors) -> None:
    first = visitors.visit("anna")
    assert visitors.visit("anna") is first
    with pytest.raises(Refused):
        visitors.visit("anna", "token")  # this robot knows no keys
    visitors.leave_name("anna", "token")
    assert visitors.visit("anna") is first


def test_who_is_expelled_is_gone(scene: Scene, visitors: Visitors) -> None:
    visitors.visit("anna").operator.on_expelled()
    assert not len(visitors)


def test_who_gives_no_name_in_a_call_has_that_of_the_client(scene: Scene, visitors: Visitors) -> None:
    visitor = visitors.visit("anna")
    answer = visitor.call("/control/acquire", b"{}")
    assert isinstance(answer, bytes)
    assert json.loads(answer)["success"]
    assert scene.control.driver == "anna"
    own = scene.control.driver_id
    for request in (b'{"client_name": "Anna B", "client_id": "a1"}', b"{}"):
        visitor.call("/control/acquire", request)
        assert scene.control.driver == "Anna B"
        assert scene.control.driver_id == public_id("a1") != own


@looped("raw", [b"", b"{", b"\xff", b'{"surprise": 1}', b'{"stamp": "soon"}', b"[" * 70000])
def test_stop_is_pressed_whatever_the_message_says(raw: bytes, tmp_path: Path) -> None:
    state = tmp_path / f"at {raw[:9].hex()}"
    state.mkdir()
    scene = Scene(FakeRobot(), state)  # of its own: a STOP that is kept would be that of the case before
    assert not scene.station.controls.stopped
    visitors = Visitors(scene.door, "broker", "192.0.2.7:1883", KEYS, role=Role.NONE, secure=False)
    visitors.newcomer("anna").call("/stop", raw, dated=False)
    assert scene.station.controls.stopped


def test_a_command_without_any_age_is_refused_and_stop_never(scene: Scene, visitors: Visitors) -> None:
    answer = visitors.visit("anna").call("/control/acquire", b"{}", dated=False)
    assert isinstance(answer, bytes)
    assert json.loads(answer)["code"] == Code.GATEWAY_UNDATED
    assert not scene.control.driver


BAD_ORDERS = [
    ("/task/start", b'{"task": "dance"}'),
    ("/task/start", b'{"tusk": 1}'),
    ("/task/start", b"{"),
    ("/x", b""),
]


@pytest.mark.parametrize(("service", "raw"), BAD_ORDERS)
def test_orders_that_are_refused_renew_no_control(
    scene: Scene, visitors: Visitors, service: str, raw: bytes
) -> None:
    visitors.visit("anna").call("/control/acquire", b"{}")
    for _ in range(round(CONTROL_TIMEOUT) + 1):
        scene.run(1.0)
        answer = visitors.visit("anna").call(service, raw)
        assert isinstance(answer, bytes)
        assert json.loads(answer)["success"] is False
    scene.run(0.1)
    assert scene.station.controls.driver is None


def test_messages_that_are_refused_renew_no_control(scene: Scene, visitors: Visitors) -> None:
    visitors.visit("anna").call("/control/acquire", b"{}")
    for _ in range(round(CONTROL_TIMEOUT) + 1):
        scene.run(1.0)
        with pytest.raises(BridgeError):
            visitors.visit("anna").publish("/cmd_vel", b'{"surprise": 1}')
    scene.run(0.1)
    assert scene.station.controls.driver is None


def test_orders_that_are_taken_renew_control(scene: Scene, visitors: Visitors) -> None:
    visitors.visit("anna").call("/control/acquire", b"{}")
    for _ in range(round(CONTROL_TIMEOUT) + 1):
        scene.run(1.0)
        visitors.visit("anna").call(TIME, b"")
    assert scene.control.driver == "anna"


GUEST, DRIVER = Role.WATCH, Identity("d1", "Dora", Role.DRIVE, proven=True)


class Keys:
    """Knows one token: that of somebody who drives."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return Identity("", "", GUEST)

    def identify(self, token: str, address: str, client: str = "", *, forgeable: bool = False) -> Identity:
        if token != "key":
            raise Refused(f"wrong, {forgeable=}")
        return DRIVER

    def needed(self, verb: str, name: str) -> Role:
        return Role.NONE


@pytest.fixture
def guests(scene: Scene) -> Visitors:
    """Clients of whom those without a key may only watch."""
    door = StationDoor(scene.station, Keys())
    return Visitors(door, "coap", "192.0.2.7:5683", KEYS, role=GUEST, secure=False, hosts=True)


def fill(visitors: Visitors, token: str = "") -> None:
    for number in range(MAX_VISITORS):
        visitors.visit(f"{token}{number}", token, f"192.0.2.{1 + number // SHARE_OF_HOST}:5000")
    assert len(visitors) == MAX_VISITORS


def test_one_host_has_a_share_of_the_places_for_those_without_a_key(guests: Visitors) -> None:
    for number in range(SHARE_OF_HOST):
        guests.visit(f"made up {number}", address=f"192.0.2.1:{5000 + number}")
        guests.visit("bert", address=f"[2001:db8::{number}]:5000")
    with pytest.raises(Refused, match="clients of your address"):
        guests.visit("bert", address="[2001:db8::99]:5000")
    for number in range(SHARE_OF_HOST):
        guests.leave_name("bert", address=f"[2001:db8::{number}]:5000")
    with pytest.raises(
        Refused, match=f"{SHARE_OF_HOST} clients of your address use this gateway already"
    ) as full:
        guests.visit("one more", address="192.0.2.1:4000")
    assert full.value.args[0].code == Code.GATEWAY_FULL
    guests.visit("made up 1", address="192.0.2.1:4000")
    guests.visit("bert", address="192.0.2.2:4000")
    guests.visit("dora", "key", address="192.0.2.1:4000")
    assert len(guests) == SHARE_OF_HOST + 2


def test_a_silent_one_of_a_host_yields_to_another_there(scene: Scene, guests: Visitors) -> None:
    for number in range(SHARE_OF_HOST):
        guests.visit(f"made up {number}", address="192.0.2.1:5000")
    scene.run(5.1)
    guests.visit("one more", address="192.0.2.1:5000")
    assert len(guests) == SHARE_OF_HOST


def test_behind_a_broker_nobody_has_a_share_of_a_host(visitors: Visitors) -> None:
    for number in range(MAX_VISITORS):
        visitors.visit(f"client {number}")
    assert len(visitors) == MAX_VISITORS


def test_who_has_a_key_takes_the_place_of_the_quietest_guest(scene: Scene, guests: Visitors) -> None:
    fill(guests)
    scene.run(1.0)
    for number in (0, *range(2, MAX_VISITORS)):
        guests.visit(str(number), address=f"192.0.2.{1 + number // SHARE_OF_HOST}:5000")
    dora = guests.visit("dora", "key", "192.0.2.1:5000")
    assert len(guests) == MAX_VISITORS
    with pytest.raises(Refused, match="clients use this gateway already"):
        guests.visit("1", address="192.0.2.200:5000")
    guests.visit("0", address="192.0.2.1:5000")
    assert guests.visit("dora", "key", "192.0.2.1:5000") is dora


def test_a_guest_takes_no_place_of_who_has_a_key(scene: Scene, guests: Visitors) -> None:
    fill(guests, "key")
    with pytest.raises(Refused, match="clients use this gateway already"):
        guests.visit("one more", address="192.0.2.200:5000")
    with pytest.raises(Refused, match="clients use this gateway already"):
        guests.visit("one more", "key", address="192.0.2.200:5000")
    scene.run(5.1)
    with pytest.raises(Refused, match="clients use this gateway already"):
        guests.visit("one more", address="192.0.2.200:5000")
    guests.visit("one more", "key", address="192.0.2.200:5000")


def test_a_wrong_token_takes_no_place_of_others(scene: Scene, guests: Visitors) -> None:
    fill(guests)
    scene.run(5.1)
    with pytest.raises(Refused, match="wrong, forgeable=True"):
        guests.visit("one more", "guess", "192.0.2.200:5000")
    assert len(guests) == MAX_VISITORS
