"""Drive commands that would arrive late are not sent at all: what `BridgeClient.publish` makes of the state of its link."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from typing import Any

import pytest

from bridge.client.client import UNREAD_TIMEOUT, BridgeClient, LinkState, Phase
from bridge.client.liveness import LATE_AFTER, Liveness
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.std_msgs import String
from tests.bridge.wires import Clock

AHEAD = Twist.planar(0.4, 0.0)


class Wire:
    """A connection that stands, as the system tells of it."""

    def __init__(self, *, ours: bool) -> None:
        self.ours = ours
        self.fingerprint = ""
        self.stuck = self.full = False
        self.unread = 0.0
        self.probes: list[float] = []
        self.sent: list[dict[str, Any]] = []
        self.on_sent: Callable[[], object] = int

    def send(self, text: str) -> bool:
        self.sent.append(json.loads(text))
        self.on_sent()
        return True

    def unread_time(self, now: float) -> float:
        return self.unread

    def probe(self, now: float) -> None:
        self.probes.append(now)


class Beat:
    """What is known of the life at the other end."""

    def __init__(self, liveness: Liveness) -> None:
        self.liveness = liveness


class Driver:
    """A client that is connected, without a socket."""

    def __init__(self, *, ours: bool) -> None:
        self.clock = Clock()
        self.wire = Wire(ours=ours)
        self.life = Liveness("robot:9090", ours, self.clock.time)
        self.life.on_pong(self.clock.time)
        self.client = BridgeClient("ws://robot:9090", now=self.clock)
        self.client._connection = self.wire  # type: ignore[assignment]
        self.client._heartbeat = Beat(self.life)  # type: ignore[assignment]
        self.client.state = LinkState(Phase.CONNECTED, "", 0, 0.0)

    def drives(self, stamp: float | None = 7000.0, *, even_late: bool = False) -> bool:
        return self.client.publish("/cmd_vel", AHEAD, stamp=stamp, even_late=even_late)


@pytest.fixture(params=[True, False], ids=["ours", "foreign"])
def driver(request: pytest.FixtureRequest) -> Driver:
    return Driver(ours=request.param)


def test_over_a_link_that_lives_it_leaves_with_its_stamp(driver: Driver) -> None:
    assert driver.drives()
    (said,) = driver.wire.sent
    assert (said["op"], said["topic"], said["stamp"]) == ("publish", "/cmd_vel", 7000.0)


def test_while_what_was_sent_before_does_not_get_through_nothing_is_sent_but_rest(driver: Driver) -> None:
    driver.wire.stuck = True
    assert not driver.drives()
    assert driver.drives(even_late=True)
    driver.wire.full = True
    assert not driver.drives(even_late=True)
    assert len(driver.wire.sent) == 1


def test_a_robot_from_which_nothing_came_for_a_second_gets_no_drive_command_but_rest(driver: Driver) -> None:
    driver.clock.time += LATE_AFTER
    assert driver.drives()
    driver.clock.time += 0.01
    assert not driver.drives()
    assert driver.drives(even_late=True)
    assert driver.client.publish("/chatter", String()), "what drives nothing may come late"
    driver.life.on_message(driver.clock.time)
    assert driver.drives()


def test_without_its_clock_a_robot_of_ours_is_not_driven_and_another_one_is_without_a_stamp(
    driver: Driver,
) -> None:
    assert driver.drives(math.nan) is not driver.wire.ours
    assert [said.get("stamp") for said in driver.wire.sent] == ([] if driver.wire.ours else [None])
    assert driver.drives(math.nan, even_late=True)


def test_a_foreign_server_that_leaves_data_unread_is_not_driven_until_it_has_read_it() -> None:
    driver = Driver(ours=False)
    assert driver.drives()
    assert driver.wire.probes == [driver.clock.time], "it is asked for a sign of having read that"
    driver.wire.unread = UNREAD_TIMEOUT + 0.01
    assert not driver.drives()
    assert driver.drives(even_late=True)
    driver.wire.unread = UNREAD_TIMEOUT
    assert driver.drives()


def test_before_the_other_end_has_proved_to_be_a_robot_nothing_is_sent(driver: Driver) -> None:
    driver.client.state = LinkState(Phase.CONNECTING, "", 1, 0.0)
    assert not driver.drives()
    assert not driver.drives(even_late=True)
    assert driver.wire.sent == []
