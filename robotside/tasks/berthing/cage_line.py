"""The line of a cage: where a robot is on it, and the orders that lead along it."""

from __future__ import annotations

import math

from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import Manoeuvre, Place
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Navigator
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.cage_sight import CageSight, Look
from robotside.tasks.berthing.cage_steering import CageSteering, Push, Velocity

__all__ = ["CREEP", "LEAN", "TAG_ABOVE", "CageLine"]

TAG_ABOVE = 0.24
"""Of the middle of the tag above the coil [m]."""

AT_COIL, CREEP, LEAN = 0.03, 0.05, 0.05
"""With its nose so near to the coil it leans on it [m]; up to there it goes so fast, and leans with such a push [m/s]."""


class CageLine:
    """Of one cage and one robot, by what is seen of the cage, and by the map before."""

    def __init__(
        self, cage: Place, navigator: Navigator, situation: Situation, look: Look, front: float
    ) -> None:
        """`cage` has a direction; `front` is from the robot's middle to its coil [m]."""
        self._cage, self._navigator, self._situation, self._front = cage, navigator, situation, front
        self.sight, self._steering = CageSight(look, situation), CageSteering()
        self.height = math.nan
        """That it keeps where it sees no cage, above the map's origin [m]."""

    def begin(self) -> None:
        """Know nothing but the map."""
        self.sight.forget()
        self._steering.begin()

    def look(self) -> None:
        """Take in the newest picture, once."""
        self.sight.take(self._on_map())

    def where(self) -> tuple[Pose2, float]:
        """The robot in the frame of the coil, and its nose before it [m]."""
        robot = self._pose().inverse()
        return robot, -robot.x - self._front

    def moving(self) -> Velocity:
        """Its speed in the frame of the cage, without the error of its log [m/s]."""
        now, (x, y), yaw = self._situation, self.sight.error, self._pose().yaw
        ahead, left = now.moving.x - x, now.moving.y - y
        cosine, sine = math.cos(yaw), math.sin(yaw)
        return cosine * ahead + sine * left, cosine * left - sine * ahead

    @property
    def wanted(self) -> float:
        """The height of the coil above the map's origin [m]."""
        return self.height if math.isnan(self.sight.height) else self.sight.height - TAG_ABOVE

    def keep(self, gap: float, height: float, look: float = 0.0) -> None:
        """Come to rest on the line, the nose so far before the coil [m], at a `height`, to `look` aside there [rad]."""
        point, robot, now = (-gap - self._front, 0.0), self.where()[0], self._situation.now
        self._do(self._steering.keep(robot, self.moving(), point, look, now), height)

    def go(self, ahead: float, most: float) -> None:
        """Go `ahead` along the line [m/s], negative is back, looking aside no farther than `most` for it [rad]."""
        push = self._steering.line(self.where()[0], self.moving(), ahead, most, self._situation.now)
        self._do(push, self.wanted)

    def press(self) -> None:
        """Come up to the coil and lean on it: what still slides aside would leave it again."""
        if self.where()[1] > AT_COIL:
            self.go(CREEP, 0.0)
        else:
            self._do(self._steering.lean(LEAN), self.wanted)

    def _on_map(self) -> Pose2:
        """The coil in `base_link`, as the map has it."""
        face = Pose2(self._cage.x, self._cage.y, self._cage.yaw).then(Pose2(self._front, 0.0, 0.0))
        return face.since(self._situation.pose)

    def _pose(self) -> Pose2:
        """The coil in `base_link`: as it was seen, else as the map has it."""
        return self.sight.pose() or self._on_map()

    def _do(self, push: Push, height: float) -> None:
        lowest, highest = self._navigator.heights
        yaw = wrap(self._situation.pose.yaw + self._pose().yaw + push.yaw)
        level = height if math.isnan(height) else min(max(height, lowest), highest)
        self._navigator.command(Manoeuvre(kind="course", yaw=yaw, speed=push.speed, height=level))
