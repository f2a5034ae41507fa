"""Landing on a pad: above it by the robot's position, over its middle by the tag that lies there, and down in steps."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, Place
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal, LegState, Navigator
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.dock_contact import DockContact
from robotside.tasks.berthing.pad_sight import FRESH, LOST_TIMEOUT, Find, PadSight

__all__ = ["MAX_TRIES", "SEARCH_HEIGHT", "PadLanding", "first_goal"]

MAX_TRIES = 3
"""Landings before it gives up."""

SEARCH_HEIGHT = 2.5
"""Above the ground, from where it looks for the pad [m]."""

RINGS = ((1.2, 6), (2.4, 10))
"""Round the place where the pad should be it looks from circles of such a radius [m], so many points on each."""

SEEK_TIMEOUT, CLIMB_TIMEOUT = 2.0, 12.0
"""It looks from one point for so long, after it has taken no longer than the second to come to its height [s]."""

STEPS = (1.8, 1.2)
"""Heights above the pad at which it stops until it is over the middle; from the last it lands [m].

Lower, one that leans into the wind has the tag no more in its picture.
"""

AT_STEP = 0.12
"""So near to a step it is there [m]."""

CENTRED, MAX_ASIDE = 0.08, 0.30
"""It is over the middle within the first; farther off than the second it does not sink [m]."""

CENTRED_TIME = 0.4
"""So long it is over the middle before it goes lower [s]: it does not just cross it."""

GAIN, MAX_SPEED = 0.7, 0.3
"""Speed for a way aside [1/s], and the most [m/s]."""

LIFT_GAIN, MAX_LIFT, MAX_SINK = 0.8, 0.4, 0.25
"""Speed up or down for a height that is wrong [1/s], and the most of both [m/s]."""

SINKING_TIMEOUT, LANDING_TIMEOUT, RISE_TIMEOUT = 60.0, 15.0, 20.0
"""From the search height down to the last step, from there to the pad, and up again it takes no longer [s]."""

MAX_GAP = 0.5
"""Left alone for longer, it may be elsewhere: it looks anew [s]."""

NEAR = 4.0
"""Where it is within this of the pad's place it looks [m]."""

CHARGING_NEAR = 3.0
"""Charging no farther than this from the pad's place, it stands on the pad already [m]."""

RISE_BY = 2.0
"""From the pad to try again [m]."""

OVER = 1.7
"""Where a pad on a platform is a thing on the map, it flies over what is so near to its place [m]."""

ASIDE = (0.0, 1.8, 2.4, 3.0)
"""So far from the pad's place the map may first have room to fly to, the nearest first [m]."""

HOP_SPEED, THERE = 0.5, 0.2
"""From one point to look from to the next [m/s], and so near to it it is there [m]."""

HOP_TIMEOUT, STRIDE = 20.0, 0.3
"""Such a way takes no longer [s], and is looked at on the map so often [m]."""

Fault = Callable[[str, float, float], Problem]
"""The reason why the robot cannot or may not be at a place of that name; empty when it can."""


def first_goal(pad: Place, fault: Fault) -> Goal:
    """Where it flies to by the map: over the place of `pad`, or beside it where that is a thing on the map; over it where all is taken."""
    around = [
        Goal(pad.name, pad.x + radius * math.cos(angle), pad.y + radius * math.sin(angle), place=pad.name)
        for radius in ASIDE
        for angle in [math.tau * n / 8 for n in range(8)]
    ]
    return next((goal for goal in around if not fault(pad.name, goal.x, goal.y)), around[0])


def search_points(pad: Place) -> list[tuple[float, float]]:
    """Where it looks from [m, in `map`]: over the place of `pad` first, then round it."""
    around = [
        (pad.x + radius * math.cos(math.tau * n / count), pad.y + radius * math.sin(math.tau * n / count))
        for radius, count in RINGS
        for n in range(count)
    ]
    return [(pad.x, pad.y), *around]


class _Stage(Enum):
    """What it does just now."""

    FLY = "flies to where it looks from"
    SEEK = "hovers and looks"
    HOP = "goes to the next point to look from"
    SINK = "goes down over the middle"
    LAND = "lands"
    CONTACT = "waits for the charge"
    RISE = "goes up to try again"


_ALOFT = (_Stage.SEEK, _Stage.HOP, _Stage.SINK, _Stage.LAND)


