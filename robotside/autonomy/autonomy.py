"""What the robot does by itself: knows where it is, runs tasks, watches out, and minds its battery and sensors."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from typing import Any

import numpy as np

from bridge.core.codes import Code
from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseStamped
from bridge.msgs.nav_msgs import OccupancyGrid, Odometry, Path
from bridge.msgs.pilothouse_msgs import (
    Bumper,
    FlightState,
    Following,
    Intruder,
    Mission,
    SonarRing,
    TagRead,
    TaskOrder,
    TaskStatus,
)
from bridge.msgs.sensor_msgs import BatteryState, CompressedImage, LaserScan
from bridge.msgs.std_msgs import Header, Time
from robotside.autonomy.sensor_health import needed
from robotside.core.bus import Bus
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Points, Pose2
from robotside.core.refusal import Refusal
from robotside.core.robot import Robot
from robotside.core.topic_demand import Demand
from robotside.limits.bumper_guard import CONTACT_TIME
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.moving_obstacles import MovingObstacles
from robotside.mapping.occupancy_grid import Grid
from robotside.mapping.sonar_points import SonarProjection
from robotside.navigation.navigator import Navigator
from robotside.perception.intruder_watch import IntruderWatch
from robotside.records import Records
from robotside.records.events import Events
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.patrol import patrol_route
from robotside.tasks.behaviours.situation import Seen, Situation
from robotside.tasks.engine import TO_CHARGE, Engine
from robotside.tasks.task_factory import TaskFactory
from robotside.tasks.task_status_publisher import TaskStatusPublisher

__all__ = ["LOW_BELOW", "Autonomy"]


GO_HOME_BELOW = 0.10
"""A task that moves the robot ends and it goes home when the battery has less than this left, 0 to 1."""

LOW_BELOW = 0.15
"""A battery with less than this left is low: it is said, and no task that moves the robot is started, 0 to 1."""

SILENCE = 0.6
"""Odometry or laser silent for this long means that the robot must not drive by itself [s]."""

UNMEASURED = 2.0
"""Without odometry for this long nobody knows whether the wheels stand still [s]."""


_CHARGING = (BatteryState.POWER_SUPPLY_STATUS_CHARGING, BatteryState.POWER_SUPPLY_STATUS_FULL)


class Autonomy:
    """The robot's own mind; fed with its messages, it drives when there is a task."""

    def __init__(
        self,
        robot: Robot,
        chart: OccupancyGrid | None,
        *,
        bus: Bus,
        events: Events,
        demand: Demand,
        clock: Callable[[], float],
        rng: random.Random,
        records: Records,
        fault: Callable[[str, float, float], Problem],
        fit: Callable[[Grid], Grid] = lambda grid: grid,
        heights: tuple[float, float] = (-math.inf, math.inf),
    ) -> None:
        """`chart` is the map, None or of no use while there is none; `clock` is the operators' [s], by which the task's messages are stamped.

        `fault` tells why the robot cannot or may not stand at a place that is called so, empty when it can.
        `fit` makes of the map the one to plan on, with all occupied where the robot may not go.
        `heights` are the lowest and the highest at which it can and may be [m].
        """
        info = robot.info
        self._bus, self._events, self._demand, self._fit = bus, events, demand, fit
        self._now = 0.0
        self._kind = info.kind
        self._heard: dict[str, float] = {}
        self._laser = LaserProjection(Pose2(info.laser_x, 0.0, 0.0))
        self._sonars, self._movers = SonarProjection(), MovingObstacles()
        self._points: Points = np.empty((0, 2))
        self._swept: Pose2 | None = None
        self._bumped, self._let_go = False, -math.inf
        self.battery = math.nan
        """0 empty to 1 full; NaN while unknown."""
        self._records = records
        self.pose_estimator = PoseEstimator(info, events.say, bus.publish)
        self.has_map = False
        """There is a map to localise and plan on."""
        self.navigator = Navigator(robot, Grid.unknown(), self._show_plan)
        if chart is not None:
            self._take_map(chart)
        self.situation = Situation()
        self.watch = IntruderWatch(self.pose_estimator.track, info.camera_fov, bus.publish, self._found)
        self.status_publisher = TaskStatusPublisher(
            records, lambda status: bus.publish("/task/status", status), clock
        )
        """Tells everybody how the task is."""
        self.engine = self._engine(clock)
        self.task_factory = TaskFactory(
            self.navigator,
            self.situation,
            info,
            say=events.say,
            rng=rng,
            records=records,
            fault=fault,
            heights=heights,
        )
        """What makes tasks of orders."""
        self._show_plan(np.empty((0, 2)))
        self._take = self._takers()

    def _engine(self, clock: Callable[[], float]) -> Engine:
        return Engine(
            self.navigator,
            self.situation,
            show=self._show_status,
            progress=lambda progress: self._bus.publish("/task/progress", progress),
            say=self._events.say,
            clock=clock,
            cruise=self.navigator.cruise,
        )

    _chart: OccupancyGrid | None = None
    _coming: OccupancyGrid | None = None

    def take(self, topic: str, msg: Msg, now: float) -> None:
        """Take in one message of the robot, at `now` [s, robot clock]."""
        self._now = now
        if topic in self._take:
            self._take[topic](msg)

    def silence(self, now: float) -> str:
        """Which of the senses that it needs is silent, as `the laser has been silent for 0.6 s`; empty when none is."""
        for topic, sense in needed(self._kind, self._heard).items():
            heard = self._heard.get(topic, -math.inf)
            if not now - heard <= SILENCE:
                since = f"has been silent for {SILENCE} s" if heard > -math.inf else "has sent no data yet"
                return f"the {sense} {since if sense != 'sonars' else since.replace('has', 'have', 1)}"
        return ""

    def measured(self, now: float, since: float = -math.inf) -> bool:
        """How fast it goes is known: its odometry came lately, and after `since` [s]."""
        heard = self._heard.get("/odom", -math.inf)
        return now - heard <= UNMEASURED and heard > since

    def check(self, now: float) -> None:
        """Halt the running task when it has become blind, and take a new map between two tasks; call it often."""
        if self._coming is not None and not self.engine.active:
            self._take_map(self._coming)
        if not self.engine.running:
            return
        silence = self.silence(now)
        if silence:
            self.engine.pause(Notice(Code.TASK_SENSOR_SILENT, f"Paused: {silence}."), "alarm")

    def _takers(self) -> dict[str, Callable[[Any], None]]:
        """What is done with each topic's messages."""
        return {
            "/map": self._map,
            "/odom": self._odom,
            "/scan": self._scan,
            "/sonar": self._sonar,
            "/flight": self._flight,
            "/fix": self.pose_estimator.on_fix,
            "/imu/data": self.pose_estimator.on_imu,
            "/battery_state": self._battery,
            "/bumper": self._bumper,
            "/tag": self._tag,
            "/following": self._following,
            CAMERA: self._image,
        }

    @property
    def low(self) -> bool:
        """There is charge only for the way to where there is more."""
        return self.battery < LOW_BELOW

    @property
    def patrols_mission(self) -> bool:
        """A patrol of the stored mission is under way."""
        task = self.engine.task
        return task is not None and task.name == "patrol" and not task.order.places

    def edit_patrol(self, mission: Mission) -> None:
        """Have the patrol that is under way go on with the points of `mission`, if there are any."""
        task = self.engine.task
        if task and self.patrols_mission and mission.waypoints and isinstance(task.course, Course):
            task.course.edit(patrol_route(mission))

    def place(self, pose: Pose2) -> None:
        """The operator says where it is; what was seen from the wrong place is forgotten."""
        self.pose_estimator.place(pose)
        self.navigator.obstacles.forget()
        self.watch.intruders.forget()

    def _map(self, msg: OccupancyGrid) -> None:
        """A map came later, or another one: it counts when no task is under way."""
        if msg is self._chart:
            return
        if not self.has_map and not Grid.fault(msg):
            self._events.say("localisation", Notice(Code.MAP_ARRIVED, "There is a map now."), "ok")
        self._coming = msg

    def _take_map(self, msg: OccupancyGrid) -> None:
        self._coming, self._chart = None, msg
        problem = Grid.fault(msg)
        if not problem:
            try:
                self._use(Grid.from_msg(msg))
            except MemoryError:
                problem = f"The map is of no use: {len(msg.data)} cells are too many for this computer."
        if problem:
            self._events.say("localisation", Notice(Code.MAP_UNUSABLE, problem), "warn")

    def _use(self, grid: Grid) -> None:
        self.navigator.set_map(self._fit(grid))
        self.pose_estimator.set_map(grid)
        self.has_map = True

    def _odom(self, msg: Odometry) -> None:
        if not math.isfinite(sum(Pose2.from_msg(msg.pose.pose))):
            return  # as good as none: one pose that is no number would spoil all later ones
        self._heard["/odom"] = self._now
        self.pose_estimator.on_odometry(msg)
        self.navigator.measured(msg.pose.pose.position.z)
        pose = self.pose_estimator.pose
        if pose is None:
            return
        self.navigator.sure = self.pose_estimator.sure
        if self.pose_estimator.pushes and self.engine.running and self.engine.status.phase != "docking":
            said = "Paused: the wheels turn, but something holds the robot."
            self.engine.pause(Notice(Code.TASK_HELD_FAST, said), "alarm")
        points = self._points
        if self._swept is not None and self.engine.running:
            points = pose.inverse().apply(self._swept.apply(points))
        self.engine.tick(pose, points, self.pose_estimator.odometer, self._now)

    def _scan(self, scan: LaserScan) -> None:
        self._heard["/scan"] = self._now
        stamp = scan.header.stamp.seconds
        points = self._laser.points(scan)
        self.pose_estimator.on_scan(points, stamp)
        placed = self._see(points, stamp)
        if placed is not None:
            self.watch.on_scan(placed, stamp)

    def _sonar(self, ring: SonarRing) -> None:
        """Where there is no laser, sonars keep off what is near and help to say where it is."""
        self._heard["/sonar"] = self._now
        if "/scan" not in self._heard:
            self.pose_estimator.on_sonar(self._sonars.arcs(ring))
            self._see(self._sonars.points(ring), ring.header.stamp.seconds, vague=True)

    def _see(self, points: Points, stamp: float, *, vague: bool = False) -> Points | None:
        """Take in what stands round it, in `base_link`; where that is in `map`, None while nobody knows for sure."""
        self._points = points
        self._swept = self.pose_estimator.track.at(stamp)
        if self._swept is None or not self.pose_estimator.sure:
            return None
        placed = self._swept.apply(points)
        if self.engine.active:
            obstacles = self.navigator.obstacles
            fresh, moved = obstacles.fresh(placed, vague=vague), self._movers.moving(placed, stamp)
            obstacles.update(placed[~moved], self._now, vague=vague)
            # sonars are too coarse to tell what moves: whatever is not on the map may
            moving = fresh if vague else fresh & moved
            self._points = np.concatenate([points, self._movers.nearer(points[moving])])
        return placed

    def _image(self, image: CompressedImage) -> None:
        """Pictures come while a task runs and while somebody looks: who drives by hand is told what is in them."""
        self.watch.on_image(image, placing=self.pose_estimator.sure)

    def _battery(self, msg: BatteryState) -> None:
        if msg.percentage < LOW_BELOW <= self.battery:
            low = Notice(Code.BATTERY_LOW, f"Battery low: {msg.percentage:.0%}.", charge=msg.percentage)
            self._events.say("battery", low, "warn")
        self.battery = msg.percentage
        self.situation.charging = msg.power_supply_status in _CHARGING
        self._mind_battery()

    def _mind_battery(self) -> None:
        """Go home while there is charge enough for it, whatever moves the robot elsewhere."""
        task = self.engine.task
        low = self.battery < GO_HOME_BELOW and self.engine.running
        if not low or task is None or not task.moves or task.name in TO_CHARGE:
            return
        said = f"Battery at {self.battery:.0%}"
        try:
            home = self.task_factory.task(TaskOrder(task="go_home"))
        except Refusal as problem:
            why = f"{said}: the {task.spoken} ends here. {problem}"
            ends = Notice(Code.TASK_BATTERY, why, charge=self.battery)
            self._events.say("battery", ends, "alarm")
            self.engine.cancel(ends)
            return
        goes = Notice(Code.BATTERY_GOING_HOME, f"{said}: going home.", charge=self.battery)
        self._events.say("battery", goes, "warn")
        self.engine.start(home, self._now)

    def _flight(self, msg: FlightState) -> None:
        self.situation.flight = msg.phase
        self.navigator.flies(msg.phase)

    def _tag(self, msg: TagRead) -> None:
        if msg.tag:
            self.situation.tag = msg.tag

    def _following(self, msg: Following) -> None:
        self.situation.follows, self.situation.follows_heard = msg.present, self._now

    def _bumper(self, msg: Bumper) -> None:
        was, self._bumped = self._bumped, msg.pressed
        self.situation.touched = msg.pressed
        self.pose_estimator.on_bumper(msg)
        if was and not msg.pressed:
            self._let_go = self._now
        if not msg.pressed or was or self.engine.status.phase == "docking":
            return
        self.engine.pause(Notice(Code.TASK_BUMPED, "Paused: the bumper touched something."), "alarm")
        if self._now - self._let_go < CONTACT_TIME:
            return
        pose = self.pose_estimator.pose
        at = (pose.x, pose.y) if pose else None
        side = _side(msg.bearing)
        touched = Notice(Code.BUMPER_TOUCHED, f"The bumper touched something {side}.", side=side)
        self._events.say("contact", touched, "alarm", at=at)

    def _found(self, intruder: Intruder) -> None:
        x, y = intruder.position.x, intruder.position.y
        text = f"Intruder {intruder.id}: a {intruder.class_id} at ({x:.1f}, {y:.1f})."
        found = Notice(Code.INTRUDER_FOUND, text, id=intruder.id, kind=intruder.class_id, x=x, y=y)
        self._events.say("intruder", found, "alarm", at=(x, y))
        mission = self._records.missions.current
        if self.engine.status.task != "patrol":
            return
        if mission.stop_on_intruder or mission.on_intruder == "stop":
            said = f"Paused: intruder {intruder.id} was found."
            self.engine.pause(Notice(Code.TASK_INTRUDER, said, id=intruder.id), "warn")
        elif mission.on_intruder == "circle" and self.engine.running:
            self.situation.intruders.append(Seen(intruder.id, x, y))

    def _show_status(self, status: TaskStatus) -> None:
        self._demand.set(CAMERA, "task", status.state == "RUNNING")
        self.status_publisher.show(status)

    def _show_plan(self, path: Points) -> None:
        header = Header(Time.at(self._now), "map")
        poses = [PoseStamped(header, pose.to_msg()) for pose in _directed(path)]
        self._bus.publish("/plan", Path(header, poses))


def _directed(path: Points) -> list[Pose2]:
    """The points of a path as poses that look along it."""
    if len(path) < 2:
        return []
    steps = np.diff(path, axis=0)
    yaws = np.arctan2(steps[:, 1], steps[:, 0])
    yaws = np.append(yaws, yaws[-1])
    return [Pose2(float(x), float(y), float(yaw)) for (x, y), yaw in zip(path, yaws, strict=True)]


def _side(bearing: float) -> str:
    if math.isnan(bearing):
        return "somewhere"
    if abs(bearing) < 0.5:
        return "ahead"
    if abs(bearing) > 2.6:
        return "behind"
    return "on the left" if bearing > 0 else "on the right"
