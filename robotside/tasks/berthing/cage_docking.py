"""Docking of a swimmer in its cage: before it by its position, onto its line by the tag over its coil, and slowly in."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import Manoeuvre, Place
from bridge.msgs.sensor_msgs import BatteryState
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import LegState, Navigator
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.cage_sight import FRESH, CageSight, Look
from robotside.tasks.berthing.cage_steering import SLIDE, CageSteering, Push

__all__ = ["MAX_TRIES", "STANDOFFS", "CageDocking"]

MAX_TRIES = 4
"""Approaches before it gives up."""

STANDOFFS = (2.0, 1.7, 1.4)
"""From where it is docked back to where the approach begins, the best first [m]."""

TAG_ABOVE = 0.24
"""Of the middle of the tag above the coil [m]."""

LOOKS = ((0.0, 0.0), (0.4, 0.0), (-0.4, 0.0), (0.0, 0.7), (0.0, -0.7))
"""It looks so far aside [rad] and from so much higher [m], one after the other."""

LOOK_TIME = 4.0
"""For each of those [s]."""

ENTRANCE = 0.55
"""From the coil to the open front of the cage [m]."""

GATE = 0.25
"""With its nose so far before the entrance it has to be on the line [m]."""

MAX_OFF, MAX_MISS, MAX_ASKEW, MAX_LIFT = 0.12, 0.12, 0.4, 0.10
"""There it is no farther off the line, would miss the coil as it slides by no more, and is no more askew and no farther off its height [m, m, rad, m]."""

BACK = 1.9
"""It goes back to here to come in anew: its nose before the coil [m]."""

FAST, CREEP, ASTERN = 0.2, 0.05, 0.15
"""On the way in, at the coil, and back [m/s]: slower, its fins have no push to steer by."""

BRAKE_GAIN, BRAKES = 0.45, 0.4
"""Speed for a way that is left [1/s]; so near to the coil it brakes, and straight, for astern its fins steer the other way [m]."""

TURN_OUT, TURN_IN = 0.35, 0.35
"""It looks aside no farther than this before the gate and beyond it [rad]."""

AT_COIL, LEAN, AT_REST = 0.03, 0.05, 0.015
"""Its nose so near to the coil it leans on it with a push of so much, and lies still slower than the last [m, m/s, m/s]."""

TOUCH = 0.10
"""With its nose so near to the coil it waits for the charge [m]."""

STILL, STRAIGHT, ON_LINE = 0.04, 0.12, 0.06
"""Slower than the first along it, and than `SLIDE` aside, it is at rest, less askew than the second straight, nearer than the third on the line [m/s, rad, m]."""

NEAREST, FARTHEST = 1.2, 2.6
"""From where it may come up: its nose before the coil [m]."""

SETTLED_TIME, STILL_TIMEOUT = 0.5, 15.0
"""It is on the line for so long before it comes up, and waits to be at rest no longer before it looks about [s]."""

LOST_TIMEOUT = 8.0
"""Without a sight of the tag for so long it looks for it anew [s]."""

APPROACH_TIMEOUT, ENTER_TIMEOUT = 120.0, 50.0
"""It comes onto the line, and up or in or back from there, within these times [s]."""

CONTACT_TIMEOUT, DEAD_TIME = 8.0, 3.0
"""At the coil, the battery tells within the first whether it takes charge; a coil without current for the second is dead [s]."""

MAX_GAP = 0.5
"""Left alone for longer, it may be elsewhere: it looks anew [s]."""

NEAR = 4.0
"""Where it is within this of the cage it looks for it on its way there [m]."""

CHARGING_NEAR = 2.0
"""Charging no farther than this from the cage's place, it is in it already [m]."""


class _Stage(Enum):
    """What it does just now."""

    SWIM = "swims to where the approach begins"
    SEEK = "keeps its place and looks"
    ALIGN = "comes to rest on the line"
    APPROACH = "comes up along the line"
    ENTER = "goes in"
    CONTACT = "waits for the charge"
    RETREAT = "goes back to come up anew"


