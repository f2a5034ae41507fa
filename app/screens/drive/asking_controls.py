"""Controls of a drive screen that ask for something once: a slide that confirms, a course dial, a goal pad."""

from __future__ import annotations

from typing import Any

from app.layout.layout import Control
from app.link.commands import Outcome
from app.session.layout_actions import ACTIONS, LayoutActions
from app.session.session import Session
from bridge.msgs.geometry_msgs import PoseStamped
from bridge.msgs.pilothouse_msgs import FlightState, TaskOrder, Waypoint
from widgets.core.language import tr, within

__all__ = ["AskingControls"]

USELESS_ACTIONS = {
    "landed": ("task.land",),
    "flying": ("task.take_off",),
    "turned_over": ("task.land", "task.take_off"),
}
"""Phase of a flight to the actions that do nothing in it."""


class AskingControls:
    """The controls, and which of them waits for an answer."""

    def __init__(self, session: Session, actions: LayoutActions) -> None:
        """`actions` does what a slide confirms."""
        self._session, self._actions = session, actions
        self._controls: list[tuple[Any, Control]] = []
        self._asked: tuple[Any, str, str] | None = None
        """The control that asked last, by which command, and for which task; None once that is answered."""

    @property
    def widgets(self) -> list[Any]:
        """Every one of them, in the order of the layout."""
        return [widget for widget, _ in self._controls]

    def add(self, widget: Any, one: Control) -> None:
        """Take a control in, and have it ask for what the layout says."""
        self._controls.append((widget, one))
        words = ACTIONS.get(one.action, ("", ""))
        for name, value in (("text", tr(one.title) or within(tr(words[0]))), ("icon", one.icon or words[1])):
            if value and hasattr(widget, name):
                setattr(widget, name, value)
        if hasattr(widget, "on_confirm"):
            widget.bind(on_confirm=lambda _: self._act(widget, one.action))
        elif hasattr(widget, "on_course"):
            widget.bind(on_course=lambda _, yaw: self._follow(widget, yaw))
        elif PoseStamped in getattr(widget, "sends", ()):
            widget.bind(on_command=lambda _, goal: self._go_to(widget, goal))

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

    def on_outcome(self, outcome: Outcome) -> None:
        """The robot answered to a command: tell the control that asked."""
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

    def rest(self) -> None:
        """Every one lets go."""
        for widget in self.widgets:
            widget.rest()

    def tick(self) -> None:
        """Bring up to date what may be asked for."""
        session = self._session
        able = {action.name: action for action in self._actions.slides()}
        asked = session.may_ask and not session.robot_stop.latched
        useless = self._useless()
        for widget, one in self._controls:
            action = able.get(one.action)
            may = (action is not None and action.able) if one.action else asked
            may = may and (not one.action or one.action not in useless)
            widget.state = "live" if may else "disabled"
            if action is not None and not one.title and hasattr(widget, "text"):
                widget.text = within(action.text)
        slides = [widget for widget in self.widgets if hasattr(widget, "kin")]
        for widget in slides:
            widget.kin = [other.text for other in slides if other is not widget]

    def _useless(self) -> tuple[str, ...]:
        """The actions that do nothing: what flies need not take off, what stands need not land, what lies on its back can neither."""
        flight: FlightState | None = self._session.feeds.latest("/flight")
        if flight is None or self._session.feeds.state("/flight") != "live":
            return ()
        return USELESS_ACTIONS.get(flight.phase, ())
