"""Rudder and throttle of a boat on one stick; it springs back when released.

helm = RudderThrottle(max_steering=0.61)
robot.on("/rudder", helm.show)
helm.bind(on_command=lambda _, manoeuvre: drive.command(manoeuvre))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import Manoeuvre, RudderState
from widgets.controls.sticks.stick import DEAD_ZONE, Stick
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import HULL, Points, rounded
from widgets.core.language import figure, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, wide

__all__ = ["RudderThrottle", "samples"]

ROOMY = 220
"""From this height on each figure has its name above it [dp]."""
SCALE = 14
"""Width of a scale along the edge of the pad [dp]."""
STEPS = 4
"""Into which a scale is divided from its middle to its end."""


class RudderThrottle(Stick, Gauge):
    """Dispatches `on_command(manoeuvre)` of kind `steer` at every change; the boat in it shows what rudder and throttle do."""

    accepts: ClassVar = (RudderState,)
    sends = (Manoeuvre,)
    drawn_from: ClassVar[tuple[str, ...]] = (
        "forward",
        "left",
        "most",
        "max_steering",
        "angle",
        "throttle",
        "led",
    )

    max_steering = NumericProperty(0.61)
    """Of the rudder at the end of the pad [rad], more than 0."""
    most = NumericProperty(1.0)
    """Throttle at the end of the pad, a share of the full one, 0 to 1."""
    angle = NumericProperty(math.nan)
    """Of the rudder as the boat reports it [rad], positive turns to the left; NaN when not known."""
    throttle = NumericProperty(math.nan)
    """Of the propeller as the boat reports it, -1 to 1; NaN when not known."""

    led = BooleanProperty(False)
    """A task steers: while no hand does, the boat's own rudder and throttle are shown, marked as the task's."""

    def _knob_radius(self) -> float:
        return min(min(self.size) * 0.15, theme.target * 0.75)

    knob_radius = AliasProperty(_knob_radius, bind=["size"], cache=True)
    """[px]"""

    @property
    def pad(self) -> tuple[float, float, float, float]:
        """Where the knob goes: left, low, width, height [px]."""
        edge, scale, head = self.edge, dp(SCALE), sp(44 if self.roomy else 20) + dp(4)
        left, low = self.x + edge + scale, self.y + edge + scale
        return left, low, self.right - edge - left, max(self.top - edge - head - low, dp(10))

    @property
    def knob_pos(self) -> tuple[float, float]:
        """The knob's middle [px]."""
        (x, y), (across, up) = self.middle, self.travel
        return x - self.left * across, y + self.forward * up

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.veil_radius = theme.radius

    def on_bare(self, *_: object) -> None:
        """The card is a ground too."""
        self.card = not self.bare

    @property
    def hides(self) -> list[tuple[float, float, float, float]]:
        """The figures too."""
        rows = [(self.x, self.top - dp(24), self.width, dp(24))] if self.bare else []
        return [*super().hides, *rows]

    @property
    def roomy(self) -> bool:
        """Each figure has its name above it."""
        return bool(self.height >= dp(ROOMY))

    @property
    def order(self) -> Manoeuvre:
        """What the hand commands now."""
        # + 0.0 turns the minus zero of a stick at rest into zero
        throttle, steering = self.forward * self.most + 0.0, self.left * self.max_steering + 0.0
        return Manoeuvre(kind="steer", speed=math.nan, throttle=throttle, steering=steering)

    @property
    def middle(self) -> tuple[float, float]:
        """Of the pad [px]."""
        left, low, width, height = self.pad
        return left + width / 2, low + height / 2

    @property
    def travel(self) -> tuple[float, float]:
        """To the pad's edges, so far as the knob fits in."""
        _, _, width, height = self.pad
        return max(width / 2 - self.knob_radius, dp(8)), max(height / 2 - self.knob_radius, dp(8))

    def shaped(self, forward: float, left: float) -> tuple[float, float]:
        """Rudder and throttle each for itself: straight ahead is easily held, and full throttle with the rudder hard over."""
        return _eased(forward), _eased(left)

    def sign_place(self) -> tuple[float, float]:
        """In the lower right corner of the pad, where the knob comes least."""
        left, low, width, _ = self.pad
        return left + width - self.sign_size[0] - dp(5), low + dp(5)

    def show(self, msg: RudderState) -> None:
        """Show where rudder and throttle are; NaN for what is not known."""
        self.angle, self.throttle = round(msg.angle, 3), round(msg.throttle, 3)

    @property
    def throttle_words(self) -> str:
        """What is commanded, as in `60 % ahead`; `idle` at rest."""
        if self._has_report:
            if not math.isfinite(self.throttle):
                return tr("task")
            return tr("task {percent} %").format(percent=f"{self.throttle * 100:.0f}")
        percent = round(self.forward * self.most * 100)
        way = tr("ahead") if percent > 0 else tr("astern")
        return f"{abs(percent)} % {way}" if percent else tr("idle")

    @property
    def rudder_words(self) -> str:
        """What is commanded, as in `12° port`; `set amidships` at rest, where the rudder itself may still be on its way."""
        turned = self.left * self.max_steering
        if self._has_report:
            turned = self.angle if math.isfinite(self.angle) else 0.0
        degrees = round(math.degrees(turned))
        side = tr("port", context="side") if degrees > 0 else tr("starboard")
        return f"{abs(degrees)}° {side}" if degrees else tr("set amidships")

    @property
    def _has_report(self) -> bool:
        """The words show what the boat does, and not what the hand does."""
        return bool(self.led) and not (self.forward or self.left)

    def draw(self) -> None:
        """Pad, boat, scales, knob; in the gauge's way."""
        Gauge.draw(self)

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Draw all of it and give the words."""
        left, low, width, height = self.pad
        (x, y), (across, up) = self.middle, self.travel
        rim = rounded(left, low, width, height, dp(9))
        if not self.bare:
            shapes.polygon([(a, b) for a, b in rim], tint(theme.raised, 0.9))
        shapes.line(np.array([*rim, rim[0]]), dp(1.2), theme.text if self.bare else theme.line)
        cross = np.array([[x, low], [left, y]]), np.array([[x, low + height], [left + width, y]])
        shapes.segments(*cross, dp(1), self.glassy(theme.text) if self.bare else theme.line)
        self._boat(shapes)
        self._scale(shapes, (left - dp(6), y), (0.0, up), (self.forward, _known(self.throttle, self.most)))
        turned = _known(self.angle, self.max_steering)
        self._scale(shapes, (x, low - dp(6)), (-across, 0.0), (self.left, turned))
        if self.forward or self.left:
            shapes.line(np.array([[x, y], self.knob_pos]), dp(4), theme.accent)
        self.draw_knob(shapes, self.knob_pos, self.knob_radius, theme.accent)
        yield from self._figures(shapes)

    def _boat(self, shapes: Shapes) -> None:
        """From above, as long as the pad is high, with its rudder as it is."""
        (x, y), half = self.middle, self.pad[3] * 0.43
        hull = np.array(HULL) * half + np.array(self.middle)
        shapes.polygon([(a, b) for a, b in hull], tint(theme.muted, 0.2))
        shapes.line(np.concatenate([hull, hull[:1]]), dp(1.5), tint(theme.muted, 0.6))
        stern = np.array([x, y - half * 0.8])
        known = math.isfinite(self.angle)
        turned = self.angle if known else 0.0
        # a rudder turned so that the boat goes left has its blade on the left
        blade = np.array([-math.sin(turned), -math.cos(turned)]) * half * 0.34
        ink = theme.text if known else theme.faint
        shapes.line(np.stack([stern, stern + blade]), dp(4), ink)
        shapes.disc(float(stern[0]), float(stern[1]), dp(3.2), ink)

    def _scale(
        self,
        shapes: Shapes,
        middle: tuple[float, float],
        end: tuple[float, float],
        shares: tuple[float, float],
    ) -> None:
        """Ticks to both sides of `middle`, a bar to the first of `shares`, which is wanted, a mark at the second, which is."""
        at, way = np.array(middle), np.array(end)
        aside = np.array([way[1], way[0]]) / max(float(np.hypot(*way)), 1e-6) * dp(4)
        ticks: Points = at + np.linspace(-1.0, 1.0, 2 * STEPS + 1)[:, None] * way
        shapes.segments(ticks - aside, ticks + aside, dp(1.2), theme.muted)
        wanted, told = shares
        if wanted:
            shapes.line(np.stack([at, at + way * wanted]), dp(6), theme.plan)
        if math.isfinite(told):
            mark = at + way * told
            for width, ink in ((dp(7), theme.surface), (dp(4), theme.text)):
                shapes.line(np.stack([mark - aside * 1.35, mark + aside * 1.35]), width, ink)

    def _figures(self, shapes: Shapes) -> Iterator[Word]:
        left, top = self.x + self.edge, self.top - self.edge
        right = self.right - self.edge - (dp(18) if self.alarmed else 0)
        colour = theme.plan if self._has_report else theme.text
        colour = colour if self.state != "disabled" else theme.faint
        size = sp(14)
        if self.roomy:
            yield Word(tr("Throttle set").upper(), left, top - sp(6), sp(11.5), theme.muted, anchor=(0, 0.5))
            yield Word(tr("Rudder set").upper(), right, top - sp(6), sp(11.5), theme.muted, anchor=(1, 0.5))
            top, size = top - sp(18), sp(18)
        throttle, rudder, size = self._fitting(right - left - dp(8), size)
        y = top - size * 0.6
        for word in (
            Word(throttle, left, y, size, colour, bold=True, anchor=(0, 0.5)),
            Word(rudder, right, y, size, colour, bold=True, anchor=(1, 0.5)),
        ):
            if self.bare:
                ground(shapes, word, tint(theme.surface, 0.7))
            yield word

    def _fitting(self, room: float, size: float) -> tuple[str, str, float]:
        """Words for throttle and rudder, and their size [px], so that both fit into `room` [px]."""
        throttle, rudder = self.throttle_words, self.rudder_words
        brief = (
            throttle.replace(tr("ahead"), "").replace(tr("astern"), tr("back", context="way")),
            rudder.replace(tr("set amidships"), tr("set 0°")).replace(tr("starboard"), tr("stbd")),
        )
        least = throttle if self._has_report else figure(self.forward * self.most * 100, 0) + " %", brief[1]
        for words in ((throttle, rudder), brief, least):
            for height in (size, sp(14), sp(12), sp(10.5)):
                if height <= size and sum(wide(text, height, bold=True) for text in words) <= room:
                    return words[0].strip(), words[1], height
        return "", rudder, sp(10.5)


def _eased(share: float) -> float:
    """Nothing near the middle, never more than 1, and no step between."""
    pushed = (min(abs(share), 1.0) - DEAD_ZONE) / (1.0 - DEAD_ZONE)
    return math.copysign(max(pushed, 0.0), share)


def _known(value: float, end: float) -> float:
    """`value` as a share of what the scale's `end` stands for, -1 to 1; NaN stays so."""
    return max(-1.0, min(1.0, value / end)) if math.isfinite(value) and end > 0 else math.nan


