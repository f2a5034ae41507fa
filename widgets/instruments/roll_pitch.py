"""Attitude of a boat in the waves: roll from astern, pitch from its right side, and the range of both lately.

lie = RollPitch()
robot.on("/compass", lie.show)
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import ListProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import Compass
from bridge.msgs.std_msgs import Header, Time
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import DASH, Points
from widgets.core.language import figure, mark, tr, within
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["RollPitch", "spread_of", "samples"]

SPAN = 30
"""How long the greatest angles are remembered [s]."""
LEVEL = 0.5
"""Less is level [deg]."""
WIDE = 1.25
"""A card this many times broader than high has the two views beside each other."""
SCALE = (-30, -20, -10, 0, 10, 20, 30)
"""Ticks beside a view [deg]."""

STERN = ((-0.5, 0.26), (-0.44, -0.12), (-0.2, -0.32), (0.2, -0.32), (0.44, -0.12), (0.5, 0.26))
"""A hull from astern, in radii of the view."""
SIDE = ((-0.6, 0.16), (-0.54, -0.16), (0.4, -0.16), (0.62, 0.04), (0.74, 0.24))
"""A hull from its right side, the bow to the right."""
CABINS = {
    "roll": ((-0.22, 0.26), (0.22, 0.26), (0.18, 0.52), (-0.18, 0.52)),
    "pitch": ((-0.3, 0.18), (0.18, 0.2), (0.08, 0.44), (-0.3, 0.44)),
}


@dataclass(frozen=True)
class _View:
    """One of the two."""

    name: str
    title: str
    hull: Sequence[tuple[float, float]]
    zero: float
    """Where its scale has 0 [rad]: above for roll, at the bow for pitch."""
    words: tuple[str, str]
    """Of a positive and of a negative angle."""


VIEWS = (
    _View("roll", mark("Roll"), STERN, math.pi / 2, (mark("right"), mark("left"))),
    _View("pitch", mark("Pitch"), SIDE, 0.0, (mark("bow down"), mark("bow up"))),
)


class RollPitch(Gauge):
    """Both angles by REP-103: roll positive with the right side down, pitch positive with the bow down."""

    accepts: ClassVar = (Compass,)
    drawn_from: ClassVar = ("roll", "pitch", "rolled", "pitched", "steep", "capsizing")

    roll = NumericProperty(math.nan)
    """[rad], positive right side down; NaN when not known."""
    pitch = NumericProperty(math.nan)
    """[rad], positive bow down; NaN when not known."""
    rolled: ListProperty[float] = ListProperty()
    """Least and greatest roll of the last half minute [rad]; empty before the first."""
    pitched: ListProperty[float] = ListProperty()
    """Least and greatest pitch of the last half minute [rad]; empty before the first."""
    steep = NumericProperty(math.radians(20))
    """From here on an angle is a warning [rad]."""
    capsizing = NumericProperty(math.radians(40))
    """From here on an angle is a danger [rad]."""

    def __init__(self, **kwargs: Any) -> None:
        self._past: deque[tuple[int, list[float], list[float]]] = deque(maxlen=SPAN + 2)
        super().__init__(**{"title": tr("Lie"), **kwargs})

    def show(self, msg: Compass) -> None:
        """Show the newest angles."""
        self.roll, self.pitch = round(msg.roll, 3), round(msg.pitch, 3)
        if not math.isfinite(self.roll + self.pitch):
            return
        second = int(msg.header.stamp.seconds)
        if self._past and second < self._past[-1][0]:
            self._past.clear()  # its clock was set back
        if not self._past or second > self._past[-1][0]:
            self._past.append((second, [], []))
        while self._past[0][0] < second - SPAN:
            self._past.popleft()
        for past, angle in zip(self._past[-1][1:], (self.roll, self.pitch), strict=True):
            past[:] = spread_of([*past, angle])
        self.rolled = spread_of([angle for _, rolls, _ in self._past for angle in rolls])
        self.pitched = spread_of([angle for *_, pitches in self._past for angle in pitches])

    def words(self, name: str) -> tuple[str, str]:
        """Figure and direction of `roll` or `pitch`, as in `8°` and `right`; a dash and nothing while not known."""
        angle = getattr(self, name)
        if not math.isfinite(angle):
            return DASH, ""
        degrees = math.degrees(angle)
        positive, negative = map(tr, next(view.words for view in VIEWS if view.name == name))
        side = tr("level") if abs(degrees) < LEVEL else positive if degrees > 0 else negative
        return f"{abs(degrees):.0f}°", side

    def most(self, name: str) -> str:
        """How far it went lately, as in `most 12°`; empty before anything is known."""
        past = self.rolled if name == "roll" else self.pitched
        return tr("most {angle}°").format(angle=figure(math.degrees(max(map(abs, past))))) if past else ""

    def role(self, name: str) -> str:
        """Role of an angle's colour."""
        angle = abs(getattr(self, name))
        if math.isnan(angle):
            return "muted"
        return "danger" if angle >= self.capsizing else "warn" if angle >= self.steep else "text"

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Two views with their figures, beside each other or one above the other."""
        if self.low:
            yield from self._brief()
            return
        edge = self.edge
        left, low, width, height = self.x + edge, self.y + edge, self.width - 2 * edge, self.height - 2 * edge
        beside = self.width > WIDE * self.height
        for number, view in enumerate(VIEWS):
            if beside:
                half = (width - dp(12)) / 2
                yield from self._upright(shapes, view, (left + number * (half + dp(12)), low, half, height))
            else:
                half = (height - dp(8)) / 2
                box = (left, low + (1 - number) * (half + dp(8)), width, half)
                yield from self._lying(shapes, view, box)

    def _upright(self, shapes: Shapes, view: _View, box: tuple[float, float, float, float]) -> Iterator[Word]:
        """Its name above, its figures below."""
        left, low, width, height = box
        large = height > dp(170)
        size, foot = sp(24 if large else 18), sp(46 if large else 24)
        figure, side = self.words(view.name)
        radius = max(min(width / 2, (height - foot - sp(18)) / 2), dp(8))
        x = left + width / 2
        self._draw_view(shapes, view, x, low + foot + (height - foot - sp(18)) / 2, radius)
        yield Word(tr(view.title).upper(), left, low + height - sp(6), sp(11.5), theme.muted, anchor=(0, 0.5))
        y = low + foot - size * 0.6 - dp(2)
        ink = theme.roles[self.role(view.name)]
        yield Word(figure, left, y, size, ink, bold=True, anchor=(0, 0.5))
        after = wide(figure, size, bold=True) + dp(7)
        words = fitting_size([side], sp(15 if large else 13), width - after)
        yield Word(side, left + after, y - (size - words) * 0.3, words, ink, anchor=(0, 0.5))
        if large:
            yield Word(self.most(view.name), left, low + sp(7), sp(12.5), theme.muted, anchor=(0, 0.5))

    def _lying(self, shapes: Shapes, view: _View, box: tuple[float, float, float, float]) -> Iterator[Word]:
        """Its name and its figures to the right."""
        left, low, width, height = box
        figure, side = self.words(view.name)
        radius = max(min(height / 2, (width - dp(56)) / 2), dp(8))
        self._draw_view(shapes, view, left + radius, low + height / 2, radius)
        x = left + 2 * radius + dp(10)
        room = left + width - x
        roomy = height >= dp(66)
        scale = min(max(height / dp(84), 1.0), 1.9)
        large = (("name", 11, 6), ("figure", 22, 26), ("side", 12.5, 45), ("most", 12, 61))
        lines = large if roomy else (("name", 11, 6), ("figure", 17, 22), ("side", 12.5, 37))
        texts = {"name": view.name.upper(), "figure": figure, "side": side, "most": self.most(view.name)}
        ink = theme.roles[self.role(view.name)]
        inks = {"figure": ink, "side": ink}
        top = low + height / 2 + sp(34 if roomy else 25) * scale
        for line, size, down in lines:
            bold, text = line == "figure", texts[line]
            fitted = fitting_size([text], sp(size) * scale, room, bold=bold)
            y = top - sp(down) * scale
            yield Word(text, x, y, fitted, inks.get(line, theme.muted), bold=bold, anchor=(0, 0.5))

    def _draw_view(self, shapes: Shapes, view: _View, x: float, y: float, radius: float) -> None:
        """Water, boat, scale with the angles of late, rim."""
        angle = getattr(self, view.name)
        known = math.isfinite(angle)
        shapes.disc(x, y, radius, theme.raised)
        chord = np.linspace(math.pi, math.tau, 25)
        water = np.stack([np.cos(chord), np.sin(chord)], axis=1) * radius + np.array([x, y])
        shapes.polygon([(a, b) for a, b in water], tint(theme.sky, 0.45) if known else tint(theme.muted, 0.2))
        shapes.segments(np.array([water[0]]), np.array([water[-1]]), dp(1.5), theme.muted)
        # both views turn clockwise as their angle grows
        turned = -angle if known else 0.0
        ink = theme.roles[self.role(view.name)] if known else theme.faint
        for corners, strength in ((view.hull, 1.0), (CABINS[view.name], 0.7)):
            points = _turned(corners, turned) * radius * 0.92 + np.array([x, y])
            shapes.polygon([(a, b) for a, b in points], tint(ink, strength))
        self._draw_scale(shapes, view, (x, y, radius), turned if known else math.nan)
        shapes.ring(x, y, radius - dp(0.75), dp(1.5), theme.line)

    def _draw_scale(
        self, shapes: Shapes, view: _View, disc: tuple[float, float, float], turned: float
    ) -> None:
        x, y, radius = disc
        middle = np.array([x, y])
        past = self.rolled if view.name == "roll" else self.pitched
        if past and past[1] > past[0]:
            angles = view.zero - np.linspace(past[0], past[1], 16)
            points = np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius * 0.9 + middle
            shapes.line(points, max(radius * 0.11, dp(4)), tint(theme.accent, 0.4))
        ticks = view.zero + np.radians(SCALE)
        units = np.stack([np.cos(ticks), np.sin(ticks)], axis=1)
        shapes.segments(units * radius * 0.97 + middle, units * radius * 0.86 + middle, dp(1.3), theme.muted)
        if math.isfinite(turned):
            yaw = view.zero + turned
            ahead, aside = np.array([math.cos(yaw), math.sin(yaw)]), np.array([-math.sin(yaw), math.cos(yaw)])
            tip, back, half = radius * 0.95, radius * 0.76, radius * 0.09
            corners = (
                middle + ahead * tip,
                middle + ahead * back + aside * half,
                middle + ahead * back - aside * half,
            )
            shapes.polygon([(float(a), float(b)) for a, b in corners], theme.accent)

    def _brief(self) -> Iterator[Word]:
        """Both in a line each."""
        room = self.width - 2 * self.edge
        for number, view in enumerate(VIEWS):
            figure, side = self.words(view.name)
            said = f"{within(tr(view.title))} {figure}"
            text = first_fitting((f"{said} {side}".strip(), said, figure), sp(13), room, bold=True)
            y = self.center_y + sp(9) * (1 - 2 * number)
            yield Word(text, self.center_x, y, sp(13), theme.roles[self.role(view.name)], bold=True)


def spread_of(angles: Sequence[float]) -> list[float]:
    """Least and greatest of them; empty for none."""
    return [min(angles), max(angles)] if angles else []


def _turned(corners: Sequence[tuple[float, float]], angle: float) -> Points:
    """The corners turned anticlockwise by `angle` [rad]."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.asarray(np.array(corners) @ np.array([[cos, sin], [-sin, cos]]))


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""

    def made(
        *angles: tuple[float, float], size: tuple[float, float] = (176, 176), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> RollPitch:
            view = RollPitch(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            for second, (roll, pitch) in enumerate(angles):
                header = Header(Time.at(float(second)), "base_link")
                view.show(Compass(header, 38.0, math.radians(roll), math.radians(pitch)))
            return view

        return build

    waves = ((-9.0, 2.0), (12.0, -7.0), (8.0, -4.0))
    large = (326, 228)
    return {
        "never": made(),
        "live": made(*waves, state="live"),
        "level": made((0.2, -0.3), state="live"),
        "steep": made((4.0, 3.0), (-27.0, 22.0), state="live"),
        "capsizing": made((4.0, 3.0), (52.0, 5.0), state="live"),
        "not measured": made(*waves, (math.nan, math.nan), state="live"),
        "large": made(*waves, size=large, state="live"),
        "large never": made(size=large),
        "short": made(*waves, size=(212, 148), state="live"),
        "tiny": made(*waves, size=(128, 128), state="live"),
        "square": made(*waves, size=(194, 194), state="live"),
        "huge": made(*waves, size=(420, 440), state="live"),
        "low": made(*waves, size=(140, 54), state="live"),
        "low and narrow": made(*waves, size=(72, 54), state="live", card=False),
        "stale": made(*waves, state="stale", age=2.0),
        "alarm": made((4.0, 3.0), (52.0, 5.0), size=large, state="alarm"),
        "disabled": made(*waves, state="disabled"),
    }
