"""Clients that give an id: the same one in the next request, bounded, and gone when they are silent."""

from __future__ import annotations

import pytest

from bridge.core.errors import Refused
from bridge.core.identity import Identity, Role
from bridge.core.robot_catalogue import Operator
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest
from robotside.gateways.payloads.table import KEYS
from robotside.gateways.plain.visitors import IDLE_TIMEOUT, MAX_VISITORS, SILENT_TIMEOUT
from robotside.gateways.soap.callers import Callers
from tests.robotside.scene import Scene

DRIVER = Identity("", "", Role.DRIVE)


@pytest.fixture
def callers(scene: Scene) -> Callers:
    return Callers(scene.door, KEYS)


def request(scene: Scene, host: str = "192.0.2.7", identity: Identity = DRIVER) -> Operator:
    """Who asks once, by a port of its own."""
    made = scene.door.join(f"{host}:{len(scene.door._operators) + 1024}", way="soap", role=Role.DRIVE)
    made.identity = identity
    return made


def test_the_same_id_from_the_same_host_is_the_same_client(callers: Callers, scene: Scene) -> None:
    first = callers.visit(request(scene), "a")
    assert callers.visit(request(scene), "a") is first
    assert callers.visit(request(scene), "b") is not first
    assert callers.visit(request(scene, "192.0.2.8"), "a") is not first
    proven = Identity("p1", "Anna", Role.DRIVE, proven=True)
    assert callers.visit(request(scene, identity=proven), "a") is not first
    assert len(callers) == 4


def test_who_gives_none_is_gone_with_its_request(callers: Callers, scene: Scene) -> None:
    asks = request(scene)
    assert callers.visit(asks, "").operator is asks
    assert len(callers) == 0


def test_with_another_role_it_begins_anew_and_has_control_no_more(callers: Callers, scene: Scene) -> None:
    kept = callers.visit(request(scene), "a")
    assert scene.door.call(kept.operator, "/control/acquire", CommandRequest()).success  # type: ignore[union-attr]
    weak = callers.visit(request(scene, identity=Identity("", "", Role.WATCH)), "a")
    assert weak is not kept
    assert weak.operator.role(scene.clock) is Role.WATCH
    assert not scene.control.driver
    assert len(callers) == 1


@pytest.mark.parametrize("ending", ["leaves", "all leave", "is expelled"])
def test_a_robot_rests_when_its_driver_is_gone(callers: Callers, scene: Scene, ending: str) -> None:
    anna = Identity("p1", "Anna", Role.DRIVE, proven=True)
    operator = callers.visit(request(scene, identity=anna), "a").operator
    operator.asked_time = True
    scene.door.publish(operator, "/cmd_vel", Twist.planar(0.3, 0.0), scene.clock)
    assert not scene.robot.at_rest
    if ending == "leaves":
        callers.leave(request(scene, identity=anna), "a")
    elif ending == "all leave":
        callers.leave_all()
    else:
        scene.door.expel(["p1"])
    assert scene.robot.at_rest
    assert not scene.control.driver
    assert len(callers) == 0


def test_silent_ones_are_forgotten_and_make_room(callers: Callers, scene: Scene) -> None:
    for number in range(MAX_VISITORS):
        callers.visit(request(scene), str(number))
    with pytest.raises(Refused, match=f"{MAX_VISITORS} clients"):
        callers.visit(request(scene), "late")
    scene.clock += SILENT_TIMEOUT + 1
    callers.visit(request(scene), "late")
    assert len(callers) == MAX_VISITORS
    scene.clock += IDLE_TIMEOUT - SILENT_TIMEOUT
    callers.leave_silent()
    assert len(callers) == 1
