"""Pairing and people at the door: only over TLS, a driver who is removed stops, and nobody raises itself."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Iterator
from pathlib import Path
from typing import Any

import pytest
from spake2 import SPAKE2_A

from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    GetMeRequest,
    GetPeopleRequest,
    InviteGuestRequest,
    InvitePersonRequest,
    PairBeginRequest,
    PairFinishRequest,
    PairScanRequest,
    RemovePersonRequest,
)
from bridge.trust.pairing import PairLink, confirmations, sides, split_code
from robotside.core.config import TrustSettings
from robotside.door.station_door import StationDoor
from robotside.services.people_services import people_services
from robotside.trust.pairing import Pairing
from robotside.trust.people_file import PeopleFile, Unkept
from robotside.trust.permissions import PERMISSIONS
from robotside.trust.qr import as_rows
from robotside.trust.trust import Trust
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene

PRINT = "ab" * 32
FAR = "192.0.2.9:1"


class Robot:
    """A robot with people, in virtual time."""

    def __init__(self, state: Path) -> None:
        self.scene = Scene(FakeRobot(), state)
        station = self.scene.station
        self.trust = Trust(PeopleFile(state), station.clock, TrustSettings())
        self.pairing = Pairing(PRINT, station.info.name, station.clock)
        self.pairing.host, self.pairing.port = "192.0.2.1", 9090
        self.services = list(
            people_services(
                self.trust,
                self.pairing,
                robot=station.info.name,
                now=station.clock,
                say=station.events.say,
                connected=lambda: self.door.connected,
            )
        )
        self.door = StationDoor(station, self.trust, self.services)
        self.trust.on_lost = self.door.expel
        self.cut: list[Operator] = []

    def close(self) -> None:
        self.trust.close()
        self.door.close()

    def join(self, token: str = "", *, secure: bool = True, address: str = FAR) -> Operator:
        operator = self.door.join(address, way="rosbridge", secure=secure, token=token)
        operator.on_expelled = lambda: self.cut.append(operator)
        return operator

    async def call(self, operator: Operator, name: str, request: Msg) -> Any:
        answer = self.door.call(operator, name, request)
        return await answer if isinstance(answer, Awaitable) else answer

    async def refused(self, operator: Operator, name: str, request: Msg) -> str:
        with pytest.raises(Refused) as refused:
            await self.call(operator, name, request)
        return str(refused.value)

    async def paired(self, name: str = "tablet-A", role: Role = Role.DRIVE) -> Any:
        """The answer to a handheld that scanned the link."""
        secret = self.pairing.open(role).secret
        return await self.call(self.join(), "/pair/scan", PairScanRequest(secret, name))

    async def typed(self, code: str, sees: str = PRINT) -> tuple[bytes, Operator]:
        tag, digits = split_code(code)
        handheld, robot = sides(sees)
        spake, stranger = SPAKE2_A(digits.encode(), idA=handheld, idB=robot), self.join()
        begun = await self.call(stranger, "/pair/begin", PairBeginRequest(tag, spake.start().hex()))
        return spake.finish(bytes.fromhex(begun.message)), stranger


@pytest.fixture
def robot(tmp_path: Path) -> Iterator[Robot]:
    made = Robot(tmp_path)
    yield made
    made.close()


def test_the_table_of_permissions_has_each_of_them(robot: Robot) -> None:
    assert {f"call {each.name}" for each in robot.services} <= PERMISSIONS.keys()
    assert not any(robot.door.is_urgent(each.name) for each in robot.services)


async def test_without_tls_no_key_is_given(robot: Robot) -> None:
    offer = robot.pairing.open(Role.DRIVE)
    plain = robot.join(secure=False)
    local = robot.join(secure=False, address="127.0.0.1:1")
    for who in (plain, local):
        assert "over TLS only" in await robot.refused(who, "/pair/scan", PairScanRequest(offer.secret, "a"))
        assert "over TLS only" in await robot.refused(who, "/pair/begin", PairBeginRequest("", "41" * 33))
        assert "over TLS only" in await robot.refused(who, "/pair/finish", PairFinishRequest("", "a"))
    assert "over TLS only" in await robot.refused(local, "/people/invite", InvitePersonRequest())
    assert "over TLS only" in await robot.refused(local, "/people/guest", InviteGuestRequest())
    assert robot.pairing.offer is offer
    assert robot.trust.people == ()


async def test_who_scans_the_link_is_known_from_then_on(robot: Robot) -> None:
    answer = await robot.paired()
    assert (answer.role, answer.robot) == ("manage", robot.scene.station.info.name)  # the first is the owner
    assert math.isnan(answer.ends)
    tablet = robot.join(answer.token)
    me = await robot.call(tablet, "/people/me", GetMeRequest())
    assert (me.id, me.name, me.role, me.proven, me.secure) == (answer.id, "tablet-A", "manage", True, True)
    assert answer.token not in "".join(robot.scene.events())
    assert "tablet-A was paired and may manage." in robot.scene.events()


async def test_the_secret_is_for_one_use(robot: Robot) -> None:
    offer = robot.pairing.open(Role.DRIVE)
    request = PairScanRequest(offer.secret, "a")
    answers = [
        await asyncio.gather(robot.call(robot.join(), "/pair/scan", request), return_exceptions=True)
        for _ in range(2)
    ]
    assert [isinstance(answer, Refused) for (answer,) in answers] == [False, True]
    assert len(robot.trust.people) == 1


async def test_a_bad_name_uses_nothing_up(robot: Robot) -> None:
    offer = robot.pairing.open(Role.DRIVE)
    assert "1 to 40 characters" in await robot.refused(
        robot.join(), "/pair/scan", PairScanRequest(offer.secret, "a\nb")
    )
    assert await robot.call(robot.join(), "/pair/scan", PairScanRequest(offer.secret, "ab"))


async def test_who_types_the_code_is_known_from_then_on(robot: Robot) -> None:
    key, stranger = await robot.typed(robot.pairing.open(Role.WATCH).code)
    own, robots = confirmations(key)
    answer = await robot.call(stranger, "/pair/finish", PairFinishRequest(own, "tablet-A"))
    assert answer.confirmation == robots
    assert robot.join(answer.token).identity.id == answer.id


async def test_somebody_between_gets_nothing(robot: Robot) -> None:
    key, stranger = await robot.typed(robot.pairing.open(Role.DRIVE).code, sees="cd" * 32)
    said = await robot.refused(stranger, "/pair/finish", PairFinishRequest(confirmations(key)[0], "x"))
    assert "another computer answers" in said
    assert robot.trust.people == ()


async def test_who_cannot_be_kept_is_not_paired_and_may_try_again(
    robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise Unkept("The list of people cannot be written: no space left on device.")

    offer = robot.pairing.open(Role.DRIVE)
    with monkeypatch.context() as patched:
        patched.setattr(PeopleFile, "change", full)
        said = await robot.refused(robot.join(), "/pair/scan", PairScanRequest(offer.secret, "a"))
    assert "Not paired: The list of people cannot be written" in said
    assert await robot.call(robot.join(), "/pair/scan", PairScanRequest(offer.secret, "a"))


async def test_a_driver_who_is_removed_stops_and_is_cut(robot: Robot) -> None:
    scene = robot.scene
    owner = robot.join((await robot.paired("owner")).token)
    answer = await robot.paired("driver")
    driver = robot.join(answer.token)
    assert (await robot.call(driver, "/control/acquire", CommandRequest(client_id="d"))).success
    robot.door.publish(driver, "/cmd_vel", Twist(), None)
    scene.run(0.1)
    robot.door.publish(driver, "/cmd_vel", Twist.planar(0.3, 0.0), None)
    assert scene.station.controls.driver is not None
    assert scene.robot.commands[-1] == Twist.planar(0.3, 0.0)
    gone = await robot.call(owner, "/people/remove", RemovePersonRequest(answer.id))
    assert gone.name == "driver"
    assert robot.cut == [driver]
    assert scene.station.controls.driver is None
    assert scene.robot.commands[-1] is None  # at rest
    with pytest.raises(Refused):
        robot.door.publish(driver, "/cmd_vel", Twist.planar(0.3, 0.0), None)
    with pytest.raises(Refused):
        robot.join(answer.token)


async def test_a_driver_whose_role_ends_stops_and_is_cut(robot: Robot) -> None:
    scene = robot.scene
    _, token = await robot.trust.add("guest", Role.DRIVE, "guest", scene.clock + 5.0)
    driver = robot.join(token)
    assert (await robot.call(driver, "/control/acquire", CommandRequest(client_id="d"))).success
    scene.run(1.0)
    robot.trust.update()
    assert robot.cut == []
    scene.clock += 5.0
    robot.trust.update()
    assert robot.cut == [driver]
    assert scene.station.controls.driver is None


async def test_somebody_may_go_but_send_away_only_who_manages(robot: Robot) -> None:
    owner = await robot.paired("owner")
    guest_, other = await robot.paired("one"), await robot.paired("two")
    one = robot.join(guest_.token)
    for id in (owner.id, other.id):
        said = await robot.refused(one, "/people/remove", RemovePersonRequest(id))
        assert "needs the role manage; you have drive" in said
    stranger = robot.join()
    assert "pair with it first" in await robot.refused(
        stranger, "/people/remove", RemovePersonRequest(other.id)
    )
    assert (await robot.call(one, "/people/remove", RemovePersonRequest(guest_.id))).name == "one"
    assert [each.name for each in robot.trust.people] == ["owner", "two"]


@pytest.mark.parametrize("name", ["/people/list", "/people/guest", "/people/invite"])
async def test_only_who_manages_lists_and_invites(robot: Robot, name: str) -> None:
    await robot.paired("owner")
    driver = robot.join((await robot.paired("driver")).token)
    request = next(each.request for each in robot.services if each.name == name)
    assert "needs the role manage" in await robot.refused(driver, name, request())
    assert "pair with it first" in await robot.refused(robot.join(), name, request())


async def test_who_manages_sees_everybody_and_who_is_there(robot: Robot) -> None:
    owner = robot.join((await robot.paired("owner")).token)
    await robot.paired("other")
    people = (await robot.call(owner, "/people/list", GetPeopleRequest())).people
    assert [(each.name, each.role, each.kind, each.connected) for each in people] == [
        ("owner", "manage", "handheld", True),
        ("other", "drive", "handheld", False),
    ]
    assert math.isnan(people[1].last_seen)


async def test_who_manages_invites_a_handheld_with_the_role_it_chooses(robot: Robot) -> None:
    owner = robot.join((await robot.paired("owner")).token)
    offer = await robot.call(owner, "/people/invite", InvitePersonRequest("watch"))
    assert offer.open_until == robot.scene.clock + 600.0
    assert offer.qr_rows == as_rows(offer.link)
    link = PairLink.read(offer.link)
    answer = await robot.call(robot.join(), "/pair/scan", PairScanRequest(link.secret, "b"))
    assert answer.role == "watch"
    for role in ("none", "king"):
        assert await robot.refused(owner, "/people/invite", InvitePersonRequest(role))


async def test_a_guest_watches_for_an_hour_unless_told_otherwise(robot: Robot) -> None:
    owner = robot.join((await robot.paired("owner")).token)
    offer = await robot.call(owner, "/people/guest", InviteGuestRequest())
    assert offer.qr_rows == as_rows(offer.link)
    key, stranger = await robot.typed(offer.code)
    answer = await robot.call(stranger, "/pair/finish", PairFinishRequest(confirmations(key)[0], "visitor"))
    assert (answer.role, answer.ends) == ("watch", offer.ends) == ("watch", robot.scene.clock + 3600.0)
    assert robot.trust.people[-1].kind == "guest"
    said = await robot.refused(owner, "/people/guest", InviteGuestRequest("manage"))
    assert "watches or drives" in said
    assert "60 to 86400 s" in await robot.refused(owner, "/people/guest", InviteGuestRequest("", 1e9))
