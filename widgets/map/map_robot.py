"""The robot on a map: its pose and trail, its outline to scale, and a view that follows it and turns with it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from kivy.metrics import dp
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, StringProperty

from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import RobotInfo
from widgets.core.canvas_ink import Word
from widgets.core.geometry import Points, Trail, View
from widgets.core.shapes import Shapes
from widgets.map import map_marks as marks
from widgets.map.map_heights import pose_words, robot_height
from widgets.map.map_viewport import MapViewport

__all__ = ["MapRobot", "corners", "turned"]

SEEN, SEEN_TURN = 0.25, math.radians(0.25)
"""A shift [px] and a turn [rad] of the robot that are less are not seen."""
MAX_UNSEEN = 0.05
"""Greatest shift that is left out on a small map [m]."""
MAX_CORNERS = 64
"""Of an outline that is drawn."""
MIN_LENGTH = 26.0
"""Least length of the outline on the glass [dp]; where the map is smaller than that, a disc stands for the robot."""


class MapRobot(MapViewport):
    """A map that knows where the robot is and what it looks like."""

    robot_radius = NumericProperty(0.2)
    """Of the robot itself [m]; its disc never gets smaller than that on the map."""
    footprint: ListProperty[tuple[float, float]] = ListProperty()
    """Corners of its outline in `base_link`, (x ahead, y left) [m]; empty draws a disc."""
    camera_fov = NumericProperty(math.nan)
    """Horizontal field of view of its camera [rad]; NaN draws none."""
    height_words = StringProperty("")
    """How high or deep it is, beside its sign; empty on the ground and at the surface, and where that is not known."""
    heights: ListProperty[float | None] = ListProperty()
    """Of the waypoints, in their order, above the map's origin [m]; None, and where there are fewer, for none of its own."""
    heading_up = BooleanProperty(False)
    """While the robot is followed, the way it looks is up; else the map stays turned as it is."""

    def __init__(self, **kwargs: Any) -> None:
        self._trail = Trail()
        super().__init__(**kwargs)

    @property
    def trail(self) -> Points:
        """Where it has been, oldest first, shape (n, 2) [m]; the newest 2,000 points are kept."""
        return self._trail.points

    def retrace(self, places: Points) -> None:
        """Have the trail lead through these places instead, oldest first, shape (n, 2) [m]."""
        self._trail.replace(places)
        self.property("robot").dispatch(self)  # what draws it follows the robot

    def centre_on_robot(self) -> None:
        """Bring the robot into the middle of what is free and keep it there; nothing while it is not located."""
        super().centre_on_robot()
        self._turn_with_robot()

    def follow_or_turn(self) -> None:
        """Follow the robot; once it is followed, change between the way it looks up and north up."""
        if self.follow:
            self.look_ahead()
        else:
            self.centre_on_robot()

    def look_ahead(self) -> None:
        """Have the way it looks up, and follow it; again for north."""
        if self.heading_up:
            self.north_up()
        else:
            self.heading_up = True
            self.centre_on_robot()

    def north_up(self) -> None:
        """Have north up, about the middle of what is free."""
        self.heading_up = False
        self._turn_to(0.0)

    def on_heading_up(self, *_: object) -> None:
        """Turn at once where the robot is followed."""
        self._turn_with_robot()

    def _turn_with_robot(self) -> None:
        if self.heading_up and self.follow and self.located:
            self._turn_to(math.pi / 2 - self.robot[2])

    def _turn_to(self, turn: float) -> None:
        if not self.may_turn or turn == self.view.turn:
            return
        middle = self._free_middle()
        there = self.view.to_world(*middle)
        self.view = View.centred(*there, at=middle, scale=self.view.scale, turn=turn)

    def _show_pose(self, msg: PoseWithCovarianceStamped) -> None:
        pose, first = msg.pose.pose, not self.located
        self.height_words = pose_words(msg)
        place = [pose.position.x, pose.position.y, pose.orientation.yaw]
        if not (self.located and self._looks_alike(place)):
            self.robot = place
        if not self.located:
            return
        self._trail.add(*self.robot[:2])
        if self.follow:
            self._centre(*self.robot[:2])
            self._turn_with_robot()
        elif first:
            self._fit_until_touched()

    def _looks_alike(self, place: Sequence[float]) -> bool:
        """The robot there could not be told from where it is shown: no reason to draw the map anew 20 times a second."""
        step = min(SEEN / self.view.scale, MAX_UNSEEN)
        x, y, yaw = self.robot
        return math.dist(place[:2], (x, y)) < step and abs(place[2] - yaw) < SEEN_TURN

    def _robot_disc(self) -> float:
        return float(max(self.mark_radius * 1.1, self.robot_radius * self.view.scale))

    def _outline(self, pose: tuple[float, float, float]) -> Points | None:
        """The corners on the glass [px]; None where there is no outline, or where it would be too small to see."""
        if len(self.footprint) < 3:
            return None
        seen = self.view.many_to_screen(turned(self.footprint, pose))
        return seen if np.ptp(seen, axis=0).max() >= dp(MIN_LENGTH) else None

    def _robot_shapes(
        self, shapes: Shapes, pose: tuple[float, float, float], *, faded: bool, alarm: bool
    ) -> None:
        outline = self._outline(pose)
        fov = math.nan if faded else self.camera_fov
        disc = self._robot_disc()
        if outline is not None:
            marks.outline_mark(shapes, outline, faded=faded, alarm=alarm)
            disc = min(disc, self.mark_radius * 1.1, float(np.ptp(outline, axis=0).min()) * 0.4)
        marks.robot_mark(shapes, self.view, pose, disc, fov=fov, faded=faded, alarm=alarm)

    def _robot_words(
        self, shapes: Shapes, pose: tuple[float, float, float], *, faded: bool
    ) -> Iterator[Word]:
        """What stands beside its sign: how high or deep it is."""
        outline, low = self._outline(pose), self._robot_disc()
        if outline is not None:
            low = max(low, float(np.ptp(outline, axis=0).max()) / 2)
        at = self.view.to_screen(*pose[:2])
        yield from robot_height(shapes, at, self.height_words, low, faded=faded)


def corners(info: RobotInfo) -> list[tuple[float, float]]:
    """The outline that a robot tells of itself [m]; empty for a round one, and for what is no outline."""
    found = [(corner.x, corner.y) for corner in info.footprint]
    sound = 3 <= len(found) <= MAX_CORNERS and all(math.isfinite(value) for pair in found for value in pair)
    return found if sound else []


def turned(corners: Sequence[tuple[float, float]], pose: tuple[float, float, float]) -> Points:
    """Corners in `base_link` as places in `map` [m], for a robot at `pose`: x, y [m] and yaw [rad]."""
    x, y, yaw = pose
    cos, sin = math.cos(yaw), math.sin(yaw)
    return np.array([(x + cos * u - sin * v, y + sin * u + cos * v) for u, v in corners])
