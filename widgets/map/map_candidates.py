"""The doubt about the robot's place on a map: how far it may be off, and at which of several places it may be.

A candidate is a letter in a diamond with its share beside it, so that shape and word tell it and not its colour alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from kivy.input import MotionEvent
from kivy.metrics import dp, sp
from kivy.properties import ListProperty

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import PlaceCandidate, PlaceCandidates
from widgets.core.candidate_letters import candidate_letters, share_words
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import Points, nearest
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map import map_marks as marks
from widgets.map.map_robot import MapRobot

__all__ = ["MapCandidates", "ellipse_of"]

MAX_VARIANCE = 1e6
"""Of a place [m2]; one that is told a larger one, or none that is a number, has no ellipse."""
SIGMAS = 2.0
"""The ellipse holds the robot in 86 of 100 cases: so many standard deviations."""
UNSURE_SPREAD = 1.0
"""A robot that may be off by this many metres is drawn hollow."""
STEP = 0.05
"""A change of the ellipse that is less is not drawn [m]."""
CORNERS = 48
"""Of the ellipse."""


def ellipse_of(xx: float, xy: float, yy: float) -> tuple[float, float, float]:
    """Long and short half axis [m] and the direction of the long one [rad] of a variance of x and y [m2]; zeros beyond `MAX_VARIANCE` and for no number."""
    if not all(abs(each) <= MAX_VARIANCE for each in (xx, xy, yy)):
        return 0.0, 0.0, 0.0
    middle, off = (xx + yy) / 2, math.hypot((xx - yy) / 2, xy)
    long, short = (SIGMAS * math.sqrt(max(0.0, middle + sign * off)) for sign in (1, -1))
    return long, short, math.atan2(2 * xy, xx - yy) / 2


class MapCandidates(MapRobot):
    """A map that shows how sure the robot is of its place."""

    candidates: ListProperty[PlaceCandidate] = ListProperty()
    """Where it may be, while it asks which of them it is; empty otherwise."""
    doubt: ListProperty[float] = ListProperty([0.0, 0.0, 0.0])
    """Long and short half axis [m] and direction of the long one [rad] of the ellipse that it is in."""

    __events__ = ("on_choose_candidate",)  # type: ignore[assignment]

    def on_choose_candidate(self, number: int) -> None:
        """A tap says that the robot is at the candidate of this `number`, its id."""

    def show(self, msg: Msg) -> None:
        """Take over where the robot may be."""
        if isinstance(msg, PlaceCandidates):
            found = [each for each in msg.candidates if math.isfinite(each.x + each.y + each.yaw)]
            self.candidates = found if len(found) > 1 else []
        else:
            super().show(msg)  # type: ignore[misc]

    @property
    def unsure(self) -> bool:
        """Where it is drawn it need not be."""
        return bool(self.candidates) or self.doubt[0] >= UNSURE_SPREAD

    def _show_pose(self, msg: PoseWithCovarianceStamped) -> None:
        variance = msg.pose.covariance
        fresh = ellipse_of(
            *(variance[0], variance[1], variance[7]) if len(variance) == 36 else (0.0, 0.0, 0.0)
        )
        if abs(fresh[0] - self.doubt[0]) > STEP or abs(fresh[1] - self.doubt[1]) > STEP:
            self.doubt = list(fresh)
        super()._show_pose(msg)

    def _robot_shapes(
        self, shapes: Shapes, pose: tuple[float, float, float], *, faded: bool, alarm: bool
    ) -> None:
        disc = self._robot_disc()
        self._draw_doubt(shapes, pose, disc)
        if not self.unsure:
            super()._robot_shapes(shapes, pose, faded=faded, alarm=alarm)
            return
        x, y = self.view.to_screen(*pose[:2])
        colour = theme.danger if alarm else theme.muted if faded else theme.warn
        shapes.disc(x, y, disc + dp(3), tint(theme.bg, 0.6))
        shapes.ring(x, y, disc, dp(2.6), colour, dashes=12)
        shapes.polygon(marks.arrow(x, y, pose[2] + self.view.turn, disc), colour)

    def _draw_doubt(self, shapes: Shapes, pose: tuple[float, float, float], disc: float) -> None:
        long, short, way = self.doubt
        if long * self.view.scale < disc + dp(6):
            return  # it is not larger than the robot
        around = np.linspace(0.0, math.tau, CORNERS + 1)
        u, v = long * np.cos(around), max(short, 1e-3) * np.sin(around)
        cos, sin = math.cos(way), math.sin(way)
        places: Points = np.column_stack((pose[0] + cos * u - sin * v, pose[1] + sin * u + cos * v))
        seen = self.view.many_to_screen(places)
        shapes.dashes(seen, dp(3), theme.warn, period=dp(11), dash=dp(5))

    def _candidate_marks(self, shapes: Shapes) -> Iterator[Word]:
        """A diamond with a letter for each candidate, an arrow where it would look, and how likely it is."""
        size = max(self.mark_radius * 1.15, dp(15))
        for each, letter in zip(self.candidates, candidate_letters(self.candidates), strict=True):
            x, y = self.view.to_screen(each.x, each.y)
            if self._under_placed(x, y, size * 1.35):
                continue
            yaw = each.yaw + self.view.turn
            tip = (x + 2.1 * size * math.cos(yaw), y + 2.1 * size * math.sin(yaw))
            shapes.line(np.array([(x, y), tip]), dp(6), tint(theme.bg, 0.7))
            shapes.line(np.array([(x, y), tip]), dp(3), theme.warn)
            for reach, colour in ((size * 1.35, theme.warn), (size * 1.1, theme.bg)):
                shapes.polygon([(x + reach, y), (x, y + reach), (x - reach, y), (x, y - reach)], colour)
            yield Word(letter, x, y, size, theme.warn, True)
            share = Word(share_words(each.share), x, y - size * 1.35 - dp(12), sp(14), theme.text, True)
            ground(shapes, share, tint(theme.bg, 0.85))
            yield share

    def _under_placed(self, x: float, y: float, reach: float) -> bool:
        """A sign at (x, y) of that `reach` [px] lies under the robot that is being placed, which it would be taken for."""
        if not self.placed:
            return False
        return math.dist((x, y), self.view.to_screen(*self.placed[:2])) < reach + self._robot_disc()

    def _tap_to_look(self, touch: MotionEvent) -> None:
        seen = [self.view.to_screen(each.x, each.y) for each in self.candidates]
        index = nearest(seen, *touch.pos, theme.target / 2)
        if index < 0:
            super()._tap_to_look(touch)
        else:
            self.dispatch("on_choose_candidate", self.candidates[index].id)
