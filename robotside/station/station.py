"""The robot side as a whole, without sockets: commands in, robot's messages through, everything on one bus.

Two clocks: `now` is the robot's [s], by which things are measured and tasks run; `clock` is the operators' [s], by
which drive commands and control expire and by which everything that is told to operators is stamped. docs/bridge.md
says which stamp is of which clock.
"""

from __future__ import annotations

import logging
import math
import random
from collections.abc import Callable, Iterable
from datetime import UTC, tzinfo
from functools import partial

from msgspec.structs import replace

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, Twist
from bridge.msgs.nav_msgs import OccupancyGrid
from bridge.msgs.pilothouse_msgs import (
    ControlStatus,
    Event,
    IntruderArray,
    Manoeuvre,
    Mission,
    TaskOrder,
)
from bridge.msgs.std_msgs import Header, Time
from robotside.control.command_gate import Controls
from robotside.control.guarded_robot import Guarded, port_info
from robotside.control.safe_state import SafeState
from robotside.control.stop_consequences import still_moves
from robotside.control.stop_latch import Latch
from robotside.control.teleop import FOLLOW_LINK, LOST_LINK_STOPS_TASK, Helm, Options
from robotside.core.bus import Bus
from robotside.core.config import DEFAULT_CONFIG, Config
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.core.refusal import Refusal
from robotside.core.robot import Robot
from robotside.core.topic_demand import Demand
from robotside.kinds.registry import described, kind_of, unknown
from robotside.limits.limits import LimitKeeper
from robotside.motion.manoeuvres import Order
from robotside.motion.measured import MeasuredState
from robotside.records import Records
from robotside.records.events import Events
from robotside.records.records_publisher import RecordsPublisher
from robotside.tasks.agenda import Agenda
from robotside.tasks.autonomy import Autonomy
from robotside.tasks.interrupted_task import InterruptedTask
from robotside.tasks.readiness import Readiness
from robotside.tasks.task_factory import tasks_of
from robotside.tasks.task_history import TaskHistory

__all__ = ["NO_MAP", "Station"]

log = logging.getLogger(__name__)

NO_MAP = Notice(Code.MAP_MISSING, "There is no map of where the robot is: it can be driven by hand only.")

