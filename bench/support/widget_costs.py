"""Cost of widgets on the main thread, `python -m bench.support.widget_costs ours|naive`: one line of JSON, times in ms.

Every call to OpenGL is swallowed: what is left is Kivy's and Python's own work. Each update is a message that differs from the one before,
and the frame in which it is drawn; the time is the CPU time of this one thread, less that of a frame without an update.
"""

from __future__ import annotations

import json
import math
import os
import sys
import time
import tracemalloc
from collections.abc import Callable, Iterator, Sequence
from typing import Any

os.environ.update(
    KIVY_GL_BACKEND="mock",
    SDL_VIDEODRIVER="offscreen",
    SDL_AUDIODRIVER="dummy",
    KIVY_NO_ARGS="1",
    KIVY_NO_CONFIG="1",
    KIVY_NO_FILELOG="1",
    KIVY_NO_CONSOLELOG="1",
    KIVY_METRICS_DENSITY="1",
    KIVY_DPI="96",
)
os.environ.pop("DISPLAY", None)

UPDATES, WARM_UP = 300, 60
NAIVE_UPDATES = 60
RUNS = 5
"""The least of so many runs counts: what disturbs only adds."""
BEAMS = 1080
LIVE = 30
"""Widgets at once."""
IDLE_FRAMES, FRAME_RATE = 300, 60
GROWTH_UPDATES, GROWTH_WARM_UP = 100_000, 10_000
KEPT = 1000
"""Samples that a plot keeps: it is full before growth is measured."""

Make = Callable[[], Any]
Message = Callable[[int], Any]


def scan(number: int) -> Any:
    """A sweep through a room that changes a little."""
    import numpy as np

    from bridge.msgs.arrays import Float32Array
    from bridge.msgs.sensor_msgs import LaserScan

    angles = np.linspace(-2.3, 2.3, BEAMS)
    ranges = 3 + 1.3 * np.sin(angles * 3 + number * 0.1) + 0.9 * np.cos(angles * 5)
    return LaserScan(
        angle_min=-2.3,
        angle_max=2.3,
        angle_increment=4.6 / (BEAMS - 1),
        range_min=0.1,
        range_max=12.0,
        ranges=Float32Array(ranges.tolist()),
    )


def imu(number: int) -> Any:
    """A robot that turns by 3° from one message to the next, and rolls."""
    from bridge.msgs.geometry_msgs import Quaternion, Vector3
    from bridge.msgs.sensor_msgs import Imu

    half, roll = number * 0.026, 0.1 * math.sin(number * 0.3)
    way = Quaternion(roll * math.cos(half), roll * math.sin(half), math.sin(half), math.cos(half))
    return Imu(orientation=way, angular_velocity=Vector3(0.0, 0.0, math.sin(number * 0.1)))


def odometry(number: int) -> Any:
    """A speed that changes."""
    from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance
    from bridge.msgs.nav_msgs import Odometry

    return Odometry(twist=TwistWithCovariance(Twist.planar(math.sin(number * 0.1), 0.1)))


def ours() -> dict[str, tuple[Make, Message, tuple[int, int]]]:
    """What is measured: the widget, its messages and its size [px]."""
    import widgets

    return {
        "laser": (lambda: widgets.LaserScanView(state="live"), scan, (326, 228)),
        "compass": (lambda: widgets.Compass(state="live"), imu, (260, 260)),
        "horizon": (lambda: widgets.ArtificialHorizon(state="live"), imu, (260, 260)),
        "heading_tape": (lambda: widgets.HeadingTape(state="live"), imu, (420, 52)),
        "turn_tape": (lambda: widgets.TurnTape(state="live"), imu, (320, 150)),
        "plot": (
            lambda: widgets.Plot(state="live", paths=["twist.twist.linear.x"], capacity=KEPT),
            odometry,
            (400, 220),
        ),
    }


def naive() -> dict[str, tuple[Make, Message, tuple[int, int]]]:
    """The same pictures as a beginner draws them: the canvas is cleared and filled with instructions at every message."""
    from bench.support import naive_widgets as naively

    return {
        "laser": (naively.Laser, scan, (326, 228)),
        "compass": (naively.Compass, imu, (260, 260)),
        "horizon": (naively.Horizon, imu, (260, 260)),
        "heading_tape": (naively.Tape, imu, (420, 52)),
        "turn_tape": (naively.Scales, imu, (320, 150)),
        "plot": (naively.Plot, odometry, (400, 220)),
    }


