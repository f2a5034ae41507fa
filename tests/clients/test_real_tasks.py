"""Tasks as the real robot side offers them, `/task/run`, and programs on roslibpy and roslib that ask for them."""

from __future__ import annotations

from contextlib import asynccontextmanager

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from robotside.control.command_gate import STOP_SENTENCE
from robotside.core.pose2 import ORIGIN
from robotside.core.refusal import Refusal
from robotside.services.preconditions import Preconditions
from tests.bridge.wires import Record
from tests.clients.peers import BOTH, both, peer
from tests.clients.test_actions import CANCELED, SUCCEEDED
from tests.fakes import FakeRobot
from tests.robotside.serving.test_station_server import serving

TASK = {"name": "/task/run", "type": "pilothouse_msgs/action/RunTask"}
FAR, NEAR = Waypoint(6.0, 0.0), Waypoint(0.4, 0.0)


@asynccontextmanager
async def robot(state, *points):
    """A robot side that knows where it is and has a mission; its task's states are recorded."""
    async with serving(state, FakeRobot()) as serves:
        station, states = serves.station, Record()
        station.autonomy.place(ORIGIN)
        station.missions.store(Mission(waypoints=list(points), laps=1))
        station.bus.subscribe("/task/status", lambda _, msg: states(msg.state))
        yield serves, states


async def reason(client, library):
    """Why a goal failed, in a sentence."""
    told = (await client.event("failed"))["msg"]
    return str(told["values"] if library == "roslibpy" else told)


@BOTH
async def test_a_task_tells_how_far_it_is_and_its_end(tmp_path, library):
    async with robot(tmp_path, NEAR) as (serves, _), peer(library, serves.server.port) as client:
        await client.do("goal", **TASK, args={"task": "patrol", "client_name": "script"})
        told = (await client.event("result"))["msg"]
        result = told["values"] if library == "roslibpy" else told
        assert library == "roslib" or told["status"] == SUCCEEDED
        assert (result["state"], result["visited"]) == ("SUCCEEDED", 1)
        assert result["message"] == serves.station.autonomy.engine.status.reason
        assert 0.0 <= client.of("feedback")[0]["msg"]["distance_driven"] < 0.4


@BOTH
async def test_a_task_that_is_taken_back_leaves_the_robot_at_rest(tmp_path, library):
    async with robot(tmp_path, FAR) as (serves, states), peer(library, serves.server.port) as client:
        goal = await client.do("goal", **TASK, args={"task": "patrol", "client_name": "script"})
        await client.event("feedback")
        await client.do("cancel", **TASK, id=goal["id"])
        told = await client.event("result" if library == "roslibpy" else "failed")
        assert library == "roslib" or told["msg"]["status"] == CANCELED
        await states.until(lambda seen: "CANCELED" in seen)
        assert serves.station.autonomy.engine.status.code == Code.TASK_CANCELED
        assert serves.station.robot._robot.at_rest


@BOTH
async def test_a_task_is_refused_while_stop_is_pressed(tmp_path, library):
    async with robot(tmp_path, NEAR) as (serves, _), peer(library, serves.server.port) as client:
        serves.station.stop.press("Anna")
        await client.do("goal", **TASK, args={"task": "patrol"})
        assert STOP_SENTENCE in await reason(client, library)
        assert serves.station.robot._robot.at_rest


async def test_a_second_task_is_refused_and_the_first_goes_on(tmp_path):
    async with robot(tmp_path, FAR) as (serves, _), both(serves.server.port) as (python, script):
        await python.do("goal", **TASK, args={"task": "patrol", "client_name": "first"})
        await python.event("feedback")
        with pytest.raises(Refusal) as active:
            Preconditions(serves.station).idle()
        assert active.value.notice.code == Code.TASK_ACTIVE
        await script.do("goal", **TASK, args={"task": "patrol", "client_name": "second"})
        assert active.value.notice in await reason(script, "roslib")
        await python.do("goal", **TASK, args={"task": "patrol", "client_name": "first"})
        assert active.value.notice in await reason(python, "roslibpy")
        assert serves.station.autonomy.engine.running


@BOTH
async def test_stop_pauses_a_task_and_its_program_still_waits(tmp_path, library):
    async with robot(tmp_path, FAR) as (serves, states), peer(library, serves.server.port) as client:
        await client.do("goal", **TASK, args={"task": "patrol"})
        await client.event("feedback")
        await client.do("call", name="/stop", type="std_srvs/Trigger")
        await states.until(lambda seen: "PAUSED" in seen)
        assert client.of("result") + client.of("failed") == []
        await client.do("call", name="/task/cancel", type="std_srvs/Trigger")
        assert await reason(client, library)
        assert states[-1] == "CANCELED"


@BOTH
async def test_a_task_ends_with_the_program_that_asked_for_it(tmp_path, library):
    async with robot(tmp_path, FAR) as (serves, states):
        async with peer(library, serves.server.port, leaves=True) as client:
            await client.do("goal", **TASK, args={"task": "patrol", "client_name": "script"})
            await client.event("feedback")
        await states.until(lambda seen: "CANCELED" in seen)
        assert serves.station.autonomy.engine.status.code == Code.TASK_ASKER_GONE
        assert serves.station.robot._robot.at_rest
