"""The robot in a person's hands: what a driver's command does, and what happens when none comes any more."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

from bridge.core.codes import Code
from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.core.robot_catalogue import Operator
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.control.authority import NOT_ASKED, OBJECTION_TIME, Asker, Driver
from robotside.control.command_gate import CommandGate
from robotside.control.guarded_robot import GuardedRobot
from robotside.control.limit_violations import LimitViolations
from robotside.control.safe_state import Act, SafeState
from robotside.core.config import ControlSettings
from robotside.core.notice import Notice, Problem
from robotside.core.refusal import Refusal
from robotside.kinds.registry import kind_of
from robotside.limits.bumper_guard import CONTACT_TIME, kept_off
from robotside.limits.limits import turned_over
from robotside.motion.manoeuvres import STREAMED_KINDS, Order, settled
from robotside.motion.measured import MeasuredState
from robotside.records.events import Say

__all__ = ["FOLLOW_LINK", "LOST_LINK_STOPS_TASK", "Teleop", "Options"]

FOLLOW_LINK = "follow_link"
LOST_LINK_STOPS_TASK = "lost_link_stops_task"


class TaskRunner(Protocol):
    """What runs the robot's tasks, as much of it as driving by hand has to do with."""

    @property
    def running(self) -> bool:
        """A task is under way and moves the robot."""

    def pause(self, reason: Notice, level: str = "info") -> None:
        """Hold the running task where it is; `reason` is one sentence."""


class Options:
    """The settings that an operator may switch: those kept, else those of the configuration."""

    def __init__(
        self,
        settings: ControlSettings,
        kept: Callable[[str], str],
        keep: Callable[[str, str, Callable[[], object]], None],
    ) -> None:
        """`kept` gives what is kept under a name, empty for nothing; `keep` keeps it and calls what it is given then."""
        self._kept, self._keep = kept, keep
        self._usual = {
            FOLLOW_LINK: settings.follow_link,
            LOST_LINK_STOPS_TASK: settings.lost_link_stops_task,
        }

    def on(self, name: str) -> bool:
        """Whether it is on."""
        value = self._kept(name)
        return value == "on" if value else self._usual[name]

    def set(self, name: str, value: str, then: Callable[[], object]) -> None:
        """Switch one, and call `then` once that is kept; Refusal for what does not exist."""
        if name not in self._usual:
            said = f"There is no setting {name!r}; there are {', '.join(self._usual)}."
            raise Refusal(Notice(Code.SETTING_UNKNOWN, said, setting=name))
        if value not in ("on", "off"):
            said = f"{name} is on or off, not {value!r}."
            raise Refusal(Notice(Code.SETTING_VALUE_UNKNOWN, said, setting=name, value=value))
        self._keep(name, value, then)


