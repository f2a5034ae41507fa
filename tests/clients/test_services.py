"""Services as programs on roslibpy and roslib call and offer them."""

from __future__ import annotations

import pytest

from bridge.core.compat import Compat
from tests.bridge.wires import server
from tests.clients.peers import BOTH, both, peer

STOP = {"name": "/stop", "type": "pilothouse_msgs/Command"}
DOOR = {"name": "/door/open", "type": "std_srvs/SetBool"}
PAIRS = pytest.mark.parametrize(
    ("provider", "caller"), [(0, 1), (1, 0)], ids=["Python serves", "JavaScript serves"]
)


@BOTH
async def test_the_robots_own_services_answer(library):
    async with server() as robot, peer(library, robot.port) as client:
        answer = await client.do("call", **STOP, args={"command_id": "c1"})
        told = {"success": True, "message": "Accepted c1.", "code": "", "actor_id": "", "parameters": []}
        assert answer == {"values": told}
        assert (await client.do("call", name="/stop", type="std_srvs/Trigger"))["values"]["success"]


@BOTH
async def test_what_there_is_not_is_refused_with_a_reason(library):
    async with server() as robot, peer(library, robot.port) as client:
        assert "/dance" in (await client.do("call", name="/dance", type="std_srvs/Trigger"))["failed"]
        assert "command_id" in (await client.do("call", **STOP, args={"command_id": 7}))["failed"]


async def test_arguments_may_come_in_their_order_alone():
    async with server() as robot, peer("roslib", robot.port) as script:
        await script.do("hear", name="n")
        await script.do("say", op={"op": "call_service", "id": "n", "service": "/stop", "args": ["c9"]})
        assert (await script.event("heard", "n"))["msg"]["values"]["message"] == "Accepted c9."


@PAIRS
async def test_what_one_client_offers_the_other_calls(provider, caller):
    async with server() as robot, both(robot.port) as pair:
        await pair[provider].do("serve", **DOOR, values={"success": True, "message": "open"})
        await pair[provider].settled()
        answer = await pair[caller].do("call", **DOOR, args={"data": True})
        assert answer == {"values": {"success": True, "message": "open"}}
        assert (await pair[provider].event("request", "/door/open"))["msg"] == {"data": True}


@BOTH
async def test_a_client_may_call_what_it_offers_itself(library):
    async with server() as robot, peer(library, robot.port) as client:
        await client.do("serve", **DOOR, values={"success": True, "message": "self"})
        await client.settled()
        assert (await client.do("call", **DOOR, args={"data": False}))["values"]["message"] == "self"


async def test_a_refusal_with_values_reaches_the_caller_as_they_are():
    """Both of ROS's servers do so, and programs on roslibpy look into the values."""
    async with server() as robot, both(robot.port) as (python, script):
        await python.do("serve", **DOOR, values={"success": False, "message": "stuck"}, result=False)
        await python.settled()
        answer = await script.do("call", **DOOR, args={"data": True})
        assert answer == {"values": {"success": False, "message": "stuck"}}


async def test_a_refusal_is_one_where_that_was_asked_for():
    async with server(compat=Compat.strict()) as robot, both(robot.port) as (python, script):
        await python.do("serve", **DOOR, values={"success": False, "message": "stuck"}, result=False)
        await python.settled()
        assert "failed" in await script.do("call", **DOOR, args={"data": True})


@BOTH
async def test_a_refusal_without_values_is_told_all_the_same(library):
    """roslib sends none when its callback gives false; behind the ROS 1 server the caller waits for ever."""
    async with server() as robot, peer("roslib", robot.port) as script, peer(library, robot.port) as caller:
        await script.do("serve", **DOOR, values={}, result=False)
        await script.settled()
        assert await caller.do("call", **DOOR, args={"data": True})


@BOTH
async def test_a_provider_that_throws_tells_why(library):
    async with server() as robot, peer("roslib", robot.port) as script, peer(library, robot.port) as caller:
        await script.do("serve_and_throw", **DOOR, reason="no key")
        await script.settled()
        assert "no key" in (await caller.do("call", **DOOR, args={"data": True}))["failed"]


async def test_who_waits_for_a_provider_that_leaves_is_told():
    async with server() as robot, peer("roslib", robot.port) as waiting:
        async with peer("roslib", robot.port, leaves=True) as leaving:
            # it offers the service and never answers
            await leaving.do("hear", name="/door/open")
            await leaving.do(
                "say", op={"op": "advertise_service", "service": "/door/open", "type": DOOR["type"]}
            )
            await leaving.settled()
            await waiting.do("hear", name="w")
            await waiting.do("say", op={"op": "call_service", "id": "w", "service": "/door/open", "args": {}})
            await leaving.event("heard", "/door/open")
        assert (await waiting.event("heard", "w"))["msg"]["result"] is False
        assert "failed" in await waiting.do("call", **DOOR, args={"data": True})


@BOTH
async def test_what_is_no_longer_offered_is_refused(library):
    async with server() as robot, both(robot.port) as pair:
        client, other = pair if library == "roslibpy" else pair[::-1]
        await client.do("serve", **DOOR, values={"success": True, "message": ""})
        await client.settled()
        assert "values" in await other.do("call", **DOOR, args={"data": True})
        await client.do("unserve", **DOOR)
        await client.settled()
        assert "failed" in await other.do("call", **DOOR, args={"data": True})


@BOTH
async def test_the_robots_own_services_cannot_be_taken_over(library):
    async with server() as robot, both(robot.port) as pair:
        client, other = pair if library == "roslibpy" else pair[::-1]
        await client.do("serve", **STOP, values={"success": False, "message": "forged"})
        await client.settled()
        assert (await other.do("call", **STOP, args={"command_id": "c1"}))["values"][
            "message"
        ] == "Accepted c1."
