"""Docking on wheels: to a place before the dock, and from there by what is seen of the dock until the battery takes charge."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Place
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal, Navigator
from robotside.perception.dock_track import DockTrack
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.drive_to import LEG_STATUS
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing import dock_outcomes
from robotside.tasks.berthing.approach import ALIGN_GAP, CREEP_SPEED, DOCK_NEAR, RETREAT_SPEED, Approach
from robotside.tasks.berthing.dock_contact import DockContact
from robotside.tasks.berthing.dock_sight import DockSight
from robotside.tasks.berthing.dock_start import DockStarts

__all__ = ["MAX_OUTS", "MAX_TRIES", "Dock"]

MAX_TRIES = 3
"""Approaches before it gives up."""

SEEK_TIMEOUT = 4.0
"""It stands and looks for the dock for so long [s]."""

APPROACH_TIMEOUT = 90.0
"""One approach takes no longer [s]."""

BLOCKED_TIMEOUT = 15.0
"""It waits for who stands in the way for so long [s]."""

MAX_OUTS = 3
"""In one try it sets out anew no more often than this because it is too far beside the line."""

MAX_BEYOND = 0.05
"""It creeps no farther than this beyond the face that it sees [m]."""

MAP_BEYOND, MAP_GAP = 0.25, 0.45
"""Of a dock that is only on the map: how far it creeps beyond its face, and from where on what it touches is the dock [m]."""

_SEEN = {
    "reflectors": "by its reflectors",
    "one reflector": "by one of its reflectors",
    "shape": "by its shape",
    "tag": "by its tag",
    "": "by the map only",
}


class _Stage(Enum):
    """What it does just now."""

    DRIVE = "drives to where the approach begins"
    SEEK = "stands and looks"
    CLOSER = "comes nearer to see it"
    APPROACH = "goes up to the dock"
    CONTACT = "waits for the charge"
    RETREAT = "goes back to try again"


class Dock(Behaviour):
    """Succeeds when the battery takes charge; fails after three approaches, at rest, and says what was seen."""

    def __init__(
        self,
        dock: Place,
        course: Course,
        navigator: Navigator,
        situation: Situation,
        approach: Approach,
        track: DockTrack,
        starts: DockStarts,
    ) -> None:
        """`course` has the one point where it begins by the map, which is the first of `starts`; `track` follows the dock by laser, if there is one."""
        super().__init__("dock")
        self._dock, self._course, self._navigator, self._situation = dock, course, navigator, situation
        self._way, self._track, self._sight = approach, track, DockSight(track, situation)
        self._starts, self._contacts = starts, DockContact(dock.name, situation)
        self._mapped = Pose2(dock.x, dock.y, dock.yaw).then(Pose2(approach.front, 0.0, 0.0))
        """The face of the dock, as the map has it."""
        self._face = self._mapped
        """The same, as it was seen in this try."""
        self._distance = math.hypot(course.goal.x - dock.x, course.goal.y - dock.y)
        self._stage, self._since = _Stage.DRIVE, 0.0
        self._tries = self._outs = 0
        self._missed = False
        """The last try came up to the dock, and beside it."""
        self._by = ""
        self._blocked = math.inf
        self._begun = Pose2(0.0, 0.0, 0.0)
        """Where its wheels were when it went back."""
        self._steps: dict[_Stage, Callable[[], Status]] = {
            _Stage.DRIVE: self._drive,
            _Stage.SEEK: self._seek,
            _Stage.CLOSER: self._come_closer,
            _Stage.APPROACH: self._approach,
            _Stage.CONTACT: self._contact,
            _Stage.RETREAT: self._retreat,
        }

    def initialise(self) -> None:
        """Set out."""
        self._tries = self._outs = 0
        self._starts.forget()
        self._face = self._mapped
        self._set_out()

    def update(self) -> Status:
        """Go on."""
        now = self._situation
        near = now.pose.distance(self._dock.x, self._dock.y) <= DOCK_NEAR
        if now.charging and (near or self._stage is not _Stage.DRIVE):
            self._course.reached()
            return Status.SUCCESS
        return self._steps[self._stage]()

    def terminate(self, new_status: Status) -> None:
        """Stand still."""
        self._navigator.rest()

    def _enter(self, stage: _Stage) -> None:
        self._stage, self._since = stage, self._situation.worked
        self._blocked = math.inf
        self._begun = self._situation.odom

    @property
    def _spent(self) -> float:
        """In this stage [s]."""
        return self._situation.worked - self._since

    def _set_out(self) -> None:
        self._begin_at(self._starts.next(self._way.docked(self._face)))

    def _begin_at(self, goal: Goal) -> None:
        self._track.forget()
        self._distance = self._way.docked(self._face).distance(goal.x, goal.y)
        self._navigator.head_for(goal)
        self._enter(_Stage.DRIVE)

    def _drive(self) -> Status:
        now, name = self._situation, self._dock.name
        leg = self._navigator.update(now.pose, now.points, now.now)
        phase, does = ("turning", "Turning to") if self._navigator.turning else ("driving", "Heading for")
        now.report(phase, f"{does} {name}.", place=name, still=self._distance / CREEP_SPEED / 2)
        if LEG_STATUS[leg] is Status.SUCCESS:
            self._navigator.finish()
            self._enter(_Stage.SEEK)
            return Status.RUNNING
        if LEG_STATUS[leg] is Status.FAILURE and self._goes_elsewhere():
            return Status.RUNNING
        return LEG_STATUS[leg]

    def _goes_elsewhere(self) -> bool:
        """Where no way leads to one place to begin from, one may lead to another."""
        why = self._navigator.reason
        missing = why and why.code == Code.WAY_MISSING and self._outs < MAX_OUTS
        goal = self._starts.other(self._way.docked(self._face)) if missing else None
        if goal is not None:
            self._outs += 1
            self._begin_at(goal)
        return goal is not None

    def _seek(self) -> Status:
        self._navigator.move(Twist())
        self._sight.look(self._on_map())
        self._tell(f"Looking for {self._dock.name}.")
        if self._track.known:
            self._begin_approach()
        elif self._spent > SEEK_TIMEOUT or not self._sight.able:
            if self._sight.would_see:
                return self._not_seen()
            self._by = ""
            self._enter(_Stage.APPROACH)
        return Status.RUNNING

    def _begin_approach(self) -> None:
        """The dock is seen: from now on that is where it is."""
        self._by = self._track.by
        seen = self._track.pose(self._situation.odom)
        if seen is not None:
            self._face = self._situation.pose.then(seen)
        self._enter(_Stage.APPROACH)

    def _not_seen(self) -> Status:
        """From here; one that may see it from nearer goes there."""
        if self._way.gap(self._on_map().inverse()) <= self._way.look_gap:
            return self._again(self._unseen())
        self._enter(_Stage.CLOSER)
        return Status.RUNNING

    def _come_closer(self) -> Status:
        """Along the line that the map has, with an eye on where the dock should be."""
        self._sight.look(self._on_map())
        dock = self._on_map()
        if self._track.known:
            self._begin_approach()
        elif self._way.gap(dock.inverse()) <= self._way.look_gap or self._spent > APPROACH_TIMEOUT:
            return self._again(self._unseen())
        elif self._way.blocked(self._situation.points, dock, self._way.look_gap):
            return self._wait_for_room()
        else:
            self._blocked = math.inf
            self._tell(f"Looking for {self._dock.name}.")
            self._way.lead(dock.inverse(), self._navigator)
        return Status.RUNNING

    def _unseen(self) -> Notice:
        now, name = self._situation, self._dock.name
        if self._way.taken(now.points, self._on_map()):
            return dock_outcomes.taken(name)
        return dock_outcomes.unseen(name, by_laser=now.scan is not None)

    def _on_map(self) -> Pose2:
        """The dock in `base_link`, as the map has it or as it was seen in this try."""
        return self._face.since(self._situation.pose)

    def _approach(self) -> Status:
        self._sight.look(self._on_map())
        dock = self._track.pose(self._situation.odom) if self._by else self._on_map()
        if dock is None:
            self._track.forget()
            self._enter(_Stage.SEEK)
            return Status.RUNNING
        robot = dock.inverse()
        gap = self._way.gap(robot)
        moved = gap > self._distance + 0.5 or abs(robot.y) > 0.5 * self._distance
        if moved or (gap > ALIGN_GAP and not self._way.reaches(robot)):
            return self._out_of_reach(robot)
        if self._spent > APPROACH_TIMEOUT:
            return self._again(dock_outcomes.not_in_time(self._dock.name, APPROACH_TIMEOUT))
        return self._go_up(dock, robot, gap)

    def _out_of_reach(self, robot: Pose2) -> Status:
        """It was moved meanwhile, or no bend leads onto the line any more: set out anew, now that the line is known better."""
        self._outs += 1
        if self._outs > MAX_OUTS:
            return self._again(dock_outcomes.missed(self._dock.name, self._way.aside(robot)))
        self._set_out()
        return Status.RUNNING

    def _go_up(self, dock: Pose2, robot: Pose2, gap: float) -> Status:
        now, name = self._situation, self._dock.name
        if gap > ALIGN_GAP and self._way.blocked(now.points, dock):
            return self._wait_for_room()
        self._blocked = math.inf
        if self._by and 0.5 * ALIGN_GAP < gap < ALIGN_GAP and self._way.off(robot):
            return self._again(dock_outcomes.missed(self._dock.name, self._way.aside(robot)))
        touches = gap < (ALIGN_GAP if self._by else MAP_GAP)
        arrived = gap < -(MAX_BEYOND if self._by else MAP_BEYOND) or self._contacts.meet
        if arrived or (now.touched and touches):
            self._contacts.begin()
            self._enter(_Stage.CONTACT)
            return Status.RUNNING
        self._tell(f"Going up to {name}, {_SEEN[self._by]}.", touches=touches)
        self._way.lead(robot, self._navigator)
        return Status.RUNNING

    def _wait_for_room(self) -> Status:
        now, name = self._situation, self._dock.name
        self._navigator.move(Twist())
        self._blocked = min(self._blocked, now.worked)
        if now.worked - self._blocked > BLOCKED_TIMEOUT:
            return self._again(dock_outcomes.blocked(name))
        self._tell(f"Waiting: something stands before {name}.")
        return Status.RUNNING

    def _contact(self) -> Status:
        self._navigator.move(Twist())
        self._tell(f"Waiting for the charge at {self._dock.name}.", touches=True)
        why = self._contacts.outcome(_SEEN[self._by])
        if why is None:
            return Status.RUNNING
        if why.code == Code.DOCK_MISSED:
            return self._again(why)
        self._navigator.reason = why
        return Status.FAILURE

    def _again(self, why: Notice) -> Status:
        """Go back and try once more; after the last time `why` is the reason."""
        self._tries += 1
        if self._tries >= MAX_TRIES:
            self._navigator.reason = dock_outcomes.given_up(why, MAX_TRIES)
            return Status.FAILURE
        self._outs, self._missed = 0, why.code == Code.DOCK_MISSED
        if why.code == Code.DOCK_UNSEEN:
            self._face = self._mapped
        self._enter(_Stage.RETREAT)
        return Status.RUNNING

    def _retreat(self) -> Status:
        """Straight back as far as there is room, then anew from where the approach begins."""
        now = self._situation
        gone = now.odom.distance(self._begun.x, self._begun.y)
        on_map = self._on_map().inverse()
        far = self._way.gap(on_map) >= self._distance - 0.1
        if far and self._missed and self._way.min_radius and self._way.reaches(on_map):
            # it stands on the line already, better than a way by the map leads there
            self._track.forget()
            self._enter(_Stage.SEEK)
            return Status.RUNNING
        if far or gone > self._distance - 0.1 or self._way.room_behind(now.points) < 0.1:
            self._set_out()
            return Status.RUNNING
        self._tell(f"Going back to try {self._dock.name} again.", touches=True)
        self._navigator.move(Twist.planar(-RETREAT_SPEED, 0.0))
        return Status.RUNNING

    def _tell(self, text: str, *, touches: bool = False) -> None:
        name, still = self._dock.name, self._distance / CREEP_SPEED / 2
        self._situation.report("docking", text, place=name, still=still, touches=touches)
