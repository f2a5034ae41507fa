"""Buttons of a recording: the event before and after, play and pause, how fast."""

from __future__ import annotations

from typing import Any

from kivy.properties import BooleanProperty, NumericProperty
from kivy.uix.stacklayout import StackLayout

from app.replay.player import SPEEDS
from app.screens.replay.places import BUTTONS
from widgets.core.language import figure
from widgets.parts.kit import IconButton, PushButton, QuietButton

__all__ = ["Transport", "speed_text"]

SPACING = 6
"""Between buttons, and between rows [dp]."""


def speed_text(speed: float) -> str:
    """How many times as fast as it was, as in `0.5×`."""
    return f"{figure(speed, 0 if speed == round(speed) else 1)}×"


class Transport(StackLayout):
    """In two rows where one is too narrow. Dispatches `on_play`, `on_step(way)` with 1 or -1, and `on_pace(speed)`."""

    __events__ = ("on_play", "on_step", "on_pace")

    playing = BooleanProperty(False)
    speed = NumericProperty(1.0)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"spacing": f"{SPACING}dp", **kwargs})
        self.before = IconButton(icon="skip_previous")
        self.play = IconButton(icon="play_arrow", role="accent")
        self.after = IconButton(icon="skip_next")
        self.fast: PushButton = QuietButton(text=speed_text(1.0), size_hint_x=None, width="72dp")
        self.before.bind(on_release=lambda _: self.dispatch("on_step", -1))
        self.play.bind(on_release=lambda _: self.dispatch("on_play"))
        self.after.bind(on_release=lambda _: self.dispatch("on_step", 1))
        self.fast.bind(on_release=lambda _: self._next_speed())
        for button in (self.before, self.play, self.after, self.fast):
            self.add_widget(button)
        self.bind(playing=self._show, speed=self._show)

    def height_in(self, width: float, dp: float) -> float:
        """Height of one row, or of two where that is too narrow for one [px]."""
        rows = 1 if width >= BUTTONS * dp else 2
        return float(rows * self.play.height + (rows - 1) * SPACING * dp)

    def _show(self, *_: object) -> None:
        self.play.icon = "pause" if self.playing else "play_arrow"
        self.fast.text = speed_text(self.speed)

    def _next_speed(self) -> None:
        place = SPEEDS.index(self.speed) if self.speed in SPEEDS else 0
        self.dispatch("on_pace", SPEEDS[(place + 1) % len(SPEEDS)])

    def on_play(self) -> None:
        """A finger starts or pauses it."""

    def on_step(self, way: int) -> None:
        """A finger asks for the event after or before."""

    def on_pace(self, speed: float) -> None:
        """A finger asks for another speed."""
