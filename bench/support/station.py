"""The robot's computer as a process of its own, on free ports, with a state folder that is thrown away."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import IO

import psutil

from bench.support.child import Child, child
from bridge.client.remote_robot import RemoteRobot
from bridge.core.errors import BridgeError
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    Mission,
    SetMissionRequest,
    StartTaskRequest,
    Waypoint,
)

__all__ = ["ROUND", "Serving", "patrol", "serving"]

READY = re.compile(r"^robotside: ready bridge=(\S+)(?: http=(\S+))?")
ROUND = [Waypoint(-17.0, -7.5), Waypoint(17.0, -7.5), Waypoint(17.0, 7.5), Waypoint(-17.0, 7.5)]
"""Corners of the parking lot's two aisles: a lap of 98 m."""


@dataclass(frozen=True, slots=True)
class Serving:
    """A robot side that serves."""

    child: Child
    url: str
    """Of its rosbridge socket."""
    site: str = ""
    """Of its web site; empty for one that has none."""

    def cpu(self) -> float:
        """CPU time since its start, of all its threads and of the process that draws for it [s]."""
        return self.own_cpu() + sum(
            map(_cpu, psutil.Process(self.child.process.pid).children(recursive=True))
        )

    def own_cpu(self) -> float:
        """CPU time since its start, of all its threads without the process that draws for it [s]."""
        return _cpu(psutil.Process(self.child.process.pid))


def _cpu(process: psutil.Process) -> float:
    times = process.cpu_times()
    return float(times.user + times.system)


@contextmanager
def serving(
    module: str = "robotside",
    *more: str,
    before: Sequence[str] = (),
    state: str | None = None,
    log: IO[str] | None = None,
    own_session: bool = False,
) -> Iterator[Serving]:
    """Run `python -m module serve`, with the words `before` between the two, with the simulated patrol robot unless `more` says otherwise, until the end of the block.

    With its records in the folder `state`; in a folder of its own if None. It logs to `log`, to our standard error if None;
    `own_session` is as `child` has it.
    """
    options = (*before, "serve", "--port", "0", "--http-port", "0", *more, "--state")
    with (
        tempfile.TemporaryDirectory() as own,
        child(module, *options, state or own, log=log, own_session=own_session) as process,
    ):
        while not (ready := READY.match(process.line())):
            pass
        yield Serving(process, ready[1], ready[2] or "")


def patrol(url: str) -> None:
    """Have the robot patrol `ROUND` until the next order; BridgeError when it refuses."""
    with RemoteRobot(url) as robot:
        robot.wait()
        order(robot, "/mission/set", SetMissionRequest(mission=Mission(waypoints=ROUND)))
        order(robot, "/task/start", StartTaskRequest())
        order(robot, "/control/release", CommandRequest())


def order(robot: RemoteRobot, service: str, request: CommandRequest) -> None:
    """Give a command; BridgeError with the robot's own sentence when it refuses."""
    answer = robot.call(service, request, CommandResponse)
    if not isinstance(answer, CommandResponse) or not answer.success:
        raise BridgeError(f"{service}: {answer}")