class Teleop:
    """Hands the robot from its driver to its safe state and back; tasks drive it by themselves.

    `now` is always of the robot's clock [s], `stamp` of the operators'.
    """

    def __init__(
        self,
        controls: CommandGate,
        robot: GuardedRobot,
        engine: TaskRunner,
        safe: SafeState,
        options: Options,
        *,
        say: Say,
        clock: Callable[[], float],
        measured: Callable[[], MeasuredState],
        go_home: Callable[[], bool],
    ) -> None:
        """`clock` is the operators' [s]; `go_home` begins the way home, False when that cannot be."""
        self._controls, self._robot, self._engine = controls, robot, engine
        self._safe, self._options = safe, options
        self._say, self._clock = say, clock
        self._measured, self._go_home = measured, go_home
        self._violations = LimitViolations(robot.info, say, clock)
        self._ran = self._returned = False
        self._pushed = -math.inf
        self._done: Act | None = None

    def step(self, now: float) -> None:
        """Bring everything up to `now` [s, robot clock]."""
        clock, controls = self._clock(), self._controls
        if self._engine.running and turned_over(self._measured(), self._robot.info.kind):
            robot = self._robot.info.name
            over = Notice(Code.TASK_OVERTURNED, f"Paused: {robot} has turned over.", robot=robot)
            self._engine.pause(over, "alarm")
        lost = controls.update(clock)
        if lost:
            said, who = (
                f"{lost} lost control: no contact for {CONTROL_TIMEOUT:.0f} s.",
                controls.fell_id,
            )
            lapsed = Notice(Code.CONTROL_LAPSED, said, actor_id=who, name=lost, seconds=CONTROL_TIMEOUT)
            self._say("control", lapsed, "warn")
            self._lost(lost, who, now)
        controls.update_speed_cap(clock)
        if controls.expired(clock) and not self._engine.running:
            self.rest(now)
        self._keep_safe(now)

    def drive(self, client: Operator, order: Order, stamp: float | None) -> Problem:
        """Obey a drive command, a twist or a manoeuvre, or say why not; empty when there is nothing to say.

        `stamp` is when it was given [s, operators' clock], None when that is not known.
        """
        engine = self._engine
        fault = self._strange(order)
        if fault:
            self._controls.dropped += 1
            return fault
        trouble = self._robot.trouble or self._grounded(order)
        ruling = self._controls.drive(
            client, order, self._clock(), stamp=stamp, auto=engine.running, trouble=trouble
        )
        if ruling.order is None:
            return ruling.said
        self._safe.leave()
        name, client_id = self._controls.name(client), self._controls.id(client)
        said = f"Paused: {name} took the stick."
        engine.pause(Notice(Code.TASK_TAKEN_OVER, said, actor_id=client_id, name=name), "warn")
        self._violations.check(client.id, order)
        self._ran = self._returned = False
        self._robot.follow(self._kept_off(settled(ruling.order, self._robot.info)))
        return ""

    def _kept_off(self, order: Order) -> Order:
        """`order` without what pushes into a thing that is in touch, which is said when that begins."""
        left = kept_off(order, self._robot.info, self._measured())
        if left is order:
            return order
        before, self._pushed = self._pushed, self._clock()
        if self._pushed - before > CONTACT_TIME:
            said = "It touches something there: no stick pushes it on. Drive it away."
            self._say("control", Notice(Code.DRIVE_TOUCHES, said), "warn")
        return left

    def _grounded(self, order: Order) -> Problem:
        """Why `order` starts no rotors: that takes a task, which cannot be given by brushing against a stick; empty when it need not."""
        info, measured = self._robot.info, self._measured()
        twist = order if isinstance(order, Twist) else order.twist
        stands = measured.landed and not measured.overturned  # of that it is told why nothing moves it
        if not (kind_of(info.kind).flies and stands and twist.linear.z > 0):
            return ""
        said = f"{info.name} stands on the ground: The sticks cannot start the rotors. Slide to take off."
        return Notice(Code.DRIVE_ON_GROUND, said, robot=info.name)

    def _strange(self, order: Order) -> Problem:
        """Why this robot cannot be driven by such an order, as one sentence; empty when it can."""
        if not isinstance(order, Manoeuvre):
            return ""
        info = self._robot.info
        if order.kind not in STREAMED_KINDS:
            said = f"it is {', '.join(STREAMED_KINDS[:-1])} or {STREAMED_KINDS[-1]}, not {order.kind!r}"
            dropped = f"A drive command was dropped: {said}."
            return Notice(Code.DRIVE_KIND_UNKNOWN, dropped, kind=order.kind)
        lacks = {"steer": not info.max_steering, "tilt": not info.max_tilt}
        if lacks.get(order.kind) and order.kind not in info.manoeuvres:
            said = f"A drive command was dropped: {info.name} cannot {order.kind}."
            return Notice(Code.DRIVE_UNABLE, said, robot=info.name, kind=order.kind)
        return ""

    def put_back(self) -> None:
        """The robot was put elsewhere, at rest: what held or drove it is over, and a stick counts once it was let go."""
        self._controls.halt()
        self._safe.leave()
        self._ran = self._returned = False

    def rest(self, now: float) -> None:
        """No one drives any more: take the safe state, `now` [s, robot clock]."""
        self._enter(now)
        self._do(self._safe.step(now, self._measured(), lost=self._controls.driver is None))

    def on_gone(self, client: Operator, now: float) -> None:
        """A client's socket closed; if it was driving, the robot takes its safe state at once."""
        drove, name, who = (
            self._controls.drives(client),
            self._controls.name(client),
            self._controls.id(client),
        )
        held = self._controls.on_gone(client)
        self._violations.forget(client.id)
        if drove and not self._engine.running:
            self.rest(now)
        if held:
            self._lost(name, who, now)

    def release(self, client: Operator, now: float) -> Problem:
        """Give control back; returns why not, empty when done. A robot driven by hand takes its safe state."""
        problem = self._controls.release(client)
        self._handed(now)
        return problem

    def request(self, client: Operator) -> str:
        """Ask for control; the sentence of success, or Refusal."""
        controls = self._controls
        before = controls.asker
        problem = controls.request(client, self._clock())
        if problem:
            raise Refusal(problem)
        held, asker = controls.driver, controls.asker
        if asker is None or held is None or controls.holds(client):
            return "You have control."
        if asker is not before:
            self._say("control", _asks(asker, held), "warn")
        return f"{held.name} is asked; you have control in {max(0.0, asker.due - self._clock()):.0f} s unless {held.name} objects."

    def grant(self, client: Operator, now: float) -> str:
        """Hand control over to who asks; the sentence of success, or Refusal."""
        problem = self._controls.grant(client)
        if problem or self._controls.driver is None:
            raise Refusal(problem or NOT_ASKED)
        self._handed(now)
        return f"{self._controls.driver.name} has control."

    def object(self, client: Operator) -> str:
        """Keep control though somebody asks for it; the sentence of success, or Refusal."""
        asker = self._controls.asker
        problem = self._controls.object(client, self._clock())
        if problem or asker is None:
            raise Refusal(problem or NOT_ASKED)
        name, client_id = self._controls.name(client), self._controls.id(client)
        said, code = f"{name} objected: {asker.name} does not get control.", Code.CONTROL_OBJECTED
        self._say("control", Notice(code, said, actor_id=client_id, name=name, asker=asker.name))
        return f"You keep control; {asker.name} is notified."

    def _handed(self, now: float) -> None:
        """Control may have gone to somebody else, with whom the robot begins at rest."""
        if self._controls.expired(self._clock()) and not self._engine.running:
            self.rest(now)

    def _lost(self, name: str, client_id: str, now: float) -> None:
        """Who had control is not heard any more: a task goes on, unless it was told otherwise."""
        if self._options.on(LOST_LINK_STOPS_TASK):
            said = f"Paused: the link to {name} was lost."
            self._engine.pause(Notice(Code.TASK_LINK_LOST, said, actor_id=client_id, name=name), "warn")
        if not (self._engine.running or self._safe.brakes):
            self._enter(now)

    def _enter(self, now: float) -> None:
        if not self._safe.active:
            self._done = None
        self._safe.enter(now, self._measured())

    def _keep_safe(self, now: float) -> None:
        ran, self._ran = self._ran, self._engine.running
        if self._engine.running or self._controls.stopped or self._robot.trouble:
            self._safe.leave()
            return
        if ran and not self._controls.driving and not self._safe.brakes:
            self._enter(now)  # a task ended: who watched it may be gone
            if self._returned:
                self._safe.cannot_return()  # it has been home
        if self._safe.active:
            self._do(self._safe.step(now, self._measured(), lost=self._controls.driver is None))

    def _do(self, act: Act) -> None:
        before, self._done = self._done, act
        if act.home and not (before and before.home):
            self._returned = self._go_home()
            if self._returned:
                self._say("control", _nobody_drives("goes home"), "warn")
                return
            self._safe.cannot_return()
        if act.order is not None:
            if before is None or before.order is None or before.order.kind != act.order.kind:
                self._robot.manoeuvre(act.order)  # once: it may know better, as when its charge ends
        elif act.twist is not None:
            self._robot.drive(act.twist)
        elif before is None or before.twist is not None:
            self._robot.stop()
        if before is not None and act.phase != before.phase and act.phase not in ("is at rest", "brakes"):
            self._say("control", _nobody_drives(act.phase), "warn")


def _asks(asker: Asker, held: Driver) -> Notice:
    said = (
        f"{asker.name} asks for control; it goes over in {OBJECTION_TIME:.0f} s unless {held.name} objects."
    )
    who, name, driver = asker.client_id, asker.name, held.name
    return Notice(Code.CONTROL_ASKED, said, actor_id=who, name=name, driver=driver, seconds=OBJECTION_TIME)


def _nobody_drives(does: str) -> Notice:
    return Notice(Code.NOBODY_DRIVES, f"No one drives the robot: it {does}.", phase=does)
