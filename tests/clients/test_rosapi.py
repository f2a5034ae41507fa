"""What programs on roslibpy and roslib ask about the robot, by every method that they have for it."""

from __future__ import annotations

from tests.bridge.wires import Clock, server
from tests.clients.peers import BOTH, both, peer


def names(library: str, method: str) -> str:
    """The same method as each library spells it."""
    first, *rest = method.split("_")
    return method if library == "roslibpy" else first + "".join(word.capitalize() for word in rest)


QUESTIONS = {
    "get_topic_type": (["/odom"], "nav_msgs/Odometry"),
    "get_topics_for_type": (["nav_msgs/Odometry"], "/odom"),
    "get_services": ([], "/stop"),
    "get_service_type": (["/stop"], "pilothouse_msgs/Command"),
    "get_services_for_type": (["pilothouse_msgs/Command"], "/stop"),
    "get_nodes": ([], "/pilothouse"),
    "get_node_details": (["/pilothouse"], "/odom"),
    "get_service_request_details": (["pilothouse_msgs/Command"], "command_id"),
    "get_service_response_details": (["pilothouse_msgs/Command"], "success"),
    "get_message_details": (["nav_msgs/Odometry"], "covariance"),
}
"""Of each method what it is asked with and what its answer must speak of."""


@BOTH
async def test_every_question_is_answered(library):
    async with server() as robot, peer(library, robot.port) as client:
        for method, (args, expected) in QUESTIONS.items():
            assert expected in str(await client.ask(names(library, method), *args)), method


async def test_all_topics_are_told_with_their_types():
    async with server() as robot, both(robot.port) as (python, script):
        told = await script.ask("getTopics")
        assert told["types"][told["topics"].index("/odom")] == "nav_msgs/Odometry"
        assert set(await python.ask("get_topics")) == set(told["topics"])


async def test_all_topics_are_told_with_the_text_of_their_types():
    async with server() as robot, peer("roslib", robot.port) as script:
        told = await script.ask("getTopicsAndRawTypes")
        text = told["typedefs_full_text"][told["topics"].index("/odom")]
        assert "child_frame_id" in text


async def test_the_robots_clock_is_told():
    async with server(now=Clock(1000.5)) as robot, peer("roslibpy", robot.port) as python:
        assert await python.ask("get_time") == {"secs": 1000, "nsecs": 500_000_000}


async def test_what_is_made_of_types_can_be_unfolded():
    """roslib's own `decodeTypeDefs` goes through them by their names."""
    async with server() as robot, peer("roslib", robot.port) as script:
        typedefs = await script.ask("getMessageDetails", "nav_msgs/Odometry")
        by_name = {typedef["type"]: typedef for typedef in typedefs}
        odometry = by_name["nav_msgs/Odometry"]
        inner = odometry["fieldtypes"][odometry["fieldnames"].index("pose")]
        covariance = by_name[inner]["fieldnames"].index("covariance")
        assert by_name[inner]["fieldarraylen"][covariance] == 36


@BOTH
async def test_parameters_are_kept_for_everybody(library):
    value = {"speed": 0.5, "names": ["a", "ü"]}
    async with server() as robot, both(robot.port) as pair:
        client, other = pair if library == "roslibpy" else pair[::-1]
        await client.do("set_param", name="/limits", value=value)
        assert (await other.do("get_param", name="/limits"))["values"] == value
        assert "/limits" in str(await pair[0].ask("get_params"))
        await client.do("delete_param", name="/limits")
        assert (await pair[0].do("get_param", name="/limits"))["values"] is None


async def test_parameters_that_the_robot_has_are_told():
    async with server(params={"/max_speed": 0.8}) as robot, both(robot.port) as (python, script):
        assert (await python.do("get_param", name="/max_speed"))["values"] == 0.8
        assert (await script.do("get_param", name="/max_speed"))["values"] == 0.8


async def test_clients_are_nodes_and_told_with_what_they_do():
    async with server() as robot, both(robot.port) as (python, script):
        await python.do("advertise", name="/chat", type="std_msgs/String")
        await script.do("subscribe", name="/chat", type="std_msgs/String")
        for client in (python, script):
            await client.settled()
        publishers = (await script.do("call", name="/rosapi/publishers", type="", args={"topic": "/chat"}))[
            "values"
        ]
        subscribers = (await script.do("call", name="/rosapi/subscribers", type="", args={"topic": "/chat"}))[
            "values"
        ]
        (publisher,), (subscriber,) = publishers["publishers"], subscribers["subscribers"]
        assert publisher != subscriber
        assert {publisher, subscriber} <= set(await python.ask("get_nodes"))
        assert "/chat" in str(await python.ask("get_node_details", publisher))
