"""Clients that work for each other over a server: services, actions, learned types."""

from __future__ import annotations

import asyncio
from contextlib import asynccontextmanager
from typing import ClassVar

import pytest

from bridge.client.client import Phase
from bridge.core.errors import NoReply, NotConnected, ProtocolError, Refused
from bridge.core.robot_catalogue import Action
from bridge.msgs import Msg
from bridge.msgs.std_srvs import SetBoolRequest, SetBoolResponse, TriggerResponse
from tests.bridge.client.foreign_server import foreign
from tests.bridge.wires import Record, link, server, url, wire


class CountGoal(Msg, frozen=True, gc=False):
    """How far to count."""

    MSGTYPE: ClassVar[str] = "test_msgs/CountGoal"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32",)
    upto: int = 0


class CountFeedback(Msg, frozen=True, gc=False):
    """How far it has come."""

    MSGTYPE: ClassVar[str] = "test_msgs/CountFeedback"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32",)
    at: int = 0


class CountResult(Msg, frozen=True, gc=False):
    """The numbers."""

    MSGTYPE: ClassVar[str] = "test_msgs/CountResult"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32[]",)
    numbers: list[int] = []


COUNT = {"result": CountResult, "feedback": CountFeedback}


class Counter:
    """Counts when it is let, as an action."""

    def __init__(self) -> None:
        self.begun, self.cancelled, self.go = Record(), Record(), asyncio.Event()

    async def run(self, goal, tell):
        self.begun(goal)
        if goal.upto < 0:
            raise Refused("It cannot count backwards.")
        tell(CountFeedback(0))
        try:
            await self.go.wait()
        except asyncio.CancelledError:
            self.cancelled(goal)
            raise
        return CountResult(list(range(goal.upto)))


@asynccontextmanager
async def two(**options):
    """A server and two clients on it."""
    async with server(**options) as robot, link(url(robot)) as one, link(url(robot)) as other:
        yield await one.connected(), await other.connected()


async def settled(client):
    """The server has heard everything that was sent before."""
    await client.call("/rosapi/get_time", None, CountGoal)


def flip(request):
    if request.data:
        raise Refused("It is on already.")
    return SetBoolResponse(True, "on")


async def test_a_client_answers_calls_of_its_service():
    async with two() as (one, other):
        one.serve("/light", "std_srvs/SetBool", flip)
        await settled(one)
        assert await other.call("/light", SetBoolRequest(False), SetBoolResponse) == SetBoolResponse(
            True, "on"
        )


async def test_a_service_that_takes_its_time_may_be_a_coroutine():
    async def later(request):
        await asyncio.sleep(0)
        return TriggerResponse(True, "later")

    async with two() as (one, other):
        one.serve("/light", "std_srvs/srv/Trigger", later)
        await settled(one)
        assert (await other.call("/light", None, TriggerResponse)).message == "later"


async def test_a_refusal_reaches_the_caller_in_the_providers_words():
    async with two() as (one, other):
        one.serve("/light", "std_srvs/SetBool", flip)
        await settled(one)
        with pytest.raises(Refused, match="^It is on already.$"):
            await other.call("/light", SetBoolRequest(True), SetBoolResponse)


async def test_a_fault_in_a_service_is_logged_here_and_a_refusal_there(caplog):
    def broken(request):
        raise ZeroDivisionError

    async with two() as (one, other):
        one.serve("/light", "std_srvs/Trigger", broken)
        await settled(one)
        with pytest.raises(Refused, match="^/light failed.$"):
            await other.call("/light", None, TriggerResponse)
    assert "ZeroDivisionError" in caplog.text


async def test_a_service_that_is_no_longer_served_is_gone():
    async with two() as (one, other):
        end = one.serve("/light", "std_srvs/Trigger", lambda _: TriggerResponse())
        end()
        end()
        await settled(one)
        with pytest.raises(Refused, match="/light"):
            await other.call("/light", None, TriggerResponse)


