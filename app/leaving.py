"""The ways out: back by one order, and no robot that moves is left without a question."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from app.device import is_android
from app.inputs.base.text_focus import typed_in
from app.pages import Pages

if TYPE_CHECKING:
    from app.session.session import Session

__all__ = ["HOME", "Leaving"]

HOME = "mission"
"""Screen that back leads to from the others of a robot."""


class Host(Protocol):
    """The app, as far as leaving needs it."""

    pages: Pages
    root: Any

    @property
    def session(self) -> Session | None:
        """The session with the robot; None while none is wanted."""

    def leave(self) -> None:
        """Back to the connect screen, at once."""


class Leaving:
    """Everything here happens in the UI thread."""

    def __init__(self, app: Host) -> None:
        self._app = app

    def back(self) -> bool:
        """A question goes first, then the keyboard, then what is open within the screen, then the screen, then the robot.

        False where there is nothing left to go back from, which the system decides.
        """
        app = self._app
        if app.pages.close_question():
            return True
        field = typed_in()
        if field is not None:
            field.focus = False
            return True
        if app.pages.back():
            return True
        shell = app.pages.shell
        if shell is not None and shell.screen != HOME:
            app.pages.show(HOME)
            return True
        if app.session is not None:
            self.leave()
            return True
        return not is_android()

    def leave(self, then: Callable[[], object] | None = None) -> None:
        """Leave the robot and do `then`; while it moves for this handheld only after a question."""
        app, session = self._app, self._app.session

        def go() -> None:
            if app.session is session:  # else it was left in another way meanwhile
                app.leave()
                if then is not None:
                    then()

        if session is None or not self._moves(session):
            go()
            return
        from app.screens.parts.leave_dialog import LeaveDialog

        app.pages.close_question()
        tasked = session.running and not session.link.driving
        app.root.add_widget(LeaveDialog(go, robot=session.robot.name, tasked=tasked))

    @staticmethod
    def _moves(session: Session) -> bool:
        """It is on its way, or told to be, and whoever leaves it here had it in hand."""
        held = session.control in ("mine", "none")
        return held and session.connected and (session.link.driving or session.checks.moves)
