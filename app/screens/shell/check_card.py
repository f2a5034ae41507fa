"""The robot's check list as a screen shows it; folded on one screen, it is folded on the others."""

from __future__ import annotations

from typing import Any

from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Checklist
from widgets import CheckList

__all__ = ["CheckCard"]


class CheckCard(CheckList):
    """A check list that folds as `session.checks` says."""

    def __init__(self, session: Session, dashboard: Dashboard, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session = session
        dashboard.bind(self, "/checklist")
        self.bind(on_fold=self._fold)

    def _fold(self, _: object, unfold: bool) -> None:
        self._session.checks.choose(unfold)
        self.open = unfold

    def show(self, msg: Checklist) -> None:
        """Take over the list, folded at once where all on it has become good."""
        self._session.checks.update()
        self.open = self._session.checks.open
        super().show(msg)

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self._session.checks.update()
        self.open = self._session.checks.open