async def test_types_that_nobody_knows_are_named():
    async with server() as robot, link(url(robot)) as made:
        client = await made.connected()
        with pytest.raises(ProtocolError, match="^no_msgs/ThingRequest is no known type.$"):
            client.serve("/thing", "no_msgs/Thing", flip)
        with pytest.raises(ProtocolError, match="^no_msgs/ThingGoal is no known type.$"):
            client.provide_action("/thing", "no_msgs/Thing", Counter().run)
        with pytest.raises(ProtocolError, match="^test_msgs/CountResult is no known type.$"):
            client.goal("/count", CountGoal())
        with pytest.raises(ProtocolError, match="^std_srvs/SetBoolRequest is not the goal of an action.$"):
            client.goal("/count", SetBoolRequest())


async def test_services_and_actions_are_offered_again_after_a_cut():
    counter = Counter()
    counter.go.set()
    async with (
        server() as robot,
        wire(robot.port) as cable,
        link(url(cable)) as made,
        link(url(robot)) as far,
    ):
        one, other = await made.connected(), await far.connected()
        one.serve("/light", "std_srvs/SetBool", flip)
        one.provide_action("/count", "test_msgs/Count", counter.run, goal=CountGoal)
        cable.cut()
        await made.sentence(Phase.WAITING)
        await made.connected()
        await settled(one)
        assert (await other.call("/light", SetBoolRequest(), SetBoolResponse)).success
        assert (await other.goal("/count", CountGoal(2), **COUNT).result(5.0)).numbers == [0, 1]


async def test_a_goal_tells_how_it_goes_and_what_came_of_it():
    counter, feedback = Counter(), Record()
    async with two() as (one, other):
        one.provide_action("/count", "test_msgs/Count", counter.run, goal=CountGoal)
        await settled(one)
        goal = other.goal("/count", CountGoal(3), on_feedback=feedback, **COUNT)
        assert (await feedback.reach(1)) == [CountFeedback(0)]
        assert (goal.done, goal.status) == (False, 2)
        with pytest.raises(NoReply, match="did not finish /count within 0.01 s"):
            await goal.result(0.01)
        counter.go.set()
        assert await goal.result(5.0) == CountResult([0, 1, 2])
        assert (goal.done, goal.status, goal.cancel()) == (True, 4, False)


async def test_a_goal_that_is_taken_back_ends_the_work():
    counter = Counter()
    async with two() as (one, other):
        one.provide_action("/count", "test_msgs/Count", counter.run, goal=CountGoal)
        await settled(one)
        goal = other.goal("/count", CountGoal(3), **COUNT)
        await counter.begun.reach(1)
        assert goal.cancel()
        with pytest.raises(Refused, match="^/count was cancelled.$"):
            await goal.result(5.0)
        assert goal.status == 5
        await counter.cancelled.reach(1)


async def test_a_goal_that_is_refused_says_why():
    async with two() as (one, other):
        one.provide_action("/count", "test_msgs/Count", Counter().run, goal=CountGoal)
        await settled(one)
        with pytest.raises(Refused, match="^It cannot count backwards.$"):
            await other.goal("/count", CountGoal(-1), **COUNT).result(5.0)
        with pytest.raises(Refused, match="/fly"):
            await other.goal("/fly", CountGoal(), **COUNT).result(5.0)


async def test_a_goal_of_the_robots_own():
    async def start(session, goal, tell):
        tell(CountFeedback(1))
        return CountResult([goal.upto])

    feedback = Record()
    action = Action("/count", "test_msgs/Count", CountGoal, CountResult, CountFeedback, start)
    async with server(actions=[action]) as robot, link(url(robot)) as made:
        client = await made.connected()
        goal = client.goal("/count", CountGoal(7), on_feedback=feedback, **COUNT)
        assert await goal.result(5.0) == CountResult([7])
        assert feedback == [CountFeedback(1)]