class CageDocking(Behaviour):
    """Succeeds when the battery takes charge; fails after some approaches, or where no cage is seen, and keeps its place then."""

    def __init__(
        self,
        cage: Place,
        course: Course,
        navigator: Navigator,
        situation: Situation,
        look: Look,
        front: float,
    ) -> None:
        """`course` has the one point before the `cage`, which has a direction; `front` is from the robot's middle to its coil [m]."""
        super().__init__("dock in the cage")
        self._cage, self._course, self._navigator, self._situation = cage, course, navigator, situation
        self._sight, self._steering, self._front = CageSight(look, situation), CageSteering(), front
        self._stage, self._since, self._ticked = _Stage.SWIM, 0.0, -math.inf
        self._tries = 0
        self._dead = self._settled = math.inf
        self._height = math.nan
        """That it keeps where it sees no cage, above the map's origin [m]."""
        self._steps: dict[_Stage, Callable[[], Status]] = {
            _Stage.SWIM: self._swim,
            _Stage.SEEK: self._seek,
            _Stage.ALIGN: self._align,
            _Stage.APPROACH: self._approach,
            _Stage.ENTER: self._go_in,
            _Stage.CONTACT: self._contact,
            _Stage.RETREAT: self._retreat,
        }

    def initialise(self) -> None:
        """Set out."""
        self._tries, self._ticked = 0, self._situation.now
        self._set_out()

    def update(self) -> Status:
        """Go on."""
        now = self._situation
        alone, self._ticked = now.now - self._ticked > MAX_GAP, now.now
        near = now.pose.distance(self._cage.x, self._cage.y) < CHARGING_NEAR
        if now.charging and near and self._stage is _Stage.SWIM:
            return self._done()
        if alone and self._stage is not _Stage.SWIM:
            self._set_out()
        elif now.charging and self._stage not in (_Stage.SWIM, _Stage.CONTACT):
            self._enter(_Stage.CONTACT)
        return self._steps[self._stage]()

    def _done(self) -> Status:
        self._course.reached()
        return Status.SUCCESS

    def terminate(self, new_status: Status) -> None:
        """Keep place, heading and depth as far as it can."""
        self._navigator.rest()
        self._navigator.command(Manoeuvre(kind="hover"))

    def _enter(self, stage: _Stage) -> None:
        self._stage, self._since = stage, self._situation.worked
        self._dead = self._settled = math.inf

    @property
    def _spent(self) -> float:
        """In this stage [s]."""
        return self._situation.worked - self._since

    def _set_out(self) -> None:
        self._sight.forget()
        self._steering.begin()
        goal = self._course.goal
        if not math.isnan(goal.height):
            self._navigator.keep_height(goal.height)
        self._navigator.head_for(goal)
        self._enter(_Stage.SWIM)

    def _on_map(self) -> Pose2:
        """The coil in `base_link`, as the map has it."""
        face = Pose2(self._cage.x, self._cage.y, self._cage.yaw).then(Pose2(self._front, 0.0, 0.0))
        return face.since(self._situation.pose)

    def _swim(self) -> Status:
        now, name = self._situation, self._cage.name
        if now.pose.distance(self._cage.x, self._cage.y) < NEAR:
            self._sight.take(self._on_map())
        leg = self._navigator.update(now.pose, now.points, now.now)
        now.report("driving", self._navigator.waits_for or f"Heading for {name}.", place=name, still=30.0)
        if leg is LegState.BLOCKED:
            return Status.FAILURE
        if leg is LegState.ARRIVED:
            self._navigator.finish()
            self._height = self._kept()
            self._enter(_Stage.SEEK)
        return Status.RUNNING

    def _kept(self) -> float:
        """The height to look from: the cage's, else the one that it has [m]."""
        return self._cage.height or self._navigator.height

    def _seek(self) -> Status:
        self._sight.take(self._on_map())
        guess = self._pose()
        self._tell(f"Looking for {self._cage.name}.")
        if self._sight.known and self._sight.age < FRESH:
            self._enter(_Stage.ALIGN)
            return Status.RUNNING
        still = math.hypot(*self._moving(guess)) < STILL or self._spent > STILL_TIMEOUT
        self._settled = min(self._settled, self._situation.worked) if still else self._settled
        number = int(max(0.0, self._situation.worked - self._settled) / LOOK_TIME)
        if number >= len(LOOKS):
            said = f"{self._cage.name} is not seen: no tag of a cage is where it should be; the robot keeps its depth there."
            self._navigator.reason = Notice(Code.DOCK_UNSEEN, said, place=self._cage.name)
            return Status.FAILURE
        aside, higher = LOOKS[number]
        self._keep(guess, BACK, self._height + higher, look=aside)
        return Status.RUNNING

    def _align(self) -> Status:
        """Come to rest on the line, at a distance from which there is room to go in."""
        self._sight.take(self._on_map())
        if self._lost():
            return Status.RUNNING
        now, (robot, gap), cage = self._situation, self._where(), self._pose()
        along, aside = self._moving(cage)
        rests = abs(along) < STILL and abs(aside) < SLIDE and abs(robot.yaw) < STRAIGHT
        level = abs(self._navigator.height - self._wanted()) < MAX_LIFT
        settled = rests and level and abs(robot.y) < ON_LINE and NEAREST < gap < FARTHEST
        self._settled = min(self._settled, now.worked) if settled else math.inf
        if now.worked - self._settled > SETTLED_TIME:
            self._enter(_Stage.APPROACH)
            return Status.RUNNING
        if self._spent > APPROACH_TIMEOUT:
            return self._again(f"{self._cage.name} was not reached: the water is too rough.")
        self._tell(f"Lining up with {self._cage.name}, by its tag.")
        self._keep(cage, min(max(gap, NEAREST + 0.3), FARTHEST - 0.3), self._wanted())
        return Status.RUNNING

    def _lost(self) -> bool:
        """Its tag was lost from sight: look for it anew."""
        if self._sight.age <= LOST_TIMEOUT:
            return False
        self._enter(_Stage.SEEK)
        return True

    def _approach(self) -> Status:
        self._sight.take(self._on_map())
        robot, gap = self._where()
        if self._lost():
            return Status.RUNNING
        if self._spent > ENTER_TIMEOUT:
            return self._again(f"{self._cage.name} was not reached within {ENTER_TIMEOUT:.0f} s.")
        left = gap - ENTRANCE - GATE
        if left <= 0:
            if self._astray(robot):
                off = abs(robot.y) * 100
                return self._again(f"No charge: the line to {self._cage.name} was missed by {off:.0f} cm.")
            self._enter(_Stage.ENTER)
            return Status.RUNNING
        self._tell(f"Coming up to {self._cage.name}, by its tag.")
        self._go(self._pose(), FAST, TURN_OUT)
        return Status.RUNNING

    def _astray(self, robot: Pose2) -> bool:
        """It is not so that it may go in."""
        lift = abs(self._navigator.height - self._wanted())
        along, aside = self._moving(self._pose())
        miss = robot.y + aside * (ENTRANCE + GATE) / max(along, CREEP)
        off = max(abs(robot.y) / MAX_OFF, abs(miss) / MAX_MISS, abs(robot.yaw) / MAX_ASKEW, lift / MAX_LIFT)
        return off > 1.0 or self._sight.age > FRESH

    def _go_in(self) -> Status:
        self._sight.take(self._on_map())
        _, gap = self._where()
        if gap < TOUCH or (self._situation.touched and gap < ENTRANCE) or self._meets:
            self._enter(_Stage.CONTACT)
            return Status.RUNNING
        if self._spent > ENTER_TIMEOUT:
            return self._again(f"{self._cage.name} was not reached: something holds the robot.")
        self._tell(f"Going into {self._cage.name}.", touches=gap < ENTRANCE)
        ahead = max(CREEP, min(FAST, BRAKE_GAIN * gap))
        self._go(self._pose(), ahead, TURN_IN if gap > BRAKES else 0.0)
        return Status.RUNNING

    @property
    def _meets(self) -> bool:
        """The coils meet, but there is no current."""
        return self._situation.power == BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING

    def _contact(self) -> Status:
        now, name = self._situation, self._cage.name
        self._tell(f"Waiting for the charge at {name}.", touches=True)
        self._press()
        if now.charging:
            still = math.hypot(*self._moving(self._pose())) < AT_REST
            self._settled = min(self._settled, now.worked) if still else math.inf
            rests = now.worked - self._settled > SETTLED_TIME
            return self._done() if rests or self._spent > CONTACT_TIMEOUT else Status.RUNNING
        self._dead = min(self._dead, now.worked) if self._meets else math.inf
        if now.worked - self._dead > DEAD_TIME:
            said = f"{name} gives no charge: the contacts meet, but no current flows; the robot stays there."
            self._navigator.reason = Notice(Code.DOCK_DEAD, said, place=name)
            return Status.FAILURE
        if self._spent > CONTACT_TIMEOUT and not self._meets:
            return self._again(f"{name} was reached by its tag, but its contacts did not meet.")
        return Status.RUNNING

    def _press(self) -> None:
        """Come up to the coil and lean on it: what still slides aside would leave it again."""
        cage = self._pose()
        if -cage.inverse().x - self._front > AT_COIL:
            self._go(cage, CREEP, 0.0)
        else:
            self._do(cage, self._steering.lean(LEAN), self._wanted())

    def _again(self, why: str) -> Status:
        """Go back and try once more; after the last time `why` is the reason."""
        self._tries += 1
        if self._tries >= MAX_TRIES:
            said = f"{why[:-1]}; after {MAX_TRIES} tries the robot keeps its depth there."
            self._navigator.reason = Notice(Code.DOCK_MISSED, said, place=self._cage.name)
            return Status.FAILURE
        self._enter(_Stage.RETREAT)
        return Status.RUNNING

    def _retreat(self) -> Status:
        """Back along the line, then anew."""
        self._sight.take(self._on_map())
        _, gap = self._where()
        if gap > BACK or self._spent > ENTER_TIMEOUT:
            self._enter(_Stage.ALIGN)
            return Status.RUNNING
        self._tell(f"Going back to try {self._cage.name} again.", touches=gap < ENTRANCE)
        self._go(self._pose(), -ASTERN, 0.0 if gap < ENTRANCE else TURN_IN)
        return Status.RUNNING

    def _pose(self) -> Pose2:
        """The coil in `base_link`: as it was seen, else as the map has it."""
        return self._sight.pose() or self._on_map()

    def _where(self) -> tuple[Pose2, float]:
        """The robot in the frame of the coil, and its nose before it [m]."""
        robot = self._pose().inverse()
        return robot, -robot.x - self._front

    def _moving(self, cage: Pose2) -> tuple[float, float]:
        """Its speed in the frame of the cage [m/s]."""
        now, drift = self._situation, self._sight.drift
        x, y, _ = Pose2(*drift, 0.0).since(Pose2(0.0, 0.0, now.odom.yaw))
        ahead, left = now.moving.x - x, now.moving.y - y
        cosine, sine = math.cos(cage.yaw), math.sin(cage.yaw)
        return cosine * ahead + sine * left, cosine * left - sine * ahead

    def _wanted(self) -> float:
        """The height of the coil above the map's origin [m]."""
        return self._height if math.isnan(self._sight.height) else self._sight.height - TAG_ABOVE

    def _keep(self, cage: Pose2, gap: float, height: float, look: float = 0.0) -> None:
        """Come to rest on the line of a `cage` in `base_link`, the nose so far before the coil [m], to `look` aside there [rad]."""
        point, now = (-gap - self._front, 0.0), self._situation.now
        self._do(cage, self._steering.keep(cage.inverse(), self._moving(cage), point, look, now), height)

    def _go(self, cage: Pose2, ahead: float, most: float) -> None:
        """Go `ahead` along the line of a `cage` in `base_link` [m/s], looking aside no farther than `most` for it [rad]."""
        now = self._situation.now
        push = self._steering.line(cage.inverse(), self._moving(cage), ahead, most, now)
        self._do(cage, push, self._wanted())

    def _do(self, cage: Pose2, push: Push, height: float) -> None:
        lowest, highest = self._navigator.heights
        yaw = wrap(self._situation.pose.yaw + cage.yaw + push.yaw)
        level = height if math.isnan(height) else min(max(height, lowest), highest)
        self._navigator.command(Manoeuvre(kind="course", yaw=yaw, speed=push.speed, height=level))

    def _tell(self, text: str, *, touches: bool = False) -> None:
        self._situation.report("docking", text, place=self._cage.name, still=20.0, touches=touches)
