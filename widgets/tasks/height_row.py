"""The height or depth of a mission's points: one control, for the selected point or for all of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from bridge.msgs.pilothouse_msgs import RobotInfo
from widgets.core.language import tr
from widgets.parts.stepper import Stepper

__all__ = ["MAX_HEIGHT", "HeightRow"]

MAX_HEIGHT = 120.0
"""Height and depth that can be asked for [m]; what the robot itself allows it says."""

Builder.load_string("""
<HeightRow>:
    size_hint_y: None
    height: max(theme.target, dp(46)) if root.levels else 0
    opacity: 1 if root.levels else 0
    disabled: not root.levels
    spacing: dp(8)
    Text:
        text: root.title
        pos_hint: {'center_y': .5}
""")


class HeightRow(BoxLayout):
    """Counts the height of the points up and down; zero leaves it to the robot. Away for a robot that keeps no height."""

    levels = BooleanProperty(False)
    """The robot flies or dives, and there are points."""
    deep = BooleanProperty(False)
    """It dives: what is counted is a depth."""
    index = NumericProperty(-1)
    """Of the point that it is about, from 0; -1 for all."""
    title = StringProperty("")

    def __init__(self, change: Callable[[float | None, int], object]) -> None:
        """`change` is called with a height above the map's origin [m], None for none, and the point's index, -1 for all."""
        super().__init__()
        self._change = change
        self.stepper = Stepper(step=0.5, maximum=MAX_HEIGHT, kind="height", pos_hint={"center_y": 0.5})
        self.stepper.bind(on_change=self._changed)
        self.add_widget(self.stepper)

    def show(self, heights: Sequence[float | None], selected: int, info: RobotInfo) -> None:
        """Take over the `heights` of all points, with the one at `selected`, -1 for none, of the robot of `info`."""
        count = len(heights)
        self.levels, self.deep = bool(count and (info.flies or info.dives)), info.dives
        self.index = selected if 0 <= selected < count else -1
        levels = heights if self.index < 0 else (heights[self.index],)
        same = len(set(levels)) <= 1
        self.stepper.zero = tr("as it is") if same else tr("differ")
        height = levels[0] if levels and same else None
        self.stepper.value = abs(height) if height is not None else 0.0
        name = tr("Depth") if self.deep else tr("Height")
        which = tr("all points") if self.index < 0 else tr("Point {number}").format(number=self.index + 1)
        self.title = f"{name} · {which}"

    def _changed(self, _: Stepper, value: float) -> None:
        if not math.isfinite(value):
            return
        signed = -value if self.deep else value
        self._change(signed or None, int(self.index))
