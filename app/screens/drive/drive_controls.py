"""The controls of a layout as widgets: what they say together drives the robot, and each can do no more than the robot may."""

from __future__ import annotations

import math
from typing import Any

from kivy.event import EventDispatcher
from kivy.properties import StringProperty
from kivy.uix.widget import Widget

import widgets
from app.layout.layout import SAYS, SLIDER, Control, Layout
from app.link.channels import OFFER, OUTCOME
from app.link.commands import Outcome
from app.link.control_mixer import Parts, Piloting, Reach
from app.link.drive_slot import Drive
from app.link.feeds import Post
from app.screens.drive.arm_control import ARM, ArmHand
from app.screens.drive.drive_blocked import InVain, grounded
from app.screens.drive.speed_card import SpeedCard, allowed
from app.screens.drive.tilt_control import TILT, TiltHand
from app.session.dashboard import Dashboard
from app.session.layout_actions import ACTIONS, Actions
from app.session.session import Session
from bridge.msgs.geometry_msgs import PoseStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import FlightState, TaskOrder, TaskStatus, Waypoint
from widgets.controls.sticks.stick import Stick
from widgets.controls.sticks.tilt_circle import TiltCircle

__all__ = ["Hands"]

FIRST = 0.6
"""Share of the robot's greatest speed that the slider begins with."""
CAPTIONS = {"landed": "take off first", "turned_over": "on its back"}
"""What stands on a stick in a phase of a flight in which it moves nothing."""
VAIN = {
    "landed": ("task.land",),
    "flying": ("task.take_off",),
    "turned_over": ("task.land", "task.take_off"),
}
OWN = Reach()
"""What the controls mean where the robot does not say what it can."""


