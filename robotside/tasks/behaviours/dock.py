"""Docking on wheels: to a place before the dock, and from there by what is seen of the dock until the battery takes charge."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from enum import Enum

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Place
from bridge.msgs.sensor_msgs import BatteryState, LaserScan
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal, Navigator
from robotside.perception.dock_track import DockTrack
from robotside.tasks.behaviours.approach import CREEP_SPEED, DOCK_NEAR, RETREAT_SPEED, Approach
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.drive_to import LEG_STATUS
from robotside.tasks.behaviours.situation import Situation

__all__ = ["CONTACT_TIMEOUT", "MAX_OUTS", "MAX_TRIES", "Dock", "before", "start"]

MAX_TRIES = 3
"""Approaches before it gives up."""

SEEK_TIMEOUT = 4.0
"""It stands and looks for the dock for so long [s]."""

APPROACH_TIMEOUT = 90.0
"""One approach takes no longer [s]."""

BLOCKED_TIMEOUT = 15.0
"""It waits for who stands in the way for so long [s]."""

CONTACT_TIMEOUT = 6.0
"""In contact, the battery tells within so long whether it takes charge [s]; usual ones tell once a second."""

SILENCE_TIMEOUT = 15.0
"""In contact with a battery that is silent, it waits for so long to hear from it [s]."""

DEAD_TIME = 3.0
"""A charger that gives nothing for so long, contact made, is dead [s]."""

ALIGN_GAP = 0.30
"""With its front so near to the dock it has to be on its line, and what it touches is the dock [m]."""

MAX_ASIDE, MAX_ASKEW = 0.03, 0.12
"""Off the line of a dock that is seen by no more than this [m, rad]."""

MAX_BEYOND = 0.05
"""It creeps no farther than this beyond the face that it sees [m]."""

MAP_BEYOND, MAP_GAP = 0.25, 0.45
"""Of a dock that is only on the map: how far it creeps beyond its face, and from where on what it touches is the dock [m]."""

PICTURE_PERIOD = 0.25
"""Between two pictures that are searched for a tag [s]."""

TAG_LEAVES = 1.1
"""Nearer than this the tag leaves the picture: the last bit goes by the wheels [m]."""

MAX_OUTS = 3
"""In one try it sets out anew no more often than this because it is too far from the line."""

_SEEN = {
    "reflectors": "by its reflectors",
    "one reflector": "by one of its reflectors",
    "shape": "by its shape",
    "tag": "by its tag",
    "": "by the map only",
}


def before(dock: Place, distance: float) -> Goal:
    """Where the approach begins, so far from where the robot stands docked [m]; `dock` has a direction."""
    x, y = dock.x - distance * math.cos(dock.yaw), dock.y - distance * math.sin(dock.yaw)
    return Goal(dock.name, x, y, dock.yaw, dock.name, dock.height)


def start(dock: Place, distances: Sequence[float], fault: Callable[[str, float, float], str]) -> Goal:
    """Where the approach begins: as far from the dock as one of the `distances` [m], the best first, where nothing stands.

    `fault` gives the reason why the robot cannot stand at a place of that name; the last distance is taken where none will do.
    """
    starts = [before(dock, distance) for distance in distances]
    return next((one for one in starts if not fault(one.name, one.x, one.y)), starts[-1])


class _Stage(Enum):
    """What it does just now."""

    DRIVE = "drives to where the approach begins"
    SEEK = "stands and looks"
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
    ) -> None:
        """`course` has the one point that `before` gives; `track` follows the dock by laser, if there is one."""
        super().__init__("dock")
        self._dock, self._course, self._navigator, self._situation = dock, course, navigator, situation
        self._way, self._track = approach, track
        self._face = Pose2(dock.x, dock.y, dock.yaw).then(Pose2(approach.front, 0.0, 0.0))
        """Of the dock as the map has it."""
        self._distance = math.hypot(course.goal.x - dock.x, course.goal.y - dock.y)
        self._stage, self._since = _Stage.DRIVE, 0.0
        self._tries = self._outs = 0
        self._by = ""
        self._scan: LaserScan | None = None
        self._picture_stamp = self._next_picture = -math.inf
        self._blocked = self._dead = math.inf
        self._begun = Pose2(0.0, 0.0, 0.0)
        """Where its wheels were when it went back."""
        self._steps: dict[_Stage, Callable[[], Status]] = {
            _Stage.DRIVE: self._drive,
            _Stage.SEEK: self._seek,
            _Stage.APPROACH: self._approach,
            _Stage.CONTACT: self._contact,
            _Stage.RETREAT: self._retreat,
        }

    def initialise(self) -> None:
        """Set out."""
        self._tries = self._outs = 0
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
        self._blocked = self._dead = math.inf
        self._begun = self._situation.odom

    @property
    def _spent(self) -> float:
        """In this stage [s]."""
        return self._situation.worked - self._since

    def _set_out(self) -> None:
        self._track.forget()
        self._navigator.head_for(self._course.goal)
        self._enter(_Stage.DRIVE)

    def _drive(self) -> Status:
        now, name = self._situation, self._dock.name
        leg = self._navigator.update(now.pose, now.points, now.now)
        phase = "turning" if self._navigator.turning else "driving"
        text = f"Turning to {name}." if self._navigator.turning else f"Heading for {name}."
        now.report(phase, text, place=name, still=self._distance / CREEP_SPEED / 2)
        if LEG_STATUS[leg] is Status.SUCCESS:
            self._navigator.finish()
            self._enter(_Stage.SEEK)
            return Status.RUNNING
        return LEG_STATUS[leg]

    def _seek(self) -> Status:
        self._navigator.move(Twist())
        self._look()
        self._tell(f"Looking for {self._dock.name}.")
        if self._track.known:
            self._by = self._track.by
            self._enter(_Stage.APPROACH)
        elif self._spent > SEEK_TIMEOUT or not (self._situation.scan or self._by_camera):
            if self._shines or (self._by_camera and self._situation.picture):
                return self._again(self._unseen())
            self._by = ""
            self._enter(_Stage.APPROACH)
        return Status.RUNNING

    @property
    def _by_camera(self) -> bool:
        """It has no laser, but a camera and what reads a dock's tag in its pictures."""
        return self._situation.scan is None and self._track.reads_tags

    @property
    def _shines(self) -> bool:
        """The laser would see reflectors; what it does not see is not there."""
        return self._situation.scan is not None and len(self._situation.scan.intensities) > 0

    def _unseen(self) -> Notice:
        name, now = self._dock.name, self._situation
        if self._way.taken(now.points, self._on_map()):
            return Notice(Code.DOCK_TAKEN, f"{name} is taken: something stands in it.", place=name)
        what = "no tag of a dock is" if now.scan is None else "no two reflecting strips 0.30 m apart are"
        said = f"{name} is not seen: {what} where it should be."
        return Notice(Code.DOCK_UNSEEN, said, place=name)

    def _on_map(self) -> Pose2:
        """The dock in `base_link`, as the map has it."""
        return self._face.since(self._situation.pose)

    def _look(self) -> None:
        """Take in the newest sweep, once."""
        now = self._situation
        if now.scan is not None:
            if now.scan is not self._scan:
                self._scan = now.scan
                self._track.look(now.scan, now.swept, self._on_map())
        elif now.picture_stamp > self._picture_stamp and now.worked >= self._next_picture:
            self._picture_stamp, self._next_picture = now.picture_stamp, now.worked + PICTURE_PERIOD
            dock = self._track.pose(now.odom)
            if dock is None or dock.x > TAG_LEAVES:
                self._track.look_at(now.picture, now.pictured, self._on_map())

    def _approach(self) -> Status:
        self._look()
        dock = self._track.pose(self._situation.odom) if self._by else self._on_map()
        if dock is None:
            self._track.forget()
            self._enter(_Stage.SEEK)
            return Status.RUNNING
        robot = dock.inverse()
        gap = -robot.x - self._way.front
        if gap > self._distance + 0.5 or abs(robot.y) > 0.5 * self._distance:
            self._outs += 1  # it was moved meanwhile, or the map is worse than it may be
            if self._outs > MAX_OUTS:
                return self._again(self._missed(robot))
            self._set_out()
            return Status.RUNNING
        if self._spent > APPROACH_TIMEOUT:
            said = f"{self._dock.name} was not reached within {APPROACH_TIMEOUT:.0f} s."
            return self._again(Notice(Code.DOCK_MISSED, said, place=self._dock.name))
        return self._go_up(dock, robot, gap)

    def _go_up(self, dock: Pose2, robot: Pose2, gap: float) -> Status:
        now, name = self._situation, self._dock.name
        if gap > ALIGN_GAP and self._way.blocked(now.points, dock):
            return self._wait_for_room()
        self._blocked = math.inf
        if self._by and 0.5 * ALIGN_GAP < gap < ALIGN_GAP and self._off(robot):
            return self._again(self._missed(robot))
        touches = gap < (ALIGN_GAP if self._by else MAP_GAP)
        arrived = gap < -(MAX_BEYOND if self._by else MAP_BEYOND) or self._meets
        if arrived or (now.touched and touches):
            self._enter(_Stage.CONTACT)
            return Status.RUNNING
        self._tell(f"Going up to {name}, {_SEEN[self._by]}.", touches=touches)
        self._navigator.move(self._way.steer(robot))
        return Status.RUNNING

    def _wait_for_room(self) -> Status:
        now, name = self._situation, self._dock.name
        self._navigator.move(Twist())
        self._blocked = min(self._blocked, now.worked)
        if now.worked - self._blocked > BLOCKED_TIMEOUT:
            said = f"{name} cannot be reached: something stands before it."
            return self._again(Notice(Code.DOCK_BLOCKED, said, place=name))
        self._tell(f"Waiting: something stands before {name}.")
        return Status.RUNNING

    def _missed(self, robot: Pose2) -> Notice:
        name = self._dock.name
        said = f"No charge: the line to {name} was missed by {abs(self._aside(robot)) * 100:.0f} cm."
        return Notice(Code.DOCK_MISSED, said, place=name)

    def _off(self, robot: Pose2) -> bool:
        """What is to touch the dock is too far off its line, or the robot too askew, to go on."""
        return abs(self._aside(robot)) > MAX_ASIDE or abs(robot.yaw) > MAX_ASKEW

    def _aside(self, robot: Pose2) -> float:
        """Of the robot's front off the dock's line, to the left [m]."""
        return robot.y + self._way.front * math.sin(robot.yaw)

    @property
    def _meets(self) -> bool:
        """The contacts meet, but there is no current."""
        return self._situation.power == BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING

    def _contact(self) -> Status:
        now, name = self._situation, self._dock.name
        self._navigator.move(Twist())
        self._tell(f"Waiting for the charge at {name}.", touches=True)
        self._dead = min(self._dead, now.worked) if self._meets else math.inf
        if now.worked - self._dead > DEAD_TIME:
            said = f"{name} gives no charge: the contacts meet, but no current flows; the robot stands there."
            self._navigator.reason = Notice(Code.DOCK_DEAD, said, place=name)
            return Status.FAILURE
        if now.now - now.battery_heard > CONTACT_TIMEOUT:
            return self._silent()
        if self._spent > CONTACT_TIMEOUT and not self._meets:
            said = f"{name} was reached {_SEEN[self._by]}, but its contacts did not meet."
            return self._again(Notice(Code.DOCK_MISSED, said, place=name))
        return Status.RUNNING

    def _silent(self) -> Status:
        """In contact, the battery was not heard lately."""
        if self._spent <= SILENCE_TIMEOUT:
            return Status.RUNNING
        name, heard = self._dock.name, self._situation.now - self._situation.battery_heard
        silent = f"has said nothing for {heard:.0f} s" if heard < math.inf else "says nothing"
        said = f"{name} was reached, but the battery {silent}, so nobody knows whether it charges; the robot stands there."
        self._navigator.reason = Notice(Code.CHARGE_UNKNOWN, said, place=name, seconds=heard)
        return Status.FAILURE

    def _again(self, why: Notice) -> Status:
        """Go back and try once more; after the last time `why` is the reason."""
        self._tries += 1
        if self._tries >= MAX_TRIES:
            tried = why.reworded(f"{str(why)[:-1]}; after {MAX_TRIES} tries the robot stands before it.")
            self._navigator.reason = tried
            return Status.FAILURE
        self._outs = 0
        self._enter(_Stage.RETREAT)
        return Status.RUNNING

    def _retreat(self) -> Status:
        """Straight back as far as there is room, then anew from where the approach begins."""
        now = self._situation
        gone = now.odom.distance(self._begun.x, self._begun.y)
        on_map = self._on_map().inverse()
        far = -on_map.x - self._way.front >= self._distance - 0.1
        if far or gone > self._distance - 0.1 or self._way.room_behind(now.points) < 0.1:
            self._set_out()
            return Status.RUNNING
        self._tell(f"Going back to try {self._dock.name} again.", touches=True)
        self._navigator.move(Twist.planar(-RETREAT_SPEED, 0.0))
        return Status.RUNNING

    def _tell(self, text: str, *, touches: bool = False) -> None:
        still = self._distance / CREEP_SPEED / 2
        self._situation.report("docking", text, place=self._dock.name, still=still, touches=touches)
