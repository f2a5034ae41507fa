"""The robot's own mind as a whole: its messages in, orders out while there is a task."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from bridge.core.codes import Code
from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.nav_msgs import OccupancyGrid, Odometry
from bridge.msgs.pilothouse_msgs import (
    Bumper,
    FlightState,
    Following,
    Mission,
    RobotInfo,
    SonarRing,
    TagRead,
    TaskStatus,
)
from bridge.msgs.sensor_msgs import BatteryState, CompressedImage, LaserScan
from robotside.autonomy.battery_watch import BatteryWatch
from robotside.autonomy.contact_watch import ContactWatch
from robotside.autonomy.ground_sight import GroundSight
from robotside.autonomy.intruder_response import IntruderResponse
from robotside.autonomy.map_intake import MapIntake
from robotside.autonomy.mooring import Mooring
from robotside.autonomy.plan_publisher import PlanPublisher
from robotside.autonomy.sensor_silence import SensorSilence
from robotside.autonomy.surroundings import Surroundings
from robotside.core.bus import Bus, Publish
from robotside.core.config import DEFAULT_CONFIG, ChargingSettings
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.core.robot import Robot
from robotside.core.topic_demand import Demand
from robotside.core.worker import InLoopWorker, Worker
from robotside.localisation.odometry_track import OdometryTrack
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Navigator
from robotside.perception.intruder_watch import IntruderWatch
from robotside.records import Records
from robotside.records.events import Events
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.patrol import patrol_route
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.engine import Engine
from robotside.tasks.task_factory import TaskFactory
from robotside.tasks.task_status_publisher import TaskStatusPublisher

__all__ = ["Autonomy"]


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
        charging: ChargingSettings = DEFAULT_CONFIG.charging,
        clearance: float | None = None,
        worker: Worker | None = None,
        looker: Worker | None = None,
    ) -> None:
        """`chart` is the map, None or of no use while there is none; `clock` is the operators' [s], which stamps the task's messages.

        `fault` tells why the robot cannot or may not stand at a place that is called so, empty when it can.
        `fit` makes of the map the one to plan on, with all occupied where the robot may not go.
        `heights` are the lowest and the highest at which it can and may be, `clearance` what it keeps on its ways, None for its kind's [m].
        `worker` looks for ways and makes maps ready, `looker` searches pictures, and the map for where the robot is; without them it is done in the steps of the loop.
        """
        worker = worker or InLoopWorker()
        info, say = robot.info, events.say
        self._bus, self._say, self._demand = bus, say, demand
        self._now, self._silence = 0.0, SensorSilence(info.kind)
        plan = PlanPublisher(bus.publish, lambda: self._now)
        self.pose_estimator = self._estimator(info, looker)
        self.navigator = Navigator(robot, Grid.unknown(), plan.show, worker, clearance)
        self.navigator.heights = heights
        self._maps = self._map_intake(fit, worker, chart)
        self.situation, self._wheels = Situation(), OdometryTrack()
        self._ground = GroundSight(info.cameras, self.situation, self._wheels, demand)
        self.status_publisher = TaskStatusPublisher(records, partial(bus.publish, "/task/status"), clock)
        """Publishes how the task is."""
        self.engine = self._engine(clock)
        self.task_factory = TaskFactory(
            self.navigator,
            self.situation,
            info,
            say=say,
            rng=rng,
            records=records,
            fault=fault,
            heights=heights,
        )
        """Makes tasks of orders."""
        response = IntruderResponse(self.engine, self.situation, records, events)
        self.watch = _watch(self.pose_estimator, info, bus.publish, response, looker)
        self._surroundings = Surroundings(info, self.pose_estimator, self.navigator, self.watch)
        self.battery_watch = BatteryWatch(
            self.engine, self.task_factory, self.situation, say, settings=charging, odometer=self._driven
        )
        """Watches the charge."""
        self._mooring = Mooring(info.kind, records.places.all, self.pose_estimator)
        self._contacts = ContactWatch(self.engine, self.pose_estimator, self.situation, say, kind=info.kind)
        plan.show(np.empty((0, 2)))
        self._handlers = self._make_handlers()

    def _estimator(self, info: RobotInfo, looker: Worker | None) -> PoseEstimator:
        made = PoseEstimator(info, self._say, self._bus.publish, looker)
        made.on_found = lambda _: self._forget()
        return made

    def _map_intake(
        self, fit: Callable[[Grid], Grid], worker: Worker, chart: OccupancyGrid | None
    ) -> MapIntake:
        made = MapIntake(self.pose_estimator, self.navigator, fit, self._say, worker)
        if chart is not None:
            made.use(chart)
        return made

    def _driven(self) -> float:
        return self.pose_estimator.odometer

    def _engine(self, clock: Callable[[], float]) -> Engine:
        return Engine(
            self.navigator,
            self.situation,
            show=self._show_status,
            progress=lambda progress: self._bus.publish("/task/progress", progress),
            say=self._say,
            clock=clock,
            cruise=self.navigator.cruise,
        )

    def _make_handlers(self) -> dict[str, Callable[[Any], None]]:
        """What is done with each topic's messages."""
        return {
            "/map": self._maps.on_map,
            "/odom": self._on_odometry,
            "/scan": self._on_scan,
            "/sonar": self._on_sonar,
            "/flight": self._on_flight,
            "/fix": self.pose_estimator.on_fix,
            "/imu/data": self.pose_estimator.on_imu,
            "/depth": self.pose_estimator.vertical.on_depth,
            "/range/down": self.pose_estimator.vertical.on_range,
            "/battery_state": self._on_battery,
            "/bumper": self._on_bumper,
            "/tag": self._on_tag,
            "/following": self._on_following,
            CAMERA: self._on_image,
        }

    def on_message(self, topic: str, msg: Msg, now: float) -> None:
        """Take in one message of the robot, at `now` [s, robot clock]."""
        self._now = now
        if topic in self._handlers:
            self._handlers[topic](msg)
        self._ground.on_message(topic, msg)

    def update(self, now: float) -> None:
        """Pause the running task when a sensor is silent, take a new map between two tasks, and what pictures showed; call it each tick."""
        self.watch.update(placing=self.pose_estimator.sure)
        self._ground.update()
        if not self.engine.active:
            self._maps.update()
        if not self.engine.running:
            return
        silence = self.silence(now)
        if silence:
            self.engine.pause(Notice(Code.TASK_SENSOR_SILENT, f"Paused: {silence}."), "alarm")

    @property
    def has_map(self) -> bool:
        """There is a map to localise and plan on."""
        return self._maps.has_map

    @property
    def battery(self) -> float:
        """Charge, 0 empty to 1 full; NaN while unknown."""
        return self.battery_watch.charge

    @property
    def low(self) -> bool:
        """There is charge only for the way to where there is more."""
        return self.battery_watch.is_low

    def silence(self, now: float) -> str:
        """The needed sensor that is silent, as in `the laser has been silent for 0.6 s`; empty when none is."""
        return self._silence.sentence(now)

    def skip(self, seconds: float) -> None:
        """The robot's clock jumped by `seconds` [s]: that nothing was heard or done meanwhile means nothing."""
        self._silence.skip(seconds)
        self.battery_watch.skip(seconds)
        self.engine.skip(seconds)

    def is_measured(self, now: float, since: float = -math.inf) -> bool:
        """The speed is known: odometry came lately, and after `since` [s]."""
        return self._silence.is_measured(now, since)

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

    def place(self, pose: Pose2, *, certain: bool = False) -> None:
        """An operator says where the robot is; what was seen and planned from the wrong place is forgotten.

        `certain` when it was one of the robot's own candidates.
        """
        self.pose_estimator.place(pose, certain=certain)
        self._forget()

    def _forget(self) -> None:
        """The robot is elsewhere than it believed."""
        if self.engine.running:
            self.navigator.rest()
        self.navigator.obstacles.forget()
        self._surroundings.forget()
        self.watch.forget()

    def _on_odometry(self, msg: Odometry) -> None:
        if not math.isfinite(sum(Pose2.from_msg(msg.pose.pose))):
            return  # as good as none: one pose that is no number would spoil all later ones
        self._silence.on_measurement("/odom", self._now)
        estimator = self.pose_estimator
        estimator.on_odometry(msg)
        self.situation.odom = Pose2.from_msg(msg.pose.pose)
        self.situation.moving = _moving(msg)
        self._wheels.add(msg.header.stamp.seconds, self.situation.odom)
        self.navigator.measured(estimator.vertical.height)
        pose = estimator.pose
        if pose is None:
            return
        self.navigator.sure = self.situation.sure = estimator.sure
        self.situation.by_word = estimator.by_word
        self.situation.place_asked = len(estimator.candidates) > 1
        if estimator.pushes and self.engine.running and not self.situation.touches:
            said = "Paused: the wheels turn, but something holds the robot."
            self.engine.pause(Notice(Code.TASK_HELD_FAST, said), "alarm")
        points = self._surroundings.points(pose, moved=self.engine.running)
        self.battery_watch.update(self._now)
        self.engine.tick(pose, points, estimator.odometer, self._now)

    def _on_scan(self, scan: LaserScan) -> None:
        self._silence.on_measurement("/scan", self._now)
        self.situation.swept = self._wheels.at(scan.header.stamp.seconds) or self.situation.odom
        self.situation.scan = scan
        self._surroundings.on_scan(scan, self._now, mapping=self.engine.active)

    def _on_sonar(self, ring: SonarRing) -> None:
        self._silence.on_measurement("/sonar", self._now)
        if not self._silence.has("/scan"):
            self._surroundings.on_sonar(ring, self._now, mapping=self.engine.active)

    def _on_image(self, image: CompressedImage) -> None:
        """Pictures come while a task runs and while a client wants them: who drives by hand sees detections too."""
        self.situation.picture, self.situation.picture_stamp = image.data, image.header.stamp.seconds
        self.situation.pictured = self._wheels.at(image.header.stamp.seconds) or self.situation.odom
        self.situation.ahead = self._ground.ahead(image, self.situation.pictured, self.navigator.height)
        self.watch.on_image(image, placing=self.pose_estimator.sure)

    def _on_battery(self, msg: BatteryState) -> None:
        self.battery_watch.on_battery(msg, self._now)
        self._mooring.update(charging=self.situation.charging)

    def _on_bumper(self, msg: Bumper) -> None:
        self._contacts.on_bumper(msg, self._now)

    def _on_flight(self, msg: FlightState) -> None:
        self.situation.flight = msg.phase
        self.navigator.flies(msg.phase)

    def _on_tag(self, msg: TagRead) -> None:
        if msg.tag:
            self.situation.tag = msg.tag

    def _on_following(self, msg: Following) -> None:
        self.situation.follows, self.situation.follows_heard = msg.present, self._now

    def _show_status(self, status: TaskStatus) -> None:
        self._demand.set(CAMERA, "task", status.state == "RUNNING")
        self.status_publisher.show(status)


def _moving(msg: Odometry) -> Pose2:
    """The speeds that odometry tells; 0 for one that is no number."""
    along, turning = msg.twist.twist.linear, msg.twist.twist.angular
    return Pose2(*(part if math.isfinite(part) else 0.0 for part in (along.x, along.y, turning.z)))


def _watch(
    estimator: PoseEstimator,
    info: RobotInfo,
    publish: Publish,
    response: IntruderResponse,
    looker: Worker | None,
) -> IntruderWatch:
    return IntruderWatch(
        estimator.track,
        info.camera_fov,
        publish,
        response.on_intruder,
        worker=looker,
        counts=response.counted,
    )
