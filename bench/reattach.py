"""A phone that is killed in mid-task, and the one that is started in its place.

The app is a process of its own, off screen at a phone's size, that is connected and has control while the simulated robot
patrols. It is ended by `kill -9` at an odd moment; while it is gone, another operator takes control and gives it back,
which the robot reports. Then the app is started anew. It is attached when it shows the robot's screens and knows the
task that runs, by its number, and its progress, the queue, the history and every event since the kill. The task went on
when the robot has kept its number and state and has driven meanwhile.
"""

from __future__ import annotations

import random
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bench.support.pair import PHONE, app
from bench.support.station import ROUND, order, serving
from bridge.client.remote_robot import RemoteRobot
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    Event,
    Mission,
    SetMissionRequest,
    SetQueueRequest,
    StartTaskRequest,
    TaskOrder,
    TaskProgress,
    TaskStatus,
)

FIGURES = (
    Figure("attached", "s", "from Connect until it knows everything, the longest", 2.0),
    Figure("started", "s", "the same from the start of its process, the longest", 2.0),
    Figure("lost", "", "phones that did not get everything", 0.0),
    Figure("ended", "", "tasks that did not go on", 0.0),
    Figure("kills", "", "phones that were killed"),
)
REPEATS = 1
KILLS = 20
DONE = 3
"""Tasks that are in the history before."""
ANSWER_TIMEOUT = 10.0
AWAY = (0.5, 3.0)
"""Time without a phone [s]."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(lambda: killed(KILLS), None)


class Watch:
    """Another client, which collects the robot's messages."""

    def __init__(self, robot: RemoteRobot) -> None:
        self.robot = robot
        self.events: list[int] = []
        self.status, self.driven = TaskStatus(), 0.0
        self.placed = threading.Event()
        robot.on("/events", self._event)
        robot.on("/task/status", self._told)
        robot.on("/task/progress", self._went)

    def _event(self, event: Event) -> None:
        self.events.append(event.id)

    def _told(self, status: TaskStatus) -> None:
        self.status = status

    def _went(self, progress: TaskProgress) -> None:
        self.driven = progress.distance_driven

    def begin(self) -> None:
        """Have some history, a long patrol and something in the queue behind it."""
        self.robot.on("/pose", lambda _: self.placed.set())
        self.placed.wait(ANSWER_TIMEOUT)
        order(self.robot, "/mission/set", SetMissionRequest(mission=Mission(waypoints=ROUND)))
        for _ in range(DONE):
            order(self.robot, "/task/start", StartTaskRequest(order=TaskOrder(task="hold", duration=0.1)))
            self.wait("SUCCEEDED")
        order(self.robot, "/task/start", StartTaskRequest(task="patrol"))
        self.wait("RUNNING")
        order(self.robot, "/task/queue/set", SetQueueRequest(orders=[TaskOrder(task="hold")]))
        order(self.robot, "/control/release", CommandRequest())

    def wait(self, state: str) -> None:
        """Until the task is in that state; TimeoutError when it never is."""
        end = time.monotonic() + ANSWER_TIMEOUT
        while self.status.state != state:
            if time.monotonic() > end:
                raise TimeoutError(f"The task is {self.status.state}, not {state}: {self.status.reason}")
            time.sleep(0.02)

    def intrude(self) -> None:
        """Take control and give it back, as soon as that is possible."""
        order(self.robot, "/control/acquire", CommandRequest())
        order(self.robot, "/control/release", CommandRequest())


def killed(kills: int) -> dict[str, float]:
    """So many phones, one after the other."""
    rng, found = random.Random(4), []
    with (
        serving() as served,
        RemoteRobot(served.url) as robot,
        tempfile.TemporaryDirectory() as settings,
    ):
        robot.wait()
        watch = Watch(robot)
        watch.begin()
        found = [phone(served.url, watch, settings, rng, last=number == kills) for number in range(kills + 1)]
    attached = found[1:]  # no app was killed before the first one
    return {
        "attached": max(each["took"] for each in attached),
        "started": max(each["started"] for each in attached),
        "lost": sum(each["lost"] for each in attached),
        "ended": sum(each["ended"] for each in attached),
        "kills": len(attached),
    }


def phone(url: str, watch: Watch, settings: str, rng: random.Random, *, last: bool) -> dict[str, float]:
    """Start one, wait until it is attached, and kill it unless it is the `last`; what became of it."""
    task, driven = watch.status.task_id, watch.driven
    began = time.monotonic()
    with app("--size", PHONE, "--settings", settings) as (process, _):
        known = {"task": task, "runs": DONE, "queued": 1, "events": list(watch.events[-50:])}
        answer = process.ask({"do": "attach", "url": url, **known})
        started = time.monotonic() - began
        if "fault" in answer:
            raise RuntimeError(answer["fault"])
        for missing in answer["missing"]:
            print(f"  a phone lacked {missing}")
        time.sleep(rng.uniform(0.2, 1.0))
        if not last:
            process.process.kill()
            process.process.wait()
    went = watch.status.task_id == task and watch.status.state == "RUNNING" and watch.driven > driven
    if not last:
        time.sleep(rng.uniform(*AWAY))
        watch.intrude()
    return {"took": answer["took"], "started": started, "lost": bool(answer["missing"]), "ended": not went}
