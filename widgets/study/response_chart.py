"""Response times: a bar for each method of a command, to its median, with the middle half of all times as a line.

chart = ResponseChart(title="Until it was sent")
chart.times = [("STOP", "mic", "Voice", 0.52, 0.41, 0.77, 10)]
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import groupby
from typing import Any, ClassVar

from kivy.metrics import dp
from kivy.properties import ListProperty
from kivy.uix.widget import Widget

from widgets.study.bar_rows import Bar, BarRows, Group, nice_step

__all__ = ["ResponseChart", "samples"]

MIN_SCALE = 0.5
"""The scale goes at least so far [s]: a quick answer is not drawn as a slow one."""


class ResponseChart(BarRows):
    """Groups of bars like a figure of response times in a paper, turned so that each has a line of its own."""

    drawn_from: ClassVar[tuple[str, ...]] = ("times", *BarRows.drawn_from)

    legends: ClassVar[tuple[str, ...]] = (
        "median · how many; line: the middle half",
        "median, line: the middle half",
        "median, line: middle half",
        "line: middle half",
    )

    times = ListProperty()
    """Command, icon and name of the method, median, lower and upper quartile [s], and how many; those of one command together."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": "Response time", "nothing": "No response times yet.", **kwargs})
        self.fbind("times", self.fit)

    def groups(self) -> list[Group]:
        """A group for each command."""
        return [
            Group(command, [self._bar(one) for one in those])
            for command, those in groupby(self.times, key=lambda one: one[0])
        ]

    @staticmethod
    def _bar(one: tuple[str, str, str, float, float, float, int]) -> Bar:
        _, icon, name, median, low, high, count = one
        return Bar(icon, name, median, low, high, f"{median:.2f} s · {count}")

    def scale(self) -> tuple[float, float]:
        """A little farther than the slowest quarter begins."""
        full = max([MIN_SCALE, *(one[5] for one in self.times), *(one[3] for one in self.times)]) * 1.02
        step = nice_step(full)
        return max(full, step), step

    def tick(self, value: float) -> str:
        """In seconds."""
        return f"{value:g} s"


def samples() -> dict[str, Callable[[], Widget]]:
    """Few and many times, wide and narrow, and none."""
    methods = (
        ("touch_app", "Buttons", 0.19),
        ("mic", "Voice", 0.62),
        ("mobile_vibrate", "Shake", 1.27),
        ("radio_button_checked", "Switches", 1.9),
    )
    commands = (("STOP", 0.8), ("Pause", 1.0), ("Resume", 1.06), ("Patrol", 1.2), ("Go home", 1.12))

    def made(many: int, width: float = 720, count: int = 10, **more: Any) -> Callable[[], Widget]:
        times = [
            (command, icon, name, took * by, took * by * 0.8, took * by * 1.4, count)
            for command, by in commands[:many]
            for icon, name, took in methods
        ]
        return lambda: ResponseChart(
            times=times, size_hint=(None, None), width=dp(width), **{"state": "live", **more}
        )

    return {
        "never": made(0, state="never"),
        "live": made(3),
        "many": made(5, 900),
        "narrow": made(2, 300),
        "stale": made(1, state="stale", age=12.0),
        "alarm": made(1, state="alarm"),
        "disabled": made(1, state="disabled"),
    }
