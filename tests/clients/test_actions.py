"""Actions as programs on roslib perform them and programs on roslibpy and roslib ask for them."""

from __future__ import annotations

import asyncio

from bridge.core.robot_catalogue import Action
from bridge.msgs import Msg
from tests.bridge.wires import server
from tests.clients.peers import BOTH, peer

DOCK = {"name": "/dock", "type": "acme_msgs/Dock"}
COUNT = {"name": "/count", "type": "acme_msgs/Count"}
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6


class CountGoal(Msg, frozen=True):
    """How far to count."""

    MSGTYPE = "acme_msgs/CountGoal"
    ROSTYPES = ("int32",)
    order: int = 0


class CountResult(Msg, frozen=True):
    """Where it ended."""

    MSGTYPE = "acme_msgs/CountResult"
    ROSTYPES = ("int32",)
    last: int = 0


class CountFeedback(Msg, frozen=True):
    """Where it is."""

    MSGTYPE = "acme_msgs/CountFeedback"
    ROSTYPES = ("int32",)
    now: int = 0


async def count(session, goal, tell):
    for number in range(goal.order):
        tell(CountFeedback(now=number))
        await asyncio.sleep(0)
    if goal.order < 0:
        await asyncio.Event().wait()
    return CountResult(last=goal.order)


COUNTING = Action("/count", "acme_msgs/Count", CountGoal, CountResult, CountFeedback, count)


async def outcome(client, library, kind, **expected):
    """The result or failure that a client was told of; the libraries show it in their own ways."""
    told = (await client.event(kind))["msg"]
    if library == "roslibpy":
        assert told["status"] == expected["status"]
        return told["values"]
    return told


@BOTH
async def test_the_robots_own_action_tells_how_far_it_is_and_its_result(library):
    async with server(actions=[COUNTING]) as robot, peer(library, robot.port) as client:
        await client.do("goal", **COUNT, args={"order": 3})
        assert await outcome(client, library, "result", status=SUCCEEDED) == {"last": 3}
        assert [told["msg"]["now"] for told in client.of("feedback")] == [0, 1, 2]


@BOTH
async def test_the_robots_own_action_can_be_given_up(library):
    async with server(actions=[COUNTING]) as robot, peer(library, robot.port) as client:
        goal = await client.do("goal", **COUNT, args={"order": -1})
        await client.do("cancel", **COUNT, id=goal["id"])
        # roslib calls everything failed that did not succeed
        await outcome(client, library, "result" if library == "roslibpy" else "failed", status=CANCELED)


@BOTH
async def test_an_action_that_there_is_not_is_refused(library):
    async with server() as robot, peer(library, robot.port) as client:
        await client.do("goal", **DOCK, args={"station": 1})
        assert "/dock" in str(await outcome(client, library, "failed", status=0))


@BOTH
async def test_what_one_client_performs_another_asks_for(library):
    async with (
        server() as robot,
        peer("roslib", robot.port) as performer,
        peer(library, robot.port) as client,
    ):
        await performer.do("perform", **DOCK)
        await performer.settled()
        await client.do("goal", **DOCK, args={"station": 7})
        asked = await performer.event("goal", "/dock")
        assert asked["msg"] == {"station": 7}
        assert asked["id"].startswith("action_goal:/dock:")
        await performer.do("feedback", **DOCK, id=asked["id"], values={"distance": 1.5})
        assert (await client.event("feedback"))["msg"] == {"distance": 1.5}
        await performer.do("succeed", **DOCK, id=asked["id"], values={"docked": True})
        assert await outcome(client, library, "result", status=SUCCEEDED) == {"docked": True}


@BOTH
async def test_who_performs_hears_that_it_is_to_stop_and_says_so(library):
    async with (
        server() as robot,
        peer("roslib", robot.port) as performer,
        peer(library, robot.port) as client,
    ):
        await performer.do("perform", **DOCK)
        await performer.settled()
        goal = await client.do("goal", **DOCK, args={"station": 7})
        asked = await performer.event("goal", "/dock")
        await client.do("cancel", **DOCK, id=goal["id"])
        await performer.event("cancel", "/dock")
        await performer.do("give_up", **DOCK, id=asked["id"], values={"docked": False})
        await outcome(client, library, "result" if library == "roslibpy" else "failed", status=CANCELED)


@BOTH
async def test_who_fails_is_told_to_have_failed(library):
    async with (
        server() as robot,
        peer("roslib", robot.port) as performer,
        peer(library, robot.port) as client,
    ):
        await performer.do("perform", **DOCK)
        await performer.settled()
        await client.do("goal", **DOCK, args={"station": 7})
        asked = await performer.event("goal", "/dock")
        await performer.do("fail", **DOCK, id=asked["id"])
        await outcome(client, library, "failed", status=ABORTED)


@BOTH
async def test_who_waits_for_a_performer_that_leaves_is_told(library):
    async with server() as robot, peer(library, robot.port) as client:
        async with peer("roslib", robot.port, leaves=True) as performer:
            await performer.do("perform", **DOCK)
            await performer.settled()
            await client.do("goal", **DOCK, args={"station": 7})
            await performer.event("goal", "/dock")
        assert await client.event("failed"), "that it is told so"


@BOTH
async def test_actions_are_listed(library):
    async with server(actions=[COUNTING]) as robot, peer(library, robot.port) as client:
        if library == "roslib":
            assert "/count" in await client.ask("getActionServers")
        else:
            await client.do("get_action_servers")
            assert "/count" in (await client.event("action_servers"))["msg"]["action_servers"]
