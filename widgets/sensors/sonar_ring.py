"""Ring of sonars seen from above, with the bumper ring round the robot: free distance on every side.

sonars = SonarRingView(title="Sonars")
robot.on("/sonar", sonars.show)
robot.on("/bumper", sonars.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar, NamedTuple

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import NumericProperty, ObjectProperty
from kivy.uix.widget import Widget
from numpy.typing import NDArray

from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.pilothouse_msgs import Bumper, SonarRing
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import DASH, Points, length_text, not_exceeded_by, scan_reach
from widgets.core.icons import icon
from widgets.core.language import tr
from widgets.core.sensor_geometry import away_text, side_text
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.map_marks import arrow
from widgets.parts.sensor_card import Gauge, first_fitting

__all__ = ["SonarRingView", "samples"]

AHEAD = math.pi / 2
"""Where straight ahead is on the screen [rad]."""
MAX_SONARS = 64
"""Sonars that are drawn."""
RINGS = 3
WIDE = 1.3
"""A card this many times broader than high has its figures beside the ring."""
CONTACT = math.radians(38)
"""How far the mark of a contact goes to both sides [rad]."""
MIN_BODY_RADIUS = 11
"""The robot is drawn no smaller than with this radius [dp]."""


class _Place(NamedTuple):
    """Where the ring is drawn."""

    x: float
    y: float
    radius: float
    """Of the outer ring [px]."""
    scale: float
    """[px/m]"""
    body: float
    """Radius of the robot [px]."""


class SonarRingView(Gauge):
    """One cone for each sonar, its end in the colour of its distance; a contact is an arc on the robot's rim."""

    accepts: ClassVar = (SonarRing, Bumper)
    shown_beside: ClassVar = (Bumper,)
    drawn_from: ClassVar = ("ring", "pressed", "contact", "reach", "near", "close")

    ring: ObjectProperty[SonarRing | None] = ObjectProperty(None, allownone=True, force_dispatch=True)
    """The newest SonarRing; None before the first."""
    pressed = NumericProperty(math.nan)
    """The bumper is touched: 1 or 0; NaN before its first report."""
    contact = NumericProperty(math.nan)
    """Direction of the contact [rad], 0 ahead, positive left; NaN when there is none or its direction is unknown."""
    reach = NumericProperty(0.0)
    """Distance at the edge of the picture [m]; 0 follows what is seen."""
    near = NumericProperty(0.8)
    """Closer than this is a warning [m]."""
    close = NumericProperty(0.4)
    """Closer than this is a danger [m]."""

    @property
    def echoes(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Bearings [rad] and ranges [m] of the newest ring, as many as there are of both."""
        if self.ring is None:
            return np.zeros(0), np.zeros(0)
        count = min(len(self.ring.bearings), len(self.ring.ranges), MAX_SONARS)
        bearings = np.asarray(self.ring.bearings[:count], dtype=np.float64)
        ranges = np.asarray(self.ring.ranges[:count], dtype=np.float64)
        return bearings, np.where(np.isfinite(bearings), ranges, math.nan)

    @property
    def nearest(self) -> int:
        """Number of the sonar whose echo is nearest; -1 before the first echo."""
        ranges = self.echoes[1]
        return -1 if np.isnan(ranges).all() else int(np.nanargmin(ranges))

    def __init__(self, **kwargs: Any) -> None:
        self._reach = 0.0
        super().__init__(**{"title": tr("Sonars"), **kwargs})

    def show(self, msg: SonarRing | Bumper) -> None:
        """Take the newest ring, or the bumper's report."""
        if isinstance(msg, Bumper):
            self.pressed, self.contact = float(msg.pressed), msg.bearing if msg.pressed else math.nan
        elif self.ring is None or (msg.ranges, msg.bearings) != (self.ring.ranges, self.ring.bearings):
            self.ring = msg

    @property
    def touched(self) -> bool:
        """Something touches the robot."""
        return self.pressed == 1.0

    @property
    def figure(self) -> str:
        """The nearest distance in words: `0.42 m`, `<15 cm`, `clear`, or a dash."""
        if self.nearest < 0:
            return DASH
        away = float(self.echoes[1][self.nearest])
        if math.isinf(away):
            return tr("clear") if away > 0 else f"<{(self.ring or SonarRing()).range_min * 100:.0f} cm"
        return away_text(away)

    @property
    def where(self) -> str:
        """Which way the nearest is, as in `45° left`; `all around` where all is clear."""
        if self.nearest < 0:
            return ""
        return (
            tr("all around") if self.figure == tr("clear") else side_text(float(self.echoes[0][self.nearest]))
        )

    @property
    def bump(self) -> str:
        """The bumper's state, as in `bump 45° left`, `no contact`; empty before its first report."""
        if math.isnan(self.pressed):
            return ""
        return (
            tr("bump {side}").format(side=side_text(self.contact)).strip()
            if self.touched
            else tr("no contact")
        )

    def role(self, away: float) -> str:
        """Role of the colour of a distance [m]."""
        if math.isnan(away):
            return "faint"
        return "danger" if away < self.close else "warn" if away < self.near else "accent"

    @property
    def nearest_role(self) -> str:
        """Role of the nearest distance's figure."""
        role = self.role(float(self.echoes[1][self.nearest]) if self.nearest >= 0 else math.nan)
        return {"accent": "text", "faint": "muted"}.get(role, role)

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Rings, cones, the robot, and the words for them."""
        if self.low:
            yield from self._brief()
            return
        beside = self.width > WIDE * self.height
        place = self._place(beside)
        for ring in range(1, RINGS + 1):
            shapes.ring(place.x, place.y, self._ring_radius(place, ring), dp(1.2), theme.line)
        for bearing, away in zip(*self.echoes, strict=True):
            self._cone(shapes, place, bearing + AHEAD, away)
        self._robot(shapes, place)
        words = [*self._ring_words(place)]
        for word in words:
            ground(shapes, word, tint(theme.surface, 0.85))
        yield from words
        yield from self._beside(place) if beside else self._above()

    def _place(self, beside: bool) -> _Place:
        edge, head = self.edge, 0.0 if beside else sp(16)
        radius = max(min(self.width - 2 * edge, self.height - 2 * edge - head) / 2, dp(10))
        x = self.right - edge - radius if beside else self.center_x
        ring = self.ring or SonarRing(range_max=3.0)
        ranges = self.echoes[1]
        seen = ranges[np.isfinite(ranges)]
        farthest = not_exceeded_by(seen, 0.6) if len(seen) else min(max(ring.range_max, 1.0), 3.0)
        self._reach = self.reach or scan_reach(farthest, self._reach)
        own = max(ring.radius, 0.0)
        scale = radius / (self._reach + own)
        return _Place(x, self.y + edge + (self.height - 2 * edge - head) / 2, radius, scale, own * scale)

    def _cone(self, shapes: Shapes, place: _Place, yaw: float, away: float) -> None:
        x, y, radius, scale, body = place
        if not math.isfinite(yaw):
            return
        half = min(
            max((self.ring or SonarRing()).field_of_view / 2, math.radians(4)),
            math.pi / max(len(self.echoes[0]), 4),
        )
        if math.isnan(away):
            shapes.sector(x, y, radius, yaw=yaw, half_angle=half * 0.9, colour=tint(theme.muted, 0.12))
            return
        colour = theme.roles[self.role(away)]
        length = min(body + max(away, 0.0) * scale, radius)
        strength = 0.16 if self.role(away) == "accent" else 0.34
        shapes.sector(x, y, length, yaw=yaw, half_angle=half * 0.92, colour=tint(colour, strength))
        if body + max(away, 0.0) * scale <= radius:
            shapes.line(_arc(x, y, max(length, dp(MIN_BODY_RADIUS + 4)), yaw, half * 0.86), dp(3.2), colour)

    def _robot(self, shapes: Shapes, place: _Place) -> None:
        x, y, radius, _, body = place
        size = max(body, min(dp(MIN_BODY_RADIUS), radius * 0.2))
        shapes.disc(x, y, size + dp(1), theme.surface)
        shapes.disc(x, y, size, theme.raised)
        known = not math.isnan(self.pressed)
        if self.touched and math.isnan(self.contact):
            shapes.ring(x, y, size + dp(2), dp(5), theme.danger)
        else:
            shapes.ring(x, y, size, dp(1.8), theme.text if known else theme.faint)
        if math.isfinite(self.contact):
            shapes.line(_arc(x, y, size + dp(2.5), self.contact + AHEAD, CONTACT), dp(6), theme.danger)
        shapes.polygon(arrow(x, y, AHEAD, size * 0.72), theme.text)

    def _ring_words(self, place: _Place) -> Iterator[Word]:
        """Distances behind the robot, on their rings; only the outer one where they would cover each other."""
        step = self._ring_radius(place, 2) - self._ring_radius(place, 1)
        for ring in range(1, RINGS + 1):
            if ring == RINGS or step > sp(24):
                text = length_text(round(self._reach * ring / RINGS, 2))
                inside = sp(7) if ring == RINGS else 0
                y = place.y - self._ring_radius(place, ring) + inside
                yield Word(text, place.x, y, sp(11), theme.muted)

    def _ring_radius(self, place: _Place, ring: int) -> float:
        """Of one of the rings [px], which are at round distances from the robot's rim."""
        return place.body + self._reach * ring / RINGS * place.scale

    def _above(self) -> Iterator[Word]:
        """Name and nearest distance over the ring; a contact takes the distance's place."""
        figures = (
            (self.bump, tr("bump")) if self.touched else (f"{self.figure} {self.where}".strip(), self.figure)
        )
        yield from self.header(figures, "danger" if self.touched else self.nearest_role)

    def _beside(self, place: _Place) -> Iterator[Word]:
        """All words in a column left of the ring."""
        left, top = self.x + self.edge, self.top - self.edge
        # the figures are above the ring's broadest part, where it leaves a little more
        room = place.x - place.radius - left + place.radius * 0.08
        yield Word(self.title.upper(), left, top - sp(6), sp(11.5), theme.muted, anchor=(0, 0.5))
        large = self.height >= dp(190)
        y, size = top - sp(34 if large else 30), sp(24 if large else 18)
        size = fitting_size([self.figure], size, room, bold=True)
        yield Word(self.figure, left, y, size, theme.roles[self.nearest_role], bold=True, anchor=(0, 0.5))
        if self.touched and self.height < dp(112):
            yield Word(
                tr("bump"), left, y - size * 0.5 - sp(11), sp(13), theme.danger, bold=True, anchor=(0, 0.5)
            )
            return
        where = first_fitting(
            (self.where, tr("around") if self.figure == tr("clear") else self.where), sp(13), room
        )
        yield Word(where, left, y - size * 0.5 - sp(11), sp(13), theme.muted, anchor=(0, 0.5))
        y = self.y + self.edge + sp(8)
        ink = theme.danger if self.touched else theme.muted
        room += place.radius * 0.25 - sp(20)
        brief = tr("bump") if self.touched else ""
        words = first_fitting((self.bump, brief), sp(13), room, bold=self.touched)
        if words and self.height >= dp(112):
            sign = icon("warning" if self.touched else "check")
            yield Word(sign, left, y, sp(16), ink, font=theme.icons, anchor=(0, 0.5))
            yield Word(words, left + sp(20), y, sp(13), ink, bold=self.touched, anchor=(0, 0.5))

    def _brief(self) -> Iterator[Word]:
        """A contact, or else the nearest echo and which way it is."""
        low, room = self.y + self.edge + sp(7), self.width - 2 * self.edge
        shown, role, under = self.figure, self.nearest_role, self.where
        if self.touched:
            shown, role, under = tr("bump"), "danger", side_text(self.contact) or tr("somewhere")
        yield Word(shown, self.center_x, low + sp(18), sp(15), theme.roles[role], bold=True)
        yield Word(first_fitting((under,), sp(11), room), self.center_x, low, sp(11), theme.muted)


def _arc(x: float, y: float, radius: float, yaw: float, half: float) -> Points:
    angles = np.linspace(yaw - half, yaw + half, 13)
    return np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius + (x, y)


def _room(count: int = 16, *, step_back: float = 0.0) -> SonarRing:
    """A corridor with something near on the left, a wall on the right, open ahead."""
    bearings = [math.remainder(math.tau * i / count, math.tau) for i in range(count)]
    ranges = [1.1 / max(abs(math.sin(b)), 0.25) - 0.2 + step_back for b in bearings]
    ranges[0], ranges[1], ranges[2], ranges[-3] = (
        math.inf,
        0.62 + step_back,
        0.33 + step_back,
        0.7 + step_back,
    )
    ranges[8] = math.nan
    return _ring(bearings, ranges)


def _ring(bearings: list[float], ranges: list[float]) -> SonarRing:
    return SonarRing(
        bearings=Float64Array(bearings),
        field_of_view=0.384,
        radius=0.205,
        range_min=0.1524,
        range_max=6.477,
        ranges=Float32Array(ranges),
    )


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""
    bearings = [math.remainder(math.tau * i / 16, math.tau) for i in range(16)]
    clear, free = _ring(bearings, [math.inf] * 16), Bumper()
    left = Bumper(pressed=True, bearing=math.radians(45))

    def made(
        *told: SonarRing | Bumper, size: tuple[float, float] = (190, 206), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> SonarRingView:
            view = SonarRingView(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            for message in told:
                view.show(message)
            return view

        return build

    return {
        "never": made(),
        "live": made(_room(), free, state="live"),
        "open": made(_room(step_back=2.0), free, state="live"),
        "clear": made(clear, free, state="live"),
        "bump": made(_room(), left, state="live"),
        "bump somewhere": made(_room(), Bumper(pressed=True), state="live"),
        "small": made(_room(), left, state="live", size=(176, 176)),
        "large": made(_room(), free, state="live", size=(326, 228)),
        "large bump": made(_room(), left, state="live", size=(326, 228)),
        "large never": made(size=(326, 228)),
        "short": made(_room(), left, state="live", size=(212, 148)),
        "huge": made(_room(), free, state="live", size=(420, 440)),
        "narrow": made(_room(), free, state="live", size=(98, 132), card=False),
        "low": made(_room(), free, state="live", size=(120, 54)),
        "low bump": made(_room(), left, state="live", size=(72, 54), card=False),
        "stale": made(_room(), free, state="stale", age=2.0),
        "alarm": made(_room(), left, state="alarm", size=(326, 228)),
        "disabled": made(_room(), free, state="disabled"),
    }