REMARK_PERIOD = 3.0
"""Bad drive commands of a client, and faults of the program, are told at most this often [s]."""


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
    ) -> None:
        """`now` is the robot's clock at the start [s]; `name` goes before that of `config`.

        `civil` is what the computer's clock says, by which the schedule goes in `zone` [s]; the operators' when left out.
        """
        self.clock, self.now = clock, now
        self._control, self._trouble, self._unheard = ControlStatus(), "", ""
        self._held = self._ending = False
        self._next_diagnostics = self._next_fault = -math.inf
        self._turned = -math.inf
        """When trouble began or ended last [s]: what was measured before says nothing of the time since."""
        self.keeper = LimitKeeper(config.limits, port_info(robot))
        """Keeps the robot to its limits."""
        self.info = replace(
            described(self.keeper.info),
            name=name or config.robot.name or robot.info.name,
            tasks=tasks_of(self.keeper.info),
        )
        self.bus = Bus()
        self.demand = Demand(robot.want)
        self.options = Options(config.control, records.setting, records.set_setting)
        """What operators may switch."""
        self.controls = self._controls(config)
        self.robot = Guarded(robot, lambda: self.controls.stopped, self._clamp, self.keeper.info)
        """The only way to the robot's wheels."""
        self.records = records
        """What it keeps while it is switched off."""
        self.events = Events(records.events, clock, lambda event: self.bus.publish("/events", event))
        self.readiness = Readiness(clock, self.bus.publish, robot.info.kind)
        """What is looked through before the first motion."""
        self._next_remark: dict[str, float] = {}
        first = list(robot.read(now))
        self.autonomy = self._autonomy(first, rng)
        """What it does by itself."""
        self.helm = self._helm(config)
        """Driving by hand, and what happens when nobody does."""
        self._show_beginning()
        RecordsPublisher(records, self.bus.publish, self.events.say, clock)
        self.interrupted = self._take_up()
        """The task that a restart cut, if there was one."""
        self.agenda = self._agenda(civil or clock, zone)
        """Queue and schedule."""
        self._pass_on(first)
        self.show_control()

    def step(self, now: float) -> None:
        """Bring everything up to `now` [s, robot clock]; call it often."""
        self.now = now
        self._mind(partial(self.helm.step, now))
        self._pass_on(self.robot.read(now))
        self._mind_trouble()
        self.autonomy.status_publisher.update()
        self._mind(lambda: self.autonomy.check(now))
        if not self._ending:
            self._mind(lambda: self.agenda.step(now))
        self.show_control()
        if now >= self._next_diagnostics:
            self._next_diagnostics = now + 1.0
            self.bus.publish("/diagnostics", self._diagnostics())
            self.readiness.update(self.autonomy, self.robot.trouble, now)

    def hear(self, client: Operator, topic: str, msg: Msg, stamp: float | None) -> None:
        """A client published `msg`, that is not an order: those are `robotside.services.stop_services`'.

        `stamp` is when it meant it [s, operators' clock], None when it does not say.
        """
        if stamp is not None:
            self.readiness.on_operator_time(stamp)
        if isinstance(msg, Manoeuvre) and stamp is None and msg.header.stamp.seconds > 0:
            stamp = msg.header.stamp.seconds
        if isinstance(msg, Twist | Manoeuvre):
            self._mind(lambda: self._remark(client, self.helm.drive(client, msg, stamp)))
        elif isinstance(msg, PoseWithCovarianceStamped):
            self._place(client, Pose2.from_msg(msg.pose.pose))
        self.show_control()

    def gone(self, client: Operator) -> None:
        """A client's socket closed; if it was driving, the robot stops at once."""
        self._next_remark.pop(client.id, None)
        self._mind(partial(self.helm.gone, client, self.now))
        self.show_control()

    def press_stop(self, name: str, client_id: str = "", given: float = math.inf) -> None:
        """Latch STOP, as `Controls.stop` says, bring the robot to rest and hold the task; it was `given` now at the latest."""
        fresh = not self.controls.stopped
        self.controls.stop(name, client_id, min(given, self.clock()))  # before all that may fail
        self._unheard = ""
        self._press(self.robot.stop if self._ending else self.robot.press_stop)
        if fresh:
            pressed = Notice(Code.STOP_PRESSED, f"STOP pressed by {name}.", actor_id=client_id, name=name)
            self.events.say("stop", pressed, "alarm")
        self.readiness.stop_pressed()
        held = Notice(Code.TASK_STOPPED, f"Stopped by {name}.", actor_id=client_id, name=name)
        self._press(lambda: self.autonomy.engine.pause(held, "alarm"))
        self._note()
        moves = still_moves(self.info.name, self.info.kind, self._measured())
        if fresh and moves and not self._ending:
            self.events.say("control", moves, "alarm")

    def _press(self, act: Callable[[], None]) -> None:
        try:
            act()
        except Exception as fault:
            log.exception("The robot's port failed at STOP")
            self._unheard = f"The robot's port failed: {fault!r}."

    def release_stop(self, name: str, client_id: str = "") -> None:
        """Unlatch STOP, as `name` of that `client_id` says; the robot stays where it is."""
        self.controls.release_stop()
        self.robot.release_stop()
        released = Notice(Code.STOP_RELEASED, f"STOP released by {name}.", actor_id=client_id, name=name)
        self.events.say("stop", released, "ok")

    def keep(self, mission: Mission) -> None:
        """Store `mission`; everyone is told once it is on the disk. NotRecorded when it cannot be kept."""
        count = len(mission.waypoints)
        said = f"Mission stored: {count} {'point' if count == 1 else 'points'}."

        def then() -> None:
            self.events.say("mission", Notice(Code.MISSION_STORED, said, count=count), "ok")
            self.autonomy.edit_patrol(mission)

        self.records.missions.set(mission, then)

    def show_control(self) -> None:
        """Tell everyone who steers, if that has changed, and note what a restart must know."""
        self._note()
        fresh = self._control_now()
        if fresh == self._control:
            return
        if fresh.driver_id != self._control.driver_id:
            self.events.say("control", _who_has_control(fresh))
        self._control = fresh
        self.bus.publish("/control/status", replace(fresh, stamp=Time.at(self.clock())))

    @property
    def mission(self) -> Mission:
        """The stored mission."""
        return self.records.missions.current

    @property
    def mapless(self) -> Problem:
        """Why the robot cannot be placed on a map, as one sentence; empty when it can."""
        return self.robot.trouble or ("" if self.autonomy.has_map else NO_MAP)

    @property
    def unfit(self) -> Problem:
        """Why the robot can do nothing by itself whatever is asked, as one sentence; empty when it can."""
        silence = self.autonomy.silence(self.now)
        if self.mapless or not silence:
            return self.mapless
        return Notice(Code.SENSORS_SILENT, f"It can be driven by hand only: {silence}.")

    @property
    def lost(self) -> Problem:
        """Why the robot cannot set out from where it is, as one sentence; empty when it can."""
        pose = self.autonomy.pose_estimator.pose
        if pose is None:
            said = "The robot does not know yet where it is; place it on the map."
            return Notice(Code.POSITION_UNKNOWN, said)
        return self.keeper.outside(pose)

    def fault(self, name: str, x: float, y: float) -> Problem:
        """Why the robot cannot or may not stand at a place, as one sentence that calls it `name`; empty when it can."""
        return self.keeper.fault(name, x, y) or self.autonomy.navigator.planner.fault(name, x, y)

    @property
    def at_rest(self) -> bool:
        """The wheels stand still, as measured lately; False while nobody knows."""
        return self._at_rest()

    @property
    def done(self) -> bool:
        """The robot stands, and everybody was told what became of the task."""
        return self.at_rest and self.autonomy.status_publisher.all_told

    @property
    def stop_doubt(self) -> str:
        """Why a STOP that is pressed may not have reached the robot, as one sentence; empty when it has."""
        return "" if self.at_rest else self._unheard or self.robot.trouble

    @property
    def stop_unkept(self) -> str:
        """Why a STOP that is pressed would be gone after a restart, as one sentence; empty when it would not."""
        return self._latch.doubt

    def end(self) -> None:
        """Brake, end the task and obey nobody any more: the robot side is about to go."""
        said = "The robot's computer was told to end."
        self.autonomy.engine.cancel(Notice(Code.TASK_ROBOT_ENDS, said))
        self._note()
        self._ending = True
        self.press_stop("the robot's computer, which ends")
        self.show_control()

    def close(self) -> None:
        """Bring the robot to rest and let go of it."""
        self.robot.stop()
        self.robot.close()

    def _take_up(self) -> InterruptedTask | None:
        """Go on from how it was left: STOP stays pressed, a task that was cut is offered."""
        self._latch = Latch(self.records, self.events.say)
        by, cut, engine = self.records.stopped_by, self.records.runs.under_way, self.autonomy.engine
        if by:
            self.controls.stop(by)
            self.robot.press_stop()
            said = f"STOP, pressed by {by} before the restart, is still pressed."
            self.events.say("stop", Notice(Code.STOP_STILL_PRESSED, said, name=by), "alarm")
        engine.recall(self.records.runs.last, self.records.runs.newest)
        history = TaskHistory(self.records.runs, engine, self.clock)
        self.bus.subscribe("/task/progress", history.on_message)
        self.autonomy.status_publisher.note = history.note
        return InterruptedTask(cut, engine) if cut else None

    def _show_beginning(self) -> None:
        """What there is to tell before anything has happened."""
        self.bus.publish("/robot/info", self.info)
        self.bus.publish("/limits", self.keeper.message)
        self.bus.publish("/intruders", IntruderArray(Header(Time.at(self.now), "map")))
        self.bus.publish("/control/status", self._control)
        if said := unknown(self.info.kind):
            kind_unknown = Notice(Code.ROBOT_KIND_UNKNOWN, said, kind=self.info.kind)
            self.events.say("robot", kind_unknown, "warn")

    def _agenda(self, civil: Callable[[], float], zone: tzinfo) -> Agenda:
        return Agenda(
            self.records,
            self.autonomy.engine,
            self.autonomy.task_factory,
            publish=self.bus.publish,
            say=self.events.say,
            clock=self.clock,
            civil=civil,
            zone=zone,
            barred=self._barred,
        )

    def _barred(self, drains: bool) -> str:
        """Why no task may start by itself just now, one that needs charge or not; empty when it may."""
        if self.controls.stopped:
            return "STOP is pressed"
        if self.controls.driving:
            return "the robot is driven by hand"
        if drains and self.autonomy.low:
            return f"the battery is at {self.autonomy.battery:.0%}"
        return self.unfit or self.lost

    def _note(self) -> None:
        """Note whether STOP is pressed; its own STOP at the end is not a person's."""
        if not self._ending:
            self._latch.note(self.controls.stopped_by)

    def _pass_on(self, messages: Iterable[tuple[str, Msg]]) -> None:
        for topic, msg in messages:
            if isinstance(msg, Event):
                self.events.say(msg.kind, Notice.of(msg.text, msg), msg.level)
                continue
            self.bus.publish(topic, msg)
            self.readiness.sensor_health.on_message(topic, msg, self.now)
            self._mind(partial(self.autonomy.take, topic, msg, self.now))
            if topic == "/odom":
                self._mind(self.robot.again)
                self._mind(self._mind_drift)

    def _mind_trouble(self) -> None:
        """Hold everything while the robot cannot be reached; on its return nothing moves until somebody says so."""
        trouble = self.robot.trouble
        if bool(trouble) != bool(self._trouble):
            said = trouble or Notice(Code.ROBOT_BACK, "The robot can be driven again; it stands still.")
            self.events.say("robot", said, "alarm" if trouble else "ok")
            self._turned = self.now
        self._trouble = trouble
        if trouble:
            self.controls.halt()
            paused = f"Paused: {trouble[0].lower()}{trouble[1:]}"
            self.autonomy.engine.pause(Notice(Code.TASK_ROBOT_LOST, paused), "alarm")

    def _mind(self, think: Callable[[], None]) -> None:
        """Let the robot's mind do something; a fault in it ends the task at rest, and driving by hand goes on."""
        try:
            think()
        except Exception as fault:
            if self.autonomy.engine.active:
                self.robot.stop()
            if self.now >= self._next_fault:
                self._next_fault = self.now + REMARK_PERIOD
                log.exception("The robot's own mind failed")
                told = f"The robot's program has a fault: {fault!r}."
                self.events.say("task", Notice(Code.ROBOT_FAULT, told, fault=type(fault).__name__), "alarm")
            said = f"The task ended: the robot's program has a fault ({type(fault).__name__})."
            self.autonomy.engine.fail(Notice(Code.TASK_FAULT, said, fault=type(fault).__name__))

    def _place(self, client: Operator, pose: Pose2) -> None:
        problem = self.controls.acquire(client, self.clock())  # tasks and the fence go by where it is
        if not all(map(math.isfinite, pose)):
            said = "The pose to place the robot at is not all numbers."
            problem = Notice(Code.POSITION_INVALID, said)
        problem = problem or self.mapless
        problem = problem or self.autonomy.navigator.planner.off_map("The place", pose.x, pose.y)
        if problem:
            self.events.say("command", problem, "warn")
            return
        self.autonomy.place(pose)
        name, who = self.controls.name(client), self.controls.id(client)
        text = f"{name} placed the robot at ({pose.x:.1f}, {pose.y:.1f})."
        placed = Notice(Code.POSITION_PLACED, text, actor_id=who, name=name, x=pose.x, y=pose.y)
        self.events.say("localisation", placed, at=(pose.x, pose.y))

    def _clamp(self, order: Order) -> Order:
        measured = self._measured()
        done, why = self.keeper.keep(order, measured)
        now = self.clock()
        if why and not self._held and now >= self._next_remark.get("limits", -math.inf):
            self._next_remark["limits"] = now + REMARK_PERIOD
            self.events.say("command", why, "warn")
        self._held = bool(why)
        return done

    def _measured(self) -> MeasuredState:
        where = self.autonomy.pose_estimator
        return self.readiness.sensor_health.measured(where.pose, spread=where.spread, sure=where.sure)

    def _mind_drift(self) -> None:
        said = self.keeper.adrift(self._measured())
        if said:
            self.events.say("command", said, "warn")

    def _remark(self, client: Operator, said: Problem) -> None:
        now = self.clock()
        if said and now >= self._next_remark.get(client.id, -math.inf):
            self._next_remark[client.id] = now + REMARK_PERIOD
            self.events.say("command", said, "warn")

    def _control_now(self) -> ControlStatus:
        driver, asker, at_rest = self.controls.driver, self.controls.asker, self._at_rest()
        if at_rest:
            self.readiness.rests(stopped=self.controls.stopped)
        return ControlStatus(
            mode=self._mode(),
            driver=driver.name if driver else "",
            driver_id=driver.client_id if driver else "",
            stopped=self.controls.stopped,
            stopped_by=self.controls.stopped_by,
            stopped_by_id=self.controls.stopped_by_id,
            at_rest=at_rest,
            stop_tested=self.readiness.stop_tested,
            requested_by=asker.name if asker else "",
            requested_by_id=asker.client_id if asker else "",
            handover=Time.at(asker.due) if asker else Time(),
            speed_cap=self.controls.pace.shown,
            follows_link=self.controls.follows,
            lost_link_stops_task=self.options.on(LOST_LINK_STOPS_TASK),
        )

    def _controls(self, config: Config) -> Controls:
        follows = partial(self.options.on, FOLLOW_LINK)
        return Controls(self.info, follows=follows, unmeasured_share=config.control.unmeasured_link_speed)

    def _autonomy(self, first: Iterable[tuple[str, Msg]], rng: random.Random) -> Autonomy:
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
        )

    def _helm(self, config: Config) -> Helm:
        return Helm(
            self.controls,
            self.robot,
            self.autonomy.engine,
            SafeState(self.info.kind, config.safe_state, self.info.manoeuvres),
            self.options,
            say=self.events.say,
            clock=self.clock,
            measured=self._measured,
            go_home=self._return,
        )

    def _return(self) -> bool:
        """Go home though nobody says so; False when it cannot."""
        if self._barred(True):
            return False
        try:
            task = self.autonomy.task_factory.task(TaskOrder(task="go_home"))
        except Refusal:
            return False
        self.controls.hold()
        self.agenda.hold("nobody drives the robot")
        self.autonomy.engine.start(task, self.now)
        return True

    def _mode(self) -> str:
        engine = self.autonomy.engine
        if self.controls.stopped:
            return "STOPPED"
        return "PAUSED" if engine.paused else "AUTO" if engine.running else "MANUAL"

    def _at_rest(self) -> bool:
        factor = 3.0 if self._control.at_rest else 1.0  # so that it does not change all the time
        where = self.autonomy.pose_estimator
        if not self.autonomy.measured(self.now, since=self._turned):
            return False
        if self.robot.trouble and not self._trouble:
            return False  # it began just now
        speed, turn = kind_of(self.info.kind).at_rest
        return abs(where.speed) < speed * factor and abs(where.turn) < turn * factor

    def _diagnostics(self) -> DiagnosticArray:
        where, low = self.autonomy.pose_estimator, self.autonomy.low
        status = [
            DiagnosticStatus(0 if where.sure else 1, "position", _fit_sentence(where.fit)),
            DiagnosticStatus(1 if low else 0, "battery", "low" if low else "good"),
            DiagnosticStatus(0, "drive commands", f"{self.controls.dropped} dropped since the start"),
        ]
        return DiagnosticArray(Header(Time.at(self.now)), status)


def _who_has_control(status: ControlStatus) -> Notice:
    if not status.driver_id:
        return Notice(Code.CONTROL_FREE, "Control is free.")
    said, who = f"{status.driver} has control.", status.driver_id
    return Notice(Code.CONTROL_TAKEN, said, actor_id=who, name=status.driver)


def _fit_sentence(fit: float) -> str:
    return "not known yet" if math.isnan(fit) else f"{fit:.0%} of what the laser sees is on the map"
