"""Access to the connected robot: the state of its task, and reasons why it cannot be asked for anything."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from app.intents.executor_app import ScreenApp
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.core.language import mark, tr

if TYPE_CHECKING:
    from app.session.session import Session

__all__ = ["HELD", "RobotAccess"]

HELD = mark("STOP is pressed; release it first.")


class RobotAccess:
    """Of one app, for as long as it has a session."""

    def __init__(self, app: ScreenApp) -> None:
        """`app` is asked for its `session` and its `shell`."""
        self._app = app

    @property
    def _session(self) -> Session:
        return cast("Session", self._app.session)

    @property
    def status(self) -> TaskStatus | None:
        """What the robot reports of its task; None before the first report."""
        status: TaskStatus | None = self._session.feeds.latest("/task/status")
        return status

    def state(self) -> str:
        """State of the task, as in TaskStatus; empty where it is not known."""
        return self.status.state if self.status is not None else ""

    def runs(self) -> bool:
        """A task runs, or is paused."""
        return bool(self._session.running)

    def why_not_asked(self) -> str:
        """Why the robot cannot be asked for anything from here; empty where it can."""
        session = self._session
        if not session.connected:
            return tr("There is no link to the robot.")
        if session.control == "other":
            driver = session.authority.status.driver or tr("Another person")
            return tr("{driver} has control; ask for it first.").format(driver=driver)
        return "" if session.may_ask else tr("It is not known yet who has control.")

    def why_latched(self) -> str:
        """Why nothing may move; empty while STOP is not pressed."""
        return tr(HELD) if self._session.robot_stop.latched else ""
