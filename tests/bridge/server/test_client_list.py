"""Who is connected, as rosbridge_server has it."""

from __future__ import annotations

import math

from tests.bridge.peers import peer
from tests.bridge.wires import server


async def test_a_subscriber_knows_who_is_connected_and_who_comes_and_goes():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/client_count", type="std_msgs/Int32")
        assert (await foreign.hear())["msg"] == {"data": 1}
        async with peer(robot):
            assert (await foreign.hear())["msg"] == {"data": 2}
        assert (await foreign.hear())["msg"] == {"data": 1}


async def test_each_client_is_listed_with_its_address_and_its_time():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/connected_clients", type="rosbridge_msgs/ConnectedClients")
        (client,) = (await foreign.hear())["msg"]["clients"]
        (operator,) = robot.operators
        assert client["ip_address"] == "127.0.0.1"
        assert client["connection_time"]["secs"] == int(operator.opened)


async def test_they_are_listed_and_reserved():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="set_level", level="error")
        await foreign.say(op="advertise", topic="/client_count", type="std_msgs/Int32")
        assert (await foreign.hear())["msg"] == "advertise: /client_count is this robot's own topic."
        await foreign.say(op="call_service", service="/rosapi/topics")
        assert {"/client_count", "/connected_clients"} <= set((await foreign.hear())["values"]["topics"])


async def test_who_came_while_the_robot_had_no_clock_is_listed_without_a_time():
    async with server(now=lambda: math.nan) as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/connected_clients", type="rosbridge_msgs/ConnectedClients")
        (client,) = (await foreign.hear())["msg"]["clients"]
        assert client["connection_time"] == {"secs": 0, "nsecs": 0}
