"""Putting the robot back to where it started: offered after a mishap and on request, where the robot can be put back."""

from __future__ import annotations

from app.link.commands import Outcome
from app.screens.shell.notices import Notices
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Event
from widgets import ResetCard

__all__ = ["ResetPrompt"]

SERVICE = "/robot/reset"


class ResetPrompt:
    """The card that asks before it is done."""

    def __init__(self, session: Session, notices: Notices) -> None:
        self._session, self._notices = session, notices
        self.card = ResetCard()
        self.card.bind(on_command=lambda _, name: self._answer(name))

    @property
    def possible(self) -> bool:
        """The robot is known to be one that can be put back, as a simulated one."""
        return self._session.robot.capabilities is not None and self._session.robot.offers(SERVICE)

    def ask(self) -> None:
        """Ask the operator whether it shall be done; nothing for a robot that cannot be put back."""
        if self.possible:
            self.card.ask()
            self.tick()

    def on_alarm(self, event: Event) -> bool:
        """Offer it after an alarm about the robot itself; False when that is none, or cannot be helped so."""
        if event.kind != "robot" or event.level != "alarm" or not self.possible:
            return False
        self.card.notify(event.text)
        self.tick()
        return True

    def on_outcome(self, outcome: Outcome) -> None:
        """What became of a command."""
        if outcome.name == "reset":
            self.card.answer(outcome.phase)
            self.tick()

    def tick(self) -> None:
        """Bring up to date who may, and whether the card is on the glass."""
        session, card = self._session, self.card
        card.name, card.blocked = session.robot.name, not session.may_ask
        card.flies = session.robot.info.flies
        self._notices.keep(card, shown=card.open and session.connected and self.possible)

    def _answer(self, name: str) -> None:
        if name == "reset":
            self._session.command("reset")
        self.tick()
