"""A program that drives a robot in a circle for two seconds, prints where it is and sends it home: `python -m examples.circle`."""

import time

from bridge.client import RemoteRobot
from bridge.msgs.geometry_msgs import Twist

with RemoteRobot("ws://127.0.0.1:9090") as robot:
    robot.wait()
    robot.on("/pose", lambda msg: print(msg.pose.pose.position))
    for _ in range(40):
        robot.publish("/cmd_vel", Twist.planar(0.2, 0.5))
        time.sleep(0.05)
    print(robot.call("/task/go_home").message)
