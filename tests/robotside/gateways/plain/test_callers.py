"""Clients that give an id: the same one in the next request, bounded, and gone when they are silent."""

from __future__ import annotations

from functools import partial

import pytest

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Identity, Role
from bridge.core.robot_catalogue import Operator
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest
from robotside.gateways.payloads.table import KEYS
from robotside.gateways.plain.callers import MAX_OF_HOST, Callers, stand_in
from robotside.gateways.plain.known_clients import IDLE_TIMEOUT, MAX_VISITORS, SILENT_TIMEOUT
from robotside.gateways.plain.visitor import Visitor
from tests.robotside.scene import Scene

DRIVER = Identity("", "", Role.DRIVE)
GUEST = Identity("", "", Role.WATCH)
ANNA = Identity("p1", "Anna", Role.DRIVE, proven=True)
WATCHER_WITH_KEY = Identity("p2", "Bob", Role.WATCH, proven=True)


@pytest.fixture
def callers(scene: Scene) -> Callers:
    return Callers(scene.door, KEYS)


def request(scene: Scene, host: str = "192.0.2.7", identity: Identity = DRIVER) -> Operator:
    """Who asks once, by a port of its own."""
    made = scene.door.join(f"{host}:{len(scene.door._operators) + 1024}", way="soap", role=Role.DRIVE)
    made.identity = identity
    return made


def visit(callers: Callers, scene: Scene, asks: Operator, client_id: str) -> Visitor:
    """The client behind a request, which has somebody stand in for it at the door."""
    return callers.visit(asks, client_id, partial(stand_in, scene.door))


def test_the_same_id_from_the_same_host_is_the_same_client(callers: Callers, scene: Scene) -> None:
    first = visit(callers, scene, request(scene), "a")
    assert visit(callers, scene, request(scene), "a") is first
    assert visit(callers, scene, request(scene), "b") is not first
    assert visit(callers, scene, request(scene, "192.0.2.8"), "a") is not first
    proven = Identity("p1", "Anna", Role.DRIVE, proven=True)
    assert visit(callers, scene, request(scene, identity=proven), "a") is not first
    assert len(callers) == 4


def test_with_another_role_it_begins_anew_and_has_control_no_more(callers: Callers, scene: Scene) -> None:
    kept = visit(callers, scene, request(scene), "a")
    assert scene.door.call(kept.operator, "/control/acquire", CommandRequest()).success  # type: ignore[union-attr]
    weak = visit(callers, scene, request(scene, identity=Identity("", "", Role.WATCH)), "a")
    assert weak is not kept
    assert weak.operator.role(scene.clock) is Role.WATCH
    assert not scene.control.driver
    assert len(callers) == 1


@pytest.mark.parametrize("ending", ["leaves", "all leave", "is expelled"])
def test_a_robot_rests_when_its_driver_is_gone(callers: Callers, scene: Scene, ending: str) -> None:
    anna = Identity("p1", "Anna", Role.DRIVE, proven=True)
    operator = visit(callers, scene, request(scene, identity=anna), "a").operator
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


def crowd(callers: Callers, scene: Scene, count: int, identity: Identity) -> list[Visitor]:
    """Clients without a key, as many of each host as may be."""
    return [
        visit(callers, scene, request(scene, f"198.51.100.{number // MAX_OF_HOST}", identity), str(number))
        for number in range(count)
    ]


def test_silent_ones_are_forgotten_and_make_room(callers: Callers, scene: Scene) -> None:
    crowd(callers, scene, MAX_VISITORS, DRIVER)
    with pytest.raises(Refused, match=f"{MAX_VISITORS} clients"):
        visit(callers, scene, request(scene), "late")
    scene.clock += SILENT_TIMEOUT + 1
    visit(callers, scene, request(scene), "late")
    assert len(callers) == MAX_VISITORS
    scene.clock += IDLE_TIMEOUT - SILENT_TIMEOUT
    callers.leave_silent()
    assert len(callers) == 1


def test_who_makes_up_ids_without_a_key_has_a_share_of_its_host_and_leaves_the_rest(
    callers: Callers, scene: Scene
) -> None:
    for number in range(MAX_OF_HOST):
        visit(callers, scene, request(scene), str(number))
    with pytest.raises(Refused, match=f"{MAX_OF_HOST} clients without a key of your computer") as refused:
        visit(callers, scene, request(scene), "one more")
    assert refused.value.args[0].code == Code.GATEWAY_FULL
    visit(callers, scene, request(scene, "192.0.2.8"), "another host")
    visit(callers, scene, request(scene, identity=ANNA), "a key")
    visit(callers, scene, request(scene), "0")
    assert len(callers) == MAX_OF_HOST + 2
    scene.clock += SILENT_TIMEOUT
    visit(callers, scene, request(scene), "one more")
    assert len(callers) == MAX_OF_HOST + 2


def test_who_has_a_key_has_no_share_of_its_host(callers: Callers, scene: Scene) -> None:
    for number in range(MAX_OF_HOST + 1):
        visit(callers, scene, request(scene, identity=ANNA), str(number))
    assert len(callers) == MAX_OF_HOST + 1


@pytest.mark.parametrize("newcomer", [WATCHER_WITH_KEY, DRIVER], ids=["a key", "a higher role"])
def test_where_all_places_are_taken_the_quietest_of_those_who_may_least_yields(
    callers: Callers, scene: Scene, newcomer: Identity
) -> None:
    kept = visit(callers, scene, request(scene, identity=ANNA), "first")
    crowded = crowd(callers, scene, MAX_VISITORS - 1, GUEST)
    scene.clock += 1.0
    crowded[0].heard()
    with pytest.raises(Refused, match=f"{MAX_VISITORS} clients"):
        visit(callers, scene, request(scene, identity=GUEST), "no more")
    visit(callers, scene, request(scene, identity=newcomer), "late")
    assert len(callers) == MAX_VISITORS
    known = list(callers._known.values())
    assert kept in known
    assert crowded[0] in known
    assert crowded[1] not in known


def test_nobody_with_a_key_yields_to_who_has_none(callers: Callers, scene: Scene) -> None:
    for number in range(MAX_VISITORS):
        visit(callers, scene, request(scene, identity=WATCHER_WITH_KEY), str(number))
    with pytest.raises(Refused):
        visit(callers, scene, request(scene), "late")
    visit(callers, scene, request(scene, identity=ANNA), "late")
    assert len(callers) == MAX_VISITORS