class Glass:
    """The window, and frames in it."""

    def __init__(self) -> None:
        from kivy.base import EventLoop
        from kivy.clock import Clock
        from kivy.core.window import Window

        EventLoop.start()
        Clock._max_fps = 0  # noqa: SLF001 - no waiting between frames
        self.window, self._loop = Window, EventLoop

    def show(self, made: Sequence[tuple[Any, tuple[int, int]]]) -> None:
        """Only these widgets."""
        for child in self.window.children[:]:
            self.window.remove_widget(child)
        for number, (widget, size) in enumerate(made):
            widget.size_hint, widget.size = (None, None), size
            widget.pos = (number % 6) * 200, (number // 6) * 150
            self.window.add_widget(widget)
        self.frames(3)

    def frames(self, count: int = 1) -> None:
        """So many."""
        for _ in range(count):
            self._loop.idle()

    def cost(self, steps: Callable[[int], object], count: int, runs: int) -> float:
        """Of one step with its frame, less a frame alone, the least of so many runs [ms]."""
        for number in range(WARM_UP):
            steps(number)
            self.frames()
        found = []
        for _ in range(runs):
            start = time.thread_time()
            for number in range(count):
                steps(number)
                self.frames()
            full = time.thread_time() - start
            start = time.thread_time()
            self.frames(count)
            found.append((full - (time.thread_time() - start)) / count * 1e3)
        return min(found)


def costs(
    glass: Glass, cases: dict[str, tuple[Make, Message, tuple[int, int]]], count: int, runs: int
) -> Iterator[tuple[str, float]]:
    """Name and cost of each case alone, of thirty of them at once in a frame, and of a frame in which nothing changes."""
    for name, (make, message, size) in cases.items():
        widget, told = make(), [message(number) for number in range(UPDATES)]
        glass.show([(widget, size)])

        def step(number: int, widget: Any = widget, told: Sequence[Any] = told) -> None:
            widget.show(told[number])

        yield name, glass.cost(step, count, runs)
    light = [case for name, case in cases.items() if name != "laser"]
    wall = [light[number % len(light)] for number in range(LIVE)]
    shown = [(make(), size) for make, _, size in wall]
    glass.show(shown)
    told_all = {message: [message(number) for number in range(UPDATES)] for _, message, _ in light}

    def all_of_them(number: int) -> None:
        # as messages come: each widget's own stream is at most ten a second, and a frame has its share of them
        for place, ((widget, _), (_, message, _)) in enumerate(zip(shown, wall, strict=True)):
            if (number + place) % 6 == 0:
                widget.show(told_all[message][number])

    yield "thirty", glass.cost(all_of_them, count, runs)
    start = time.thread_time()
    glass.frames(IDLE_FRAMES)
    yield "idle", (time.thread_time() - start) / IDLE_FRAMES * FRAME_RATE * 100


def growth(glass: Glass) -> float:
    """Memory that 100 000 updates leave behind [kB]."""
    import gc

    cases = {name: case for name, case in ours().items() if name != "laser"}
    made = [(make(), size) for make, _, size in cases.values()]
    told = [[message(number) for number in range(100)] for _, message, _ in cases.values()]
    glass.show(made)

    def run(count: int) -> None:
        for number in range(count // len(made)):
            for (widget, _), messages in zip(made, told, strict=True):
                widget.show(messages[number % 100])
            if number % 4 == 0:
                glass.frames()

    run(GROWTH_WARM_UP)
    gc.collect()
    tracemalloc.start()
    run(GROWTH_WARM_UP)
    gc.collect()
    before = tracemalloc.get_traced_memory()[0]
    run(GROWTH_UPDATES)
    gc.collect()
    after = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    return (after - before) / 1e3


def main(arguments: Sequence[str]) -> int:
    """Print what was found."""
    glass = Glass()
    if arguments[0] == "ours":
        found = dict(costs(glass, ours(), UPDATES, RUNS))
    else:
        found = dict(costs(glass, naive(), NAIVE_UPDATES, 2))
    if arguments[0] == "ours":
        found["growth"] = growth(glass)
    print(json.dumps(found), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
