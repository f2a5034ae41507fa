"""The factory of tasks: it turns an order into a task, with names looked up, or refuses it with the reason."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from dataclasses import replace

import msgspec
from py_trees.behaviour import Behaviour
from py_trees.composites import Sequence as Chain

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TASKS, Mission, Place, RobotInfo, TaskOrder, Waypoint
from robotside.core.notice import Notice, Problem
from robotside.core.refusal import Refusal
from robotside.core.text import plain
from robotside.kinds.registry import kind_of
from robotside.navigation.navigator import Goal, Navigator
from robotside.records import Records
from robotside.records.events import Say
from robotside.tasks.behaviours.course import Course, Span
from robotside.tasks.behaviours.deliver import deliver
from robotside.tasks.behaviours.fly import Land, Surface, TakeOff
from robotside.tasks.behaviours.follow_heading import FollowHeading
from robotside.tasks.behaviours.hold import Hold
from robotside.tasks.behaviours.lead import lead
from robotside.tasks.behaviours.patrol import at_place, patrol, patrol_course, single, way
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.dock_tasks import DockTasks, docks
from robotside.tasks.engine import Task
from robotside.tasks.order_heights import OrderHeights
from robotside.tasks.task_places import TaskPlaces

__all__ = ["TaskFactory", "tasks_of", "words_for"]

MAX_PLACES = 100
"""That one task may name."""

MAX_MESSAGE = 200
"""Characters kept of a message to a person."""

MAX_NAME = 64
"""Characters kept of a name and a tag."""

MAX_DURATION = 24 * 3600.0
"""To hold or to follow a heading, where a time is given [s]."""

_WORDS = {
    "patrol": "a patrol",
    "deliver": "a delivery",
    "guide": "a guided tour",
    "go_to": "a way to a place",
    "go_home": "the way home",
    "hold": "holding",
    "follow_heading": "following a heading",
    "dock": "docking",
    "undock": "leaving the dock",
    "take_off": "taking off",
    "land": "landing",
    "surface": "surfacing",
}


def words_for(task: str) -> str:
    """The name of a task within a sentence."""
    return _WORDS.get(task, task)


def tasks_of(info: RobotInfo) -> list[str]:
    """The tasks that a robot knows, which depend on its kind and its manoeuvres."""
    unknown = {task for task in ("take_off", "land", "surface") if task not in info.manoeuvres}
    if not docks(info):
        unknown |= {"dock", "undock"}
    elif kind_of(info.kind).flies:
        unknown.add("undock")  # it takes off
    return [task for task in TASKS if task not in unknown]


class TaskFactory:
    """Makes tasks for one robot. Every method raises Refusal with one sentence when the task cannot be done."""

    def __init__(
        self,
        navigator: Navigator,
        situation: Situation,
        info: RobotInfo,
        *,
        say: Say,
        rng: random.Random,
        records: Records,
        fault: Callable[[str, float, float], Problem],
        heights: tuple[float, float] = (-math.inf, math.inf),
    ) -> None:
        """`fault` gives the reason why the robot cannot or may not stand at a place of that name; empty when it can.

        `heights` are the lowest and the highest at which it can and may be, above the map's origin [m].
        """
        self._heights = OrderHeights(info, heights)
        self._navigator, self._situation, self._info = navigator, situation, info
        self._say, self._rng, self._records, self._fault = say, rng, records, fault
        self._places = TaskPlaces(records, fault, self._heights)
        self._docks = DockTasks(self._places, navigator, situation, info, say=say, fault=fault)
        self._makers: dict[str, Callable[[TaskOrder], Task]] = {
            "patrol": self._patrol,
            "deliver": self._deliver,
            "guide": self._lead,
            "go_to": self._go_to,
            "go_home": self._go_home,
            "hold": self._hold,
            "follow_heading": self._follow_heading,
            "dock": self._docks.dock,
            "undock": self._docks.undock,
            "take_off": self._take_off,
            "land": self._land,
            "surface": self._surface,
        }

    def task(self, order: TaskOrder, by: str = "") -> Task:
        """The task of an `order` by the operator `by`."""
        make = self._makers.get(order.task)
        if make is None:
            said = f"There is no task {order.task!r}; there are {', '.join(TASKS)}."
            raise Refusal(Notice(Code.TASK_UNKNOWN, said, task=order.task[:MAX_NAME]))
        known = tasks_of(self._info)
        if order.task not in known:
            said = f"{self._info.name} does not know {words_for(order.task)}; it knows {', '.join(known)}."
            raise Refusal(Notice(Code.TASK_UNABLE, said, robot=self._info.name, task=order.task))
        order = _tidy(order)
        self._heights.check(order.height)
        if self._situation.flight == "turned_over":
            said = f"{self._info.name} has turned over; put it upright first."
            raise Refusal(Notice(Code.ROBOT_OVERTURNED, said, robot=self._info.name))
        task = make(order)
        if task.moves and task.name not in ("dock", "undock", "take_off") and docks(self._info):
            task = replace(task, root=self._docks.out_first(task.root))
        return replace(task, order=order, by=by)

    def home(self) -> Waypoint | None:
        """Where the robot returns to; None when it is not set."""
        return self._places.home()

    def check_mission(self, mission: Mission) -> None:
        """Refuse a mission with a point at which the robot cannot stand."""
        self._places.check_mission(mission)

    def _patrol(self, order: TaskOrder) -> Task:
        mission = self._records.missions.current
        if order.places:
            places = self._places.named(order, 1, MAX_PLACES, "A patrol needs at least one place")
            goals = [at_place(place) for place in places]
            dwell = mission.dwell if mission.motion == "intermittent" else 0.0
            course = Course(goals, motion=mission.motion, laps=mission.laps, dwell=dwell, rng=self._rng)
        elif mission.waypoints:
            self._places.check_mission(mission)
            course = patrol_course(mission, self._rng)
        else:
            raise Refusal(Notice(Code.MISSION_EMPTY, "The mission has no points; set at least one."))
        tree = patrol(
            course, self._navigator, self._situation, self._say, lambda x, y: self._fault("It", x, y)
        )

        def done() -> str:
            return f"Patrol done: {course.visited} {_points(course.visited)} visited."

        return Task("patrol", "Patrol", tree, course, done=done)

    def _deliver(self, order: TaskOrder) -> Task:
        rule = "A delivery needs two places, from and to, and may have a third to go on to"
        places = self._places.named(order, 2, 3, rule)
        tag = order.recipient_tag
        course, tree = deliver(places, order.message, tag, self._navigator, self._situation, self._say)
        return Task("deliver", "Delivery", tree, course, done=lambda: f"Delivered at {places[1].name}.")

    def _lead(self, order: TaskOrder) -> Task:
        places = self._places.named(order, 1, MAX_PLACES, "A guided tour needs at least one place")
        course, tree = lead(places, order.message, self._navigator, self._situation, self._say)

        def done() -> str:
            return (
                f"Guided tour done: {course.visited} {'place' if course.visited == 1 else 'places'} visited."
            )

        return Task("guide", "Guided tour", tree, course, done=done)

    def _go_to(self, order: TaskOrder) -> Task:
        if order.goals and not order.places:
            return self._to_points(order.goals)
        place = self._places.named(order, 1, 1, "go_to needs one place, or points")[0]
        course = Course([at_place(place)])
        tree = way(course, self._navigator, self._situation)
        title = f"Way to {place.name}"
        return Task("go_to", title, tree, course, done=lambda: f"{place.name} reached.")

    def _to_points(self, goals: Sequence[Waypoint]) -> Task:
        names = (
            ["The goal"]
            if len(goals) == 1
            else [f"Goal {n} of {len(goals)}" for n in range(1, len(goals) + 1)]
        )
        for name, goal in zip(names, goals, strict=True):
            self._places.check(name, goal.x, goal.y, goal.height)
        points = [
            Goal(name, goal.x, goal.y, goal.yaw, height=goal.height)
            for name, goal in zip(names, goals, strict=True)
        ]
        course = Course(points)
        tree = way(course, self._navigator, self._situation, self._say if len(goals) > 1 else None)
        return Task("go_to", "Way to the goal", tree, course, done=lambda: "Way to the goal done.")

    def _go_home(self, _: TaskOrder) -> Task:
        home = self._places.home()
        if home is None:
            raise Refusal(Notice(Code.HOME_UNSET, "Home is not set; set it on the map first."))
        self._places.check("Home", home.x, home.y, home.height)
        course, tree = single("Home", home, self._navigator, self._situation)
        if "land" in tasks_of(self._info):
            down = Land(self._navigator, self._situation)
            tree = Chain("home and down", memory=True, children=[tree, down])
        return Task("go_home", "Way home", tree, course, done=lambda: "Home.")

    def _hold(self, order: TaskOrder) -> Task:
        span = self._span(order)
        tree = Hold(span, self._navigator, self._situation, order.height)
        done = f"Held for {order.duration:.0f} s."
        return Task("hold", "Holding", tree, span, done=lambda: done, moves=kind_of(self._info.kind).flies)

    def _follow_heading(self, order: TaskOrder) -> Task:
        if math.isinf(order.heading):
            said = f"The heading must be a number [rad], not {order.heading}."
            raise Refusal(Notice(Code.HEADING_INVALID, said, heading=order.heading))
        most = self._info.max_speed
        if not (math.isnan(order.speed) or 0 < order.speed <= most):
            said = f"The speed must be above 0 and at most {most:g} m/s, not {order.speed:g} m/s."
            raise Refusal(Notice(Code.SPEED_INVALID, said, speed=order.speed, max=most))
        span = self._span(order)
        if not math.isnan(order.throttle) and not (-1 <= order.throttle <= 1 and order.throttle):
            said = f"The throttle must be from -1 to 1 and not 0, not {order.throttle:g}."
            raise Refusal(Notice(Code.THROTTLE_INVALID, said, throttle=order.throttle))
        tree = FollowHeading(
            order.heading, order.speed, span, self._navigator, self._situation, throttle=order.throttle
        )
        done = f"Followed the heading for {order.duration:.0f} s."
        return Task("follow_heading", "Following a heading", tree, span, done=lambda: done)

    def _take_off(self, order: TaskOrder) -> Task:
        tree = TakeOff(self._navigator, self._situation, order.height)
        return Task("take_off", "Take-off", tree, self._moment(), done=lambda: "In the air.")

    def _land(self, _: TaskOrder) -> Task:
        tree = Land(self._navigator, self._situation)
        return Task("land", "Landing", tree, self._moment(), done=lambda: "Landed.", moves=False)

    def _surface(self, _: TaskOrder) -> Task:
        tree = Surface(self._navigator, self._situation)
        return Task("surface", "Surfacing", tree, self._moment(), done=lambda: "At the surface.", moves=False)

    def _moment(self) -> Span:
        """Of a task that visits nothing and takes as long as it takes."""
        return Span(math.nan, lambda: self._situation.worked)

    def dock_place(self) -> Place | None:
        """The dock that it goes to by itself; None when it knows none, or cannot dock."""
        return next(iter(self._places.docks()), None) if "dock" in tasks_of(self._info) else None

    def charge_break(self, until: float) -> Behaviour:
        """What the running task is interrupted by to charge up to a share, 0 to 1."""
        return self._docks.charge_break(until)

    def _span(self, order: TaskOrder) -> Span:
        if not (math.isnan(order.duration) or 0 < order.duration <= MAX_DURATION):
            allowed = f"above 0 and at most {MAX_DURATION:.0f} s, or left out until stopped"
            said = f"The duration must be {allowed}, not {order.duration:g} s."
            raise Refusal(Notice(Code.DURATION_INVALID, said, duration=order.duration, max=MAX_DURATION))
        return Span(order.duration, lambda: self._situation.worked)


def _tidy(order: TaskOrder) -> TaskOrder:
    """The same order with its texts cut to readable lines; Refusal when it names too many places."""
    if max(len(order.places), len(order.goals)) > MAX_PLACES:
        count = max(len(order.places), len(order.goals))
        said = f"A task names at most {MAX_PLACES} places or points, not {count}."
        raise Refusal(Notice(Code.PLACES_TOO_MANY, said, count=count, max=MAX_PLACES))
    return msgspec.structs.replace(
        order,
        places=[plain(name, MAX_NAME) for name in order.places],
        goals=[msgspec.structs.replace(goal, name=plain(goal.name, MAX_NAME)) for goal in order.goals],
        message=plain(order.message, MAX_MESSAGE),
        recipient_tag=plain(order.recipient_tag, MAX_NAME),
    )


def _points(count: int) -> str:
    return "point" if count == 1 else "points"
