"""Each way an input can die, once, with the real app and a robot side of its own: zero speed comes to the robot's port.

How soon is held in virtual time by `test_inputs.py` and measured by `python -m bench inputs`. It draws nothing.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from kivy.base import EventLoop

from bench.support.losses import Grip
from bench.support.station import serving
from bench.support.ways import FINGER, PAD
from bridge.msgs.geometry_msgs import Twist
from tests.e2e.handheld import Handheld, handheld

PATIENCE = 60.0
"""A fault, not a delay, uses this up [s]."""

GESTURE = 30
"""A hand that drives nothing after so many frames lets go and pushes anew, as one does on a bad link."""


class Port:
    """What the robot's port was told last."""

    def __init__(self, child: Any) -> None:
        self.moving = False
        self._news = threading.Condition()
        self._lines = child.process.stdout
        self._thread = threading.Thread(target=self._read, name="port", daemon=True)
        self._thread.start()

    def _read(self) -> None:
        for line in self._lines:
            if line.startswith(('["drive"', '["stop"')):
                what, _, *twist = json.loads(line)
                with self._news:
                    self.moving = what == "drive" and any(abs(value) > 1e-6 for value in twist)
                    self._news.notify_all()

    def rests(self) -> None:
        """Wait, with the glass frozen, until the robot is told to rest."""
        with self._news:
            assert self._news.wait_for(lambda: not self.moving, PATIENCE)


class Trial:
    """A hand on the stick of a handheld, in front of a robot whose port tells."""

    def __init__(self, glass: Handheld, port: Port) -> None:
        self.port, self.app = port, glass.app
        self._glass = glass
        self.grip = Grip(glass.app, glass.hand)
        self.grip.freeze = port.rests

    def until(self, condition: Callable[[], object], what: str) -> None:
        def moved_on() -> bool:
            self.grip.frame()
            return bool(condition())

        self._glass.until(moved_on, what, PATIENCE)

    def drives_off(self, kind: str) -> None:
        """By `finger` or `pad`."""
        grip, frames = self.grip, 0

        def off() -> bool:
            nonlocal frames
            if frames % GESTURE == 0:
                grip.again()
                grip.take(kind)
            frames += 1
            return self.port.moving and grip.stick.twist != Twist()

        if kind == "pad":
            grip.plug_in()
        self.until(lambda: grip.ready, "control and a live stick")
        self.until(off, "the robot to drive off")

    def loses(self, way: str) -> None:
        """And the stick lets go and the robot is told to rest, unless the loss itself says that it drives on."""
        self.grip.lose(way)
        if way != "frozen":
            self.until(
                lambda: not self.port.moving and self.grip.stick.twist == Twist(), f"rest after: {way}"
            )
        self.until(lambda: self.grip.settled, "STOPPED")
        self.grip.again()
        EventLoop.idle()


@pytest.fixture
def trial(tmp_path: Path) -> Iterator[Trial]:
    with (
        serving("bench.support.port", "--robot", "sim:patrol", "--world", "parking_lot") as side,
        handheld(tmp_path, url=side.url, screen="drive", discover=False) as glass,
    ):
        trial = Trial(glass, Port(side.child))
        yield trial
        trial.grip.drop()


def test_whatever_pushes_the_stick_and_is_lost_the_robots_port_is_told_to_rest(trial: Trial) -> None:
    for kind, ways in {"finger": FINGER, "pad": PAD}.items():
        for way in ways:
            trial.drives_off(kind)
            trial.loses(way)
