"""Goals of one client: real sockets, plain JSON."""

from __future__ import annotations

import asyncio

from bridge.core.robot_catalogue import Action
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from bridge.msgs.std_msgs import String
from bridge.protocol.server_session import MAX_GOALS
from tests.bridge.peers import peer
from tests.bridge.wires import Record, server


async def test_a_goal_too_many_and_one_whose_id_is_taken_are_not_begun():
    begun = Record()

    async def endless(session, goal, tell):
        begun(goal.command_id)
        await asyncio.Event().wait()

    tell = Action("/tell", "pilothouse_msgs/Tell", CommandRequest, CommandResponse, String, endless)
    async with server(actions=[tell]) as robot, peer(robot) as foreign:
        await foreign.say(op="set_level", level="error")
        ids = [0, *range(MAX_GOALS + 1)]
        for number, id in enumerate(ids):
            args = {"command_id": str(number)}
            await foreign.say(op="send_action_goal", action="/tell", id=id, args=args)
        told = [await foreign.hear() for _ in range(2)]
        await foreign.settled()
    assert [(each["op"], each["id"]) for each in told] == [("status", 0), ("status", MAX_GOALS)]
    assert "under way already" in told[0]["msg"]
    assert "at most 100 goals" in told[1]["msg"]
    assert begun == [str(number) for number, id in enumerate(ids) if number != 1][:MAX_GOALS]