class PadLanding(Behaviour):
    """Succeeds when the battery takes charge; fails after three landings, on the ground, or in the air where no pad is seen."""

    def __init__(
        self,
        pad: Place,
        course: Course,
        navigator: Navigator,
        situation: Situation,
        find: Find,
        fault: Fault,
    ) -> None:
        """`course` has the one point that `first_goal` gives."""
        super().__init__("land on the pad")
        self._pad, self._course, self._navigator, self._situation = pad, course, navigator, situation
        self._sight, self._fault = PadSight(find, situation), fault
        self._contacts = DockContact(pad.name, situation)
        self._stands_out = False
        """The pad is a thing on the map."""
        self._points: list[tuple[float, float]] = []
        """To look from yet, in `map` [m]."""
        self._stage, self._since, self._ticked = _Stage.FLY, 0.0, -math.inf
        self._tries = self._step = 0
        self._settled = math.inf
        self._up_to = math.nan
        self._steps: dict[_Stage, Callable[[], Status]] = {
            _Stage.FLY: self._fly,
            _Stage.SEEK: self._seek,
            _Stage.HOP: self._hop,
            _Stage.SINK: self._sink,
            _Stage.LAND: self._land,
            _Stage.CONTACT: self._contact,
            _Stage.RISE: self._rise,
        }

    def initialise(self) -> None:
        """Set out."""
        self._tries = 0
        self._stands_out = bool(self._fault(self._pad.name, self._pad.x, self._pad.y))
        self._sight.begin()
        self._situation.looks_down = True
        self._ticked = self._situation.now
        self._set_out()

    def update(self) -> Status:
        """Go on."""
        now = self._situation
        alone, self._ticked = now.now - self._ticked > MAX_GAP, now.now
        near = now.pose.distance(self._pad.x, self._pad.y) < CHARGING_NEAR
        if now.charging and now.flight == "landed" and (near or self._stage is not _Stage.FLY):
            self._course.reached()
            return Status.SUCCESS
        if alone and self._stage is not _Stage.FLY:
            self._look_anew()
        elif now.flight == "landed" and self._stage in _ALOFT:
            self._enter(_Stage.CONTACT)
        return self._steps[self._stage]()

    def terminate(self, new_status: Status) -> None:
        """Stay where it is: in the air it hovers."""
        self._situation.looks_down = False
        self._navigator.rest()

    def _enter(self, stage: _Stage) -> None:
        self._stage, self._since = stage, self._situation.worked
        self._settled = math.inf
        self._up_to = math.nan
        if stage is _Stage.CONTACT:
            self._contacts.begin()

    @property
    def _spent(self) -> float:
        """In this stage [s]."""
        return self._situation.worked - self._since

    def _set_out(self) -> None:
        self._points = search_points(self._pad)
        self._navigator.head_for(self._course.goal)
        self._enter(_Stage.FLY)

    def _look_anew(self) -> None:
        """Somebody may have moved it meanwhile."""
        self._sight.forget()
        now = self._situation
        if now.pose.distance(self._pad.x, self._pad.y) > NEAR or now.flight == "landed":
            self._set_out()
        else:
            self._navigator.finish()
            self._enter(_Stage.SEEK)

    def _hover(self, height: float, aside: tuple[float, float] = (0.0, 0.0), *, down: bool = True) -> None:
        """Go to a height above what is below [m], and `aside` [m, ahead and to the left]; no lower without `down`."""
        lift = _lift(self._situation.below, height)
        fast = GAIN * math.hypot(*aside)
        most = MAX_SPEED if height < SEARCH_HEIGHT else HOP_SPEED
        share = GAIN * (min(1.0, most / fast) if fast > 0 else 0.0)
        upward = lift if down else max(0.0, lift)
        self._navigator.move(Twist(Vector3(share * aside[0], share * aside[1], upward)))

    def _fly(self) -> Status:
        now, name = self._situation, self._pad.name
        leg = self._navigator.update(now.pose, now.points, now.now)
        now.report("driving", self._navigator.waits_for or f"Heading for {name}.", place=name, still=20.0)
        if now.flight == "flying" and now.pose.distance(self._pad.x, self._pad.y) < NEAR:
            self._sight.look()
        if self._sight.found:
            self._navigator.finish()
            self._begin_sinking()
        elif leg is LegState.ARRIVED:
            self._navigator.finish()
            self._points = [point for point in self._points if now.pose.distance(*point) > 2 * THERE]
            self._enter(_Stage.SEEK)
        elif leg is LegState.BLOCKED:
            return Status.FAILURE
        return Status.RUNNING

    def _seek(self) -> Status:
        now = self._situation
        self._sight.look()
        self._hover(SEARCH_HEIGHT)
        self._tell(f"Looking for {self._pad.name}.")
        if self._sight.found:
            self._begin_sinking()
            return Status.RUNNING
        if not (abs(now.below - SEARCH_HEIGHT) > 0.3 and self._spent < CLIMB_TIMEOUT):
            self._settled = min(self._settled, now.worked)
        return self._elsewhere() if now.worked - self._settled > SEEK_TIMEOUT else Status.RUNNING

    def _elsewhere(self) -> Status:
        """Look from the next point to which nothing is in the way; after the last the pad is not there."""
        here = self._situation.pose
        self._points = [point for point in self._points if self._free(here, point)]
        if self._points:
            self._enter(_Stage.HOP)
            return Status.RUNNING
        said = f"{self._pad.name} is not seen: no tag of a pad is where it should be; the robot hovers there."
        self._navigator.reason = Notice(Code.DOCK_UNSEEN, said, place=self._pad.name)
        return Status.FAILURE

    def _free(self, start: Pose2, end: tuple[float, float]) -> bool:
        """By the map, nothing but the pad is on the straight way there."""
        count = math.ceil(start.distance(*end) / STRIDE)
        for n in range(1, count + 1):
            x, y = start.x + n / count * (end[0] - start.x), start.y + n / count * (end[1] - start.y)
            above = self._stands_out and math.hypot(x - self._pad.x, y - self._pad.y) < OVER
            if not above and self._fault(self._pad.name, x, y):
                return False
        return True

    def _hop(self) -> Status:
        now, goal = self._situation, self._points[0]
        self._sight.look()
        x, y, _ = Pose2(*goal, 0.0).since(now.pose)
        self._tell(f"Looking for {self._pad.name}.")
        if self._sight.found:
            self._begin_sinking()
        elif math.hypot(x, y) < THERE or self._spent > HOP_TIMEOUT:
            self._points = self._points[1:]
            self._enter(_Stage.SEEK)
        else:
            self._hover(SEARCH_HEIGHT, (x, y))
        return Status.RUNNING

    def _begin_sinking(self) -> None:
        self._step = 0
        self._enter(_Stage.SINK)

    def _sink(self) -> Status:
        now, name = self._situation, self._pad.name
        self._sight.look()
        age, off = self._sight.age, math.hypot(*self._sight.aside)
        if age > LOST_TIMEOUT or self._spent > SINKING_TIMEOUT:
            lost = "its tag was lost from sight" if age > LOST_TIMEOUT else "the air is too rough"
            return self._again(
                Notice(Code.DOCK_MISSED, f"{name} was not reached: {lost} over it.", place=name)
            )
        fresh = age < FRESH
        there = abs(now.below - STEPS[self._step]) < AT_STEP
        self._settled = min(self._settled, now.worked) if fresh and there and off < CENTRED else math.inf
        if now.worked - self._settled >= CENTRED_TIME:
            self._step, self._settled = self._step + 1, math.inf
            if self._step == len(STEPS):
                self._enter(_Stage.LAND)
                return Status.RUNNING
        height = STEPS[self._step] if fresh else SEARCH_HEIGHT
        self._hover(height, self._sight.aside, down=fresh and off < MAX_ASIDE)
        self._tell(f"Going down to {name}, by its tag.")
        return Status.RUNNING

    def _land(self) -> Status:
        if self._spent > LANDING_TIMEOUT:
            said = f"{self._pad.name} was not reached within {LANDING_TIMEOUT:.0f} s."
            return self._again(Notice(Code.DOCK_MISSED, said, place=self._pad.name))
        self._tell(f"Landing on {self._pad.name}.", touches=True)
        self._navigator.command(Manoeuvre(kind="land"))
        return Status.RUNNING

    def _contact(self) -> Status:
        self._tell(f"Waiting for the charge at {self._pad.name}.", touches=True)
        why = self._contacts.outcome("by its tag")
        if why is None:
            return Status.RUNNING
        if why.code == Code.DOCK_MISSED:
            return self._again(why)
        self._navigator.reason = why
        return Status.FAILURE

    def _again(self, why: Notice) -> Status:
        """Rise and try once more; after the last time `why` is the reason."""
        self._tries += 1
        if self._tries >= MAX_TRIES:
            rests = "stands there" if self._situation.flight == "landed" else "hovers there"
            tried = f"{str(why)[:-1]}; after {MAX_TRIES} tries the robot {rests}."
            self._navigator.reason = why.reworded(tried)
            return Status.FAILURE
        self._sight.forget()
        self._points = search_points(self._pad)
        self._enter(_Stage.RISE)
        return Status.RUNNING

    def _rise(self) -> Status:
        now = self._situation
        self._tell(f"Rising to try {self._pad.name} again.", touches=True)
        if now.flight == "flying":
            self._enter(_Stage.SEEK)
        elif now.flight == "landing":
            self._hover(SEARCH_HEIGHT)
        elif self._spent > RISE_TIMEOUT:
            said = f"{self._pad.name} is not tried again: the robot does not rise."
            self._navigator.reason = Notice(Code.DOCK_MISSED, said, place=self._pad.name)
            return Status.FAILURE
        else:
            if math.isnan(self._up_to):
                self._up_to = (
                    0.0 if math.isnan(self._navigator.height) else self._navigator.height
                ) + RISE_BY
            self._navigator.take_off(self._up_to)
        return Status.RUNNING

    def _tell(self, text: str, *, touches: bool = False) -> None:
        self._situation.report("docking", text, place=self._pad.name, still=20.0, touches=touches)


def _lift(below: float, height: float) -> float:
    """Speed up to a `height` [m/s], from one that is `below` it now [m]: infinite beyond the range finder, NaN while not known."""
    if math.isfinite(below):
        return max(-MAX_SINK, min(MAX_LIFT, LIFT_GAIN * (height - below)))
    return -MAX_SINK if below == math.inf else 0.0
