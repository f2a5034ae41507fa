"""A program that drives a robot of this machine 20 times a second, `python -m bench.support.operator ours|roslibpy PORT`.

The twist's forward speed is `time.monotonic()` at the moment of the command. Prints `[]` when connected; each line on the
standard input is answered by `{"heard": [AT…]}`: when an Odometry came, by the same clock.
"""

from __future__ import annotations

import contextlib
import json
import sys
import threading
import time
from collections.abc import Callable, Iterator

from bridge.client.remote_robot import RemoteRobot
from bridge.msgs.geometry_msgs import Twist

PERIOD = 0.05
"""[s]"""

Send = Callable[[float], object]


@contextlib.contextmanager
def ours(port: int, heard: list[float]) -> Iterator[Send]:
    """By our own client."""
    with RemoteRobot(f"ws://127.0.0.1:{port}") as robot:
        robot.wait()
        robot.on("/odom", lambda _: heard.append(time.monotonic()))
        yield lambda at: robot.publish("/cmd_vel", Twist.planar(at, 0.0))


@contextlib.contextmanager
def roslibpy(port: int, heard: list[float]) -> Iterator[Send]:
    """By roslibpy."""
    from roslibpy import Message, Ros, Topic

    ros = Ros("127.0.0.1", port)
    ros.run()
    Topic(ros, "/odom", "nav_msgs/Odometry").subscribe(lambda _: heard.append(time.monotonic()))
    twist = Topic(ros, "/cmd_vel", "geometry_msgs/Twist")
    twist.advertise()
    try:
        yield lambda at: twist.publish(Message({"linear": {"x": at}, "angular": {"z": 0.0}}))
    finally:
        ros.terminate()


def main(kind: str, port: int) -> None:
    """Drive until the standard input ends."""
    heard: list[float] = []
    done = threading.Event()
    with {"ours": ours, "roslibpy": roslibpy}[kind](port, heard) as send:

        def drive() -> None:
            while not done.wait(PERIOD):
                send(time.monotonic())

        driving = threading.Thread(target=drive)
        driving.start()
        print("[]", flush=True)
        while sys.stdin.readline():
            print(json.dumps({"heard": list(heard)}), flush=True)
        done.set()
        driving.join()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
