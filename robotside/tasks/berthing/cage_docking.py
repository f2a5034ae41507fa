"""Docking of a swimmer in its cage: before it by its position, onto its line by the tag over its coil, and slowly in."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Manoeuvre, Place
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import LegState, Navigator
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.cage_line import CREEP, CageLine
from robotside.tasks.berthing.cage_sight import FRESH, Look
from robotside.tasks.berthing.cage_steering import SLIDE
from robotside.tasks.berthing.dock_contact import DockContact

__all__ = ["MAX_TRIES", "STANDOFFS", "CageDocking"]

MAX_TRIES = 4
"""Approaches before it gives up."""

STANDOFFS = (2.0, 1.7, 1.4)
"""From where it is docked back to where the approach begins, the best first [m]."""

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

FAST, ASTERN = 0.2, 0.15
"""On the way in, and back [m/s]: slower, its fins have no push to steer by."""

BRAKE_GAIN, BRAKES = 0.45, 0.4
"""Speed for a way that is left [1/s]; so near to the coil it brakes, and straight, for astern its fins steer the other way [m]."""

TURN_OUT, TURN_IN = 0.35, 0.35
"""It looks aside no farther than this before the gate and beyond it [rad]."""

AT_REST, LEAN_TIME = 0.015, 6.0
"""Slower than the first it lies still at the coil [m/s], when it has leaned on it for the second [s]: a slide too slow for its log goes by rubbing there."""

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

CONTACT_TIMEOUT, REST_TIMEOUT = 8.0, 15.0
"""At the coil, the battery tells within the first whether it takes charge; with charge it waits to lie still no longer than the second [s]."""

MAX_GAP = 0.5
"""Left alone for longer, it may be elsewhere: it looks anew [s]."""

NEAR = 4.0
"""Where it is within this of the cage it looks for it on its way there [m]."""


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
        self._line = CageLine(cage, navigator, situation, look, front)
        self._sight = self._line.sight
        self._contacts = DockContact(cage.name, situation, CONTACT_TIMEOUT)
        self._stage, self._since, self._ticked = _Stage.SWIM, 0.0, -math.inf
        self._tries = 0
        self._settled = math.inf
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
        if now.charging and self._stage is _Stage.SWIM:
            return self._done()  # no cable charges what swims, wherever it believes to be
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
        self._settled = math.inf
        if stage is _Stage.CONTACT:
            self._contacts.begin()

    @property
    def _spent(self) -> float:
        """In this stage [s]."""
        return self._situation.worked - self._since

    def _set_out(self) -> None:
        self._line.begin()
        goal = self._course.goal
        if not math.isnan(goal.height):
            self._navigator.keep_height(goal.height)
        self._navigator.head_for(goal)
        self._enter(_Stage.SWIM)

    def _swim(self) -> Status:
        now, name = self._situation, self._cage.name
        if now.pose.distance(self._cage.x, self._cage.y) < NEAR:
            self._line.look()
        leg = self._navigator.update(now.pose, now.points, now.now)
        now.report("driving", self._navigator.waits_for or f"Heading for {name}.", place=name, still=30.0)
        if leg is LegState.BLOCKED:
            return Status.FAILURE
        if leg is LegState.ARRIVED:
            self._navigator.finish()
            self._line.height = self._cage.height or self._navigator.height
            self._enter(_Stage.SEEK)
        return Status.RUNNING

    def _seek(self) -> Status:
        self._line.look()
        self._tell(f"Looking for {self._cage.name}.")
        if self._sight.known and self._sight.age < FRESH:
            self._enter(_Stage.ALIGN)
            return Status.RUNNING
        still = math.hypot(*self._line.moving()) < STILL or self._spent > STILL_TIMEOUT
        self._settled = min(self._settled, self._situation.worked) if still else self._settled
        number = int(max(0.0, self._situation.worked - self._settled) / LOOK_TIME)
        if number >= len(LOOKS):
            said = f"{self._cage.name} is not seen: no tag of a cage is where it should be; the robot keeps its depth there."
            self._navigator.reason = Notice(Code.DOCK_UNSEEN, said, place=self._cage.name)
            return Status.FAILURE
        aside, higher = LOOKS[number]
        self._line.keep(BACK, self._line.height + higher, look=aside)
        return Status.RUNNING

    def _align(self) -> Status:
        """Come to rest on the line, at a distance from which there is room to go in."""
        self._line.look()
        if self._lost():
            return Status.RUNNING
        now, (robot, gap) = self._situation, self._line.where()
        along, aside = self._line.moving()
        rests = abs(along) < STILL and abs(aside) < SLIDE and abs(robot.yaw) < STRAIGHT
        level = abs(self._navigator.height - self._line.wanted) < MAX_LIFT
        settled = rests and level and abs(robot.y) < ON_LINE and NEAREST < gap < FARTHEST
        self._settled = min(self._settled, now.worked) if settled else math.inf
        if now.worked - self._settled > SETTLED_TIME:
            self._enter(_Stage.APPROACH)
            return Status.RUNNING
        if self._spent > APPROACH_TIMEOUT:
            return self._again(f"{self._cage.name} was not reached: the water is too rough.")
        self._tell(f"Lining up with {self._cage.name}, by its tag.")
        self._line.keep(BACK, self._line.wanted)
        return Status.RUNNING

    def _lost(self) -> bool:
        """Its tag was lost from sight: look for it anew."""
        if self._sight.age <= LOST_TIMEOUT:
            return False
        self._enter(_Stage.SEEK)
        return True

    def _approach(self) -> Status:
        self._line.look()
        robot, gap = self._line.where()
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
        self._line.go(FAST, TURN_OUT)
        return Status.RUNNING

    def _astray(self, robot: Pose2) -> bool:
        """It is not so that it may go in."""
        lift = abs(self._navigator.height - self._line.wanted)
        along, aside = self._line.moving()
        miss = robot.y + aside * (ENTRANCE + GATE) / max(along, CREEP)
        off = max(abs(robot.y) / MAX_OFF, abs(miss) / MAX_MISS, abs(robot.yaw) / MAX_ASKEW, lift / MAX_LIFT)
        return off > 1.0 or self._sight.age > FRESH

    def _go_in(self) -> Status:
        self._line.look()
        _, gap = self._line.where()
        if gap < TOUCH or (self._situation.touched and gap < ENTRANCE) or self._contacts.meet:
            self._enter(_Stage.CONTACT)
            return Status.RUNNING
        if self._spent > ENTER_TIMEOUT:
            return self._again(f"{self._cage.name} was not reached: something holds the robot.")
        self._tell(f"Going into {self._cage.name}.", touches=gap < ENTRANCE)
        ahead = max(CREEP, min(FAST, BRAKE_GAIN * gap))
        self._line.go(ahead, TURN_IN if gap > BRAKES else 0.0)
        return Status.RUNNING

    def _contact(self) -> Status:
        now = self._situation
        self._tell(f"Waiting for the charge at {self._cage.name}.", touches=True)
        self._line.press()
        if now.charging:
            still = math.hypot(*self._line.moving()) < AT_REST
            self._settled = min(self._settled, now.worked) if still else math.inf
            rests = now.worked - self._settled > SETTLED_TIME and self._spent > LEAN_TIME
            return self._done() if rests or self._spent > REST_TIMEOUT else Status.RUNNING
        why = self._contacts.outcome("by its tag")
        if why is None:
            return Status.RUNNING
        if why.code == Code.DOCK_MISSED:
            return self._again(str(why))
        self._navigator.reason = why
        return Status.FAILURE

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
        self._line.look()
        _, gap = self._line.where()
        if gap > BACK or self._spent > ENTER_TIMEOUT:
            self._enter(_Stage.ALIGN)
            return Status.RUNNING
        self._tell(f"Going back to try {self._cage.name} again.", touches=gap < ENTRANCE)
        self._line.go(-ASTERN, 0.0 if gap < ENTRANCE else TURN_IN)
        return Status.RUNNING

    def _tell(self, text: str, *, touches: bool = False) -> None:
        self._situation.report("docking", text, place=self._cage.name, still=20.0, touches=touches)
