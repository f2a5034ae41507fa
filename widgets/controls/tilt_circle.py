"""The red circle: where a finger holds it, or how the tablet is tilted, so the robot is to tilt. In the green ring it is level.

tilt = TiltCircle(max_tilt=0.35)
tilt.bind(on_command=lambda _, manoeuvre: drive.command(manoeuvre))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import Manoeuvre
from widgets.controls.stick import Stick
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.labels import spaced
from widgets.parts.sensor_card import Gauge, first_fitting

__all__ = ["TiltCircle", "samples"]

NEUTRAL = 0.1
"""Of the way to the rim, round the middle: a hand that is not quite still commands nothing."""
WIDE = 1.3
"""From this share of its height on it is wide enough for figures beside the round."""


class TiltCircle(Stick, Gauge):
    """Dispatches `on_command(manoeuvre)` of the kind `tilt` at every change. Up is nose down, which is ahead for what flies.

    Where it `needs_hold` the tablet leads it, by `steer`, and the finger is the clutch; `on_let_go` tells that it was put to rest.
    """

    __events__ = ("on_let_go",)

    sends = (Manoeuvre,)
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

    max_tilt = NumericProperty(math.radians(20.0))
    """Roll and pitch together at the rim [rad], above 0."""
    aside = NumericProperty(0.0)
    """How far the circle is to the right, -1 to 1 at the rim; in the ring it commands nothing of that."""
    ahead = NumericProperty(0.0)
    """How far it is up, -1 to 1 at the rim."""
    needs_hold = BooleanProperty(False)
    """The tablet tilts it only while a finger is on it: the finger then says when, and not where to."""
    clutched = BooleanProperty(False)
    """A key or a switch holds it as a finger would."""
    held = BooleanProperty(False)
    """A finger, a key or a switch holds it."""
    opened = StringProperty("")
    """Why it commands nothing though it is held, in a few words; empty when it does."""
    missing = StringProperty("")
    """Why no tablet can tilt it, as a sentence; empty where one can. It looks disabled then, whoever else may push it."""
    dead = NumericProperty(NEUTRAL)
    """Within that share of the way to the rim nothing is commanded; drawn as the green ring."""
    in_shares = BooleanProperty(False)
    """What it drives does not lean: the words tell shares of full command instead of degrees."""

    def _roll(self) -> float:
        # + 0.0 turns the minus zero of a circle at rest into zero
        return -self.left * self.max_tilt + 0.0

    def _pitch(self) -> float:
        return self.forward * self.max_tilt

    roll = AliasProperty(_roll, bind=["left", "max_tilt"])
    """That it commands [rad], positive right side down."""
    pitch = AliasProperty(_pitch, bind=["forward", "max_tilt"])
    """That it commands [rad], positive nose down."""

    def __init__(self, **kwargs: Any) -> None:
        self._wanted = (0.0, 0.0)
        self._as_is = False
        super().__init__(**{"title": "Tilt", "card": False, **kwargs})
        self.fbind("clutched", self._hold)
        self._hold()
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
        return [*theme.surface[:3], self.veils.get(state, 0.0)]

    veil = AliasProperty(_veil, bind=["state", "missing", "needs_hold", "forward", "left"])

    @property
    def order(self) -> Manoeuvre:
        """What it commands now; climb and turn are others' to add."""
        return Manoeuvre(kind="tilt", roll=self._roll(), pitch=self._pitch())

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

    def shaped(self, forward: float, left: float) -> tuple[float, float]:
        """Nothing in the ring, never beyond the rim."""
        length = math.hypot(forward, left)
        scale = 0.0 if length < self.dead and not self._as_is else 1.0 / max(1.0, length)
        return forward * scale, left * scale

    def holds(self, x: float, y: float) -> bool:
        """On the round."""
        return math.dist((x, y), self.middle) <= self.round[2]

    def tilt(self, roll: float, pitch: float) -> bool:
        """Show that the tablet is tilted by `roll` and `pitch` [rad] from level, and command the same, no farther than the rim.

        False, and nothing is commanded, while it is disabled, while a finger leads it, and, where it `needs_hold`, while none
        holds it; nor is anything shown while a gamepad or a key pushes it. ValueError for what is not finite.
        """
        if not math.isfinite(roll + pitch):
            raise ValueError(f"A tilt is a finite number of radians, not {roll}, {pitch}.")
        at = roll / self.max_tilt, pitch / self.max_tilt
        ahead, left = self.shaped(at[1], -at[0])
        return self.steer(at, (-left, ahead))

    def steer(self, at: tuple[float, float], command: tuple[float, float]) -> bool:
        """Show the circle `at` so far to the right and up, and command `command`, both shares of the way to the rim.

        The dead zone and the curve of `command` are its giver's. Returns and raises as `tilt` does.
        """
        if not math.isfinite(sum(at) + sum(command)):
            raise ValueError(f"A circle is steered by finite shares, not by {at}, {command}.")
        if self.disabled or (self.finger is not None and not self.needs_hold):
            return False
        holds = not self.needs_hold or self.clutched or self.finger is not None
        self._wanted = command
        if not holds and (self.forward or self.left):
            return False  # somebody else commands, and what is commanded is what is shown
        self._at(at[1], -at[0])
        if holds:
            self._command()
        return holds

    def _command(self) -> None:
        """What the tablet's tilt comes to, as it is."""
        right, ahead = self._wanted
        self._as_is = True
        try:
            super()._push(ahead, -right)
        finally:
            self._as_is = False

    def _hold(self, *_: object) -> None:
        self.held = self.clutched or self.finger is not None

    def follow(self, touch: Any) -> None:
        """Go to where the finger is; where that only says when, command how the tablet is tilted."""
        self._hold()
        if self.needs_hold:
            self._command()
        else:
            super().follow(touch)

    def rest(self) -> None:
        """Let go of the finger, and have a key or a switch let go as well."""
        super().rest()
        self._hold()
        self.dispatch("on_let_go")

    def on_let_go(self) -> None:
        """It was put to rest, by a finger that was lifted or by whatever takes a control away from the hand."""

    def spring(self) -> None:
        """Command level; where the tablet tilts it the circle stays where that is."""
        if self.needs_hold and not self.disabled:
            self._wanted = (0.0, 0.0)
            self._command()
        else:
            super().spring()

    def _push(self, forward: float, left: float) -> None:
        self._at(forward, left)
        super()._push(forward, left)

    def _at(self, forward: float, left: float) -> None:
        scale = max(1.0, math.hypot(forward, left))
        self.ahead, self.aside = forward / scale, -left / scale + 0.0

    def draw(self) -> None:
        """In the gauge's way."""
        Gauge.draw(self)

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The pad, the neutral ring, the circle, and what it commands in words."""
        x, y, radius = self.round
        shapes.disc(x, y, radius, tint(theme.raised, 0.92))
        shapes.ring(x, y, radius - dp(0.75), dp(1.5), theme.line)
        shapes.ring(x, y, radius * 0.5, dp(1.2), theme.line, dashes=40)
        cross = np.array([[x - radius, y], [x, y - radius]]), np.array([[x + radius, y], [x, y + radius]])
        shapes.segments(*cross, dp(1), tint(theme.muted, 0.35))
        level = not (self.roll or self.pitch)
        idle = self.needs_hold and (not self.held or bool(self.opened)) and not (self.forward or self.left)
        knob = self.knob_pos
        if idle:
            rim = theme.muted if self.missing else theme.danger
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
        told = self._told()
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

    def _told(self) -> str:
        """What it commands, as in `12° ahead · 5° left` or `40\u00a0% ahead`; empty where that is nothing, or next to it."""
        if self.in_shares:
            shares = (100 * self.forward, "ahead", "back"), (-100 * self.left, "right", "left")
            parts = [
                f"{abs(part):.0f}\u00a0% {plus if part > 0 else minus}"
                for part, plus, minus in shares
                if abs(part) >= 1
            ]
        else:
            leans = (self.pitch, "ahead", "back"), (self.roll, "right", "left")
            parts = [_lean_text(*lean) for lean in leans]
        return " · ".join(part for part in parts if part)

    def _idle_words(self) -> tuple[str, ...]:
        name = spaced(self.title.upper())
        if self.needs_hold and self.missing:
            return (self.missing, "No motion sensor", "No sensor")
        if self.needs_hold and self.held and self.opened:
            return (self.opened, "let go")
        if self.needs_hold and not self.held and not self.disabled:
            return (f"{name} · hold it to tilt", "hold to tilt", self.title)
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
            ("pitch", self.pitch, "ahead", "back", middle + step / 2),
            ("roll", self.roll, "right", "left", middle - step / 2),
        )
        for name, angle, plus, minus, y in rows:
            figure = _figure(angle)
            side = "level" if not angle else plus if angle > 0 else minus
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
        "bare": make(5, 12, title=""),
        "stale": make(5, 12, state="stale", age=2.0),
        "alarm": make(5, 12, state="alarm", card=True),
        "disabled": make(state="disabled"),
    }
