"""Commands that come by a broker: STOP for anyone, goals that end with their client, topics made while somebody asks."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.topics import CAMERA
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.gateways.broker import command_desk
from robotside.gateways.broker.command_desk import (
    BYE,
    CALL,
    CANCEL,
    LEAVE,
    MAX_GOALS,
    READ,
    RUN,
    Command,
    CommandDesk,
)
from robotside.gateways.broker.topic_feed import TopicFeed
from robotside.gateways.gateway_url import read_url
from robotside.gateways.plain.known_clients import IDLE_TIMEOUT
from robotside.gateways.plain.visitors import Visitors
from tests.fakes import FakeRobot
from tests.looped import looped
from tests.robotside.scene import Scene

HOLD = b'{"order": {"task": "hold", "duration": 2.0}}'
RUN_TASK = "/task/run"
ON_DEMAND = "/sim/ground_truth"


class Desk:
    """A desk, the clients that it knows, and what they are told."""

    def __init__(self, scene: Scene, role: Role = Role.DRIVE, options: str = "") -> None:
        url = read_url(f"mqtt://192.0.2.7?{options}", {"mqtt": 1883})
        self.scene = scene
        self.visitors = Visitors(scene.door, "broker", url.address, url.keys, role=role, secure=False)
        self.feed = TopicFeed(scene.door, "broker", url, role)
        self.desk = CommandDesk(self.visitors, self.feed)
        self.answers: list[dict[str, Any]] = []
        self.feedback: list[dict[str, Any]] = []

    def command(self, verb: str, name: str = "", payload: bytes = b"", **said: Any) -> Command:
        given = {"client": "me", "stamp": self.scene.clock} | said
        hear, follow = partial(_note, self.answers), partial(_note, self.feedback)
        return Command(verb=verb, name=name, payload=payload, answer=hear, feedback=follow, **given)

    def obey(self, verb: str, name: str = "", payload: bytes = b"", **said: Any) -> None:
        self.desk.obey(self.command(verb, name, payload, **said))


def _note(heard: list[dict[str, Any]], raw: bytes) -> None:
    heard.append(json.loads(raw))


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(5.0)
    return made


@pytest.fixture
async def desk(scene: Scene) -> AsyncIterator[Desk]:
    made = Desk(scene)
    yield made
    made.visitors.leave_all()
    await made.desk.close()
    assert not scene.door._operators
    assert not scene.door._subscriptions


async def until(so: Callable[[], object]) -> None:
    """Let the loop go on until it is so."""
    for _ in range(1000):
        if so():
            return
        await asyncio.sleep(0)
    pytest.fail("it never is so")


def running(scene: Scene) -> bool:
    return scene.station.autonomy.engine.running


@looped("raw", [b"", b"{", b'{"surprise": 1}'])
def test_stop_is_pressed_for_anyone_with_a_wrong_token_too(raw: bytes, tmp_path: Path) -> None:
    async def press() -> None:
        scene = Scene(FakeRobot(), tmp_path)
        scene.drive(Twist.planar(0.3, 0.0))
        desk = Desk(scene, Role.NONE)
        desk.desk.press_stop(desk.command(CALL, "/stop", raw, token="wrong"))
        assert scene.station.controls.stopped
        assert scene.robot.at_rest
        await until(lambda: desk.answers)
        assert not [each for each in scene.door._operators if each.way]

    asyncio.run(press())


async def test_a_goal_tells_how_far_it_is_and_what_it_came_to(desk: Desk, scene: Scene) -> None:
    desk.obey(RUN, RUN_TASK, HOLD, id=b"7")
    await until(lambda: running(scene))
    scene.run_task()
    await until(lambda: desk.answers)
    assert desk.answers[0]["state"] == "SUCCEEDED"
    assert desk.feedback
    assert "progress" in desk.feedback[0]


@pytest.mark.parametrize("end", ["bye", "silent", "lost", "cancel", "cancel all"])
async def test_a_goal_ends_with_its_client_or_when_that_takes_it_back(
    end: str, desk: Desk, scene: Scene
) -> None:
    desk.obey(RUN, RUN_TASK, HOLD.replace(b"2.0", b"600"), id=b"7")
    await until(lambda: running(scene))
    if end == "bye":
        desk.obey(BYE)
    elif end == "silent":
        scene.run(IDLE_TIMEOUT + 0.1)
        desk.visitors.leave_silent()
    elif end == "lost":
        desk.visitors.leave_all()
    else:
        desk.obey(CANCEL, RUN_TASK, id=b"7" if end == "cancel" else b"")
    await until(lambda: desk.answers)
    scene.run(0.5)
    assert not running(scene)
    assert scene.robot.at_rest
    assert (desk.answers[0]["success"], desk.answers[0]["code"]) == (False, Code.GATEWAY_CANCELLED)


async def test_a_goal_that_is_taken_back_before_it_began_is_answered_and_never_begins(
    desk: Desk, scene: Scene
) -> None:
    desk.obey(RUN, RUN_TASK, HOLD, id=b"7")
    desk.obey(CANCEL, RUN_TASK, id=b"7")
    await until(lambda: desk.answers)
    scene.run(0.5)
    assert not running(scene)
    assert desk.answers[0]["code"] == Code.GATEWAY_CANCELLED


async def test_nobody_takes_back_what_another_client_runs(desk: Desk, scene: Scene) -> None:
    desk.obey(RUN, RUN_TASK, HOLD, id=b"7")
    await until(lambda: running(scene))
    with pytest.raises(Refused, match="No goal of /task/run runs for you"):
        desk.obey(CANCEL, RUN_TASK, id=b"7", client="other")
    with pytest.raises(Refused, match="with this id runs already"):
        desk.obey(RUN, RUN_TASK, HOLD, id=b"7")
    assert running(scene)


async def test_a_goal_is_as_fresh_as_a_call_and_needs_its_role(scene: Scene) -> None:
    driver = Desk(scene)
    with pytest.raises(Refused) as refused:
        driver.obey(RUN, RUN_TASK, HOLD, stamp=float("nan"))
    assert refused.value.args[0].code == Code.GATEWAY_UNDATED
    driver.obey(RUN, RUN_TASK, HOLD, stamp=scene.clock - 60)
    await until(lambda: driver.answers)
    assert "too old: given 60.0 s ago" in driver.answers[0]["message"]
    watcher = Desk(scene, Role.WATCH)
    watcher.obey(RUN, RUN_TASK, HOLD)
    await until(lambda: watcher.answers)
    assert watcher.answers[0]["code"] == Code.TRUST_ROLE
    assert not running(scene)


async def test_a_client_has_a_bounded_number_of_goals(desk: Desk) -> None:
    for number in range(MAX_GOALS):
        desk.obey(RUN, RUN_TASK, HOLD, id=b"%d" % number)
    with pytest.raises(Refused, match=f"{MAX_GOALS} goals of this client"):
        desk.obey(RUN, RUN_TASK, HOLD, id=b"more")


async def test_calls_that_wait_for_their_answer_are_bounded_and_stop_is_pressed_all_the_same(
    desk: Desk, scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command_desk, "MAX_CALLS", 1)
    desk.obey(RUN, RUN_TASK, HOLD, id=b"1")
    with pytest.raises(Refused, match="1 calls by this gateway wait"):
        desk.obey(CALL, "/control/acquire", b"{}")
    desk.desk.press_stop(desk.command(CALL, "/stop"))
    assert scene.station.controls.stopped


async def test_a_topic_is_made_while_somebody_there_asks_for_it(desk: Desk, scene: Scene) -> None:
    wanted = scene.robot.wanted
    desk.feed.begin()
    assert not wanted.get(ON_DEMAND)
    desk.obey(READ, ON_DEMAND)
    desk.obey(READ, ON_DEMAND)
    desk.obey(READ, ON_DEMAND, client="other")
    desk.obey(LEAVE, ON_DEMAND, client="other")
    assert [each["success"] for each in desk.answers] == [True] * 4
    assert wanted[ON_DEMAND]
    desk.obey(BYE)
    assert not wanted[ON_DEMAND]
    desk.obey(READ, ON_DEMAND)
    scene.run(IDLE_TIMEOUT + 1)
    desk.visitors.leave_silent()
    assert not wanted[ON_DEMAND]
    desk.feed.end()


async def test_pictures_come_on_request(desk: Desk, scene: Scene) -> None:
    sent: list[tuple[str, bytes]] = []

    async def send(message: Any) -> None:
        sent.append((message.name, message.payload))

    running = asyncio.create_task(desk.feed.run(send))
    desk.obey(READ, CAMERA)
    scene.station.bus.publish(CAMERA, CompressedImage(format="jpeg", data=b"picture"))
    await until(lambda: sent)
    assert sent[0][0] == CAMERA
    assert json.loads(sent[0][1])["data"] == "cGljdHVyZQ=="
    desk.obey(LEAVE, CAMERA)
    scene.station.bus.publish(CAMERA, CompressedImage(format="jpeg", data=b"another"))
    await asyncio.sleep(0)
    assert len(sent) == 1
    running.cancel()


async def test_what_cannot_be_asked_for_is_refused_and_what_comes_anyway_is_said(scene: Scene) -> None:
    desk = Desk(scene, options="payloads=wheels")
    for name, why in (
        ("/cmd_vel", "it listens there"),
        ("/nothing", "does not carry /nothing"),
        (CAMERA, "does not carry"),
    ):
        with pytest.raises(Refused, match=why):
            desk.obey(READ, name)
    desk.obey(READ, "/odom")
    assert "comes without being asked for" in desk.answers[0]["message"]
    with pytest.raises(Refused, match="is one of publish, call"):
        desk.obey("fly", "/odom")
    with pytest.raises(Refused):
        Desk(scene, Role.NONE).obey(READ, ON_DEMAND)
