"""The robot's check list as a screen shows it; folded on one screen, it is folded on the others."""

from __future__ import annotations

from typing import Any

from kivy.properties import BooleanProperty

from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Checklist
from widgets import CheckList

__all__ = ["CheckCard"]


class CheckCard(CheckList):
    """A check list that folds as `session.checks` says, or where it is `tight` only as fingers on it say."""

    tight = BooleanProperty(False)
    """It lies over a picture that shall be seen: a chip until a finger unfolds it, and again when the robot moves."""

    def __init__(self, session: Session, dashboard: Dashboard, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session = session
        dashboard.bind(self, "/checklist")
        self._wanted = False
        self.bind(on_fold=self._fold, tight=lambda *_: self._follow())

    def _fold(self, _: object, unfold: bool) -> None:
        if self.tight:
            self._wanted = unfold
        else:
            self._session.checks.choose(unfold)
        self.open = unfold

    def _follow(self) -> None:
        checks = self._session.checks
        checks.update()
        self._wanted = self._wanted and self.tight and not checks.moved
        self.open = self._wanted if self.tight else checks.open

    def show(self, msg: Checklist) -> None:
        """Take over the list, folded at once where all on it has become good."""
        self._follow()
        super().show(msg)

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self._follow()
