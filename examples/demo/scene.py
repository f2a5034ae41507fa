"""The scene of a story: everything that its steps use."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from kivy.uix.widget import Widget

from examples.demo.fingers import Hand, Point
from examples.demo.glass import Glass
from examples.demo.report import Report
from examples.demo.witness import Witness

__all__ = ["Enough", "Scene", "Wait"]

Wait = Generator[None, None, Any]


class Enough(Exception):
    """The step that was to be the last one is over."""


@dataclass
class Scene:
    """The screen, a hand, a witness of the truth, and a report."""

    glass: Glass
    witness: Witness
    report: Report
    url: str
    """Of the robot."""
    speed: float
    """Robot seconds per second."""
    until: str | None = None
    """Name of the last step to play; None plays all."""
    power_cut: Callable[[], None] = lambda: None
    """Kills the robot's computer and has it start again."""

    @property
    def hand(self) -> Hand:
        """The hand that touches the screen."""
        return self.glass.hand

    @contextmanager
    def step(self, name: str) -> Iterator[Callable[..., bool]]:
        """A step of the report; gives what notes an expectation. The picture is taken when it ends, however it does.

        Raises Enough after the last step to play.
        """
        if self.until and self.report.done == self.until:
            raise Enough
        self.report.begin(name)
        try:
            yield self.report.check
        finally:
            self.report.end()

    def cards(self) -> list[Any]:
        """The robot's own card on the connect screen; empty while it was not heard."""
        cards: list[Any] = self.glass.all("RobotCard")
        return [card for card in cards if card.entry is not None and card.entry.url == self.url]

    def map(self) -> Widget:
        """The map on the screen."""
        return self.glass.all("MapOverlay")[0]

    def on_map(self, x: float, y: float) -> Point:
        """Place of (x, y) of `map` [m] on the screen [px, window]."""
        chart: Any = self.map()
        return tuple(chart.to_window(*chart.view.to_screen(x, y)))  # type: ignore[return-value]

    def rest(self, seconds: float) -> Wait:
        """Wait until the robot stands still, at most `seconds`; returns whether it does."""
        still = yield from self.glass.soon(lambda: self.witness.speed() < 0.01, seconds)
        return bool(still)

    def task(self, task: str, state: str = "RUNNING") -> bool:
        """The robot says that `task` is in this state."""
        status = self.witness["/task/status"]
        return status is not None and (status.task, status.state) == (task, state)

    @property
    def stopped(self) -> bool:
        """The robot says that STOP is pressed."""
        status = self.witness["/control/status"]
        return bool(status is not None and status.stopped)

    def robot_time(self, seconds: float) -> Wait:
        """Let so much of the robot's time pass."""
        end = self.witness.now + seconds
        yield from self.glass.soon(lambda: self.witness.now >= end, 3 * seconds + 5)

    def off(self) -> tuple[float, float]:
        """How far the robot believes to be from where it is: [m], [rad]."""
        pose = self.witness["/pose"].pose.pose
        _, x, y, yaw = self.witness.truth
        turned = math.remainder(2 * math.atan2(pose.orientation.z, pose.orientation.w) - yaw, math.tau)
        return math.dist((pose.position.x, pose.position.y), (x, y)), abs(turned)
