"""The task's question, over every screen until it is answered."""

from __future__ import annotations

from app.link.commands import Outcome
from app.screens.shell.notices import Notices
from app.session.session import Session
from widgets import QuestionCard
from widgets.core.base import age_text

__all__ = ["TaskQuestion"]


class TaskQuestion:
    """The card of one robot's frame."""

    def __init__(self, session: Session, notices: Notices) -> None:
        self._session, self._notices = session, notices
        self.card = QuestionCard()
        self.card.bind(on_command=lambda _, name: session.command(name))

    def on_outcome(self, outcome: Outcome) -> None:
        """The robot answered to a command: to the answer, where it was one."""
        if outcome.name in ("confirm", "resume", "cancel"):
            self.card.answer(outcome.label, outcome.phase, outcome.reason)

    def tick(self, *, tight: bool, gives_way: bool) -> None:
        """Bring it up to date; `tight` where there is little room, `gives_way` while another card needs that."""
        card, session = self.card, self._session
        card.blocked = not session.may_ask
        card.held = session.robot_stop.latched
        card.tight = tight
        card.old = "" if session.connected else age_text(session.feeds.age("/task/status"))
        self._notices.keep(card, shown=card.open and not gives_way)
