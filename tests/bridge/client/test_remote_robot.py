"""A robot as an object, used from threads that have no event loop."""

from __future__ import annotations

import asyncio
import concurrent.futures
import queue
import subprocess
import sys
import textwrap
import threading
import time

import pytest

from bridge.client.client import Phase
from bridge.client.remote_robot import RemoteRobot
from bridge.core.errors import BridgeError, NoReply, NotConnected, Refused
from bridge.core.network_thread import NetworkThread
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, RobotInfo
from bridge.server.server import BridgeServer
from tests.bridge.wires import TIMEOUT, door, service


class Served:
    """A server in a thread of its own."""

    def __init__(self, **options):
        self.heard = queue.Queue()
        self.thread = NetworkThread("server")
        options = {"on_message": lambda *all: self.heard.put(all)} | options
        self.bridge = BridgeServer(door(options), **options)
        self.thread.start(self.bridge.start(port=0)).result(TIMEOUT)
        self.url = f"ws://127.0.0.1:{self.bridge.port}"

    def publish(self, topic, msg):
        self.thread.call(self.bridge.publish, topic, msg)

    def close(self):
        self.thread.start(self.bridge.close()).result(TIMEOUT)
        self.thread.close()


@pytest.fixture
def robot():
    served = Served()
    yield served
    served.close()


def test_ten_lines_are_enough_to_see_and_to_drive(robot):
    seen = queue.Queue()
    robot.publish("/robot/info", RobotInfo(name="Patrol-1"))
    with RemoteRobot(robot.url) as remote:
        remote.on("/robot/info", seen.put)
        remote.wait()
        remote.publish("/cmd_vel", Twist.planar(0.5, 0.0))
        assert seen.get(timeout=TIMEOUT).name == "Patrol-1"
        _, topic, msg, _ = robot.heard.get(timeout=TIMEOUT)
        assert (topic, msg) == ("/cmd_vel", Twist.planar(0.5, 0.0))
    assert remote.state.phase is Phase.CLOSED


def test_a_drive_command_says_when_it_was_meant(robot):
    with RemoteRobot(robot.url) as remote:
        remote.wait()
        before = time.time()
        remote.publish("/cmd_vel", Twist.planar(0.5, 0.0))
        *_, stamp = robot.heard.get(timeout=TIMEOUT)
        assert before - 0.05 <= stamp <= time.time() + 0.05


def test_a_call_waits_for_its_answer(robot):
    with RemoteRobot(robot.url) as remote:
        remote.wait()
        answer = remote.call("/stop", CommandRequest(command_id="c1"))
        assert answer == CommandResponse(success=True, message="Accepted c1.")
        with pytest.raises(Refused, match="no service"):
            remote.call("/dance")


def test_many_threads_may_call_at_once(robot):
    with RemoteRobot(robot.url) as remote, concurrent.futures.ThreadPoolExecutor(8) as pool:
        remote.wait()
        answers = pool.map(lambda n: remote.call("/stop", CommandRequest(command_id=str(n))), range(40))
        assert [answer.message for answer in answers] == [f"Accepted {n}." for n in range(40)]


def test_a_callback_may_not_wait_for_an_answer(robot):
    outcome = queue.Queue()

    def ask(_):
        try:
            remote.call("/stop")
        except BridgeError as error:
            outcome.put(str(error))

    robot.publish("/robot/info", RobotInfo())
    with RemoteRobot(robot.url) as remote:
        remote.on("/robot/info", ask)
        expected = "/stop cannot be called from a callback; callbacks must not wait."
        assert outcome.get(timeout=TIMEOUT) == expected


def test_who_does_not_want_a_topic_any_more_hears_nothing_more(robot):
    seen = []
    with RemoteRobot(robot.url) as remote:
        remote.wait()
        off = remote.on("/odom", seen.append)
        remote.call("/stop")
        off()
        remote.call("/stop")
        robot.publish("/odom", Odometry())
        remote.call("/stop")
        assert seen == []


def test_a_topic_outside_the_table_needs_its_type(robot):
    with RemoteRobot(robot.url) as remote:
        with pytest.raises(KeyError):
            remote.on("/elsewhere", print)
        remote.on("/elsewhere", print, Twist)()


def test_without_a_robot_waiting_ends_with_the_reason():
    with RemoteRobot("ws://127.0.0.1:1") as remote:
        with pytest.raises(NotConnected, match="No robot answers at 127.0.0.1:1"):
            remote.wait(0.1)
        with pytest.raises(NotConnected, match="There is no connection"):
            remote.call("/stop")
        remote.publish("/cmd_vel", Twist())


def test_a_closed_robot_says_so_and_may_be_closed_again(robot):
    remote = RemoteRobot(robot.url)
    remote.wait()
    remote.close()
    remote.close()
    remote.publish("/cmd_vel", Twist())
    with pytest.raises(NotConnected, match="The link is closed"):
        remote.call("/stop")


def test_closing_while_somebody_waits_ends_the_wait():
    begun = threading.Event()

    async def never(session, request):
        begun.set()
        await asyncio.Event().wait()

    served = Served(services=[service("/stop", never)])
    remote = RemoteRobot(served.url)
    remote.wait()
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(remote.call, "/stop", timeout=60.0)
        assert begun.wait(TIMEOUT)
        remote.close()
        with pytest.raises((NotConnected, NoReply)):
            waiting.result(TIMEOUT)
    served.close()


FOREIGN = textwrap.dedent("""
    import sys, threading
    import roslibpy
    robot = roslibpy.Ros("127.0.0.1", int(sys.argv[1]))
    robot.run(timeout=5)
    seen = threading.Event()
    info = []
    roslibpy.Topic(robot, "/robot/info", "pilothouse_msgs/RobotInfo").subscribe(
        lambda msg: (info.append(msg["name"]), seen.set())
    )
    assert seen.wait(5)
    command = roslibpy.Topic(robot, "/cmd_vel", "geometry_msgs/Twist")
    command.publish(roslibpy.Message({"linear": {"x": 0.25, "y": 0, "z": 0}, "angular": {"x": 0, "y": 0, "z": 0}}))
    stop = roslibpy.Service(robot, "/stop", "std_srvs/Trigger").call(roslibpy.ServiceRequest(), timeout=5)
    print(info[0], stop["success"], robot.get_time()["secs"] > 0, "/odom" in robot.get_topics(),
          robot.get_topic_type("/odom"), robot.get_service_type("/stop"), robot.get_nodes())
    robot.terminate()
""")


def test_a_program_on_roslibpy_finds_what_it_expects(robot):
    robot.publish("/robot/info", RobotInfo(name="Patrol-1"))
    run = subprocess.run(
        [sys.executable, "-c", FOREIGN, str(robot.bridge.port)],
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    expected = (
        "Patrol-1 True True True nav_msgs/Odometry pilothouse_msgs/Command ['/pilothouse', '/client_1']"
    )
    assert run.stdout.strip() == expected
    assert robot.heard.get(timeout=TIMEOUT)[2] == Twist.planar(0.25, 0.0)
