"""Services and actions that clients offer to each other, and the robot's own actions: real sockets, plain JSON."""

from __future__ import annotations

import asyncio
from contextlib import asynccontextmanager

import pytest

from bridge.core.compat import Compat
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Action
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from bridge.msgs.std_msgs import String
from bridge.server import client_services
from tests.bridge.peers import peer
from tests.bridge.wires import Record, server

ADD = {"service": "/add", "type": "my_srvs/Add"}
COUNT = {"action": "/count", "type": "my_msgs/Count"}


@asynccontextmanager
async def pair(**options):
    """A server with somebody who answers `/add` and somebody who calls it."""
    async with server(**options) as robot, peer(robot) as provider, peer(robot) as caller:
        await provider.say(op="advertise_service", **ADD)
        await provider.say(op="advertise_action", **COUNT)
        await provider.settled()
        yield provider, caller


async def test_a_call_reaches_the_client_that_answers_and_its_answer_the_caller():
    async with pair() as (provider, caller):
        await caller.say(op="call_service", service="add", id="c1", args={"a": 1, "b": 2})
        call = await provider.hear()
        assert (call["op"], call["service"], call["args"]) == ("call_service", "/add", {"a": 1, "b": 2})
        assert call["id"] == "service_request:/add:1"
        await provider.say(
            op="service_response", id=call["id"], service="/add", values={"sum": 3}, result=True
        )
        assert await caller.hear() == {
            "op": "service_response",
            "service": "add",
            "id": "c1",
            "values": {"sum": 3},
            "result": True,
        }


@pytest.mark.parametrize(("compat", "result"), [(Compat(), True), (Compat.strict(), False)])
async def test_a_providers_refusal_comes_as_todays_clients_expect_it(compat, result):
    async with pair(compat=compat) as (provider, caller):
        await caller.say(op="call_service", service="/add", id="c")
        call = await provider.hear()
        await provider.say(
            op="service_response", id=call["id"], service="/add", values={"sum": 0}, result=False
        )
        answer = await caller.hear()
        assert (answer["values"], answer["result"]) == ({"sum": 0}, result)


async def test_who_waits_for_a_client_that_leaves_is_told():
    async with pair() as (provider, caller):
        await caller.say(op="call_service", service="/add", id="c")
        await provider.hear()
        provider.ws.transport.abort()
        answer = await caller.hear()
        assert (answer["id"], answer["result"]) == ("c", False)
        assert "gone" in answer["values"]
        answer = await caller.call("/add")
        assert answer["values"] == 'This robot has no service "/add".'


async def test_who_waits_too_long_is_told_and_the_late_answer_is_nobodys():
    async with pair() as (provider, caller):
        await caller.say(op="call_service", service="/add", id="c", timeout=0.02)
        call = await provider.hear()
        assert (await caller.hear())["values"] == "/add gave no answer within 0.02 s."
        await provider.say(op="service_response", id=call["id"], service="/add", values={}, result=True)
        await provider.settled()
        await caller.settled()


async def test_an_answer_counts_once_and_from_the_one_who_was_asked():
    async with pair() as (provider, caller):
        await caller.say(op="call_service", service="/add", id="c")
        call = await provider.hear()
        forged = {"op": "service_response", "id": call["id"], "service": "/add", "result": True}
        await caller.say(**forged, values={"sum": 666})
        await caller.settled()
        for number in (3, 4):
            await provider.say(**forged, values={"sum": number})
        assert (await caller.hear())["values"] == {"sum": 3}
        await caller.settled()


async def test_a_caller_that_left_is_forgotten():
    async with pair() as (provider, caller):
        await caller.say(op="call_service", service="/add", id="c")
        call = await provider.hear()
        caller.ws.transport.abort()
        await provider.say(op="service_response", id=call["id"], service="/add", values={}, result=True)
        await provider.settled()


async def test_the_newest_provider_answers():
    async with server() as robot, peer(robot) as old, peer(robot) as new:
        for each in (old, new):
            await each.say(op="advertise_service", **ADD)
            await each.settled()
        await old.say(op="call_service", service="/add", id="c")
        assert (await new.hear())["service"] == "/add"
        await old.say(op="unadvertise_service", service="/add")
        await old.settled()
        assert "/add" in (await old.call("/rosapi/services"))["values"]["services"]


@pytest.mark.parametrize("service", ["/stop", "stop", "/rosapi/topics"])
async def test_nobody_takes_the_robots_own_services(service):
    async with server() as robot, peer(robot) as thief, peer(robot) as caller:
        await thief.say(op="advertise_service", service=service, type="pilothouse_msgs/Command")
        await thief.settled()
        assert (await caller.call("/stop"))["values"]["success"] is True
        providers = await caller.call("/rosapi/nodes")
        details = [
            await caller.call("/rosapi/node_details", args={"node": node})
            for node in providers["values"]["nodes"]
        ]
        offered = [
            each["values"]["services"] for each in details if "/stop" not in each["values"]["services"]
        ]
        assert offered == [[], []]


