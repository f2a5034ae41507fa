"""A signal reaches a topic that the robot listens to, while nothing forbids it; whatever forbids it brings it to rest."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.link.capabilities import Capabilities
from app.link.commands import SERVICES
from app.link.signals.signal_sender import SignalNews, SignalSender
from app.link.signals.signal_slot import REST_REPEATS
from bridge.core.errors import NoReply
from bridge.msgs.rosapi_msgs import PublishersResponse, SubscribersResponse
from bridge.msgs.std_msgs import Bool, String
from tests.app.link.test_link import Operator
from tests.bridge.wires import Clock

ON, OFF = Bool(True), Bool(False)
TOPICS = {"/horn": "std_msgs/Bool", "/touch": "std_msgs/Bool", "/cmd_vel": "geometry_msgs/Twist"}


class Desk:
    """The sender, and what went out by it."""

    def __init__(self) -> None:
        self.clock, self.forbidden, self.dumb = Clock(), False, False
        self.sent: list[tuple[str, Any]] = []
        self.late: list[bool] = []
        self.advertised: list[tuple[str, type]] = []
        self.news: list[SignalNews] = []
        self.publishers: dict[str, list[str]] = {"/touch": ["/disc"]}
        self.subscribers: dict[str, list[str]] = {"/horn": ["/disc"], "/touch": ["/disc"]}
        self.client: Any = SimpleNamespace(
            publish=self._publish,
            call=self._call,
            late=False,
            advertise=self._advertise,
        )
        self.network: Any = SimpleNamespace(call=lambda act, *args: act(*args))
        self.robot: Any = SimpleNamespace(capabilities=Capabilities.of(TOPICS, frozenset()))
        self.health: Any = SimpleNamespace(silent=False)
        self.sender = SignalSender(
            self.client,
            self.network,
            self.robot,
            self.health,
            self.clock,
            lambda: self.forbidden,
            SERVICES,
            self.news.append,
        )

    def _advertise(self, topic: str, kind: type) -> None:
        self.advertised.append((topic, kind))
        self.publishers.setdefault(topic, []).append("/bridge_of_another_name")

    def _publish(self, topic: str, message: Any, *, even_late: bool = False) -> bool:
        self.sent.append((topic, message))
        self.late.append(even_late)
        return True

    async def _call(self, service: str, request: Any, response: type, *, timeout: float) -> Any:
        if self.dumb:
            raise NoReply("no answer")
        if response is PublishersResponse:
            return PublishersResponse(tuple(self.publishers.get(request.topic, ())))
        return SubscribersResponse(tuple(self.subscribers.get(request.topic, ())))

    async def turn(self) -> None:
        for _ in range(60):
            await asyncio.sleep(0)

    async def wait(self, seconds: float, *, finger: bool = False) -> list[tuple[str, Any]]:
        """What goes out meanwhile; a `finger` says the horn again every 0.1 s."""
        self.sent.clear()
        for step in range(round(seconds / 0.05)):
            if finger and step % 2 == 0:
                self.sender.hold("/horn", ON, OFF)
            self.sender.send()
            self.clock.time += 0.05
        await self.turn()
        return list(self.sent)


@pytest.fixture
async def desk() -> AsyncIterator[Desk]:
    desk = Desk()
    task = asyncio.get_running_loop().create_task(desk.sender.run())
    desk.sender.on_connected()
    desk.sender.look({"/horn": Bool})
    await desk.turn()
    yield desk
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task


async def test_what_is_held_goes_to_a_topic_that_was_advertised_once_and_rests_at_the_end(desk: Desk) -> None:
    assert desk.advertised == [("/horn", Bool)]
    assert desk.news == [SignalNews("/horn")]
    assert set(await desk.wait(1.0, finger=True)) == {("/horn", ON)}
    assert not any(desk.late), "only a rest may leave late"
    desk.sender.let_go("/horn")
    assert await desk.wait(1.0) == [("/horn", OFF)] * REST_REPEATS
    assert desk.late[-1]
    assert desk.news[-1].sent == OFF


def stopped(desk: Desk) -> None:
    desk.forbidden = True


def silent(desk: Desk) -> None:
    desk.health.silent = True


def late(desk: Desk) -> None:
    desk.client.late = True


def another_type(desk: Desk) -> None:
    desk.robot.capabilities = Capabilities.of({**TOPICS, "/horn": "std_msgs/Float64"}, frozenset())


def driving(desk: Desk) -> None:
    desk.robot.capabilities = Capabilities.of({**TOPICS, "/horn": "geometry_msgs/Twist"}, frozenset())


def gone(desk: Desk) -> None:
    desk.robot.capabilities = Capabilities.of({}, frozenset())


def removed(desk: Desk) -> None:
    desk.sender.look({})


def bound_to_another_type(desk: Desk) -> None:
    desk.sender.look({"/horn": String})


def stop_pressed(desk: Desk) -> None:
    desk.sender.drop()


FORBIDS: list[Callable[[Desk], None]] = [
    *(stopped, silent, late, another_type, driving, gone, removed, bound_to_another_type, stop_pressed)
]


@pytest.mark.parametrize("forbid", FORBIDS)
async def test_what_is_held_rests_and_stays_at_rest_under_the_same_finger_when(
    desk: Desk, forbid: Callable[[Desk], None]
) -> None:
    assert ("/horn", ON) in await desk.wait(0.5, finger=True)
    forbid(desk)
    await desk.turn()
    assert ON not in [msg for _, msg in await desk.wait(0.5, finger=True)]
    assert desk.news[-1].sent == OFF or desk.news[-2].sent == OFF


@pytest.mark.parametrize("forbid", FORBIDS[:-1])
async def test_a_switch_is_not_said_at_all_when(desk: Desk, forbid: Callable[[Desk], None]) -> None:
    forbid(desk)
    await desk.turn()
    desk.sender.say("/horn", ON)
    assert await desk.wait(1.0) == []
    assert desk.news.count(SignalNews("/horn", unsent=True)) == 1


@pytest.mark.parametrize("topic", ["/cmd_vel", "/touch", "/nowhere"])
async def test_nothing_goes_where_nobody_may_send(desk: Desk, topic: str) -> None:
    desk.sender.look({topic: Bool})
    await desk.turn()
    assert desk.news[-1].topic == topic
    assert desk.news[-1].problem
    desk.sender.say(topic, ON)
    desk.sender.hold(topic, ON, OFF)
    assert await desk.wait(1.0) == []
    assert topic not in dict(desk.advertised)


async def test_a_topic_that_no_control_on_the_glass_is_bound_to_gets_nothing(desk: Desk) -> None:
    desk.sender.say("/touch", ON)
    assert await desk.wait(1.0) == []


async def test_of_a_topic_that_another_type_is_bound_to_since_nothing_leaves_before_it_is_asked_again(
    desk: Desk,
) -> None:
    desk.sender.look({"/horn": String})
    desk.sender.say("/horn", ON)
    desk.sender.send()
    assert desk.sent == []


async def test_a_topic_that_left_the_glass_and_came_back_is_not_held_by_the_same_finger(desk: Desk) -> None:
    await desk.wait(0.5, finger=True)
    for topics in ({}, {"/horn": Bool}):
        desk.sender.look(topics)
        await desk.turn()
    assert ON not in [msg for _, msg in await desk.wait(0.5, finger=True)]
    desk.sender.let_go("/horn")
    assert ("/horn", ON) in await desk.wait(0.5, finger=True), "lifted, it holds anew"


async def test_what_waits_when_the_link_is_lost_is_forgotten_and_not_only_held_back(desk: Desk) -> None:
    desk.sender.hold("/horn", ON, OFF)
    desk.sender.say("/horn", ON)
    desk.sender.on_lost()
    assert not desk.sender.slot.busy
    desk.sender.hold("/horn", ON, OFF)
    assert not desk.sender.slot.busy, "the same finger holds nothing over the next link"


async def test_nothing_leaves_before_it_is_known_who_listens(desk: Desk) -> None:
    desk.sender.on_lost()
    desk.sender.on_connected()
    desk.sender.say("/horn", ON)
    desk.sender.hold("/horn", ON, OFF)
    assert await desk.wait(0.6) == []


async def test_a_robot_that_does_not_say_who_listens_is_sent_nothing(desk: Desk) -> None:
    desk.dumb = True
    desk.sender.on_lost()
    desk.sender.on_connected()
    await desk.turn()
    assert "does not say who listens to /horn" in desk.news[-1].problem
    desk.sender.say("/horn", ON)
    assert await desk.wait(1.0) == []


async def test_a_link_that_is_lost_while_it_is_held_brings_rest_first_of_all_over_the_next(
    desk: Desk,
) -> None:
    await desk.wait(0.5, finger=True)
    desk.sender.on_lost()
    assert await desk.wait(2.0, finger=True) == []
    desk.sender.on_connected()
    assert (await desk.wait(1.0, finger=True))[0] == ("/horn", OFF)
    assert ("/horn", ON) not in desk.sent


async def test_the_link_that_is_closed_says_rest_a_last_time(desk: Desk) -> None:
    await desk.wait(0.5, finger=True)
    desk.sent.clear()
    desk.sender.finish()
    assert desk.sent == [("/horn", OFF)]


async def test_a_node_of_the_robot_that_begins_to_publish_ends_the_sending_over_any_link(desk: Desk) -> None:
    desk.sender.on_lost()
    desk.sender.on_connected()
    await desk.turn()
    assert desk.news[-1] == SignalNews("/horn"), "its own bridge is no node of the robot"
    desk.sender.on_lost()
    desk.publishers["/horn"].append("/disc")
    desk.sender.on_connected()
    await desk.turn()
    assert desk.news[-1].problem == "The robot itself publishes /horn: nothing else is sent there."
    desk.sender.say("/horn", ON)
    assert await desk.wait(1.0) == []


def test_stop_lets_switches_and_buttons_go_before_anything_of_it_is_sent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # a link that is lost lets go too, and this one finds nobody
    monkeypatch.setattr(SignalSender, "on_lost", lambda _: None)
    operator = Operator("ws://127.0.0.1:9", tmp_path, wants_control=True)
    try:
        signals = operator.link.signals
        signals.say("/lamp", ON)
        signals.hold("/horn", ON, OFF)
        assert signals.slot.busy
        operator.link.stop()
        assert not signals.slot.busy
        signals.hold("/horn", ON, OFF)
        assert not signals.slot.busy, "the same finger holds nothing after STOP"
    finally:
        operator.close()
