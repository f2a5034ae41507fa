"""An honest client in a process of its own, `python -m bench.support.attack.honest`: drives, watches, presses STOP again and again.

The first line of JSON on the standard input, `{"url": URL, "pin": FINGERPRINT, "token": T}`, says which robot, and is answered by `[]`
when it drives. Each further line on the standard input is answered by `{"stops": [SECONDS…], "gap": SECONDS, "poses": N,
"way": METRES, "rounds": N}` of the time since the line before: how long each STOP took to its answer (a STOP that fails counts as
null), the longest time between two poses, and how far the robot was driven.
"""

from __future__ import annotations

import contextlib
import json
import math
import random
import sys
import threading
import time
from typing import Any

from bridge.client.credentials import Credentials
from bridge.client.remote_robot import RemoteRobot
from bridge.core.errors import BridgeError
from bridge.msgs.geometry_msgs import Twist

__all__ = ["Honest"]

STICK_PERIOD = 0.05
"""[s]"""
DRIVE_TIME = 1.2
"""Of each round [s]."""
SPEED = 0.3
"""[m/s]"""
STOPPED_TIME = 2.5
"""As long it presses STOP in each round [s]; a robot wants some 3 s between two releases."""
STOP_TIMEOUT = 5.0
"""[s]"""
RELEASE_HOLD = 1.2
"""As long the release is held [s]."""
PAUSE = (0.05, 0.6)
"""Between two STOPs [s]."""


class Honest:
    """Drives, stops, releases, and notes what it sees."""

    def __init__(self, robot: RemoteRobot) -> None:
        self._robot = robot
        self._rng = random.Random(7)
        self._lock = threading.Lock()
        self._way = 1.0
        self._pose: tuple[float, float, float] | None = None
        self._seen = self._fresh()
        self._ended = threading.Event()
        robot.on("/pose", self._on_pose)

    @staticmethod
    def _fresh() -> dict[str, Any]:
        return {"stops": [], "gap": 0.0, "poses": 0, "way": 0.0, "rounds": 0, "refused": []}

    def report(self) -> dict[str, Any]:
        """What it saw since the last call."""
        with self._lock:
            if self._pose is not None:
                self._seen["gap"] = max(self._seen["gap"], time.monotonic() - self._pose[0])
            seen, self._seen = self._seen, self._fresh()
        return seen

    def live(self) -> None:
        """Go on until ended."""
        while not self._ended.is_set():
            self._drive()
            end = time.monotonic() + STOPPED_TIME
            while time.monotonic() < end and not self._ended.is_set():
                self._stop()
                self._ended.wait(self._rng.uniform(*PAUSE))
            self._release()
            with self._lock:
                self._seen["rounds"] += 1

    def end(self) -> None:
        """Leave the robot at rest."""
        self._ended.set()

    def _drive(self) -> None:
        """Forth in one round and back in the next, a stick that was at zero before and is again after."""
        self._asked("/control/acquire")
        end = time.monotonic() + DRIVE_TIME
        self._robot.publish("/cmd_vel", Twist())
        while time.monotonic() < end and not self._ended.is_set():
            self._robot.publish("/cmd_vel", Twist.planar(self._way * SPEED, 0.0))
            time.sleep(STICK_PERIOD)
        self._way = -self._way

    def _stop(self) -> None:
        began, taken = time.monotonic(), math.inf
        with contextlib.suppress(BridgeError):
            if self._robot.call("/stop", timeout=STOP_TIMEOUT).success:
                taken = time.monotonic() - began
        with self._lock:
            self._seen["stops"].append(taken if taken < math.inf else None)

    def _release(self) -> None:
        """Hold, and release; a robot that asks for no hold does not know the first."""
        self._robot.publish("/cmd_vel", Twist())
        self._asked("/stop/hold")
        self._ended.wait(RELEASE_HOLD)
        self._asked("/stop/release")

    def _asked(self, service: str) -> None:
        try:
            answer = self._robot.call(service)
            said = "" if answer.success else answer.message
        except BridgeError as problem:
            said = str(problem)
        if said:
            with self._lock:
                self._seen["refused"] = [*self._seen["refused"], f"{service}: {said}"][-5:]

    def _on_pose(self, msg: Any) -> None:
        now, at = time.monotonic(), msg.pose.pose.position if hasattr(msg.pose, "pose") else msg.pose.position
        with self._lock:
            if self._pose is not None:
                before, x, y = self._pose
                self._seen["gap"] = max(self._seen["gap"], now - before)
                self._seen["way"] += math.hypot(at.x - x, at.y - y)
            self._pose = now, at.x, at.y
            self._seen["poses"] += 1


def main() -> None:
    """Live until the standard input ends."""
    asked = json.loads(sys.stdin.readline())
    credentials = Credentials(asked["pin"], asked["token"])
    with RemoteRobot(asked["url"], credentials=credentials) as robot:
        robot.wait(10.0)
        honest = Honest(robot)
        living = threading.Thread(target=honest.live, name="honest")
        living.start()
        print("[]", flush=True)
        try:
            while sys.stdin.readline():
                print(json.dumps(honest.report()), flush=True)
        finally:
            honest.end()
            living.join()


if __name__ == "__main__":
    main()
