"""Rotors seen from above: the speed of each and the temperature of its motor.

rotors = RotorSpeeds()
robot.on("/motors", rotors.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import ListProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import MotorArray
from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import DASH, Points
from widgets.core.icons import icon
from widgets.core.language import figure, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.map_marks import arrow
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["RotorSpeeds", "samples"]

RPM = 60 / math.tau
"""Turns a minute to a radian a second."""
STOPPED, TURNING = 20.0, 100.0
"""A rotor slower than the first stands, when others are faster than the second [rad/s]."""
USUAL = ("front_left", "front_right", "rear_left", "rear_right")
"""Rotors that are drawn before the first report."""
MAX_ROTORS = 8
"""Rotors that have room."""
SWEEP = math.radians(270)
"""Of the scale round each rotor, from lower left clockwise to lower right."""


class RotorSpeeds(Gauge):
    """A disc for each rotor with a scale round it, ahead is up; the figures are turns a minute."""

    accepts: ClassVar = (MotorArray,)
    drawn_from: ClassVar = ("rotors", "full", "warm", "hot")

    rotors: ListProperty[tuple[str, float, float]] = ListProperty()
    """Name, speed [rad/s] and temperature [degC] of each; NaN for what is not measured. Empty before the first."""
    full = NumericProperty(500.0)
    """Speed of a full scale [rad/s]: the fastest that was seen, if that is more."""
    warm = NumericProperty(70.0)
    """From here on a motor is too warm to go on like this for long [degC]."""
    hot = NumericProperty(90.0)
    """From here on it must rest [degC]."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": tr("Rotors"), **kwargs})

    def show(self, msg: MotorArray) -> None:
        """Show the newest speeds and temperatures."""
        told = [
            (name, _at(msg.speeds, number), _at(msg.temperatures, number))
            for number, name in enumerate(msg.names[:MAX_ROTORS])
        ]
        fastest = max((abs(speed) for _, speed, _ in told if math.isfinite(speed)), default=0.0)
        self.full = max(self.full, fastest)
        self.rotors = told

    def stands(self, speed: float) -> bool:
        """A rotor of this speed [rad/s] stands still while another turns."""
        turning = any(abs(other) > TURNING for _, other, _ in self.rotors)
        return turning and abs(speed) < STOPPED

    def role(self, speed: float, warmth: float) -> str:
        """Role of the colour of a rotor of this speed [rad/s] and temperature [degC]."""
        if self.stands(speed) or warmth >= self.hot:
            return "danger"
        return "warn" if warmth >= self.warm else "accent"

    def _trouble(self) -> tuple[str, str]:
        """What is wrong, in a word, and the role of its colour; empty when nothing is."""
        if any(self.stands(speed) for _, speed, _ in self.rotors):
            return tr("stopped"), "danger"
        known = [warmth for *_, warmth in self.rotors if math.isfinite(warmth)]
        if known and max(known) >= self.warm:
            return (tr("hot"), "danger") if max(known) >= self.hot else (tr("warm"), "warn")
        return "", "muted"

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The frame, the rotors at its ends, and what is wrong."""
        rotors = [*self.rotors] or [(name, math.nan, math.nan) for name in USUAL]
        if self.low:
            yield self._brief()
            return
        trouble, role = self._trouble()
        figures = (tr("one stopped"), trouble) if trouble == tr("stopped") else (trouble,)
        yield from self.header(figures if trouble else (tr("rpm"),), role if trouble else "muted", told=False)
        bottom, top = self.y + self.edge, self.top - self.edge - sp(12) - dp(4)
        room, high = self.width - 2 * self.edge, top - bottom
        x, y = self.center_x, (bottom + top) / 2
        places = _places([name for name, *_ in rotors])
        radius = min(high / 4, room / 4) * 0.94 if len(rotors) <= 4 else min(high, room) / 7
        across, up = room / 2 - radius, high / 2 - radius
        across, up = min(across, 1.5 * up), min(up, 1.5 * across)
        at = places * (across, up) + (x, y)
        middle = np.repeat(np.array([[x, y]]), len(at), axis=0)
        shapes.segments(middle, at, max(dp(3), radius * 0.1), theme.line)
        hub = max(dp(9), radius * 0.3)
        shapes.disc(x, y, hub, theme.raised)
        shapes.ring(x, y, hub, dp(1.5), theme.line)
        shapes.polygon(arrow(x, y, math.pi / 2, hub * 0.8), theme.text)
        for rotor, (rx, ry) in zip(rotors, at, strict=True):
            yield from self._rotor(shapes, rotor, (float(rx), float(ry), radius))

    def _rotor(
        self, shapes: Shapes, rotor: tuple[str, float, float], place: tuple[float, float, float]
    ) -> Iterator[Word]:
        (_, speed, warmth), (x, y, radius) = rotor, place
        role = self.role(speed, warmth)
        thick = max(dp(4), radius * 0.13)
        shapes.disc(x, y, radius, theme.raised)
        shapes.line(_arc(x, y, radius - thick / 2, 1.0), thick, tint(theme.muted, 0.3))
        share = min(abs(speed) / self.full, 1.0) if math.isfinite(speed) else 0.0
        if share > 0.005:
            shapes.line(_arc(x, y, radius - thick / 2, share), thick, theme.roles[role])
        elif self.stands(speed):
            shapes.ring(x, y, radius - thick / 2, thick, theme.danger)
        told = figure(round(speed * RPM, -1), 0) if math.isfinite(speed) else DASH
        inside = 2 * (radius - thick) * 0.86
        size = min(sp(20), radius * 0.52)
        size = min(size, size * inside / max(wide(told, size, bold=True), 1.0))
        roomy = radius >= dp(27)
        lift = size * 0.22 if roomy else 0.0
        yield Word(
            told, x, y + lift, size, theme.roles["danger" if self.stands(speed) else "text"], bold=True
        )
        if role in ("danger", "warn"):
            sign = icon("warning_fill" if role == "danger" else "thermostat")
            yield Word(sign, x, y - radius * 0.74, sp(15), theme.roles[role], font=theme.icons)
        if roomy and math.isfinite(warmth):
            small = max(min(size * 0.62, sp(13)), sp(10.5))
            colour = theme.muted if warmth < self.warm else theme.roles[role]
            yield Word(f"{figure(warmth, 0)} °C", x, y - size * 0.62, small, colour, bold=warmth >= self.warm)

    def _brief(self) -> Word:
        """The mean of them in a line, or what is wrong."""
        trouble, role = self._trouble()
        known = [abs(speed) for _, speed, _ in self.rotors if math.isfinite(speed)]
        room = self.width - 2 * self.edge
        if trouble:
            text = first_fitting(
                (tr("a rotor is {trouble}").format(trouble=trouble), trouble), sp(14), room, bold=True
            )
            return Word(text, *self.center, sp(14), theme.roles[role], bold=True)
        if not known:
            return Word(DASH, *self.center, sp(14), theme.muted)
        told = figure(round(sum(known) / len(known) * RPM, -1), 0)
        text = first_fitting(
            (tr("rotors {speed} rpm").format(speed=told), f"{told} {tr('rpm')}", told),
            sp(14),
            room,
            bold=True,
        )
        return Word(text, *self.center, sp(14), theme.text, bold=True)


def _at(values: Float64Array, number: int) -> float:
    """Rounded to what is shown; NaN where the message has fewer, as it may."""
    told = float(values[number]) if number < len(values) else math.nan
    return float(round(told)) if math.isfinite(told) else math.nan


def _places(names: list[str]) -> Points:
    """Where each rotor is, -1 to 1 to the right and ahead: by its name, or all of them round a ring."""
    known = []
    for name in names:
        words = name.lower().split("_")
        aside = 1 if "right" in words else -1 if "left" in words else 0
        ahead = 1 if "front" in words else -1 if "rear" in words or "back" in words else 0
        known.append((aside, ahead))
    if len(set(known)) == len(known) and all(aside and ahead for aside, ahead in known):
        return np.array(known, dtype=np.float64)
    turns = math.pi / 2 + math.tau * (0.5 - np.arange(len(names))) / max(len(names), 1)
    return np.stack([np.cos(turns), np.sin(turns)], axis=1)


def _arc(x: float, y: float, radius: float, share: float) -> Points:
    """So much of the scale round (x, y) [px], from its lower left end."""
    angles = math.pi / 2 + SWEEP / 2 - np.linspace(0.0, share * SWEEP, max(int(40 * share), 3))
    return np.stack([x + np.cos(angles) * radius, y + np.sin(angles) * radius], axis=1)


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""
    names = ["front_left", "front_right", "rear_right", "rear_left"]
    hover, warmth = (361.0, 372.0, 358.0, 349.0), (27.0, 28.0, 27.0, 26.0)

    def made(
        speeds: tuple[float, ...] = hover,
        warm: tuple[float, ...] = warmth,
        size: tuple[float, float] = (176, 176),
        **more: Any,
    ) -> Callable[[], Widget]:
        def build() -> RotorSpeeds:
            view = RotorSpeeds(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if speeds:
                named = names if len(speeds) == 4 else [f"motor{number}" for number in range(len(speeds))]
                view.show(
                    MotorArray(names=named, speeds=Float64Array(speeds), temperatures=Float64Array(warm))
                )
            return view

        return build

    nan = math.nan
    return {
        "never": made(()),
        "live": made(state="live"),
        "at rest": made((0.0,) * 4, (21.0,) * 4, state="live"),
        "warm": made(warm=(27.0, 74.0, 27.0, 26.0), state="live"),
        "hot": made(warm=(27.0, 74.0, 27.0, 95.0), state="live"),
        "stopped": made((361.0, 0.0, 480.0, 349.0), state="live"),
        "not measured": made((361.0, nan, 358.0, 349.0), (27.0, 28.0, nan, 26.0), state="live"),
        "six": made((361.0, 372.0, 358.0, 349.0, 355.0, 360.0), (27.0,) * 6, state="live"),
        "large": made(size=(326, 228), state="live"),
        "large never": made((), size=(326, 228)),
        "tall": made(size=(176, 300), state="live"),
        "low": made(size=(128, 44), state="live"),
        "small": made(size=(120, 120), state="live"),
        "stale": made(state="stale", age=2.0),
        "alarm": made(state="alarm"),
        "disabled": made(state="disabled"),
    }
