"""The screens of one robot in their frame, made when there is a robot to show."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from app.layout.layout import Layout
from app.link.feeds import Post
from app.screens.drive.dive import DiveScreen
from app.screens.drive.drive import DriveScreen
from app.screens.inputs.screen import InputsScreen
from app.screens.mission.mission import MissionScreen
from app.screens.parts.robot_screen import RobotScreen
from app.screens.shell.screen_host import ScreenHost
from app.screens.shell.shell import Shell, ShellHost
from app.screens.tasks.tasks import TasksScreen
from app.screens.topics.topics import TopicsScreen
from app.session.session import Session

__all__ = ["Profile", "robot_shell"]

DRIVE: dict[str, type[DriveScreen | DiveScreen]] = {
    "float": DriveScreen,
    "two_sticks": DriveScreen,
    "columns": DiveScreen,
}
"""The drive screen of each arrangement."""


class Host(ShellHost, ScreenHost, Protocol):
    """The app, as far as a robot's screens and their frame need it."""


class Profile:
    """The drive screen that is made for the robot: as soon as that says what it is, and anew when it says something else."""

    def __init__(self, app: Host, session: Session, layout_for: Callable[[str, str], Layout]) -> None:
        """`layout_for` gives the layout of a robot's model and kind."""
        self._app, self._session, self._layout_for = app, session, layout_for
        self.layout = self._wanted()
        """The one that is on the glass."""

    def _wanted(self) -> Layout:
        info = self._session.robot.info
        return self._layout_for(info.model, info.kind)

    def screen(self) -> DriveScreen | DiveScreen:
        """Make its screen."""
        return DRIVE[self.layout.arrangement](self.layout, app=self._app, session=self._session)

    def follow(self, shell: Shell) -> None:
        """Have `shell` show another one when the robot turns out to be something else."""

        def hear(channel: str, _: Post) -> None:
            if channel == "/robot/info" and self._wanted() != self.layout:
                self.layout = self._wanted()
                shell.replace("drive", self.screen())

        shell.follow(hear)


def robot_shell(
    app: Host, session: Session, layout_for: Callable[[str, str], Layout], **kwargs: Any
) -> Shell:
    """The frame with every screen in it; `layout_for` gives the drive screen of a robot's model and kind."""
    profile = Profile(app, session, layout_for)
    screens: dict[str, RobotScreen] = {
        "mission": MissionScreen(app=app, session=session),
        "drive": profile.screen(),
        "tasks": TasksScreen(app=app, session=session),
        "topics": TopicsScreen(app=app, session=session),
        "inputs": InputsScreen(app=app),
    }
    shell = Shell(screens, app=app, session=session, **kwargs)
    profile.follow(shell)
    return shell