async def test_a_cut_ends_what_was_asked_and_what_was_being_done_for_others():
    counter = Counter()
    async with server() as robot, wire(robot.port) as cable, link(url(cable)) as made:
        client = await made.connected()
        client.provide_action("/count", "test_msgs/Count", counter.run, goal=CountGoal)
        goal = client.goal("/count", CountGoal(3), **COUNT)
        await counter.begun.reach(1)
        cable.cut()
        with pytest.raises(NotConnected, match="The connection was cut before /count was finished"):
            await goal.result(5.0)
        assert goal.status == 0
        await counter.cancelled.reach(1)


async def test_a_cut_ends_the_calls_that_were_being_answered():
    begun, ended = Record(), Record()

    async def slow(request):
        begun(request)
        try:
            await asyncio.Event().wait()
        finally:
            ended(request)

    async with (
        server() as robot,
        wire(robot.port) as cable,
        link(url(cable)) as made,
        link(url(robot)) as asking,
    ):
        client = await made.connected()
        client.serve("/slow", "std_srvs/SetBool", slow)
        await settled(client)
        caller = await asking.connected()
        waiting = asyncio.create_task(caller.call("/slow", SetBoolRequest(), SetBoolResponse, timeout=5.0))
        await begun.reach(1)
        cable.cut()
        await ended.reach(1)
        with pytest.raises(Refused, match="gone"):
            await waiting


async def test_without_a_connection_there_is_no_goal_and_none_is_sent_later():
    counter = Counter()
    async with server() as robot, link(url(robot)) as far, link("ws://127.0.0.1:1") as made:
        (await far.connected()).provide_action("/count", "test_msgs/Count", counter.run, goal=CountGoal)
        with pytest.raises(NotConnected, match="There is no connection to 127.0.0.1:1"):
            made.client.goal("/count", CountGoal(), **COUNT)
    assert counter.begun == []


async def test_feedback_that_does_not_fit_and_a_fault_in_who_hears_it_cost_nothing(caplog):
    async def start(session, goal, tell):
        tell(CountResult([1]))
        tell(CountFeedback(1))
        return CountResult()

    def broken(_):
        raise ZeroDivisionError

    class Wrong(Msg, frozen=True, gc=False):
        MSGTYPE: ClassVar[str] = "test_msgs/Wrong"
        numbers: int = 0

    action = Action("/count", "test_msgs/Count", CountGoal, CountResult, CountFeedback, start)
    async with server(actions=[action]) as robot, link(url(robot)) as made:
        client = await made.connected()
        goal = client.goal("/count", CountGoal(), on_feedback=broken, result=CountResult, feedback=Wrong)
        assert await goal.result(5.0) == CountResult()
    assert "Feedback of /count is left out: numbers must be a whole number" in caplog.text
    assert "ZeroDivisionError" in caplog.text


async def test_a_type_never_seen_is_learned_from_a_foreign_server_and_read():
    heard = Record()
    async with foreign(2) as robot, link(f"ws://127.0.0.1:{robot.port}") as made:
        client = await made.connected()
        kind = await client.learn("acme_msgs/msg/Gripper")
        assert kind.MSGTYPE == "acme_msgs/Gripper"
        assert await client.learn("acme_msgs/Gripper") is kind
        client.subscribe("/gripper", kind, heard)
        (first, _), *_ = await heard.reach(1)
        assert isinstance(first, kind)


async def test_a_type_that_is_known_is_not_asked_for():
    async with link("ws://127.0.0.1:1") as made:
        assert await made.client.learn("std_srvs/srv/SetBoolRequest") is SetBoolRequest
        with pytest.raises(NotConnected):
            await made.client.learn("acme_msgs/Gripper")


async def test_a_type_that_the_robot_does_not_know_either_is_named():
    async with server() as robot, link(url(robot)) as made:
        client = await made.connected()
        with pytest.raises((ProtocolError, Refused), match="no_msgs/Thing"):
            await client.learn("no_msgs/Thing")
