"""What roslibpy's own suites do with a ROS system, for ROS 1 and ROS 2: one line of JSON says how each scenario went.

python suite.py PORT TRANSPORT
"""

from __future__ import annotations

import functools
import json
import sys
import threading
import time
import traceback
from collections.abc import Callable
from contextlib import contextmanager
from typing import Any

import roslibpy
from roslibpy.ros1 import actionlib
from roslibpy.ros2 import Header
from roslibpy.tf import TFClient

TIMEOUT = 60.0
"""Longest wait for what must come [s]."""
CLIENTS = 30
"""Connections at a time."""


class Suite:
    """The scenarios; each is a method without arguments."""

    def __init__(self, port: int, transport: str) -> None:
        self.port, self.transport = port, transport

    @contextmanager
    def ros(self, *address: Any) -> Any:
        ros = roslibpy.Ros(*(address or ("127.0.0.1", self.port)), transport=self.transport)
        ros.run(timeout=TIMEOUT)
        try:
            yield ros
        finally:
            ros.close()

    def heard(self, topic: roslibpy.Topic, count: int, say: Callable[[], None] = int) -> list[Any]:
        """The first `count` messages; `say` is called until they have come."""
        found: list[Any] = []
        enough = threading.Event()

        def hear(msg: Any) -> None:
            found.append(msg)
            if len(found) >= count:
                enough.set()

        topic.subscribe(hear)
        until = time.monotonic() + TIMEOUT
        while not enough.wait(0.05):
            assert time.monotonic() < until, f"{len(found)} of {count} on {topic.name}"
            say()
        topic.unsubscribe()
        return found[:count]

    def connects_by_host_and_by_url_and_closes(self) -> None:
        for address in (("127.0.0.1", self.port), (f"ws://127.0.0.1:{self.port}",)):
            with self.ros(*address) as ros:
                assert ros.is_connected
            until = time.monotonic() + TIMEOUT
            while ros.is_connected:
                assert time.monotonic() < until, "it is still connected"
                time.sleep(0.01)

    def many_connect_at_a_time(self) -> None:
        clients: list[Any] = []

        def connect() -> None:
            ros = roslibpy.Ros("127.0.0.1", self.port, transport=self.transport)
            ros.run(timeout=TIMEOUT)
            clients.append(ros)

        threads = [threading.Thread(target=connect) for _ in range(CLIENTS)]
        for each in threads:
            each.start()
        for each in threads:
            each.join()
        assert [ros.is_connected for ros in clients] == [True] * CLIENTS
        for ros in clients:
            ros.close()

    def topics_are_listed_with_rosout(self) -> None:
        told: list[Any] = []
        came = threading.Event()
        with self.ros() as ros:
            assert "/rosout" in ros.get_topics()
            ros.get_topics(lambda found: (told.append(found), came.set()))
            assert came.wait(TIMEOUT)
        assert "/rosout" in told[0]["topics"]

    def a_publisher_is_heard(self) -> None:
        for kind in ("std_msgs/String", "std_msgs/msg/String"):
            with self.ros() as ros:
                name = f"/chatter_{len(kind)}"
                talker = roslibpy.Topic(ros, name, kind)
                say = functools.partial(talker.publish, roslibpy.Message({"data": "test"}))
                assert self.heard(roslibpy.Topic(ros, name, kind), 3, say) == [{"data": "test"}] * 3
                talker.unadvertise()

    def a_header_travels_in_both_dialects(self) -> None:
        for kind, header in (
            (
                "geometry_msgs/PointStamped",
                roslibpy.Header(seq=3, stamp=roslibpy.Time(5, 6), frame_id="base"),
            ),
            ("geometry_msgs/msg/PointStamped", Header(stamp=roslibpy.Time(5, 6), frame_id="base")),
        ):
            with self.ros() as ros:
                name = f"/points_{len(kind)}"
                talker = roslibpy.Topic(ros, name, kind)
                msg = roslibpy.Message({"header": header, "point": {"x": 0.0, "y": 1.0, "z": 2.0}})
                (heard,) = self.heard(
                    roslibpy.Topic(ros, name, kind), 1, functools.partial(talker.publish, msg)
                )
                assert heard["point"] == {"x": 0.0, "y": 1.0, "z": 2.0}
                assert heard["header"]["frame_id"] == "base"
                assert ("seq" in heard["header"]) is ("/msg/" not in kind)

    def the_listener_says_hello(self) -> None:
        with self.ros() as ros:
            (heard,) = self.heard(roslibpy.Topic(ros, "/listener", "std_msgs/String"), 1)
        assert heard == {"data": "Hello, World"}

    def a_service_adds_two_ints(self) -> None:
        with self.ros() as ros:
            client = roslibpy.Service(ros, "/add_two_ints", "rospy_tutorials/AddTwoInts")
            assert client.call(roslibpy.ServiceRequest({"a": 2, "b": 40}), timeout=TIMEOUT)["sum"] == 42

    def a_service_of_its_own_is_called(self) -> None:
        with self.ros() as ros:
            service = roslibpy.Service(ros, "/test_sum_service", "rospy_tutorials/AddTwoInts")

            def add(request: Any, response: Any) -> bool:
                response["sum"] = request["a"] + request["b"]
                return False

            service.advertise(add)
            client = roslibpy.Service(ros, "/test_sum_service", "rospy_tutorials/AddTwoInts")
            assert client.call(roslibpy.ServiceRequest({"a": 2, "b": 40}), timeout=TIMEOUT)["sum"] == 42
            empty = roslibpy.Service(ros, "/test_empty_service", "std_srvs/Empty")
            empty.advertise(lambda request, response: True)
            roslibpy.Service(ros, "/test_empty_service", "std_srvs/Empty").call(
                roslibpy.ServiceRequest(), timeout=TIMEOUT
            )
            service.unadvertise()
            empty.unadvertise()

    def a_parameter_comes_and_goes(self) -> None:
        with self.ros() as ros:
            param = roslibpy.Param(ros, f"test_param_{self.transport}")
            assert param.get(timeout=TIMEOUT) is None
            param.set("test_value", timeout=TIMEOUT)
            assert param.get(timeout=TIMEOUT) == "test_value"
            param.delete(timeout=TIMEOUT)
            assert param.get(timeout=TIMEOUT) is None

    def an_action_of_ros_1_succeeds_on_the_fibonacci_node(self) -> None:
        with self.ros() as ros:
            client = actionlib.ActionClient(ros, "/fibonacci", "actionlib_tutorials/FibonacciAction")
            goal = actionlib.Goal(client, roslibpy.Message({"order": 5}))
            goal.send()
            assert goal.wait(TIMEOUT)["sequence"] == [0, 1, 1, 2, 3, 5, 8]
            client.dispose()

    def an_action_server_of_its_own_succeeds_and_is_preempted(self) -> None:
        name = f"/test_action_{self.transport}"
        with self.ros() as ros:
            server = actionlib.SimpleActionServer(ros, name, "actionlib/TestAction")

            def execute(goal: Any) -> None:
                if goal["goal"] == 13:
                    server.set_succeeded({"result": goal["goal"]})
                    return
                while not server.is_preempt_requested():
                    time.sleep(0.05)
                server.set_preempted()

            server.start(execute)
            client = actionlib.ActionClient(ros, name, "actionlib/TestAction")
            for number, status, result in (
                (13, actionlib.GoalStatus.SUCCEEDED, 13),
                (14, actionlib.GoalStatus.PREEMPTED, 0),
            ):
                goal = actionlib.Goal(client, roslibpy.Message({"goal": number}))
                goal.send()
                if number == 14:
                    time.sleep(0.5)
                    goal.cancel()
                assert goal.wait(TIMEOUT)["result"] == result
                assert goal.status["status"] == status
            client.dispose()

    def an_action_of_ros_2_succeeds_on_the_fibonacci_node(self) -> None:
        ended, steps = threading.Event(), []
        told: list[Any] = []
        with self.ros() as ros:
            client = roslibpy.ActionClient(ros, "/fibonacci", "example_interfaces/action/Fibonacci")
            client.send_goal(
                roslibpy.Goal({"order": 5}),
                lambda result: (told.append(result), ended.set()),
                steps.append,
                lambda error: (told.append(error), ended.set()),
            )
            assert ended.wait(TIMEOUT)
        assert told[0]["values"]["sequence"] == [0, 1, 1, 2, 3, 5, 8], told
        assert len(steps) == 5

    def a_transform_comes_from_the_republisher(self) -> None:
        found: list[Any] = []
        came = threading.Event()
        with self.ros() as ros:
            client = TFClient(ros, fixed_frame="world")
            client.subscribe("/world", lambda transform: (found.append(transform), came.set()))
            assert came.wait(TIMEOUT)
        assert found[0]["translation"] == {"x": 0.0, "y": 0.0, "z": 0.0}
        assert found[0]["rotation"] == {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}


def main(port: int, transport: str) -> None:
    """Run all scenarios, one after the other."""
    roslibpy.ros.set_rosapi_timeout(TIMEOUT)
    suite = Suite(port, transport)
    went: dict[str, str] = {}
    for name, scenario in vars(Suite).items():
        if name[0] == "_" or name in ("ros", "heard"):
            continue
        try:
            scenario(suite)
        except Exception:  # noqa: BLE001 -- whatever goes wrong is told
            went[name] = traceback.format_exc()
        else:
            went[name] = ""
    sys.stdout.write(json.dumps(went) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
