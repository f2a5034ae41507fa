"""The table of permissions covers every operation of a station, and names no operation that there is not."""

from __future__ import annotations

import pytest

from bridge.core.identity import Role
from robotside.trust.permissions import ANY, PERMISSIONS, needed_role
from tests.robotside.scene import Scene


@pytest.fixture
def operations(scene: Scene) -> set[str]:
    door = scene.door
    return {f"call {name}" for name in door.services} | {f"run {name}" for name in door.actions}


def test_every_service_and_action_of_a_station_has_its_line(operations: set[str]) -> None:
    assert operations - PERMISSIONS.keys() == set()


EQUIPMENT = {"call /arm/move", "call /lights/set", "call /robot/reset"}
"""Services of robots that carry more than the one of these tests."""
SERVED = {"call /gateways/bring_up", "call /gateways/bring_down", "call /payloads/set"}
"""Services of robots that are served; tests/robotside/serving has their tests."""
PEOPLE = {f"call /pair/{what}" for what in ("scan", "begin", "finish")} | {
    f"call /people/{what}" for what in ("me", "list", "remove", "guest", "invite")
}
"""Services of robots that know people; tests/robotside/services/test_people_services.py has that these are all."""


def test_every_line_of_a_service_or_action_is_one_of_a_station(operations: set[str]) -> None:
    named = {each for each in PERMISSIONS if each.split()[0] in ("call", "run") and not each.endswith(ANY)}
    assert named - operations == EQUIPMENT | PEOPLE | SERVED


def test_without_a_role_there_is_stop_and_nothing_that_shows_or_moves_the_robot() -> None:
    free = {each for each, role in PERMISSIONS.items() if role is Role.NONE}
    assert free == {
        "subscribe /robot/info",
        "rosapi /rosapi/get_time",
        "call /stop",
        "call /pair/scan",
        "call /pair/begin",
        "call /pair/finish",
        "call /people/me",
        "page /stop",
        "page /",
        "page /login",
        "page /logout",
        "page /healthz",
    }


def test_who_watches_sees_what_there_is_and_may_go_and_changes_nothing_else() -> None:
    watched = {each for each, role in PERMISSIONS.items() if role is Role.WATCH}
    assert watched == {
        f"subscribe {ANY}",
        f"camera {ANY}",
        f"rosapi {ANY}",
        f"page {ANY}",
        "call /events/get",
        "call /events/picture",
        "call /history/get",
        "call /mission/get",
        "call /missions/get",
        "call /people/remove",
    }


def test_the_line_of_a_name_goes_before_that_of_its_verb_and_what_has_neither_is_for_managers() -> None:
    assert needed_role("subscribe", "/robot/info") is Role.NONE
    assert needed_role("subscribe", "/scan") is Role.WATCH
    assert needed_role("page", "/audit.csv") is Role.MANAGE
    assert needed_role("publish", "/of/no/line") is Role.MANAGE
    assert needed_role("call", "/of/no/line") is Role.MANAGE
    assert needed_role("shout", "/stop") is Role.MANAGE
