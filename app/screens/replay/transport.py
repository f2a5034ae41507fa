"""Buttons of a recording: the event before and after, play and pause, how fast."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, NumericProperty
from kivy.uix.stacklayout import StackLayout

from app.replay.player import SPEEDS
from app.screens.replay.places import SPACING, buttons_width
from widgets.core.language import figure
from widgets.core.theme import theme
from widgets.parts.kit import IconButton, PushButton, QuietButton

__all__ = ["Transport", "speed_text", "without_date"]

Builder.load_string("""
<StepButton>:
    size: [max(dp(53), theme.least)] * 2
""")


def speed_text(speed: float) -> str:
    """How many times as fast as it was, as in `0.5×`."""
    return f"{figure(speed, 0 if speed == round(speed) else 1)}×"


def without_date(badge: str) -> str:
    """What says that this is the past, for a narrow glass: of a moment only the time of day."""
    word, dot, moment = badge.partition(" · ")
    return f"{word}{dot}{moment.rpartition(' ')[2]}"


class StepButton(IconButton):
    """As small as a button may be: four of them stand in a narrow place."""


class Transport(StackLayout):
    """In two rows where one is too narrow. Dispatches `on_play`, `on_step(way)` with 1 or -1, and `on_pace(speed)`."""

    __events__ = ("on_play", "on_step", "on_pace")

    playing = BooleanProperty(False)
    speed = NumericProperty(1.0)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"spacing": f"{SPACING}dp", **kwargs})
        self.before = StepButton(icon="skip_previous")
        self.play = StepButton(icon="play_arrow", role="accent")
        self.after = StepButton(icon="skip_next")
        self.fast: PushButton = QuietButton(text=speed_text(1.0), size_hint=(None, None))
        self.play.bind(size=lambda _, size: setattr(self.fast, "size", (max(size[0], dp(72)), size[1])))
        self.fast.size = max(self.play.width, dp(72)), self.play.height
        self.before.bind(on_release=lambda _: self.dispatch("on_step", -1))
        self.play.bind(on_release=lambda _: self.dispatch("on_play"))
        self.after.bind(on_release=lambda _: self.dispatch("on_step", 1))
        self.fast.bind(on_release=lambda _: self._next_speed())
        for button in (self.before, self.play, self.after, self.fast):
            self.add_widget(button)
        self.bind(playing=self._show, speed=self._show)

    def height_in(self, width: float, density: float) -> float:
        """Height of one row, or of two where that is too narrow for one [px]."""
        rows = 1 if width >= buttons_width(theme.least, density) else 2
        return float(rows * self.play.height + (rows - 1) * SPACING * density)

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
