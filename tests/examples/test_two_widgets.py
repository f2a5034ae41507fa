"""The example of docs/architecture.md, on a socket of its own."""

from __future__ import annotations

import math
import queue
import threading
import time

import pytest

from bridge.client import RemoteRobot
from bridge.msgs.geometry_msgs import Quaternion, Twist
from bridge.msgs.sensor_msgs import Imu
from examples.two_widgets import two_widgets
from tests.bridge.client.test_remote_robot import Served
from tests.bridge.wires import TIMEOUT


@pytest.fixture
def served():
    asked = queue.Queue()
    served = Served(on_demand=lambda topic, wanted: asked.put(topic))
    served.asked = asked
    yield served
    served.close()


@pytest.fixture
def robot(served):
    with RemoteRobot(served.url) as robot:
        robot.wait()
        yield robot


def test_the_compass_turns_with_the_robot_in_the_thread_of_the_glass(stage, served, robot):
    compass = stage.show(two_widgets(robot), size=(800, 400)).children[1]
    threads = []
    compass.bind(heading=lambda *_: threads.append(threading.current_thread()))
    assert served.asked.get(timeout=TIMEOUT) == "/imu/data"
    served.publish("/imu/data", Imu(orientation=Quaternion.from_yaw(0.0)))
    end = time.monotonic() + TIMEOUT
    while math.isnan(compass.heading) and time.monotonic() < end:
        stage.frames()
    assert compass.heading == pytest.approx(90.0)
    assert threads == [threading.main_thread()]


def test_the_stick_drives_for_as_long_as_it_is_held(stage, served, robot):
    stick = stage.show(two_widgets(robot), size=(800, 400)).children[0]
    finger = stage.touch(stick.center_x, stick.center_y + stick.reach)
    finger.touch_down()
    stage.run_for(0.5)
    finger.touch_up()
    stage.run_for(0.5)
    twists = [served.heard.get(timeout=TIMEOUT)[2]]
    while twists[-1] != Twist():
        twists.append(served.heard.get(timeout=TIMEOUT)[2])
    assert set(map(repr, twists[:-1])) == {repr(Twist.planar(0.5, 0.0))}
    assert 8 <= len(twists) <= 12
    robot.publish("/cmd_vel", Twist.planar(0.1, 0.0))
    assert served.heard.get(timeout=TIMEOUT)[2] == Twist.planar(0.1, 0.0)
