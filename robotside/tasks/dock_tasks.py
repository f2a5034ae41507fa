"""The tasks of docks: onto one, out of it, and the break of another task to charge there."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from py_trees.behaviour import Behaviour
from py_trees.composites import Sequence as Chain

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Place, RobotInfo, TaskOrder
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.core.refusal import Refusal
from robotside.kinds.registry import kind_of
from robotside.navigation.navigator import Goal, Navigator
from robotside.perception.cage_finder import CageFinder
from robotside.perception.dock_finder import DockFinder
from robotside.perception.dock_track import FIRST_REACH, DockTrack
from robotside.perception.pad_finder import DOWN, PadFinder
from robotside.perception.tag_finder import TagFinder
from robotside.records.events import Say
from robotside.tasks.behaviours.charge import MIN_CHARGE, Charge
from robotside.tasks.behaviours.course import Course, Span
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing import cage_line, jetty_line
from robotside.tasks.berthing.approach import DOCK_NEAR, Approach
from robotside.tasks.berthing.cage_docking import STANDOFFS, CageDocking
from robotside.tasks.berthing.dock import Dock
from robotside.tasks.berthing.dock_start import DockStarts, body_fault, starts
from robotside.tasks.berthing.jetty_docking import NEAR, JettyDocking
from robotside.tasks.berthing.pad_landing import PadLanding, first_goal
from robotside.tasks.berthing.undock import Undock
from robotside.tasks.engine import Task
from robotside.tasks.task_places import TaskPlaces

__all__ = ["DockTasks", "docks"]


def docks(info: RobotInfo) -> bool:
    """The robot can come to a charger of its kind; down onto a pad, or into a cage, only with a camera that looks there."""
    how = kind_of(info.kind).docks
    if how == "jetty":
        return bool(info.cameras) and {"course", "steer"} <= set(info.manoeuvres)
    if how == "cage":
        return bool(info.cameras) and "course" in info.manoeuvres
    return bool(how) and (how != "pad" or (DOWN in info.cameras and "land" in info.manoeuvres))


class DockTasks:
    """Makes them for one robot. Every method raises Refusal with one sentence when it cannot be done."""

    def __init__(
        self,
        places: TaskPlaces,
        navigator: Navigator,
        situation: Situation,
        info: RobotInfo,
        *,
        say: Say,
        fault: Callable[[str, float, float], Problem],
    ) -> None:
        """`fault` gives the reason why the robot cannot or may not stand at a place of that name; empty when it can."""
        self._places, self._navigator, self._situation, self._info = places, navigator, situation, info
        self._say, self._fault = say, fault
        self._approach = Approach.of(info)
        self._how = kind_of(info.kind).docks
        self._flies = self._how == "pad"

    def dock(self, order: TaskOrder) -> Task:
        """Onto a dock, and to stay there until the battery has what the order says."""
        dock, until = self._places.dock(order), order.charge_to
        if not (math.isnan(until) or MIN_CHARGE <= until <= 1):
            allowed = f"from {MIN_CHARGE:.0%} to 100%, or left out"
            said = f"The charge to stay for must be {allowed}, not {until:.0%}."
            raise Refusal(Notice(Code.CHARGE_INVALID, said, charge=until, least=MIN_CHARGE))
        tree, course = self._onto(dock)
        if math.isnan(until):
            done = f"Docked at {dock.name}: the battery takes charge."
            return Task("dock", "Docking", tree, course, done=lambda: done)
        charge = self._charge(until, dock)
        chain = Chain("dock and charge", memory=True, children=[tree, charge])

        def charged() -> str:
            return f"Charged to {self._situation.charge:.0%} at {dock.name}."

        return Task("dock", "Charging", chain, course, done=charged)

    def undock(self, _: TaskOrder) -> Task:
        """Out of the dock that it is in."""
        leave, here = self._leave(), self._situation

        def done() -> str:
            return f"Out of {leave.dock}." if leave.dock else "The robot stands in no dock."

        span = Span(math.nan, lambda: here.worked)
        return Task("undock", "Undocking", leave, span, done=done)

    def out_first(self, tree: Behaviour) -> Behaviour:
        """`tree` for a robot that may be in a dock: it leaves it first."""
        if self._flies:
            return tree  # it takes off, wherever it stands
        return Chain("out of the dock first", memory=True, children=[self._leave(), tree])

    def charge_break(self, until: float) -> Behaviour:
        """What a task is interrupted by to charge up to a share, 0 to 1; the task goes on outside of the dock."""
        dock = self._places.dock(TaskOrder(task="dock"))
        tree, _ = self._onto(dock)
        charge = self._charge(until, dock)
        children = [tree, charge] if self._flies else [tree, charge, self._leave()]
        return Chain("charge first", memory=True, children=children)

    def _charge(self, until: float, dock: Place) -> Charge:
        lean = {"cage": cage_line.LEAN, "jetty": jetty_line.LEAN}.get(self._how, math.nan)
        return Charge(until, dock.name, self._navigator, self._situation, self._say, lean)

    def _leave(self) -> Undock:
        # no cable charges what swims, and where it is it does not know well
        near = {"cage": math.inf, "jetty": NEAR}.get(self._how, DOCK_NEAR)
        return Undock(self._places.docks, self._navigator, self._situation, self._approach, near)

    def _onto(self, dock: Place) -> tuple[Behaviour, Course]:
        ways = {"pad": self._down_onto, "cage": self._into, "jetty": self._alongside}
        return ways.get(self._how, self._up_to)(dock)

    def _into(self, cage: Place) -> tuple[Behaviour, Course]:
        finder = CageFinder(self._info.camera_fov, self._approach.front)
        if not finder.able:
            raise _unread(cage)
        course = self._before(cage, STANDOFFS)
        tree = CageDocking(cage, course, self._navigator, self._situation, finder.find, self._approach.front)
        return tree, course

    def _alongside(self, jetty: Place) -> tuple[Behaviour, Course]:
        front = self._approach.front
        finder = CageFinder(self._info.camera_fov, front - jetty_line.CAMERA_BEHIND)
        if not finder.able:
            raise _unread(jetty)
        course = self._before(jetty, self._approach.standoffs)
        begin = self._begin(jetty)
        tree = JettyDocking(
            jetty,
            course,
            self._navigator,
            self._situation,
            finder.find,
            front,
            lambda docked: begin(docked)[0],
        )
        return tree, course

    def _down_onto(self, pad: Place) -> tuple[Behaviour, Course]:
        finder = PadFinder()
        if not finder.able:
            raise _unread(pad)
        first = first_goal(pad, self._fault)
        self._places.check(pad.name, first.x, first.y)
        course = Course([first])
        course.index = 0
        tree = PadLanding(pad, course, self._navigator, self._situation, finder.find, self._fault)
        return tree, course

    def _before(self, dock: Place, distances: Sequence[float]) -> Course:
        """To where the approach begins, at one of the `distances` [m]."""
        if math.isnan(dock.yaw):
            said = f"{dock.name} has no direction; docking needs the one to stand in there."
            raise Refusal(Notice(Code.DOCK_UNDIRECTED, said, place=dock.name))
        first = self._starts(dock, Pose2(dock.x, dock.y, dock.yaw), distances)[0]
        before = f"The place before {dock.name}"
        self._places.check(before, first.x, first.y, dock.height)
        problem = body_fault(before, first, self._fault, self._navigator.controller.discs)
        if problem:
            raise Refusal(problem)
        course = Course([first])
        course.index = 0
        return course

    def _starts(self, dock: Place, docked: Pose2, distances: Sequence[float]) -> list[Goal]:
        discs = self._navigator.controller.discs
        return starts(dock, docked, distances, self._fault, slants=self._approach.slants, discs=discs)

    def _up_to(self, dock: Place) -> tuple[Behaviour, Course]:
        course = self._before(dock, self._approach.standoffs)
        tags = TagFinder(self._info.camera_fov) if self._info.cameras else None
        # an error of the dock's direction swings the face of one that a long body stands before
        reach = FIRST_REACH + 0.2 * self._approach.front
        track = DockTrack(DockFinder(Pose2(self._info.laser_x, 0.0, 0.0)), tags, reach)
        places = DockStarts(self._begin(dock), varied=self._approach.min_radius > 0)
        return Dock(dock, course, self._navigator, self._situation, self._approach, track, places), course

    def _begin(self, dock: Place) -> Callable[[Pose2], list[Goal]]:
        """Where the approach to a dock may begin, the best first, for where the robot would stand docked."""
        return lambda docked: self._starts(dock, docked, self._approach.standoffs)


def _unread(dock: Place) -> Refusal:
    said = f"{dock.name} cannot be found: the library that reads its tag, pupil-apriltags, is not installed."
    return Refusal(Notice(Code.DOCK_TAGS_UNREAD, said, place=dock.name))
