"""An arm with four or five joints and a gripper that goes to named poses, to angles, by increments, or with its tip to a point."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

from bridge.msgs import Msg
from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import ArmOrder, ArmState
from bridge.msgs.std_msgs import Header, Time
from sim.core.parameters import Positive
from sim.core.shapes import Shape, Vec3, compose, from_yaw, rotate
from sim.dynamics.control import given, towards
from sim.payloads.kinematics import BENDING, Angles, Arm
from sim.payloads.mounted import Mount
from sim.payloads.simple import on_deck
from sim.physics.backend_bullet import State
from sim.sensors.suite import Measurement
from sim.vehicles.model import Vehicle

__all__ = ["ArmParameters", "MountedArm"]

ARM_RATE = 20.0
"""Of its motion and of its messages [Hz]."""
HAND_RADIUS = 0.03
"""Radius round its tip within which the hand touches things [m]."""
ANGLE_TOLERANCE = 1e-3
"""Angles nearer than this are the same [rad]."""
FINGER = 0.055
"""Length of a finger [m]."""
THICKNESS = 0.012
"""Of a finger [m]."""
_STEEL, _BLACK = (0.30, 0.32, 0.35), (0.09, 0.09, 0.10)

Pair = tuple[float, float]


class ArmParameters(Mount, frozen=True, kw_only=True):
    """The arm."""

    foot: Pair
    upper: Pair
    fore: Positive
    hand: Positive
    joints: tuple[str, ...]
    """Names, from the foot on: four, or five with one that turns the hand about its own length."""
    limits: tuple[Pair, ...]
    """Least and greatest angle of each joint."""
    speed: Positive
    """Of a joint [rad/s]."""
    gripper: Pair
    """Opening shut and wide [m]."""
    gripper_speed: Positive
    """[m/s]"""
    poses: dict[str, Angles]
    """Angles by name; the first is the one that it starts in."""


class MountedArm:
    """An arm on a vehicle; what it carries does not weigh, and its links bump into nothing."""

    accepts: type[Msg] | None = ArmOrder

    def __init__(self, vehicle: Vehicle, figures: ArmParameters) -> None:
        """On the deck of `vehicle`, in its first pose, gripper wide open; ValueError for figures that contradict each other."""
        self._figures = figures
        if not BENDING <= len(figures.joints) == len(figures.limits) <= BENDING + 1:
            count = f"{len(figures.joints)} joints and the limits of {len(figures.limits)}"
            raise ValueError(f"An arm has four or five joints, and limits for each, not {count}.")
        self.arm = Arm(figures.foot, figures.upper, figures.fore, figures.hand, figures.limits)
        for name, angles in figures.poses.items():
            if not self.arm.allowed(angles):
                raise ValueError(f"The arm's pose {name!r} is beyond the limits of its joints.")
        self._at = on_deck(vehicle, figures.at)
        self.angles: Angles = next(iter(figures.poses.values()))
        """Of the joints from the foot on [rad]."""
        self._wanted = self.angles
        self._gripper = self._opening = figures.gripper[1]
        self._backend, self._body = vehicle.scene.backend, vehicle.body
        vehicle.suite.add("arm", ARM_RATE, self._move)

    @property
    def power(self) -> float:
        """Power that it takes now [W]: a third for holding still."""
        return self._figures.power * (1.0 if self._moves else 1 / 3)

    @property
    def tip(self) -> Vec3:
        """Between the fingertips, in `base_link` [m]."""
        return self._placed(self.arm.forward(self.angles).tip)

    def command(self, order: Msg) -> None:
        """Go to a pose, a point or angles; ValueError with one sentence when that cannot be."""
        if not isinstance(order, ArmOrder):
            raise ValueError("The arm takes an ArmOrder.")  # noqa: TRY004 - what a port refuses is a ValueError
        low, high = self._figures.gripper
        opening = given(order.gripper, self._opening)
        if not low <= opening <= high:
            raise ValueError(f"The gripper opens from {low:g} to {high:g} m, not {opening:g} m.")
        self._wanted = self._goal(order)
        self._opening = opening

    def hold(self) -> None:
        """Stay as it is, gripper and all."""
        self._wanted, self._opening = self.angles, self._gripper

    def shapes(self) -> tuple[Shape, ...]:
        """Its visible shapes, in `base_link`."""
        joints = [self._placed(point) for point in self.arm.points(self.angles)]
        x, y, z = self._at
        foot = Shape(
            "cylinder",
            (0.07, 0.07, self._figures.foot[1]),
            (x, y, z + self._figures.foot[1] / 2),
            colour=_BLACK,
        )
        knobs = [Shape("sphere", (0.045,) * 3, joint, colour=_BLACK) for joint in joints[:3]]
        palm, *fingers = self._gripping(joints[3])
        links = [_link(one, other) for one, other in itertools.pairwise((*joints[:3], palm.position))]
        return (foot, *links, *knobs, palm, *fingers)

    def _gripping(self, tip: Vec3) -> tuple[Shape, Shape, Shape]:
        """The palm and two fingers as far apart as they are open, turned as the hand is."""
        turn, *bends = self.angles[:BENDING]
        pitch, roll = sum(bends), sum(self.angles[BENDING:])
        hand = compose(from_yaw(turn), (0.0, math.sin(pitch / 2), 0.0, math.cos(pitch / 2)))
        hand = compose(hand, (math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2)))

        def box(size: Vec3, back: float, side: float = 0.0) -> Shape:
            x, y, z = rotate(hand, (-back, side, 0.0))
            return Shape("box", size, (tip[0] + x, tip[1] + y, tip[2] + z), hand, _BLACK)

        apart, finger = (self._gripper + THICKNESS) / 2, (FINGER, THICKNESS, 0.02)
        palm = box((0.02, self._figures.gripper[1] + 2 * THICKNESS, 0.025), FINGER)
        return palm, box(finger, FINGER / 2, -apart), box(finger, FINGER / 2, apart)

    @property
    def _moves(self) -> bool:
        return self.angles != self._wanted or self._gripper != self._opening

    def _goal(self, order: ArmOrder) -> Angles:
        """The angles that an order means."""
        told = (
            bool(order.pose),
            not math.isnan(order.point.x),
            len(order.angles) > 0,
            len(order.increments) > 0,
        )
        if sum(told) > 1:
            raise ValueError("Give the arm one goal: a pose, a point, angles, or increments.")
        if order.pose:
            if order.pose not in self._figures.poses:
                known = ", ".join(self._figures.poses)
                raise ValueError(f"The arm knows no pose {order.pose!r}; it knows {known}.")
            return self._figures.poses[order.pose]
        if not math.isnan(order.point.x):
            x, y, z = order.point.x, order.point.y, order.point.z
            own = (x - self._at[0], y - self._at[1], z - self._at[2])
            finite = all(map(math.isfinite, own)) and not math.isinf(order.pitch)
            found = self.arm.inverse(own, order.pitch) if finite else None
            if found is None:
                raise ValueError(f"The arm does not reach ({x:.2f}, {y:.2f}, {z:.2f}).")
            return found + self._wanted[BENDING:]
        if len(order.angles):
            return self._within(tuple(order.angles))
        if len(order.increments):
            return self._within(self._wanted, tuple(order.increments))
        return self._wanted

    def _within(self, angles: Angles, increments: Angles = ()) -> Angles:
        """`angles` with what is added to each; ValueError when that is too few, too many, or beyond a joint's limits."""
        joints, count = self._figures.joints, len(increments or angles)
        if count != len(joints):
            raise ValueError(f"The arm has {len(joints)} joints, {', '.join(joints)}; {count} are given.")
        goal = tuple(map(sum, zip(angles, increments, strict=True))) if increments else angles
        number = self.arm.beyond(goal)
        if number is None:
            return goal
        (low, high), said = self._figures.limits[number], f"not to {goal[number]:g} rad"
        if increments:
            said += f", which is {angles[number]:g} and {increments[number]:g}"
        raise ValueError(f"The joint {joints[number]} goes from {low:g} to {high:g} rad, {said}.")

    def _placed(self, point: Vec3) -> Vec3:
        return (self._at[0] + point[0], self._at[1] + point[1], self._at[2] + point[2])

    def _move(self, _: State, stamp: float) -> Iterator[Measurement]:
        """One period later; all joints arrive together."""
        most = max(abs(goal - now) for goal, now in zip(self._wanted, self.angles, strict=True))
        share = min(1.0, self._figures.speed / ARM_RATE / most) if most else 1.0
        way = tuple(now + share * (goal - now) for goal, now in zip(self._wanted, self.angles, strict=True))
        self.angles = self._wanted if share == 1.0 else way
        self._gripper = towards(self._gripper, self._opening, self._figures.gripper_speed / ARM_RATE)
        yield "/arm", self._state(stamp)

    def _state(self, stamp: float) -> ArmState:
        tip, pitch = self.tip, self.arm.forward(self.angles).pitch
        poses = self._figures.poses
        here = (
            name
            for name, angles in poses.items()
            if all(abs(a - b) < ANGLE_TOLERANCE for a, b in zip(angles, self.angles, strict=True))
        )
        return ArmState(
            Header(Time.at(stamp), "base_link"),
            [*self._figures.joints],
            Float64Array(self.angles),
            Float64Array(self._wanted),
            self._gripper,
            self._opening,
            next(here, ""),
            list(poses),
            Point(*tip),
            pitch,
            self._touches(tip),
        )

    def _touches(self, tip: Vec3) -> bool:
        """Whether something is within a finger's breadth of the tip, by rays along three axes."""
        ends = []
        for axis in range(3):
            near, far = list(tip), list(tip)
            near[axis], far[axis] = near[axis] - HAND_RADIUS, far[axis] + HAND_RADIUS
            ends += [
                ((near[0], near[1], near[2]), (far[0], far[1], far[2])),
                ((far[0], far[1], far[2]), (near[0], near[1], near[2])),
            ]
        start = self._backend.ray_points(self._body, [one for one, _ in ends])
        end = self._backend.ray_points(self._body, [other for _, other in ends])
        return bool((self._backend.rays(self._body, start, end) < 1.0).any())


def _link(one: Vec3, other: Vec3) -> Shape:
    """A bar from one joint to the next."""
    along = tuple(b - a for a, b in zip(one, other, strict=True))
    length = math.hypot(*along) or 1e-9
    yaw, pitch = math.atan2(along[1], along[0]), -math.asin(along[2] / length)
    rotation = compose(from_yaw(yaw), (0.0, math.sin(pitch / 2), 0.0, math.cos(pitch / 2)))
    middle = tuple((a + b) / 2 for a, b in zip(one, other, strict=True))
    return Shape("box", (length, 0.035, 0.03), (middle[0], middle[1], middle[2]), rotation, _STEEL, gloss=0.3)
