"""The ways out: back by one order, and no robot that this handheld has in hand is left without a question."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from app.device import is_android
from app.inputs.base.text_focus import typed_in
from app.pages import Pages
from bridge.msgs.pilothouse_msgs import TaskStatus

if TYPE_CHECKING:
    from app.inputs.inputs import Inputs
    from app.session.session import Session

__all__ = ["HOME", "Leaving"]

HOME = "mission"
"""Screen that back leads to from the others of a robot."""


class Host(Protocol):
    """The app, as far as leaving needs it."""

    pages: Pages
    root: Any
    inputs: Inputs

    @property
    def session(self) -> Session | None:
        """The session with the robot; None while none is wanted."""

    def leave(self) -> None:
        """Back to the connect screen, at once."""

    def stop(self) -> None:
        """End, at once."""


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
        """Leave the robot and do `then`; only after a question while this handheld has it in hand."""
        app, session = self._app, self._app.session

        def go() -> None:
            if app.session is session:  # else it was left in another way meanwhile
                app.leave()
                if then is not None:
                    then()

        if session is None or not self.asks(session):
            go()
            return
        from app.screens.parts.leave_dialog import LeaveDialog

        app.pages.close_question()
        app.root.add_widget(LeaveDialog(go, robot=session.robot.name, cause=self._cause(session)))

    def close_window(self) -> bool:
        """The window shall close: True where it stays for now, because it is asked first; asked to a second time it closes."""
        app, session = self._app, self._app.session
        from app.screens.parts.leave_dialog import LeaveDialog

        asked = any(isinstance(one, LeaveDialog) for one in app.root.children)
        if asked or session is None or not self.asks(session):
            return False
        self.leave(app.stop)
        return True

    def asks(self, session: Session) -> bool:
        """This handheld has the robot in hand: control is here, a finger or a key is on what moves it, or it moves and has no control to hold."""
        if self._app.inputs.held:
            return True
        if not session.connected:
            return False
        return session.control == "mine" or (session.control == "none" and self._moves(session))

    def _cause(self, session: Session) -> str:
        """What is told of a robot before it is left, as in `LeaveDialog.cause`."""
        task: TaskStatus | None = session.feeds.latest("/task/status")
        if self._app.inputs.held or session.link.driving:
            return "moves"
        if task is not None and task.state == "RUNNING":
            return "task"
        return "moves" if self._moves(session) else "control"

    @staticmethod
    def _moves(session: Session) -> bool:
        """It is on its way, or told to be."""
        return session.link.driving or session.checks.moves