def samples() -> dict[str, Callable[[], Widget]]:
    """At rest, pushed, not heard of yet, disabled, in the sizes that screens give it."""

    def make(
        push: tuple[float, float] = (0.0, 0.0),
        told: tuple[float, float] = (0.0, 0.0),
        size: tuple[float, float] = (242, 242),
        **kwargs: Any,
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            helm = RudderThrottle(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **kwargs)
            helm.lean(*push)
            helm.show(RudderState(throttle=told[0], angle=told[1]))
            return helm

        return build

    return {
        "never": make(told=(math.nan, math.nan), state="never"),
        "at rest": make(),
        "ahead to the left": make((0.75, 0.6), (0.7, 0.2)),
        "astern": make((-0.5, -0.3), (-0.45, -0.15)),
        "half throttle at most": make((1.0, 0.0), (0.5, 0.0), most=0.5),
        "small": make((0.75, 0.6), (0.7, 0.2), (176, 176)),
        "small at rest": make(size=(176, 176)),
        "smallest": make((-1.0, -1.0), (-0.8, -0.5), (140, 140)),
        "bare": make((0.2, 0.1), (0.1, 0.1), (176, 176), bare=True),
        "bare at rest": make(size=(176, 176), bare=True),
        "large": make((0.75, -0.6), (0.7, -0.2), (326, 242)),
        "a task steers": make(told=(0.86, -0.45), led=True),
        "small, a task steers": make(told=(0.86, -0.45), size=(176, 176), led=True),
        "gamepad drives": make((0.75, 0.2), (0.7, 0.1), (176, 176), gamepad="drives"),
        "stale": make(told=(0.3, 0.1), state="stale", age=3.0),
        "alarm": make(told=(0.3, 0.1), state="alarm"),
        "disabled": make(state="disabled"),
    }