async def test_types_of_what_clients_offer_are_told():
    async with pair() as (_, caller):
        for ask, args, answer in (
            ("service_type", {"service": "/add"}, {"type": "my_srvs/Add"}),
            ("services_for_type", {"type": "my_srvs/Add"}, {"services": ["/add"]}),
            ("action_servers", {}, {"action_servers": ["/count"]}),
        ):
            assert (await caller.call(f"/rosapi/{ask}", args=args))["values"] == answer


async def test_a_goal_goes_to_the_client_that_carries_it_out_with_feedback_and_result():
    async with pair() as (provider, caller):
        await caller.say(
            op="send_action_goal", id="g1", action="/count", action_type="x/Y", args={"to": 3}, feedback=True
        )
        goal = await provider.hear()
        assert (goal["op"], goal["id"], goal["args"]) == (
            "send_action_goal",
            "action_goal:/count:1",
            {"to": 3},
        )
        about = {"id": goal["id"], "action": "/count"}
        await provider.say(op="action_feedback", values={"at": 1}, **about)
        assert await caller.hear() == {
            "op": "action_feedback",
            "id": "g1",
            "action": "/count",
            "values": {"at": 1},
        }
        await provider.say(op="action_result", values={"done": 3}, status=4, result=True, **about)
        result = await caller.hear()
        assert (result["op"], result["id"], result["values"]) == ("action_result", "g1", {"done": 3})
        assert (result["status"], result["result"]) == (4, True)


async def test_feedback_goes_only_to_who_asked_for_it():
    async with pair() as (provider, caller):
        await caller.say(op="send_action_goal", id="g", action="/count")
        goal = await provider.hear()
        assert not goal.get("feedback")
        await provider.say(op="action_feedback", id=goal["id"], action="/count", values={})
        await provider.settled()
        await caller.settled()


async def test_a_goal_can_be_taken_back():
    async with pair() as (provider, caller):
        await caller.say(op="send_action_goal", id="g", action="/count")
        goal = await provider.hear()
        await caller.say(op="cancel_action_goal", id="g", action="/count")
        assert await provider.hear() == {"op": "cancel_action_goal", "id": goal["id"], "action": "/count"}
        await provider.say(
            op="action_result", id=goal["id"], action="/count", values={}, status=5, result=True
        )
        assert (await caller.hear())["status"] == 5


async def test_whose_goal_a_client_leaves_behind_is_told_and_a_caller_that_leaves_takes_its_goals_back():
    async with pair() as (provider, caller):
        await caller.say(op="send_action_goal", id="g", action="/count")
        await provider.hear()
        provider.ws.transport.abort()
        result = await caller.hear()
        assert (result["result"], result["id"]) == (False, "g")
    async with pair() as (provider, caller):
        await caller.say(op="send_action_goal", id="g", action="/count")
        await provider.hear()
        caller.ws.transport.abort()
        assert (await provider.hear())["op"] == "cancel_action_goal"


async def test_a_goal_for_nobody_fails_at_once():
    async with server() as robot, peer(robot) as caller:
        await caller.say(op="send_action_goal", id="g", action="/dance")
        result = await caller.hear()
        assert (result["result"], result["values"]) == (False, 'This robot has no action "/dance".')


def action(start):
    return Action("/tell", "pilothouse_msgs/Tell", CommandRequest, CommandResponse, String, start)


async def test_the_robots_own_action_tells_how_it_goes_and_what_became_of_it():
    async def start(session, goal, tell):
        tell(String("half-way"))
        await asyncio.sleep(0)
        return CommandResponse(success=True, message=goal.command_id)

    async with server(actions=[action(start)]) as robot, peer(robot) as caller:
        await caller.say(op="send_action_goal", id=7, action="tell", args={"command_id": "c"}, feedback=True)
        heard = [await caller.hear(), await caller.hear()]
        assert [each["op"] for each in heard] == ["action_feedback", "action_result"]
        assert heard[0]["values"] == {"data": "half-way"}
        assert (heard[1]["values"]["message"], heard[1]["status"], heard[1]["id"]) == ("c", 4, 7)
        await caller.say(op="send_action_goal", id=7, action="tell")
        assert (await caller.hear())["op"] == "action_result"


async def endless(session, goal, tell):
    await asyncio.Event().wait()


async def test_the_robots_own_action_is_cancelled_by_who_asked_for_it():
    async with server(actions=[action(endless)]) as robot, peer(robot) as caller:
        await caller.say(op="send_action_goal", id="g", action="/tell")
        await caller.say(op="cancel_action_goal", id="g", action="/tell")
        result = await caller.hear()
        assert (result["status"], result["result"]) == (5, True)


