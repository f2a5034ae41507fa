"""Red circle that leans the robot, moved by a finger or by the tablet's tilt; in the green ring the robot is level.

tilt = TiltCircle(max_tilt=0.35)
tilt.bind(on_command=lambda _, manoeuvre: drive.command(manoeuvre))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.controls.sticks.tilt_stick import TiltStick
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.language import tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.labels import spaced
from widgets.parts.sensor_card import Gauge, first_fitting

__all__ = ["TiltCircle", "samples"]

WIDE = 1.3
"""From this share of its height on it is wide enough for figures beside the round."""


class TiltCircle(TiltStick, Gauge):
    """The stick as a red circle within a round, with words for what it commands."""

    drawn_from: ClassVar[tuple[str, ...]] = (
        "forward",
        "left",
        "aside",
        "ahead",
        "max_tilt",
        "needs_hold",
        "held",
        "opened",
        "missing",
        "dead",
        "in_shares",
        "badge",
        "state",
    )

    opened = StringProperty("")
    """Why it commands nothing though it is held, in a few words; empty when it does."""
    missing = StringProperty("")
    """Why no tablet can tilt it, as a sentence; empty where one can. It looks disabled then, whoever else may push it."""
    in_shares = BooleanProperty(False)
    """What it drives does not lean: the words show shares of full command instead of degrees."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": tr("Tilt"), "card": False, **kwargs})
        for name in ("size", "card", "title", "missing"):
            self.fbind(name, self._round_veil)
        self._round_veil()

    def _round_veil(self, *_: object) -> None:
        self.veil_radius = theme.radius if self._veils_all else self.round[2]

    def _veil_box(self) -> tuple[float, float, float, float]:
        """The round alone, lest it were a box of its own on a picture; the words below fade by themselves."""
        if self._veils_all:
            return super()._veil_box()
        (x, y, radius), rim = self.round, theme.outline
        return x - radius - rim, y - radius - rim, 2 * (radius + rim), 2 * (radius + rim)

    veil_box = AliasProperty(_veil_box, bind=["pos", "size", "card", "title", "missing"])

    @property
    def _veils_all(self) -> bool:
        """Its words fade with it, unless they say why it is disabled."""
        return bool((self.card or self.wide) and not self.missing)

    def _veil(self) -> list[float]:
        led = self.forward or self.left
        state = (
            "disabled"
            if self.missing and self.needs_hold and self.state == "live" and not led
            else self.state
        )
        return [*theme.surface[:3], 0.0 if self.bare else self.veils.get(state, 0.0)]

    veil = AliasProperty(_veil, bind=["state", "missing", "needs_hold", "forward", "left", "bare"])

    @property
    def wide(self) -> bool:
        """Figures stand beside the round, and not below it."""
        return bool(self.width >= WIDE * self.height)

    @property
    def round(self) -> tuple[float, float, float]:
        """Middle and radius of the round [px]."""
        x, y, right, top = (
            self.x + self.edge,
            self.y + self.edge,
            self.right - self.edge,
            self.top - self.edge,
        )
        if self.wide:
            radius = (top - y) / 2
            return right - radius, self.center_y, radius
        y += sp(20) if self.title else 0.0
        return (x + right) / 2, (y + top) / 2, max(min(right - x, top - y) / 2, 1.0)

    @property
    def knob_radius(self) -> float:
        """Of the red circle [px]."""
        return min(self.round[2] * 0.22, theme.target / 2)

    @property
    def middle(self) -> tuple[float, float]:
        """Of the round."""
        return self.round[:2]

    @property
    def travel(self) -> tuple[float, float]:
        """The same to all sides."""
        reach = max(1.0, self.round[2] - self.knob_radius - dp(3))
        return reach, reach

    @property
    def knob_pos(self) -> tuple[float, float]:
        """The circle's middle [px]."""
        (x, y), (across, up) = self.middle, self.travel
        return x + self.aside * across, y + self.ahead * up

    def holds(self, x: float, y: float) -> bool:
        """On the round."""
        return math.dist((x, y), self.middle) <= self.round[2]

    def draw(self) -> None:
        """In the gauge's way."""
        Gauge.draw(self)

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The pad, the neutral ring, the circle, and what it commands in words."""
        x, y, radius = self.round
        if self.bare:
            shapes.ring(x, y, radius - dp(2), dp(4), tint(theme.surface, 0.3))
            shapes.ring(x, y, radius - dp(2), dp(1.5), self.glassy(theme.text))
        else:
            shapes.disc(x, y, radius, tint(theme.raised, 0.92))
            shapes.ring(x, y, radius - dp(0.75), dp(1.5), theme.line)
            shapes.ring(x, y, radius * 0.5, dp(1.2), theme.line, dashes=40)
        cross = np.array([[x - radius, y], [x, y - radius]]), np.array([[x + radius, y], [x, y + radius]])
        shapes.segments(*cross, dp(1), tint(theme.muted, 0.35))
        level = not (self.roll or self.pitch)
        idle = self.needs_hold and (not self.held or bool(self.opened)) and not (self.forward or self.left)
        knob = self.knob_pos
        if idle or (self.bare and level and not (self.forward or self.left)):
            rim = theme.muted if self.missing or (self.bare and self.state == "disabled") else theme.danger
            shapes.ring(*knob, self.knob_radius - dp(1.5), dp(3), rim)
        else:
            shapes.disc(*knob, self.knob_radius, theme.danger)
        ring = self.knob_radius + self.dead * self.travel[0]
        lies_dead = self.missing and self.needs_hold and idle
        shapes.ring(x, y, ring, dp(3 if level else 2), theme.muted if lies_dead else theme.ok)
        if self.wide:
            yield from self._beside(x - radius)
        elif self.title and not self.badge:
            yield from self._below(shapes, x, y - radius - sp(13))

    def _below(self, shapes: Shapes, x: float, y: float) -> Iterator[Word]:
        """What it commands in a line, or its name."""
        room = self.width - 2 * self.edge - dp(6)
        told = self._command_words()
        words = (told,) if told else self._idle_words()
        size = sp(13)
        role = (
            "faint"
            if self.disabled and not self.card and not self.missing
            else "text"
            if told or self.missing
            else "muted"
        )
        word = Word(first_fitting(words, size, room), x, y, size, theme.roles[role])
        if not self.card and word.text:
            ground(shapes, word, tint(theme.bg, 0.7))
        yield word

    def _command_words(self) -> str:
        """What it commands, as in `12° ahead · 5° left` or `40\u00a0% ahead`; empty where that is nothing, or next to it."""
        if self.in_shares:
            shares = (
                (100 * self.forward, tr("ahead"), tr("back", context="way")),
                (-100 * self.left, tr("right"), tr("left")),
            )
            parts = [
                f"{abs(part):.0f}\u00a0% {plus if part > 0 else minus}"
                for part, plus, minus in shares
                if abs(part) >= 1
            ]
        else:
            leans = (
                (self.pitch, tr("ahead"), tr("back", context="way")),
                (self.roll, tr("right"), tr("left")),
            )
            parts = [_lean_text(*lean) for lean in leans]
        return " · ".join(part for part in parts if part)

    def _idle_words(self) -> tuple[str, ...]:
        name = spaced(self.title.upper())
        if self.needs_hold and self.missing:
            return (self.missing, tr("No motion sensor"), tr("No sensor"))
        if self.needs_hold and self.held and self.opened:
            return (self.opened, tr("let go"))
        if self.needs_hold and not self.held and not self.disabled:
            return (tr("{name} · hold it to tilt").format(name=name), tr("hold to tilt"), self.title)
        return (name, self.title.upper())

    def _beside(self, end: float) -> Iterator[Word]:
        """Name, pitch and roll one under the other, to the left of the round that begins at `end` [px]."""
        left, high = self.x + self.edge, self.height - 2 * self.edge
        room = end - left - dp(8)
        top = self.top - self.edge - sp(7)
        yield Word(
            first_fitting(self._idle_words(), sp(11.5), room),
            left,
            top,
            sp(11.5),
            theme.muted,
            anchor=(0, 0.5),
        )
        size = min(sp(26), room / 3.2)
        step = min(high * 0.36, sp(62))
        middle = self.center_y - sp(6)
        rows = (
            (tr("pitch"), self.pitch, tr("ahead"), tr("back", context="way"), middle + step / 2),
            (tr("roll"), self.roll, tr("right"), tr("left"), middle - step / 2),
        )
        for name, angle, plus, minus, y in rows:
            figure = _figure(angle)
            side = tr("level") if not angle else plus if angle > 0 else minus
            yield Word(name.upper(), left, y + size * 0.55 + sp(6), sp(11.5), theme.muted, anchor=(0, 0.5))
            yield Word(figure, left, y, size, theme.text, bold=True, anchor=(0, 0.5))
            yield Word(side, left, y - size * 0.55 - sp(6), sp(13), theme.muted, anchor=(0, 0.5))


def _figure(angle: float) -> str:
    return f"{abs(math.degrees(angle)):.0f}°"


def _lean_text(angle: float, plus: str, minus: str) -> str:
    """As in `12° ahead`; empty for less than half a degree."""
    return "" if abs(angle) < math.radians(0.5) else f"{_figure(angle)} {plus if angle > 0 else minus}"


def samples() -> dict[str, Callable[[], Widget]]:
    """Level, leaned each way, at the rim, only while held, on a card, disabled; small and large."""

    def make(
        roll: float = 0.0, pitch: float = 0.0, size: tuple[float, float] = (176, 176), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            circle = TiltCircle(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            circle.tilt(math.radians(roll), math.radians(pitch))
            return circle

        return build

    return {
        "level": make(),
        "ahead to the right": make(5, 12),
        "back": make(0, -8),
        "at the rim": make(-40, 15),
        "not held": make(6, 4, needs_hold=True, title="Tablet tilt"),
        "held": make(6, 9, needs_hold=True, clutched=True, dead=0.16, title="Tablet tilt"),
        "held by one who walks": make(0, 14, needs_hold=True, clutched=True, dead=0.32, in_shares=True),
        "opened": make(opened="beyond 50°", needs_hold=True, clutched=True, title="Tablet tilt"),
        "no sensor": make(needs_hold=True, missing="This computer has no motion sensor.", title="Tilt"),
        "no sensor, card": make(
            size=(326, 228),
            card=True,
            needs_hold=True,
            missing="This computer has no motion sensor.",
            title="Tilt",
        ),
        "card": make(5, 12, card=True, title="Tablet tilt"),
        "large": make(5, 12, size=(326, 228), card=True, title="Tablet tilt"),
        "large level": make(size=(326, 228), card=True, title="Tablet tilt"),
        "gamepad": make(5, 12, gamepad="drives"),
        "tall": make(5, 12, size=(228, 326), card=True, title="Tablet tilt"),
        "untitled": make(5, 12, title=""),
        "over a picture": make(bare=True, title=""),
        "over a picture, leaned": make(5, 12, bare=True, title=""),
        "stale": make(5, 12, state="stale", age=2.0),
        "alarm": make(5, 12, state="alarm", card=True),
        "disabled": make(state="disabled"),
    }
