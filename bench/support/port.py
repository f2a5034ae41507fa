"""The robot side with a robot whose port reports its commands, `python -m bench.support.port serve --robot sim:MODEL …`.

With `--relay` it is no robot side but the simplest thing that works: a server that hands every twist on to the robot, as
rosbridge_server and a simple drive do, and checks neither its age nor who is gone.

Prints a line of JSON for each: `["drive", at, forward, yaw rate]`, `["stop", at]` and, 20 times a second by odometry,
`["speed", at, over ground]`. `at` is `time.monotonic()` [s].
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import sys
import time
from collections.abc import Iterable, Sequence
from typing import Any

from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

import sim.robot
from bench.support.kinds import Aloft
from bench.support.probe import Probe, report
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from robotside.__main__ import main
from robotside.core.robot import Robot

TICK = 1 / 60
"""[s]"""


class Port(Probe):
    """A robot port that reports every command and the speed."""

    def stop(self) -> None:
        """Report the command to rest."""
        report("stop", time.monotonic())
        super().stop()

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        """Report the speed."""
        for topic, msg in self._robot.read(now):
            if isinstance(msg, Odometry) and topic == "/odom":
                v = msg.twist.twist.linear
                report("speed", time.monotonic(), math.hypot(v.x, v.y))
            yield topic, msg


def make(robots: Sequence[str], world: str, **options: Any) -> list[Robot]:
    """The simulated robots of these names behind ports that report; those that fly are in the air."""
    return [
        Port(Aloft(robot) if "take_off" in robot.info.manoeuvres else robot)
        for robot in simulated(robots, world, **options)
    ]


async def relay(robot: Robot) -> None:
    """Hand on every twist that comes, from anyone."""

    async def serve_client(ws: ServerConnection) -> None:
        with contextlib.suppress(ConnectionClosed):
            async for raw in ws:
                op = json.loads(raw)
                if op["op"] == "publish":
                    linear, angular = op["msg"]["linear"], op["msg"]["angular"]
                    robot.drive(Twist.planar(linear["x"], angular["z"]))

    async with serve(serve_client, "127.0.0.1", 0) as server:
        port = server.sockets[0].getsockname()[1]
        print(f"robotside: ready bridge=ws://127.0.0.1:{port}", flush=True)
        while True:
            for _ in robot.read(time.monotonic()):
                pass
            await asyncio.sleep(TICK)


if __name__ == "__main__":
    simulated = sim.robot.make_several
    if "--relay" in sys.argv:
        named, world = (sys.argv[sys.argv.index(option) + 1] for option in ("--robot", "--world"))
        asyncio.run(relay(make([named.removeprefix("sim:")], world)[0]))
    sim.robot.make_several = make  # type: ignore[assignment]
    sys.exit(main())
