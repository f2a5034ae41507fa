"""The line of a jetty's berth: where a boat is on it, and the orders that lead along it."""

from __future__ import annotations

import math
from dataclasses import replace

from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, Place
from robotside.core.pose2 import Pose2
from robotside.motion.speed_limit import within
from robotside.navigation.navigator import Navigator
from robotside.perception.cage_finder import CageSighting, FrontView
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.cage_sight import CageSight, Look
from robotside.tasks.berthing.jetty_steering import JettySteering
from robotside.tasks.berthing.tag_mirror import unmirrored

__all__ = ["CAMERA_BEHIND", "LEAN", "JettyLine"]

RECESS = 0.22
"""The tag stands so far behind what the bow touches [m]."""

CAMERA_BEHIND = 0.18
"""A boat's camera is taken to be so far behind its bow [m]: no robot tells where its camera is."""

REACH = 4.0
"""The jetty is first seen no farther than this from where it should be [m]: a usual satellite receiver, and the map's error."""

LEAN = 0.06
"""It leans on the jetty with the push that would make it so fast through still water [m/s]."""

MAP_TURN, MAX_TURN = 0.25, 0.45
"""The direction that the map has is usually wrong by no more than the first, and what is seen turned from it by more than the second is none of it [rad]."""

FUNNEL, FUNNEL_END = 0.25, 0.15
"""It looks aside no farther for each metre that is left, nor than the second at the berth [rad]."""

MOST_ASIDE = 0.9
"""And nowhere farther than this [rad]: the tag would leave the picture."""

BACK_GAIN, MAX_BACK_TURN = 0.4, 0.2
"""Astern: turn rate for a heading that is off [1/s], and the most [rad/s]."""


class JettyLine:
    """Of one jetty and one boat, by what is seen of the jetty, and by the map before."""

    def __init__(
        self, jetty: Place, navigator: Navigator, situation: Situation, look: Look, front: float
    ) -> None:
        """`jetty` has a direction; `look` finds tags, and `front` is from the boat's middle to its bow [m]."""
        self._navigator, self._situation, self._front = navigator, situation, front
        self._mapped = Pose2(jetty.x, jetty.y, jetty.yaw).then(Pose2(front, 0.0, 0.0))
        self._look = look
        self.sight, self._steering = CageSight(self._faces, situation, REACH), JettySteering()

    def begin(self) -> None:
        """Know nothing but the map."""
        self.sight.forget()
        self._steering.begin()

    def look(self) -> None:
        """Take in the newest picture, once."""
        self.sight.take(self._on_map())

    def where(self) -> tuple[Pose2, float]:
        """The boat in the frame of what its bow touches, and its bow before that [m]."""
        robot = self._pose().inverse()
        return robot, -robot.x - self._front

    def docked(self) -> Pose2:
        """Where the boat lies docked, in `map`."""
        return self._situation.pose.then(self._pose()).then(Pose2(-self._front, 0.0, 0.0))

    def aside(self) -> float:
        """Of its bow off the line, to the left [m]."""
        robot, _ = self.where()
        return robot.y + self._front * math.sin(robot.yaw)

    def moving(self) -> Pose2:
        """Its speed in the frame of the jetty, without the error of its log [m/s], and how fast it turns [rad/s]."""
        now, (x, y), yaw = self._situation, self.sight.error, self.where()[0].yaw
        ahead, left = now.moving.x - x, now.moving.y - y
        cosine, sine = math.cos(yaw), math.sin(yaw)
        return Pose2(cosine * ahead - sine * left, cosine * left + sine * ahead, now.moving.yaw)

    def go(self, ahead: float, way: float) -> None:
        """Go `ahead` along the line over ground [m/s], with at least `way` through the water [m/s]."""
        robot, gap = self.where()
        most = min(MOST_ASIDE, FUNNEL_END + FUNNEL * max(0.0, gap))
        push = self._steering.line(
            robot, self.aside(), self.moving(), ahead, most=most, way=way, now=self._situation.now
        )
        self._course(push.yaw, push.speed)

    def back(self, speed: float) -> None:
        """Go astern at a `speed` through the water [m/s], its heading along the line as far as its rudder can."""
        self._steering.lie()
        turn = within(-BACK_GAIN * self.where()[0].yaw, MAX_BACK_TURN) if self.moving().x < 0 else 0.0
        self._navigator.move(Twist.planar(-speed, turn))

    def lean(self) -> None:
        """Lean on the jetty, and brake what waves do to it there."""
        self._steering.lie()
        self._straight(LEAN - self.moving().x)

    def creep(self, ahead: float) -> None:
        """Go `ahead` over ground [m/s] with the rudder amidships: on so slow a course a boat kicks ahead to turn."""
        robot, moving = self.where()[0], self.moving()
        self._straight(self._steering.straight(robot, moving, ahead, self._situation.now))

    def _straight(self, speed: float) -> None:
        """Keep a `speed` through the water [m/s], rudder amidships."""
        self._navigator.command(Manoeuvre(kind="steer", speed=speed, steering=0.0))

    def _course(self, yaw: float, speed: float) -> None:
        """Look off the line by `yaw` [rad], at a `speed` through the water [m/s]."""
        now, robot = self._situation, self.where()[0]
        self._navigator.command(
            Manoeuvre(kind="course", yaw=wrap(now.pose.yaw - robot.yaw + yaw), speed=speed)
        )

    def _faces(self, view: FrontView) -> list[CageSighting]:
        """What the bow would touch, of each tag in a picture."""
        mapped, ahead = self._on_map().yaw, self._front - CAMERA_BEHIND
        expected = mapped + within(wrap(self._pose().yaw - mapped), MAP_TURN)
        faces = (_face_of(unmirrored(seen, ahead, expected)) for seen in self._look(view))
        return [face for face in faces if abs(wrap(face.pose.yaw - mapped)) < MAX_TURN]

    def _on_map(self) -> Pose2:
        return self._mapped.since(self._situation.pose)

    def _pose(self) -> Pose2:
        """What the bow touches, in `base_link`: as it was seen, else as the map has it."""
        return self.sight.pose() or self._on_map()


def _face_of(tag: CageSighting) -> CageSighting:
    """What the bow would touch below a tag."""
    return replace(tag, pose=tag.pose.then(Pose2(-RECESS, 0.0, 0.0)))
