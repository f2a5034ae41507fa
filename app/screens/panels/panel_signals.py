"""Switches and buttons of a view that tell the robot a bool: when they may, what they send, and what became of it.

They go the way of `app.link.signals`, never that of driving; a control that drives is one of `panel_controls`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import widgets
from app.layout.view_checks import is_signal
from app.layout.views import Panel
from app.link.channels import CAPABILITIES, LINK, SIGNAL
from app.link.commands import SERVICES
from app.link.feeds import Post
from app.link.signals.signal_rule import topic_fault
from app.screens.panels.offers import title_of
from app.session.session import Session
from bridge.msgs import Msg
from widgets.core.language import tr

__all__ = ["PanelSignals", "not_now", "sendable"]


def sendable(session: Session, topic: str, kind: type[Msg]) -> bool:
    """A switch may be put on a view for that topic of the robot."""
    return not topic_fault(session.robot.capabilities, topic, kind, SERVICES)


def not_now(session: Session) -> str:
    """Why no switch may send anything just now, in one sentence; empty where it may.

    A robot that is not ours has no control to have: what lets the stick drive it lets a switch send, and nothing else.
    """
    if not session.connected or session.link.silent:
        return tr("The robot is not heard.")
    if session.robot_stop.phase != "ready" or session.robot_stop.latched:
        return tr("STOP is pressed; nothing is sent.")
    if not session.robot.foreign and session.control != "mine":
        return tr("Take control first.")
    if not session.may_drive:
        return tr("This robot cannot be driven from here, so nothing is sent.")
    return ""


class PanelSignals:
    """Made anew for every view. A control that is not in sight, or may not send, lets go and sends nothing but its rest."""

    def __init__(self, panels: Sequence[Panel | None], session: Session, seen: Callable[[Any], bool]) -> None:
        """`panels` by their index in the view, None for one that is hidden; `seen` as of `PanelControls`."""
        self._session, self._seen = session, seen
        self._panels = {
            index: panel
            for index, panel in enumerate(panels)
            if panel is not None and is_signal(panel.widget)
        }
        self._faults: dict[str, str] = {}
        """By topic, what the link knows of it; one that is not in it is still asked about."""
        self._link: object = None
        self.widgets: dict[int, Any] = {index: self._made(panel) for index, panel in self._panels.items()}
        """By the index of the panel in the view."""

    def _made(self, panel: Panel) -> Any:
        kind: Any = getattr(widgets, panel.widget)
        icon = {"icon": panel.icon} if panel.icon and hasattr(kind, "icon") else {}
        # a switch has its name over it; what is held has it under the thumb
        title = title_of(panel, brief=True) if kind.at_rest is not None else ""
        widget = kind(card=False, title=title, state="disabled", **icon)
        widget.bind(on_command=lambda one, msg: self._said(one, panel, msg))
        return widget

    @property
    def topics(self) -> Mapping[str, type[Msg]]:
        """What is sent where."""
        found: dict[str, type[Msg]] = {}
        for index, panel in self._panels.items():
            found.setdefault(panel.topic, self.widgets[index].sends[0])
        return found

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold and is in sight."""
        return [widget for widget in self.widgets.values() if self._seen(widget)]

    def problem(self, index: int) -> str:
        """Why that panel may not send, in one sentence; empty where it may."""
        panel, widget = self._panels[index], self.widgets[index]
        fault = topic_fault(self._session.robot.capabilities, panel.topic, widget.sends[0], SERVICES)
        asked = self._faults.get(
            panel.topic, tr("Asking the robot who listens to {topic} …").format(topic=panel.topic)
        )
        return fault or asked or not_now(self._session)

    # what a finger does

    def _said(self, widget: Any, panel: Panel, msg: Any) -> None:
        signals, index = self._session.link.signals, self._index(widget)
        if widget.at_rest is not None and msg == widget.at_rest:
            signals.let_go(panel.topic)
        elif self.problem(index) or not self._seen(widget):
            widget.rest()
        elif widget.at_rest is not None:
            signals.hold(panel.topic, msg, widget.at_rest)
        else:
            signals.say(panel.topic, msg)

    def _index(self, widget: Any) -> int:
        return next(index for index, one in self.widgets.items() if one is widget)

    # what the view calls

    def enter(self) -> None:
        """Come onto the glass: the robot is asked who listens."""
        self._look()
        if any(self.problem(index) for index in self.widgets):
            self._session.link.ask_offer()  # what listens may have come since
        self.tick()

    def leave(self) -> None:
        """Leave the glass: everything lets go, and nothing can be sent any longer."""
        self.rest()
        if self.widgets:
            self._session.link.signals.look({})

    def rest(self) -> None:
        """Every control lets go."""
        for widget in self.widgets.values():
            widget.rest()

    def rest_unseen(self) -> None:
        """Every control that is not in sight lets go."""
        for widget in self.widgets.values():
            if not self._seen(widget):
                widget.rest()

    def _look(self) -> None:
        if self.widgets:
            self._link = self._session.link
            self._session.link.signals.look(self.topics)

    def on_post(self, channel: str, post: Post) -> None:
        """The link says who listens, or what has left; or it is another one."""
        if channel == LINK and not self._session.connected:
            self._faults.clear()
        if channel == CAPABILITIES or (channel == LINK and self._link is not self._session.link):
            self._look()
        if channel != SIGNAL:
            return
        news = post.value
        if news.sent is None and not news.unsent:
            self._faults[news.topic] = news.problem
        for index, panel in self._panels.items():
            if news.unsent and panel.topic == news.topic and self.widgets[index].at_rest is None:
                self.widgets[index].show_unsent()
            if news.sent is not None and panel.topic == news.topic and not panel.also:
                self.widgets[index].show(news.sent)

    def tick(self) -> None:
        """Let only those be pressed that may send now."""
        if not self.widgets:
            return
        self.rest_unseen()
        for index, widget in self.widgets.items():
            widget.state, widget.age = ("disabled" if self.problem(index) else "live"), math.nan