class Hands(EventDispatcher):
    """Made once for a screen, which puts the widgets where they belong. Everything here happens in the UI thread."""

    chosen = StringProperty("")
    """Title of the one that is on the glass, of two controls in one slot; empty where every slot has one."""

    def __init__(
        self, layout: Layout, session: Session, dashboard: Dashboard, actions: Actions, in_vain: InVain
    ) -> None:
        """`actions` does what a slide confirms, `in_vain` tells why a push does nothing."""
        self._session, self._dashboard = session, dashboard
        self._actions, self._in_vain = actions, in_vain
        self.places: dict[str, list[Widget]] = {}
        """Widgets by slot, in the order of the layout."""
        self.speed: SpeedCard | None = None
        """How fast the others are at the end of their way; None where nothing says that."""
        self._sticks: list[tuple[Stick, Control]] = []
        self._asking: list[tuple[Any, Control]] = []
        """Controls that ask for something once."""
        self._asked: tuple[Any, str, str] | None = None
        """The control that asked last, by which command, and for which task; None once that is answered."""
        self._limited = False
        self.reach = OWN
        """What the controls mean at the end of their way now."""
        self.arm = ArmHand(session, dashboard, in_vain)
        super().__init__()
        self._names_all = len({one.slot for one in layout.controls if _drives(one)}) > 1
        for one in layout.controls:
            self._add(one)
        self.tablet = False
        """The tablet's tilt shall drive, where the layout has a stick and no circle of its own; `take_up` puts one on the glass."""
        self.tilt = TiltHand(self._sticks)
        self._own: dict[str, Widget] = {
            one.called: widget for one, widget in self._all(layout) if one.slot == "stick"
        }
        self.choices: dict[str, Widget] = self._own if len(self._own) > 1 else {}
        """Those of which one is on the glass, by what they are called; an arm that the robot carries is one more, and so is
        the circle of a tablet."""
        self.chosen = next(iter(self.choices), "")
        self.bind(chosen=lambda *_: self.rest())
        says = {part for _, one in self._sticks for part in one.says}
        self.piloting = Piloting(self._drive, self._kinds, lambda: self.reach, says, self._amend)

    def take_up(self) -> bool:
        """Take up what the robot has or the operator wants besides, and put away the rest; True when that changed.

        An arm where the robot has one; the circle where the tablet shall drive.
        """
        wanted = self._own | self._tilted() | ({ARM: self.arm.panel} if self.arm.carried else {})
        wanted = wanted if len(wanted) > 1 else {}
        if wanted == self.choices:
            return False
        self.choices = wanted
        if self.chosen not in self.choices:
            self.chosen = next(iter(self.choices), "")
        return True

    def _tilted(self) -> dict[str, Widget]:
        """The circle by its name, made when it is first wanted; nothing where there is none to choose."""
        made, control = self.tilt.made, self.tilt.control
        if self.tablet and control is not None:
            circle = self.tilt.circle
            if made is None:
                circle.bind(on_command=lambda stick, said: self._pushed(stick, said, control))
                circle.bind(on_in_vain=lambda _: self._in_vain.tell())
            if not any(stick is circle for stick, _ in self._sticks):
                self._sticks.append((circle, control))
            return {TILT: circle}
        if made is not None:
            made.rest()
            self._sticks = [(stick, one) for stick, one in self._sticks if stick is not made]
        return {}

    @property
    def circle(self) -> TiltCircle | None:
        """What the tablet tilts and is on the glass; None without one."""
        found = (stick for stick, _ in self.sticks if isinstance(stick, TiltCircle))
        return next(found, None)

    @property
    def lent(self) -> list[Widget]:
        """What has been made besides the layout's own and is on the glass at times: the arm, and the circle of a tablet."""
        return [widget for widget in (self.arm.made, self.tilt.made) if widget is not None]

    def _all(self, layout: Layout) -> list[tuple[Control, Widget]]:
        left = {slot: list(found) for slot, found in self.places.items()}
        return [(one, left[one.slot].pop(0)) for one in layout.controls]

    def _add(self, one: Control) -> None:
        widget = self._slider() if one.widget == SLIDER else self._made(one)
        self.places.setdefault(one.slot, []).append(widget)

    def _slider(self) -> SpeedCard:
        self.speed = SpeedCard()
        self.speed.bind(maximum_speed=self._limit)
        return self.speed

    def _made(self, one: Control) -> Any:
        kind = getattr(widgets, one.widget)
        widget = kind()
        for topic in one.topics:
            self._dashboard.bind(widget, topic, fresh=False)
        if hasattr(widget, "on_in_vain"):
            widget.bind(on_in_vain=lambda _: self._in_vain.tell())
        if isinstance(widget, Stick):
            self._sticks.append((widget, one))
            self._caption(widget, one)
            widget.bind(on_command=lambda stick, said: self._pushed(stick, said, one))
        else:
            self._asking.append((widget, one))
            self._wire(widget, one)
        return widget

    def _wire(self, widget: Any, one: Control) -> None:
        """What a control that is no stick asks for when it is used."""
        words = ACTIONS.get(one.action, ("", ""))
        for name, value in (("text", one.title or _within(words[0])), ("icon", one.icon or words[1])):
            if value and hasattr(widget, name):
                setattr(widget, name, value)
        if hasattr(widget, "on_confirm"):
            widget.bind(on_confirm=lambda _: self._act(widget, one.action))
        elif hasattr(widget, "on_course"):
            widget.bind(on_course=lambda _, yaw: self._follow(widget, yaw))
        elif PoseStamped in getattr(widget, "sends", ()):
            widget.bind(on_command=lambda _, goal: self._go_to(widget, goal))

    # what the fingers do

    def _pushed(self, stick: Stick, said: Drive, one: Control) -> None:
        self.piloting.take(stick, self._meant(stick, said, one))

    def _meant(self, stick: Stick, said: Any, one: Control) -> Parts:
        if one.widget in SAYS:
            return Parts.of(said)
        shares = ((one.forward, stick.forward), (one.left, stick.left))
        return Parts(**{part: share * self.reach.of(part) for part, share in shares if part})

    def _drive(self, order: Drive) -> None:
        self._session.link.drive(order)

    def _amend(self, order: Drive) -> None:
        self._session.link.amend(order)

    def _kinds(self) -> tuple[str, ...]:
        session = self._session
        return tuple(session.robot.info.manoeuvres) if session.link.steers else ()

    def _act(self, widget: Any, what: str) -> None:
        name = self._actions.confirm(what)
        self._asked = (widget, name, what.removeprefix("task.")) if name else None

    def _follow(self, widget: Any, yaw: float) -> None:
        self._start(widget, TaskOrder(task="follow_heading", heading=yaw))

    def _go_to(self, widget: Any, goal: PoseStamped) -> None:
        point, yaw = goal.pose.position, goal.pose.orientation.yaw
        self._start(widget, TaskOrder(task="go_to", goals=[Waypoint(point.x, point.y, yaw)]))

    def _start(self, widget: Any, order: TaskOrder) -> None:
        session, self._asked = self._session, (widget, "start", order.task)
        if session.running:
            session.tasking.start_instead(order)
        else:
            session.tasking.start(order)

    # what the screen calls

    @property
    def sticks(self) -> list[tuple[Stick, str]]:
        """What drives and is on the glass, each with the stick of a gamepad that pushes it too; empty for none."""
        return [(stick, one.pad) for stick, one in self._sticks if self.shown(stick)]

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold besides and is on the glass."""
        arm = [self.arm.panel] if self.chosen == ARM else []
        return [*(widget for widget, _ in self._asking if self.shown(widget)), *arm]

    def hear(self, channel: str, post: Post) -> None:
        """A message came: what the robot may, and what became of what was asked for."""
        if channel in ("/robot/info", "/limits"):
            self.take_limits()
        elif channel == OFFER:
            self._retake()
        elif channel == OUTCOME:
            self.arm.hear(post.value)
            self._answer(post.value)

    def _answer(self, outcome: Outcome) -> None:
        """Tell the control that asked."""
        if self._asked is None:
            return
        widget, name, task = self._asked
        order = outcome.fields.get("order")
        if outcome.name != name or (order is not None and order.task != task):
            return
        if hasattr(widget, "answer"):
            widget.answer(outcome.phase)
        if outcome.phase != "sent":
            self._asked = None

    def shown(self, widget: Widget) -> bool:
        """It is on the glass, and not the other one of its slot."""
        return widget not in self.choices.values() or self.choices[self.chosen] is widget

    def rest(self) -> None:
        """Every control lets go."""
        for widget, _ in (*self._sticks, *self._asking):
            widget.rest()
        self.arm.rest()

    def tick(self) -> None:
        """Bring up to date what may be used."""
        session = self._session
        phase = grounded(session)
        for stick, one in self._sticks:
            stick.state = "live" if session.may_drive and not phase else "disabled"
            self._caption(stick, one, phase if session.may_drive else "")
        able = {action.name: action for action in self._actions.slides()}
        asked = session.may_ask and not session.robot_stop.latched
        for widget, one in self._asking:
            action = able.get(one.action)
            may = (action is not None and action.able) if one.action else asked
            may = may and (not one.action or one.action not in self._vain())
            widget.state = "live" if may else "disabled"
            if action is not None and not one.title and hasattr(widget, "text"):
                widget.text = _within(action.text)
        slides = [widget for widget, _ in self._asking if hasattr(widget, "kin")]
        for widget in slides:
            widget.kin = [other.text for other in slides if other is not widget]
        self._tell_driven()
        self.arm.tick()

    def _caption(self, stick: Any, one: Control, phase: str = "") -> None:
        """What pushing it means, where that is not to drive; while the robot stands on the ground what has to be done before."""
        if not hasattr(stick, "caption"):
            return
        usual = " · ".join(one.says) if one.forward != "ahead" or self._names_all else ""
        stick.caption = CAPTIONS.get(phase, usual)

    def _tell_driven(self) -> None:
        """Slider and lever mean the hand alone: while a task drives, its own speed stands there."""
        status: TaskStatus | None = self._session.feeds.latest("/task/status")
        led = status is not None and status.state == "RUNNING" and not self._session.robot_stop.latched
        if self.speed is not None:
            self.speed.driven = f"task: {self._speed_words}" if led else ""
        for stick, _ in self._sticks:
            if hasattr(stick, "led"):
                stick.led = led

    @property
    def _speed_words(self) -> str:
        """How fast the robot goes, as in `1.9 m/s`; a dash where that is not known."""
        feeds = self._session.feeds
        told: Odometry | None = feeds.latest("/odom")
        if told is None or feeds.state("/odom") != "live":
            return "–"
        way = told.twist.twist.linear
        return f"{math.hypot(way.x, way.y, way.z):.1f}\u00a0m/s"

    def _vain(self) -> tuple[str, ...]:
        """The actions that do nothing: what flies need not take off, what stands need not land, what lies on its back can neither."""
        flight: FlightState | None = self._session.feeds.latest("/flight")
        if flight is None or self._session.feeds.state("/flight") != "live":
            return ()
        return VAIN.get(flight.phase, ())

    def take_limits(self) -> None:
        """The slider's range is the robot's; where it stood is kept."""
        limits, info = self._session.feeds.latest("/limits"), self._session.robot.info
        fastest, _ = allowed(info, limits)
        if self.speed is not None:
            self._range(self.speed, fastest)
        self._limited = self._limited or bool(info.max_speed)
        self._limit()

    def _range(self, speed: SpeedCard, fastest: float) -> None:
        limits = self._session.feeds.latest("/limits")
        speed.speed_limit = limits.max_speed if limits is not None else math.nan
        speed.turn_limit = limits.max_yaw_rate if limits is not None else math.nan
        fader = speed.ids.fader
        if self._limited and fader.maximum == fastest:
            return
        fader.minimum, fader.maximum, fader.step = fastest / 10, fastest, 0.0
        wanted = speed.maximum_speed if self._limited else fastest * FIRST
        fader.value = min(max(wanted, fader.minimum), fastest)
        speed.maximum_speed = fader.value

    def _limit(self, *_: object) -> None:
        """Slow on the slider is slow in everything but turning, which is never below half, and steering, which is whole."""
        info = self._session.robot.info
        fastest, turn = allowed(info, self._session.feeds.latest("/limits"))
        speed = self.speed.maximum_speed if self.speed is not None else fastest
        share = min(1.0, speed / fastest)
        self.reach = Reach(
            speed=speed,
            yaw_rate=turn * (0.5 + 0.5 * share),
            climb=info.max_climb * share,
            tilt=(info.max_tilt or OWN.tilt) * share,
            steering=info.max_steering or OWN.steering,
        )
        ends = {
            "max_speed": speed,
            "max_yaw_rate": self.reach.yaw_rate,
            "max_tilt": self.reach.tilt,
            "max_steering": self.reach.steering,
            "most": share,
        }
        for stick, _control in self._sticks:
            for name, end in ends.items():
                if hasattr(stick, name):
                    setattr(stick, name, end)
        self._retake()

    def _retake(self) -> None:
        """A finger that rests on a stick drives on, and shall do so by what the glass says now."""
        self.piloting.retake({stick: self._meant(stick, stick.order, one) for stick, one in self._sticks})


def _drives(one: Control) -> bool:
    return one.widget != SLIDER and issubclass(getattr(widgets, one.widget), Stick)


def _within(words: str) -> str:
    """Words as they are written within a sentence."""
    return words[:1].lower() + words[1:]
