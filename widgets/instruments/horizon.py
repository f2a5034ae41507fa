"""Artificial horizon: roll and pitch as seen from the cockpit.

horizon = ArtificialHorizon()
robot.on("/imu/data", horizon.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.graphics import PopMatrix, PushMatrix, Rectangle, Rotate, Translate
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.sensor_msgs import Imu
from widgets.core.canvas_ink import Drawing, Ink, Told, Word, Words
from widgets.core.geometry import DASH, dial_point, horizon_rise, screen_angle, steady
from widgets.core.shapes import Shapes
from widgets.core.surfaces import Glass
from widgets.core.theme import theme

__all__ = ["ArtificialHorizon", "samples"]

FRAGMENT = """
$HEADER$
uniform float radius;
uniform float roll;
uniform float rise;
uniform float true_rise;
uniform float rung;
uniform float strength;
uniform vec4 sky;
uniform vec4 ground;
uniform vec4 ink;
float stroke(float away, float half_width) {
    return clamp(half_width + 0.5 - abs(away), 0.0, 1.0);
}
void main() {
    vec2 p = (tex_coord0 * 2.0 - 1.0) * (radius + 2.0);
    float c = cos(roll);
    float s = sin(roll);
    float across = c * p.x + s * p.y;
    float upward = c * p.y - s * p.x;
    float above = upward - rise;
    float deep = clamp(abs(above) / radius, 0.0, 1.0);
    vec3 upper = sky.rgb * (1.10 - 0.32 * deep);
    vec3 lower = ground.rgb * (1.08 - 0.38 * deep);
    vec3 colour = mix(lower, upper, clamp(above + 0.5, 0.0, 1.0));
    float marks = stroke(above, radius * 0.014);
    float half_step = rung * 0.5;
    float pitch = upward - true_rise;
    float number = floor(pitch / half_step + 0.5);
    float tens = 1.0 - mod(abs(number), 2.0);
    float reach = radius * (tens > 0.5 ? 0.12 + 0.07 * abs(number) : 0.11);
    float room = clamp((radius * 0.70 - length(p)) / (radius * 0.06), 0.0, 1.0);
    if (abs(number) > 0.5 && abs(number) < 6.5) {
        float ends = clamp(min(reach, radius * 0.36) + 0.5 - abs(across), 0.0, 1.0);
        float ladder = stroke(pitch - number * half_step, radius * 0.009) * ends * room;
        marks = max(marks, ladder * (tens > 0.5 ? 1.0 : 0.7));
    }
    colour = mix(colour, ink.rgb, marks);
    float edge = clamp(radius + 0.5 - length(p), 0.0, 1.0);
    gl_FragColor = vec4(colour, edge * strength);
}
"""

RUNG = 0.21
"""From rung to rung of ten degrees, as a share of the radius."""
MAX_HORIZON_OFFSET = 0.8
"""How far from the middle the horizon may be drawn, as a share of the radius."""
SEEN = math.radians(0.1)
"""A turn that is less is not seen: a quarter of a pixel at the rim of a large horizon [rad]."""
BANKS = (10, 20, 30, 45, 60)
"""Ticks of the bank scale to both sides [deg]."""


class ArtificialHorizon(Glass, Drawing):
    """Attitude by REP-103: roll positive with the right side down, pitch positive with the nose down."""

    accepts: ClassVar = (Imu,)
    drawn_from: ClassVar = ("roll", "pitch", "card")

    roll = NumericProperty(math.nan)
    """About the axis ahead [rad], positive right side down; NaN when not known."""
    pitch = NumericProperty(math.nan)
    """About the axis to the left [rad], positive nose down; NaN when not known."""
    card = BooleanProperty(False)
    """Draw on a card of its own."""

    def _radius(self) -> float:
        return max(min(self.width, self.height) / 2 - (dp(16) if self.card else dp(3)), 1.0)

    radius = AliasProperty(_radius, bind=["size", "card"], cache=True)
    """Of the instrument [px]."""

    def _rise(self) -> float:
        return 0.0 if math.isnan(self.pitch) else horizon_rise(self.pitch, self.radius, RUNG)

    rise = AliasProperty(_rise, bind=["pitch", "radius"], cache=True)
    """How far a level view is above the middle, as the robot sees it [px]; a nose that is down raises it."""

    def _horizon(self) -> float:
        limit = MAX_HORIZON_OFFSET * self.radius
        return min(max(self.rise, -limit), limit)

    horizon = AliasProperty(_horizon, bind=["rise", "radius"], cache=True)
    """Where the horizon is drawn [px]: at `rise`, but never off the instrument."""

    def __init__(self, **kwargs: Any) -> None:
        self._world = Told(None, FRAGMENT)
        self._world.tell("strength", 1.0)
        # without a texture Kivy counts v from the top
        self._quad = Rectangle(tex_coords=(0, 0, 1, 0, 1, 1, 0, 1))
        self._world.add(self._quad)
        self._scale, self._frame = Ink(), Ink()
        self._ladder, self._words = Words(), Words()
        self._place, self._turn = Translate(), Rotate(axis=(0, 0, 1))
        self._scale_look: tuple[object, ...] = ()
        super().__init__(**kwargs)
        turning = (PushMatrix(), self._place, self._turn, self._scale, self._ladder.canvas, PopMatrix())
        for part in (self._world, *turning, self._frame, self._words.canvas):
            self.canvas.add(part)
        self.bind(radius=self._round, card=self._round)
        self._round()

    def _round(self, *_: object) -> None:
        self.veil_radius = theme.radius if self.card else min(self.width, self.height) / 2

    @property
    def known(self) -> bool:
        """Roll and pitch have been measured."""
        return not (math.isnan(self.roll) or math.isnan(self.pitch))

    def show(self, msg: Imu) -> None:
        """Take the attitude out of the message; one that measures no orientation gives NaN."""
        if msg.orientation_covariance[:1] == [-1]:
            self.roll = self.pitch = math.nan
        else:
            turned = msg.orientation
            self.roll, self.pitch = (
                steady(self.roll, turned.roll, SEEN),
                steady(self.pitch, turned.pitch, SEEN),
            )

    def draw(self) -> None:
        """Turn and raise the world; draw the scale anew only when its size or colours have changed."""
        roll = self.roll if self.known else 0.0
        self._paint_world(roll)
        self._place.xy, self._turn.angle = self.center, screen_angle(roll)
        look = (self.radius, theme.name, self.state, self.known, *self.pos)
        if look != self._scale_look:
            self._scale_look = look
            self._scale.fill(self._bank_scale())
            self._frame.fill(self._aircraft())
            dash = Word(DASH, *self.center, self.radius * 0.5, theme.text, bold=True)
            self._words.write([] if self.known else [dash])
        self._ladder.write(self._ladder_texts() if self.known else ())

    def _paint_world(self, roll: float) -> None:
        radius, world = self.radius, self._world
        half = radius + 2.0
        box = (self.center_x - half, self.center_y - half), (2 * half, 2 * half)
        if (self._quad.pos, self._quad.size) != box:
            self._quad.pos, self._quad.size = box
        # while nothing is known the ground covers all, without horizon or ladder
        low = self.horizon if self.known else 3 * radius
        true = self.rise if self.known else 9 * radius
        for name, value in (("radius", radius), ("roll", roll), ("rise", low), ("true_rise", true)):
            world.tell(name, value)
        world.tell("rung", radius * RUNG)
        world.tell("sky", theme.sky)
        world.tell("ground", theme.ground if self.known else theme.raised)
        world.tell("ink", theme.text)

    def _bank_scale(self) -> Shapes:
        shapes, radius = Shapes(), self.radius
        if not self.known:
            return shapes
        for bank in (0, *BANKS, *(-bank for bank in BANKS)):
            long = bank % 30 == 0
            outer, inner = (
                dial_point(bank, radius * 0.965),
                dial_point(bank, radius * (0.86 if long else 0.90)),
            )
            shapes.segments(np.array([outer]), np.array([inner]), radius * 0.022, theme.text)
        corners = [
            dial_point(bearing, radius * reach) for bearing, reach in ((0, 0.965), (-5, 0.83), (5, 0.83))
        ]
        shapes.polygon(corners, theme.text)
        return shapes

    def _aircraft(self) -> Shapes:
        """What does not move: the rim, the pointer of the bank scale, the wings."""
        shapes, radius, (x, y) = Shapes(), self.radius, self.center
        shapes.ring(x, y, radius, dp(2), theme.danger if self.state == "alarm" else theme.line)
        if not self.known:
            return shapes
        for colour, extra in ((theme.bg, dp(2.5)), (theme.warn, 0.0)):
            width = radius * 0.05 + extra
            for side in (-1, 1):
                wing = [(0.62, 0.0), (0.25, 0.0), (0.17, -0.08)]
                points = np.array([[x + side * u * radius, y + v * radius] for u, v in wing])
                shapes.line(points, width, colour)
            shapes.disc(x, y, radius * 0.045 + extra / 2, colour)
        tip, half = y + radius * 0.81, radius * 0.075
        shapes.polygon([(x, tip), (x - half, tip - half * 1.6), (x + half, tip - half * 1.6)], theme.warn)
        return shapes

    def _ladder_texts(self) -> Iterator[Word]:
        radius = self.radius
        for number in (-3, -2, -1, 1, 2, 3):
            y = number * RUNG * radius + self.rise
            x = radius * (min(0.12 + 0.14 * abs(number), 0.36) + 0.1)
            if math.hypot(x, y) < radius * 0.68:
                yield Word(f"{abs(number) * 10}", x, y, radius * 0.115, theme.text)


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the instrument by name."""

    def made(**more: Any) -> Callable[[], Widget]:
        return lambda: ArtificialHorizon(size_hint=(None, None), size=(dp(194), dp(194)), **more)

    return {
        "never": made(card=True),
        "live": made(roll=-0.12, pitch=0.03, state="live", card=True),
        "bank": made(roll=0.5, pitch=-0.2, state="live"),
        "dive": made(roll=0.0, pitch=1.2, state="live"),
        "stale": made(roll=-0.12, pitch=0.03, state="stale", age=3.0, card=True),
        "alarm": made(roll=0.6, pitch=0.1, state="alarm", card=True),
        "disabled": made(roll=-0.12, pitch=0.03, state="disabled"),
    }
