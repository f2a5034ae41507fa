"""The arm that a robot carries, as a control of any layout; of a robot without one there is nothing."""

from __future__ import annotations

from app.link.commands import Outcome
from app.screens.drive.drive_blocked import DriveBlocked
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import ArmOrder
from widgets import ArmPanel
from widgets.core.language import mark

__all__ = ["ARM", "ArmControl"]

ARM = mark("Arm")
"""What it is called beside what drives."""
TOPIC, SERVICE = "/arm", "/arm/move"


class ArmControl:
    """Sends what a finger asks of the panel, and tells it what became of that. Everything here happens in the UI thread."""

    def __init__(self, session: Session, dashboard: Dashboard, in_vain: DriveBlocked) -> None:
        """`in_vain` tells why a finger on it does nothing."""
        self._session, self._dashboard, self._in_vain = session, dashboard, in_vain
        self.made: ArmPanel | None = None
        """The panel, once there was an arm."""
        self._asked: ArmOrder | None = None

    @property
    def carried(self) -> bool:
        """The robot is known to have an arm that can be told what to do."""
        offer = self._session.robot.capabilities
        return offer is not None and offer.serves(SERVICE)

    @property
    def panel(self) -> ArmPanel:
        """Made when it is first needed."""
        if self.made is None:
            self.made = panel = ArmPanel(state="never")
            panel.bind(
                on_command=lambda _, order: self._send(order), on_in_vain=lambda _: self._in_vain.notify()
            )
            self._dashboard.bind(panel, TOPIC, fresh=False)
            message = self._session.feeds.latest(TOPIC)
            if message is not None:
                panel.show(message)
        return self.made

    def _send(self, order: ArmOrder) -> None:
        self._asked = order
        self._session.command("arm", order=order)

    def on_outcome(self, outcome: Outcome) -> None:
        """Tell the panel what became of the newest order; why one was refused is said over the screen."""
        if outcome.name == "arm" and self.made is not None and outcome.fields.get("order") is self._asked:
            self.made.answer(outcome.phase)

    def rest(self) -> None:
        """A finger that drags lets go of it; the arm goes where it was sent."""
        if self.made is not None:
            self.made.rest()

    def tick(self) -> None:
        """Bring up to date whether it may be used, and how old what it shows is."""
        if self.made is None:
            return
        session, panel = self._session, self.made
        state = session.feeds.state(TOPIC)
        age = session.feeds.age(TOPIC)
        if state == "stale" and not abs(age - panel.age) < 0.5:
            panel.age = age
        asked = session.may_ask and not session.robot_stop.latched
        panel.state = state if asked or state != "live" else "disabled"
