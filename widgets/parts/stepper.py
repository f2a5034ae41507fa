"""Stepper: a number that is counted up and down."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.properties import (
    AliasProperty,
    NumericProperty,
    StringProperty,
)
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from widgets.core.finger_stay import FingerStay
from widgets.core.language import brief_figure
from widgets.core.quantities import from_shown, round_floor, said, to_shown
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme
from widgets.parts.labels import Icon

__all__ = ["Stepper"]

REPEAT_AFTER, REPEAT_EVERY = 0.45, 0.12
"""A held plus or minus goes on counting [s]."""

Builder.load_string("""
<Stepper>:
    size_hint: None, None
    height: max(dp(40), theme.target * (1 if theme.gloves else .78))
    width: self.height * 2 + max(figures.texture_size[0], dp(44))
    corner: self.height / 2
    StepperEnd:
        step: -1
        name: 'remove'
        size: root.height, root.height
        role: 'text' if root.value > root.minimum and not root.disabled else 'faint'
        on_count: root.count(-1)
    Label:
        id: figures
        text: root.figures
        font_name: theme.font
        font_size: theme.size_body
        color: theme.faint if root.disabled else theme.text
        disabled_color: self.color
    StepperEnd:
        step: 1
        name: 'add'
        size: root.height, root.height
        role: 'text' if root.value < root.maximum and not root.disabled else 'faint'
        on_count: root.count(1)

<StepperEnd>:
    font_size: sp(22)
    canvas.before:
        Color:
            rgba: theme.text[:3] + [.14 if self.state == 'down' else 0]
        SmoothEllipse:
            pos: self.pos
            size: self.size
""")


class StepperEnd(ButtonBehavior, Icon):
    """The plus or the minus of a stepper: counts when pressed, and on while held."""

    __events__ = ("on_count",)

    step = NumericProperty(1)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._repeat = Clock.create_trigger(self._again, REPEAT_EVERY, interval=True)
        self._held = FingerStay(self._repeat, REPEAT_AFTER)

    def collide_point(self, x: float, y: float) -> bool:
        """It is hit within a whole target round it, though it looks smaller."""
        reach = max(0.0, theme.target - self.height) / 2
        return self.x - reach <= x <= self.right + reach and self.y - reach <= y <= self.top + reach

    def _again(self, _: float) -> None:
        self.dispatch("on_count")

    def on_press(self) -> None:
        """Count once, and wait whether the finger stays."""
        self.dispatch("on_count")
        self._held.begin()

    def on_state(self, _: object, state: str) -> None:
        """Stop counting when the finger has left."""
        if state == "normal":
            self._held.end()
            self._repeat.cancel()

    def on_count(self) -> None:
        """Once more."""


class Stepper(Outlined, BoxLayout):
    """A number between two ends, changed step by step; dispatches `on_change`."""

    __events__ = ("on_change",)

    value = NumericProperty(0)
    minimum = NumericProperty(0)
    maximum = NumericProperty(99)
    step = NumericProperty(1)
    unit = StringProperty("")
    kind = StringProperty("")
    """Kind of quantity, as in `widgets.core.quantities.KINDS`: `value`, its ends and `step` are in SI then, and what is shown and counted
    is in the operator's unit, which stands for `unit`; empty for a bare number."""
    zero = StringProperty("")
    """What to say instead of 0, as in `until stopped`; empty says 0."""

    def _figures(self) -> str:
        if self.zero and self.value == 0:
            return self.zero
        if self.kind:
            told = said(self.value, self.kind, max(0, -math.floor(math.log10(self.step) + 1e-9)))
            return f"{told.text} {told.unit}"
        # as it is written: nothing before the sign of degrees and of times
        gap = "" if self.unit in ("°", "×") else " "
        return f"{brief_figure(self.value)}{gap}{self.unit}".rstrip()

    figures = AliasProperty(_figures, bind=["value", "unit", "kind", "zero"], cache=True)

    def count(self, steps: int) -> None:
        """Go so many steps up or, below 0, down; stays between the ends."""
        further = self._counted(steps) if self.kind else self.value + steps * self.step
        wanted = max(self.minimum, min(self.maximum, further))
        if wanted != self.value:
            self.value = wanted
            self.dispatch("on_change", wanted)

    def _counted(self, steps: int) -> float:
        """So many round steps of the shown unit further, in SI."""
        step = round_floor(to_shown(self.step, self.kind))
        shown = (round(to_shown(self.value, self.kind) / step) + steps) * step
        return from_shown(round(shown, 9), self.kind)

    def on_change(self, value: float) -> None:
        """A finger set `value`."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Between its ends, at its end, disabled."""
    return {
        "between": lambda: Stepper(value=5, unit="s"),
        "at its end": lambda: Stepper(value=0, unit="laps", zero="until stopped"),
        "disabled": lambda: Stepper(value=5, unit="s", disabled=True),
    }
