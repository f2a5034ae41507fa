"""Ultrasonic rangers seen from above: free distance on each side.

echoes = UltrasoundView(title="Ultrasound")
robot.on("/range/front", echoes.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, DictProperty, ListProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.sensor_msgs import Range
from bridge.msgs.std_msgs import Header, Time
from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import DASH
from widgets.core.language import tr
from widgets.core.sensor_geometry import aim, away_text, side_text
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.map_marks import arrow
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["UltrasoundView", "samples"]

AHEAD = math.pi / 2
"""Where straight ahead is on the screen [rad]."""
NARROW = 60
"""With less to both sides of the robot the figures are brief [dp]."""
RESOLUTION = 0.01
"""Difference of distance that is read [m]."""
ECHO_TIMEOUT = 1.0
"""An echo older than this against the newest one is not shown any more [s]."""
MIN_HALF_ANGLE = math.radians(16)
"""A cone is drawn no narrower than this to both sides [rad]."""
MAX_RANGERS, MAX_FIGURES = 12, 4
"""Rangers that are drawn, and up to how many each has its figure; of more only what is near has one."""


class UltrasoundView(Gauge):
    """One cone for each ranger, by the name of its frame; its end in the colour of its distance."""

    accepts: ClassVar = (Range,)
    drawn_from: ClassVar = ("echoes", "silent", "reach", "near", "close")

    echoes = DictProperty()
    """The newest Range by frame."""
    silent: ListProperty[str] = ListProperty()
    """Frames that were silent for a while in which others reported."""
    reach = NumericProperty(2.0)
    """Distance at the end of a cone [m]; what is farther is shown in figures only."""
    near = NumericProperty(0.6)
    """Closer than this is a warning [m]."""
    close = NumericProperty(0.3)
    """Closer than this is a danger [m]."""

    def _nearest(self) -> str:
        known = {
            frame: echo.range for frame, echo in self.echoes.items() if not math.isnan(self._distance(frame))
        }
        return min(known, key=lambda frame: known[frame], default="")

    nearest = AliasProperty(_nearest, bind=["echoes", "silent"], cache=True)
    """Frame of the ranger whose echo is nearest; empty before the first echo."""

    def __init__(self, **kwargs: Any) -> None:
        self._stamps: dict[str, float] = {}
        super().__init__(**{"title": tr("Ultrasound"), **kwargs})

    def show(self, msg: Range) -> None:
        """Take the newest echo of one ranger; the others' stay."""
        frame = msg.header.frame_id
        before = self.echoes.get(frame)
        if before is None and len(self.echoes) >= MAX_RANGERS:
            return
        stamp = msg.header.stamp.seconds
        if stamp < self._stamps.get(frame, stamp):
            self._stamps.clear()  # its clock was set back: what was heard by the old one says nothing of silence
        self._stamps[frame] = stamp
        silent = self._silent()
        if silent != self.silent:
            self.silent = silent
        if before is None or _differ(before.range, msg.range):
            self.echoes[frame] = msg

    def _distance(self, frame: str) -> float:
        """What a ranger says now [m]; NaN when it has been silent while others were not."""
        return math.nan if frame in self.silent else float(self.echoes[frame].range)

    def _silent(self) -> list[str]:
        newest = max(self._stamps.values())
        return [frame for frame, stamp in self._stamps.items() if newest - stamp > ECHO_TIMEOUT]

    def figure(self, frame: str, *, brief: bool = False) -> str:
        """A ranger's distance in words; `brief` in metres without saying so, as far as it reaches where it is clear."""
        told, echo = self._distance(frame), self.echoes[frame]
        if math.isnan(told):
            return DASH
        if brief:
            return (
                f">{echo.max_range:g}" if told == math.inf else away_text(max(told, 0.0)).removesuffix(" m")
            )
        if told == math.inf:
            return tr("clear")
        return f"<{echo.min_range * 100:.0f} cm" if told == -math.inf else away_text(told)

    def role(self, frame: str) -> str:
        """Role of the colour of a ranger's distance."""
        told = self._distance(frame)
        if math.isnan(told):
            return "faint"
        return "danger" if told < self.close else "warn" if told < self.near else "accent"

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The cones, the robot between them, and the distances."""
        if self.low:
            yield from self._brief(shapes)
            return
        narrow = self.width / 2 - self.edge < dp(NARROW)
        yield from self.header(("m",) if narrow and self.echoes else (), "muted", told=False)
        top = self.top - self.edge - sp(16)
        x, y = self.center_x, (self.y + self.edge + top) / 2
        across, high = self.width / 2 - self.edge, (top - self.y - self.edge) / 2
        longest = max(min(across - dp(6), high - sp(18)), dp(14))
        for frame in self.echoes:
            yield self._cone(shapes, frame, (x, y, longest, across))
        shapes.polygon(arrow(x, y, AHEAD, dp(15)), theme.text)
        if not self.echoes:
            yield Word(DASH, x, y - dp(22), sp(14), theme.muted)

    def _cone(self, shapes: Shapes, frame: str, place: tuple[float, float, float, float]) -> Word:
        x, y, longest, across = place
        yaw, told, echo = aim(frame) + AHEAD, self._distance(frame), self.echoes[frame]
        half = max(echo.field_of_view / 2, MIN_HALF_ANGLE)
        inner, role = dp(9), self.role(frame)
        colour = theme.roles[role]
        share = 0.0 if math.isnan(told) else min(max(told, 0.0), self.reach) / self.reach
        length = inner + (longest - inner) * share
        shapes.sector(x, y, longest, yaw=yaw, half_angle=half, colour=tint(theme.muted, 0.22))
        if not math.isnan(told):
            shapes.sector(x, y, length, yaw=yaw, half_angle=half, colour=tint(colour, 0.35))
            angles = np.linspace(yaw - half, yaw + half, 9)
            rim = np.stack([np.cos(angles), np.sin(angles)], axis=1) * length + (x, y)
            if told < self.reach:
                shapes.line(rim, dp(3), colour)
        written = len(self.echoes) <= MAX_FIGURES or role in ("warn", "danger")
        text = self.figure(frame, brief=across < dp(NARROW)) if written else ""
        words = theme.text if role == "accent" else theme.muted if role == "faint" else colour
        end_x, end_y = math.cos(yaw), math.sin(yaw)
        if abs(end_x) > 0.9:
            aside = x + math.copysign(across, end_x)
            low = y - math.sin(half) * longest - sp(9)
            return Word(text, aside, low, sp(12), words, bold=True, anchor=(1.0 if end_x > 0 else 0.0, 0.5))
        distance = longest + sp(9)
        half_wide = wide(text, sp(12), bold=True) / 2
        at = x + end_x * distance, y + end_y * distance
        inside = min(max(at[0], x - across + half_wide), x + across - half_wide)
        return Word(text, inside, at[1], sp(12), words, bold=True)

    def _brief(self, shapes: Shapes) -> Iterator[Word]:
        """The nearest echo and which way it is."""
        frame = self.nearest
        low = self.y + self.edge + sp(7)
        if not frame:
            yield Word(DASH, self.center_x, self.center_y, sp(14), theme.muted)
            return
        role = self.role(frame)
        colour = theme.text if role == "accent" else theme.roles[role]
        size = sp(15)
        text = self.figure(frame)
        y = low + sp(9) + sp(9)
        far = math.isinf(self.echoes[frame].range) and self.echoes[frame].range > 0
        shift = 0.0 if far else dp(9)
        yield Word(text, self.center_x + shift, y, size, colour, bold=True)
        if not far:
            left = self.center_x + shift - wide(text, size, bold=True) / 2 - dp(9)
            shapes.polygon(arrow(left, y, aim(frame) + AHEAD, dp(13)), colour)
        names = (
            (tr("all around"), tr("clear"))
            if far
            else (tr("echo {side}").format(side=side_text(aim(frame))), side_text(aim(frame)))
        )
        under = first_fitting(names, sp(11), self.width - 2 * self.edge)
        yield Word(under, self.center_x, low, sp(11), theme.muted)


def _differ(one: float, other: float) -> bool:
    """Whether two distances are read as different: a thing that stands still is not drawn anew for its noise."""
    if math.isfinite(one) and math.isfinite(other):
        return abs(one - other) > RESOLUTION
    return one != other and not (math.isnan(one) and math.isnan(other))


def _echo(side: str, away: float, stamp: float = 10.0) -> Range:
    return Range(
        header=Header(Time.at(stamp), f"ultrasound_{side}"),
        field_of_view=math.radians(15),
        min_range=0.02,
        max_range=4.0,
        range=away,
    )


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""
    usual = {"front": 0.42, "left": 1.37, "right": math.inf, "rear": 0.21}

    def made(
        echoes: dict[str, float] | None = None, size: tuple[float, float] = (150, 172), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> UltrasoundView:
            view = UltrasoundView(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            for side, away in (echoes or {}).items():
                view.show(_echo(side, away, 0.0 if math.isnan(away) else 10.0))
            return view

        return build

    clear = dict.fromkeys(usual, math.inf)
    return {
        "never": made(),
        "live": made(usual, state="live"),
        "clear": made(clear, state="live"),
        "touching": made({**usual, "front": -math.inf}, state="live"),
        "one silent": made({**usual, "left": math.nan}, state="live"),
        "six": made(
            {"front_left": 0.9, "front_right": 0.5, "rear_left": 1.8, "rear_right": 0.2, **usual},
            state="live",
        ),
        "low": made(usual, state="live", size=(120, 54)),
        "low and clear": made(clear, state="live", size=(120, 54)),
        "narrow": made(usual, state="live", size=(72, 54), card=False),
        "small": made(usual, state="live", size=(98, 132), card=False),
        "stale": made(usual, state="stale", age=2.0),
        "alarm": made(usual, state="alarm"),
        "disabled": made(usual, state="disabled"),
    }
