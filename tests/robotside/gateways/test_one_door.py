"""One door for all gateways: whoever comes by whichever of them, there is one driver, STOP is for all, and a command is done once."""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterator

import pytest

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest, SetModeRequest
from robotside.door.station_door import StationDoor
from robotside.gateways.discovery import adapters
from robotside.records import Records
from robotside.station.station import Station
from tests.fakes import FakeRobot
from tests.robotside.gateways.adapter_clients import WAYS, Client
from tests.robotside.gateways.in_process import Gateways

HOWS = ("rosbridge", "memory", *WAYS)
DIRECT = ("rosbridge", "rest", "soap", "websocket", "coap")
"""Those whose clients come by a connection of their own from one host; behind a broker the broker is the host."""
AHEAD = Twist.planar(0.3, 0.0)


class World:
    """A station in virtual time, with all gateways."""

    def __init__(self) -> None:
        self.now = 1000.0
        self.body = FakeRobot()
        self.body.silent = {"/map", "/scan", "/battery_state", "/bumper"}
        self.station = Station(
            self.body, Records.in_memory(), now=self.now, clock=lambda: self.now, rng=random.Random(1)
        )
        self.gateways = Gateways(StationDoor(self.station))
        self._names = itertools.count(1)

    def connect(self, how: str, name: str = "") -> Client:
        name = name or f"{how}-{next(self._names)}"
        client = self.gateways.connect(how, name)
        client.ask("/missions/get", CommandRequest(client_id=name, client_name=name))
        return client

    def drive(self, client: Client, twist: Twist = AHEAD) -> None:
        self.now += 0.02
        client.publish("/cmd_vel", twist, self.now)
        self.station.step(self.now)

    def ask(self, client: Client, service: str, **words: object) -> str:
        """Why not; empty when it is done."""
        answer = client.ask(service, CommandRequest(**words))  # type: ignore[arg-type]
        return "" if answer.success else answer.code


@pytest.fixture
def world() -> Iterator[World]:
    made = World()
    yield made
    made.gateways.close()
    made.station.close()


def test_each_protocol_is_among_them() -> None:
    assert set(adapters()) == set(WAYS)


@pytest.mark.parametrize("how", HOWS)
def test_a_driver_by_each_has_control_alone_and_leaves_a_robot_at_rest(world: World, how: str) -> None:
    driver = world.connect(how)
    others = [world.connect(other) for other in HOWS]
    world.drive(driver)
    assert not world.body.at_rest
    assert world.station.controls.holds(driver.operator)
    before = len(world.body.commands)
    for other in others:
        world.drive(other, Twist.planar(-0.3, 0.0))
        assert world.ask(other, "/control/acquire") == Code.CONTROL_HELD.value
        assert world.station.controls.holds(driver.operator)
    assert not any(twist and twist.linear.x < 0 for twist in world.body.commands[before:])
    world.drive(driver)
    assert not world.body.at_rest
    driver.leave()
    assert world.body.at_rest
    assert world.station.controls.driver is None


@pytest.mark.parametrize("how", HOWS)
def test_stop_by_each_holds_for_all(world: World, how: str) -> None:
    clients = [world.connect(each) for each in HOWS]
    stranger = world.connect(how)
    for driver in clients:
        world.station.controls.release_stop()
        world.drive(driver, Twist())  # its stick is let go before it counts
        world.drive(driver)
        assert not world.body.at_rest
        assert world.ask(stranger, "/stop") == ""
        assert world.body.at_rest
        for each in clients:
            world.drive(each)
        assert world.body.at_rest
        assert world.ask(driver, "/control/release") == ""


def test_a_command_that_is_sent_again_by_another_gateway_is_done_once(world: World) -> None:
    """A tablet that reconnects by another protocol: its command is answered alike, and not done again."""
    for first, second in itertools.permutations(DIRECT, 2):
        name = f"tablet-{first}-{second}"
        one, other, third = world.connect(first, name), world.connect(second, name), world.connect("memory")
        asked = SetModeRequest(command_id="c1", client_id=name, mode="MANUAL")
        done = one.ask("/mode/set", asked)
        assert done.success, done.message
        assert world.ask(one, "/control/release") == ""
        assert world.ask(third, "/control/acquire") == ""
        again = other.ask("/mode/set", asked)
        assert (again.success, again.message) == (True, done.message), name
        fresh = other.ask("/mode/set", SetModeRequest(command_id="c2", client_id=name, mode="MANUAL"))
        assert fresh.code == Code.CONTROL_HELD.value
        assert world.ask(third, "/control/release") == ""
