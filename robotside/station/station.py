"""The robot side as a whole, without sockets: commands in, robot's messages through, everything on one bus.

Two clocks: `now` is the robot's [s], by which things are measured and tasks run; `clock` is the operators' [s], by
which drive commands and control expire and by which everything that goes to operators is stamped. docs/bridge.md
says which stamp is of which clock.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable
from datetime import UTC, tzinfo
from functools import partial

from msgspec.structs import replace

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, Twist
from bridge.msgs.nav_msgs import OccupancyGrid
from bridge.msgs.pilothouse_msgs import Event, IntruderArray, Manoeuvre, PlaceCandidates, RobotInfo
from bridge.msgs.std_msgs import Header, Time
from robotside.autonomy.autonomy import Autonomy
from robotside.autonomy.readiness import Readiness
from robotside.control.command_gate import CommandGate
from robotside.control.guarded_robot import GuardedRobot, port_info
from robotside.control.safe_state import SafeState
from robotside.control.teleop import FOLLOW_LINK, Options, Teleop
from robotside.core.bus import Bus
from robotside.core.config import DEFAULT_CONFIG, Config
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.core.robot import Robot
from robotside.core.topic_demand import Demand
from robotside.core.worker import Worker
from robotside.kinds.registry import described, unknown
from robotside.limits.limits import LimitKeeper
from robotside.motion.measured import MeasuredState
from robotside.records import Records
from robotside.records.events import Events
from robotside.records.records_publisher import RecordsPublisher
from robotside.station.control_status import ControlStatusPublisher
from robotside.station.diagnostics import diagnostics
from robotside.station.fault_guard import FaultGuard
from robotside.station.fitness import Fitness
from robotside.station.home_return import HomeReturn
from robotside.station.limit_guard import LimitGuard
from robotside.station.loop_watch import LoopWatch
from robotside.station.mission_store import MissionStore
from robotside.station.placing import Placing
from robotside.station.port_watch import PortWatch
from robotside.station.recovery import recover_task
from robotside.station.remarks import Remarks
from robotside.station.rest_detector import RestDetector
from robotside.station.sensor_power import SensorPower
from robotside.station.stop_control import StopControl
from robotside.tasks.agenda import Agenda
from robotside.tasks.task_factory import tasks_of

__all__ = ["Station"]

DIAGNOSTICS_PERIOD = 1.0
"""Between two messages of `/diagnostics` [s], robot clock."""


class Station:
    """One robot, its mind, and who may command it. All calls come from one thread."""

    def __init__(
        self,
        robot: Robot,
        records: Records,
        *,
        now: float,
        clock: Callable[[], float],
        rng: random.Random,
        name: str = "",
        config: Config = DEFAULT_CONFIG,
        civil: Callable[[], float] | None = None,
        zone: tzinfo = UTC,
        worker: Worker | None = None,
        looker: Worker | None = None,
    ) -> None:
        """`now` is the robot's clock at the start [s]; `name` goes before that of `config`.

        `civil` is what the computer's clock says, by which the schedule goes in `zone` [s]; the operators' when left out.
        `worker` plans, `looker` searches pictures and maps; without them that is done in the steps, a bit in each. Who made them closes
        them.
        """
        self._worker, self._looker = worker, looker
        self.clock, self.now = clock, now
        self.records = records
        """What is kept over restarts."""
        self.bus = Bus()
        self.events = Events(records.events, clock, lambda event: self.bus.publish("/events", event))
        self.keeper = LimitKeeper(config.limits, port_info(robot))
        """The robot's limits."""
        self.info = _info(self.keeper.info, name or config.robot.name or robot.info.name)
        self._remarks = Remarks(self.events.say, clock)
        self._limits = LimitGuard(self.keeper, self._measured, self._remarks, self.events.say)
        self._make_controls(robot, config)
        self.sensors = SensorPower(robot, self.readiness.sensor_health.forget)
        """What of the robot is switched on."""
        self.demand = Demand(self.sensors.want)
        first = list(robot.read(now))
        self.autonomy = self._autonomy(first, rng, config)
        """What the robot does by itself."""
        self._make_guards(config)
        self._publish_first()
        RecordsPublisher(records, self.bus.publish, self.events.say, clock)
        self.stop.recover()
        self.interrupted = recover_task(records, self.autonomy, self.bus, clock)
        """The task that a restart cut, if there was one."""
        self.agenda = _agenda(self, civil or clock, zone)
        """Queue and schedule."""
        self._next_diagnostics = -math.inf
        self._ending = False
        self.take_in(first)
        self.publish_control()

    def step(self, now: float) -> None:
        """Bring everything up to `now` [s, robot clock]; call it often."""
        self.now = now
        self._guard.run(partial(self.teleop.step, now))
        self.take_in(self.robot.read(now))
        self._port.update(now)
        self.autonomy.status_publisher.update()
        self._guard.run(lambda: self.autonomy.update(now))
        if not self._ending:
            self._guard.run(lambda: self.agenda.step(now))
        self.publish_control()
        if now >= self._next_diagnostics:
            self._next_diagnostics = now + DIAGNOSTICS_PERIOD
            self.bus.publish("/diagnostics", diagnostics(self.autonomy, self.controls, self.loop, now))
            self.readiness.update(self.autonomy, self.robot.trouble, now)

    def on_message(self, client: Operator, topic: str, msg: Msg, stamp: float | None) -> Problem:
        """Do what `client` published, a drive command or a pose of the robot; why that is not done, empty when it is.

        `stamp` is when the client meant it [s, operators' clock], None when that is not known.
        """
        if stamp is not None:
            self.readiness.on_operator_time(stamp)
        if isinstance(msg, Manoeuvre) and stamp is None and msg.header.stamp.seconds > 0:
            stamp = msg.header.stamp.seconds
        problem: Problem = ""
        if isinstance(msg, Twist | Manoeuvre):
            tell = partial(self._remarks.make, client.id)
            problem = self._guard.run(lambda: tell(self.teleop.drive(client, msg, stamp)))
        elif isinstance(msg, PoseWithCovarianceStamped):
            problem = self.placing.place(client, Pose2.from_msg(msg.pose.pose))
        self.publish_control()
        return problem

    def on_gone(self, client: Operator) -> None:
        """A client left; if it was driving, the robot stops at once."""
        self._remarks.forget(client.id)
        self._guard.run(partial(self.teleop.on_gone, client, self.now))
        self.publish_control()

    def publish_control(self) -> None:
        """Publish who drives if that has changed, and keep what a restart must know."""
        self.stop.note()
        self._control_status.update()

    def fault(self, name: str, x: float, y: float) -> Problem:
        """Why the robot cannot or may not stand at a place, as one sentence that calls it `name`; empty when it can."""
        return self.keeper.fault(name, x, y) or self.autonomy.navigator.planner.fault(name, x, y)

    @property
    def at_rest(self) -> bool:
        """The wheels stand still, as measured lately; False while that is not known."""
        return self._rest.is_at_rest

    @property
    def done(self) -> bool:
        """The robot stands, and everything about the task is published."""
        return self.at_rest and self.autonomy.status_publisher.all_told

    def end(self) -> None:
        """Brake, end the task and obey no operator any more: the robot side is about to go."""
        said = "The robot's computer was asked to shut down."
        self.autonomy.engine.cancel(Notice(Code.TASK_ROBOT_ENDS, said))
        self._ending = True
        self.stop.end("the robot's computer, which ends")
        self.publish_control()

    def close(self) -> None:
        """Bring the robot to rest and let go of it."""
        self.robot.stop()
        self.robot.close()

    def _make_controls(self, robot: Robot, config: Config) -> None:
        """What judges commands, and the port behind it."""
        self.options = Options(config.control, self.records.setting, self.records.set_setting)
        """The settings that operators may switch."""
        self.controls = CommandGate(
            self.info,
            follows=partial(self.options.on, FOLLOW_LINK),
            unmeasured_share=config.control.unmeasured_link_speed,
        )
        self.robot = GuardedRobot(robot, lambda: self.controls.stopped, self._limits.clamp, self.keeper.info)
        """The only way to the robot's wheels."""
        self.readiness = Readiness(self.clock, self.bus.publish, robot.info.kind)
        """The checklist before the first motion."""

    def _make_guards(self, config: Config) -> None:
        """What holds the robot, and who drives it by hand."""
        engine, say, now = self.autonomy.engine, self.events.say, lambda: self.now
        self.fitness = Fitness(self.autonomy, self.controls, self.keeper, self._trouble, now)
        """Why the robot cannot move by itself."""
        home = HomeReturn(self.autonomy, self.controls, self.fitness, self._hold_queue, now)
        self.teleop = Teleop(
            self.controls,
            self.robot,
            engine,
            SafeState(self.info.kind, config.safe_state, self.info.manoeuvres),
            self.options,
            say=say,
            clock=self.clock,
            measured=self._measured,
            go_home=home.begin,
        )
        """Driving by hand, and the safe state when no one drives."""
        self.loop = LoopWatch(self.robot, self.autonomy, self.readiness.sensor_health, self._limits, say)
        """What follows from the timing of the loop."""
        self._guard = FaultGuard(engine, self.robot.stop, say, now)
        self._port = PortWatch(self._trouble, self.controls, engine, say)
        self._rest = RestDetector(self.info.kind, self.autonomy, self._port, now)
        self.missions = MissionStore(self.records, self.autonomy, say)
        """The stored mission."""
        self.placing = Placing(self.controls, self.autonomy, self.fitness, say, self.clock)
        """Where operators say that the robot is."""
        self.stop = StopControl(
            self.info,
            self.controls,
            self.robot,
            engine,
            self.records,
            self.readiness,
            say=say,
            clock=self.clock,
            measured=self._measured,
            is_at_rest=lambda: self._rest.is_at_rest,
        )
        """STOP."""

    def _publish_first(self) -> None:
        """Publish what there is before anything has happened."""
        self.bus.publish("/robot/info", self.info)
        self.bus.publish("/limits", self.keeper.message)
        self.bus.publish("/localisation/candidates", PlaceCandidates(Header(Time.at(self.now), "map")))
        self.bus.publish("/intruders", IntruderArray(Header(Time.at(self.now), "map")))
        self._control_status = ControlStatusPublisher(
            self.controls,
            self.autonomy.engine,
            self.options,
            self._rest,
            self.readiness,
            self.loop,
            publish=self.bus.publish,
            say=self.events.say,
            clock=self.clock,
        )
        if said := unknown(self.info.kind):
            kind_unknown = Notice(Code.ROBOT_KIND_UNKNOWN, said, kind=self.info.kind)
            self.events.say("robot", kind_unknown, "warn")

    def _autonomy(self, first: Iterable[tuple[str, Msg]], rng: random.Random, config: Config) -> Autonomy:
        return Autonomy(
            self.robot,
            next((msg for topic, msg in first if topic == "/map" and isinstance(msg, OccupancyGrid)), None),
            bus=self.bus,
            events=self.events,
            demand=self.demand,
            clock=self.clock,
            rng=rng,
            records=self.records,
            fault=self.fault,
            fit=self.keeper.marked,
            heights=self.keeper.heights(self.robot.heights),
            charging=config.charging,
            clearance=config.limits.clearance,
            worker=self._worker,
            looker=self._looker,
        )

    def take_in(self, messages: Iterable[tuple[str, Msg]]) -> None:
        """What the robot has measured, by topic."""
        for topic, msg in messages:
            if isinstance(msg, Event):
                self.events.say(msg.kind, Notice.of(msg.text, msg), msg.level)
                continue
            self.bus.publish(topic, msg)
            self.readiness.sensor_health.on_message(topic, msg, self.now)
            self._guard.run(partial(self.autonomy.on_message, topic, msg, self.now))
            if topic == "/odom":
                self._guard.run(self.robot.again)
                self._guard.run(self._limits.report_drift)

    def _measured(self) -> MeasuredState:
        where = self.autonomy.pose_estimator
        up = where.vertical
        return self.readiness.sensor_health.measured(
            where.pose, spread=where.spread, sure=where.sure, height=up.height, height_spread=up.spread
        )

    def _hold_queue(self, why: str) -> None:
        self.agenda.hold(why)  # which is made later

    def _trouble(self) -> Problem:
        return self.robot.trouble


def _agenda(station: Station, civil: Callable[[], float], zone: tzinfo) -> Agenda:
    return Agenda(
        station.records,
        station.autonomy.engine,
        station.autonomy.task_factory,
        publish=station.bus.publish,
        say=station.events.say,
        clock=station.clock,
        civil=civil,
        zone=zone,
        barred=station.fitness.barred,
        charge=station.autonomy.battery_watch.charge_order,
    )


def _info(info: RobotInfo, name: str) -> RobotInfo:
    """Who the robot is to operators, under that name."""
    return replace(described(info), name=name, tasks=tasks_of(info))
