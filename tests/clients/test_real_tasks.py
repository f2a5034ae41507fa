"""Tasks as the real robot side offers them, `/task/run`, and programs on roslibpy and roslib that ask for them."""

from __future__ import annotations

from contextlib import asynccontextmanager

from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from robotside.core.pose2 import ORIGIN
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


async def refusal(client, library):
    """The sentence of a goal that was refused."""
    told = (await client.event("failed"))["msg"]
    return str(told["values"] if library == "roslibpy" else told)


@BOTH
async def test_a_task_tells_how_far_it_is_and_its_end(tmp_path, library):
    async with robot(tmp_path, NEAR) as (serves, _), peer(library, serves.server.port) as client:
        await client.do("goal", **TASK, args={"task": "patrol", "client_name": "script"})
        told = (await client.event("result"))["msg"]
        result = told["values"] if library == "roslibpy" else told
        assert library == "roslib" or told["status"] == SUCCEEDED
        assert (result["state"], result["message"]) == ("SUCCEEDED", "Patrol done: 1 point visited.")
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
        assert serves.station.autonomy.engine.status.reason == "Canceled by script."
        assert serves.station.robot._robot.at_rest


@BOTH
async def test_a_task_is_refused_while_stop_is_pressed(tmp_path, library):
    async with robot(tmp_path, NEAR) as (serves, _), peer(library, serves.server.port) as client:
        serves.station.stop.press("Anna")
        await client.do("goal", **TASK, args={"task": "patrol"})
        assert "STOP is pressed; hold Release to drive again." in await refusal(client, library)
        assert serves.station.robot._robot.at_rest


async def test_a_second_task_is_refused_and_the_first_goes_on(tmp_path):
    async with robot(tmp_path, FAR) as (serves, _), both(serves.server.port) as (python, script):
        await python.do("goal", **TASK, args={"task": "patrol", "client_name": "first"})
        await python.event("feedback")
        await script.do("goal", **TASK, args={"task": "patrol", "client_name": "second"})
        assert "A task is running already; stop it first." in await refusal(script, "roslib")
        await python.do("goal", **TASK, args={"task": "patrol", "client_name": "first"})
        assert "A task is running already; stop it first." in await refusal(python, "roslibpy")
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
        assert "Canceled by" in await refusal(client, library)


@BOTH
async def test_a_task_ends_with_the_program_that_asked_for_it(tmp_path, library):
    async with robot(tmp_path, FAR) as (serves, states):
        async with peer(library, serves.server.port) as client:
            await client.do("goal", **TASK, args={"task": "patrol", "client_name": "script"})
            await client.event("feedback")
        await states.until(lambda seen: "CANCELED" in seen)
        assert serves.station.autonomy.engine.status.reason == "Canceled: script, who started it, is gone."
        assert serves.station.robot._robot.at_rest
