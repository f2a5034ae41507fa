"""The controls of a layout as widgets: what they say together drives the robot, and each can do no more than the robot may."""

from __future__ import annotations

import math
from typing import Any

from kivy.event import EventDispatcher
from kivy.properties import StringProperty
from kivy.uix.widget import Widget

import widgets
from app.layout.layout import SAYS, SLIDER, Control, Layout
from app.link.channels import CAPABILITIES, OUTCOME
from app.link.control_mixer import ControlMixer, Parts, Reach
from app.link.drive_slot import Drive
from app.link.feeds import Post
from app.screens.drive.arm_control import ARM, ArmControl
from app.screens.drive.asking_controls import AskingControls
from app.screens.drive.control_reach import ControlReach
from app.screens.drive.drive_blocked import DriveBlocked, grounded
from app.screens.drive.speed_card import SpeedCard
from app.screens.drive.tilt_control import TILT, TiltControl
from app.session.dashboard import Dashboard
from app.session.layout_actions import LayoutActions
from app.session.session import Session
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.controls.sticks.stick import Stick
from widgets.controls.sticks.tilt_circle import TiltCircle
from widgets.core.language import mark, tr
from widgets.core.quantities import said

__all__ = ["DriveControls"]

CAPTIONS = {"landed": mark("take off first"), "turned_over": mark("on its back")}
"""What stands on a stick in a phase of a flight in which it moves nothing."""


class DriveControls(EventDispatcher):
    """Made once for a screen, which puts the widgets where they belong. Everything here happens in the UI thread."""

    chosen = StringProperty("")
    """Title of the one that is on the glass, of two controls in one slot; empty where every slot has one."""

    def __init__(
        self,
        layout: Layout,
        session: Session,
        dashboard: Dashboard,
        actions: LayoutActions,
        in_vain: DriveBlocked,
    ) -> None:
        """`actions` does what a slide confirms, `in_vain` tells why a push does nothing."""
        self._session, self._dashboard = session, dashboard
        self._in_vain = in_vain
        self.places: dict[str, list[Widget]] = {}
        """Widgets by slot, in the order of the layout."""
        self._reach = ControlReach(session, self._on_reach)
        self._sticks: list[tuple[Stick, Control]] = []
        self._asking = AskingControls(session, actions)
        self.arm = ArmControl(session, dashboard, in_vain)
        super().__init__()
        self._names_all = len({one.slot for one in layout.controls if _drives(one)}) > 1
        for one in layout.controls:
            self._add(one)
        self.tablet = False
        """The tablet's tilt shall drive, where the layout has a stick and no circle of its own; `take_up` puts one on the glass."""
        self.tilt = TiltControl(self._sticks)
        self._own: dict[str, Widget] = {
            one.called: widget for one, widget in self._all(layout) if one.slot == "stick"
        }
        self.choices: dict[str, Widget] = self._own if len(self._own) > 1 else {}
        """Those of which one is on the glass, by what they are called; an arm that the robot carries is one more, and so is
        the circle of a tablet."""
        self.chosen = next(iter(self.choices), "")
        self.bind(chosen=lambda *_: self.rest())
        says = {part for _, one in self._sticks for part in one.says}
        self.piloting = ControlMixer(self._drive, self._kinds, lambda: self.reach, says, self._amend)

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
                circle.bind(on_in_vain=lambda _: self._in_vain.notify())
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
        widget = self._reach.make_slider() if one.widget == SLIDER else self._made(one)
        self.places.setdefault(one.slot, []).append(widget)

    @property
    def speed(self) -> SpeedCard | None:
        """How fast the others are at the end of their way; None where nothing says that."""
        return self._reach.speed

    @property
    def reach(self) -> Reach:
        """What the controls mean at the end of their way now."""
        return self._reach.reach

    def _made(self, one: Control) -> Any:
        kind = getattr(widgets, one.widget)
        widget = kind()
        for topic in one.topics:
            self._dashboard.bind(widget, topic, fresh=False)
        if hasattr(widget, "on_in_vain"):
            widget.bind(on_in_vain=lambda _: self._in_vain.notify())
        if isinstance(widget, Stick):
            self._sticks.append((widget, one))
            self._caption(widget, one)
            widget.bind(on_command=lambda stick, said: self._pushed(stick, said, one))
        else:
            self._asking.add(widget, one)
        return widget

    # what the fingers do

    def _pushed(self, stick: Stick, said: Drive, one: Control) -> None:
        self.piloting.set_parts(stick, self._meant(stick, said, one))

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

    # what the screen calls

    @property
    def sticks(self) -> list[tuple[Stick, str]]:
        """What drives and is on the glass, each with the stick of a gamepad that pushes it too; empty for none."""
        return [(stick, one.pad) for stick, one in self._sticks if self.shown(stick)]

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold besides and is on the glass."""
        arm = [self.arm.panel] if self.chosen == ARM else []
        return [*(widget for widget in self._asking.widgets if self.shown(widget)), *arm]

    def on_post(self, channel: str, post: Post) -> None:
        """A message came: what the robot may, and what became of what was asked for."""
        if channel in ("/robot/info", "/limits"):
            self.take_limits()
        elif channel == CAPABILITIES:
            self._retake()
        elif channel == OUTCOME:
            self.arm.on_outcome(post.value)
            self._asking.on_outcome(post.value)

    def shown(self, widget: Widget) -> bool:
        """It is on the glass, and not the other one of its slot."""
        return widget not in self.choices.values() or self.choices[self.chosen] is widget

    def rest(self) -> None:
        """Every control lets go."""
        for stick, _ in self._sticks:
            stick.rest()
        self._asking.rest()
        self.arm.rest()

    def tick(self) -> None:
        """Bring up to date what may be used."""
        session = self._session
        phase = grounded(session)
        for stick, one in self._sticks:
            stick.state = "live" if session.may_drive and not phase else "disabled"
            self._caption(stick, one, phase if session.may_drive else "")
        self._asking.tick()
        self._tell_driven()
        self.arm.tick()

    def _caption(self, stick: Any, one: Control, phase: str = "") -> None:
        """What pushing it means, where that is not to drive; while the robot stands on the ground what has to be done before."""
        if not hasattr(stick, "caption"):
            return
        usual = " · ".join(one.says) if one.forward != "ahead" or self._names_all else ""
        stick.caption = tr(CAPTIONS.get(phase, usual))

    def _tell_driven(self) -> None:
        """Slider and lever mean the hand alone: while a task drives, its own speed stands there."""
        status: TaskStatus | None = self._session.feeds.latest("/task/status")
        led = status is not None and status.state == "RUNNING" and not self._session.robot_stop.latched
        if self.speed is not None:
            self.speed.driven = tr("task: {speed}").format(speed=self._speed_words) if led else ""
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
        return said(math.hypot(way.x, way.y, way.z), "speed", 1).words

    def take_limits(self) -> None:
        """The slider's range is the robot's; where it stood is kept."""
        self._reach.update()

    def _on_reach(self) -> None:
        for stick, _ in self._sticks:
            self._reach.show_on(stick)
        self._retake()

    def _retake(self) -> None:
        """A finger that rests on a stick drives on, and shall do so by what the glass says now."""
        self.piloting.retake({stick: self._meant(stick, stick.order, one) for stick, one in self._sticks})


def _drives(one: Control) -> bool:
    return one.widget != SLIDER and issubclass(getattr(widgets, one.widget), Stick)