async def test_the_robots_own_action_ends_when_its_caller_vanishes():
    begun, ended = Record(), Record()

    async def start(session, goal, tell):
        begun(session)
        try:
            await asyncio.Event().wait()
        finally:
            ended(session)

    async with server(actions=[action(start)]) as robot, peer(robot) as caller:
        await caller.say(op="send_action_goal", id="g", action="/tell")
        await begun.reach(1)
        caller.ws.transport.abort()
        await ended.reach(1)


async def refuse(session, goal, tell):
    raise Refused("The battery is too low.")


async def fail(session, goal, tell):
    raise ZeroDivisionError


@pytest.mark.parametrize(
    ("start", "reason"),
    [
        (refuse, "The battery is too low."),
        (fail, "The robot failed at /tell; its log says why."),
    ],
)
async def test_what_goes_wrong_is_told_as_the_result(start, reason, caplog):
    async with server(actions=[action(start)]) as robot, peer(robot) as caller:
        await caller.say(op="send_action_goal", id="g", action="/tell")
        result = await caller.hear()
        assert (result["values"], result["result"], result["status"]) == (reason, False, 0)
    assert ("ZeroDivisionError" in caplog.text) == (start is fail)


async def test_a_result_that_cannot_be_written_ends_the_goal_all_the_same():
    async def start(session, goal, tell):
        return CommandResponse(success=True, message=object())

    async with server(actions=[action(start)]) as robot, peer(robot) as caller:
        await caller.say(op="send_action_goal", id="g", action="/tell")
        result = await caller.hear()
        assert result["result"] is False
        assert result["values"].startswith("pilothouse_msgs/CommandResponse cannot be sent: ")


async def test_a_goal_that_does_not_fit_is_refused_with_the_field():
    async with server(actions=[action(endless)]) as robot, peer(robot) as caller:
        await caller.say(op="send_action_goal", id="g", action="/tell", args={"valid_for": "long"})
        assert (await caller.hear())["values"] == 'valid_for must be a number or null, not "long".'


DEEP = []
for _ in range(150):
    DEEP = [DEEP]


async def test_what_is_nested_too_deeply_is_not_passed_on_to_others():
    async with pair() as (provider, caller):
        await caller.say(op="call_service", service="/add", id="c", args={"a": DEEP})
        assert (await caller.hear())["values"] == "args are nested too deeply."
        await caller.say(op="call_service", service="/add", id="d")
        call = await provider.hear()
        answer = {"op": "service_response", "id": call["id"], "service": "/add", "result": True}
        await provider.say(**answer, values={"sum": DEEP})
        assert (await caller.hear())["values"] == 'The answer of "/add" is nested too deeply.'
        await caller.say(op="send_action_goal", id="g", action="/count", args={"to": DEEP})
        assert (await caller.hear())["values"] == "The goal is nested too deeply."
        await provider.settled()


async def test_who_reads_gets_all_its_refusals_when_who_should_answer_is_gone(monkeypatch):
    monkeypatch.setattr(client_services, "MAX_CALLS", 600)
    async with pair() as (provider, caller):
        for number in range(601):
            await caller.say(op="call_service", service="/add", id=number)
        refused = await caller.hear()
        assert (refused["id"], refused["result"]) == (600, False)
        assert "600 calls of this client wait for their answer already" in refused["values"]
        for _ in range(600):
            await provider.hear()
        provider.ws.transport.abort()
        answers = [await caller.hear() for _ in range(600)]
    assert [answer["id"] for answer in answers] == list(range(600))
    assert {answer["values"] for answer in answers} == {'The client that answers "/add" is gone.'}


@pytest.mark.parametrize(
    "op",
    [
        {"op": "advertise_service", "service": "/stop/", "type": "x/Y"},
        {"op": "advertise_service", "service": "//stop", "type": "x/Y"},
        {"op": "advertise_action", "action": "/task//run", "type": "x/Y"},
        {"op": "advertise", "topic": "/cmd_vel/", "type": "geometry_msgs/Twist"},
        {"op": "advertise", "topic": "/odom//pose", "type": "geometry_msgs/Pose"},
    ],
)
async def test_nobody_offers_what_only_looks_like_the_robots_own(op):
    async with server() as robot, peer(robot) as provider, peer(robot) as caller:
        await provider.say(op="set_level", level="error")
        await provider.say(**op)
        remark = await provider.hear()
        assert (remark["op"], remark["level"]) == ("status", "error")
        assert "without empty parts" in remark["msg"]
        services = (await caller.call("/rosapi/services"))["values"]["services"]
        assert not [name for name in services if name.endswith("/") or "//" in name]
