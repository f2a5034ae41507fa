"""Success of each method: a bar to the share, its interval as a line on it, and the result of a paper.

bars = SuccessBars(title="Understood")
bars.rates = [("mic", "Voice", 46, 50, 0.812, 0.968, 0.775)]
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

from kivy.metrics import dp
from kivy.properties import ListProperty
from kivy.uix.widget import Widget

from widgets.study.bar_rows import Bar, BarRows, Group

__all__ = ["SuccessBars", "samples"]


class SuccessBars(BarRows):
    """A row for each method, from 0 to 100 %."""

    drawn_from: ClassVar[tuple[str, ...]] = ("rates", *BarRows.drawn_from)

    rates = ListProperty()
    """Icon and name of the method, hits, trials, low and high end of the interval (0 to 1), and the share to compare with,
    NaN for none."""

    def __init__(self, **kwargs: Any) -> None:
        given = {"title": "Success", "nothing": "No trials yet.", "compared": "in the paper"}
        super().__init__(**{**given, **kwargs})
        self.fbind("rates", self.fit)

    def groups(self) -> list[Group]:
        """All in one."""
        return [Group("", [self._bar(one) for one in self.rates])] if self.rates else []

    @staticmethod
    def _bar(one: tuple[str, str, int, int, float, float, float]) -> Bar:
        icon, name, hits, trials, low, high, mark = one
        if not trials:
            return Bar(icon, name, math.nan, math.nan, math.nan, "—", mark)
        return Bar(
            icon, name, hits / trials, low, high, f"{hits / trials * 100:.0f} % · {hits}/{trials}", mark
        )

    def scale(self) -> tuple[float, float]:
        """All of it, in quarters."""
        return 1.0, 0.25

    def tick(self, value: float) -> str:
        """In per cent."""
        return f"{value * 100:.0f} %"


def samples() -> dict[str, Callable[[], Widget]]:
    """Some methods, one that was not tried, narrow and none."""
    some = [
        ("touch_app", "Buttons", 50, 50, 0.929, 1.0, 1.0),
        ("mic", "Voice", 46, 50, 0.812, 0.968, 0.775),
        ("mobile_vibrate", "Shake", 27, 30, 0.744, 0.965, 0.625),
        ("radio_button_checked", "Switches", 10, 10, 0.722, 1.0, math.nan),
        ("screen_rotation_alt", "Tilt", 0, 0, 0.0, 1.0, math.nan),
    ]

    def made(rates: list[tuple[Any, ...]], width: float = 640, **more: Any) -> Callable[[], Widget]:
        return lambda: SuccessBars(
            rates=rates, size_hint=(None, None), width=dp(width), **{"state": "live", **more}
        )

    return {
        "never": made([], state="never"),
        "live": made(some),
        "narrow": made(some, 300),
        "stale": made(some[:2], state="stale", age=12.0),
        "alarm": made(some[:2], state="alarm"),
        "disabled": made(some[:2], state="disabled"),
    }
