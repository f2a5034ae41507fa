"""The screens of one robot in their frame, made when there is a robot to show, and each screen when it is first looked at."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from app.core.optional_parts import bring
from app.layout.layout import Layout
from app.layout.layout_choice import LayoutChoice
from app.link.feeds import Post
from app.screens.parts.robot_screen import RobotScreen
from app.screens.parts.screen_table import SCREENS, Entry
from app.screens.shell.screen_host import ScreenHost
from app.screens.shell.screen_set import ScreenSet
from app.screens.shell.shell import Shell, ShellHost
from app.session.session import Session

if TYPE_CHECKING:
    from app.screens.drive.dive import DiveScreen
    from app.screens.drive.drive import DriveScreen

__all__ = ["Profile", "robot_shell"]

DRIVE = {
    "float": "app.screens.drive.drive:DriveScreen",
    "two_sticks": "app.screens.drive.drive:DriveScreen",
    "columns": "app.screens.drive.dive:DiveScreen",
}
"""Module and class of the drive screen of each arrangement."""


class Host(ShellHost, ScreenHost, Protocol):
    """The app, as far as a robot's screens and their frame need it."""


class Profile:
    """The drive screen that is made for the robot: as soon as that says what it is, and anew when it says something else."""

    def __init__(self, app: Host, session: Session, layouts: LayoutChoice) -> None:
        """`layouts` give the one of a robot's model and kind."""
        self._app, self._session, self._layouts = app, session, layouts
        self.layout = self._wanted()
        """The one that is on the glass."""

    def _wanted(self) -> Layout:
        info = self._session.robot.info
        return self._layouts.of(info.model, info.kind)

    def screen(self) -> DriveScreen | DiveScreen:
        """Make its screen."""
        made: DriveScreen | DiveScreen = bring(DRIVE[self.layout.arrangement])(
            self.layout, app=self._app, session=self._session
        )
        return made

    def follow(self, shell: Shell) -> None:
        """Have `shell` show another one when the robot turns out to be something else, and say what is wrong with a layout."""

        def hear(channel: str, _: Post) -> None:
            if channel == "/robot/info" and self._wanted() != self.layout:
                self.layout = self._wanted()
                shell.replace("drive")
                tell()

        def tell() -> None:
            if self._layouts.mistake:
                shell.say(self._layouts.mistake, "warn")

        shell.follow(hear)
        tell()


def robot_shell(
    app: Host, session: Session, layouts: LayoutChoice, before: Shell | None = None, **kwargs: Any
) -> Shell:
    """The frame with every screen in it; `layouts` give the drive screen of a robot's model and kind.

    `before` is the one in whose place it comes, None for the first: what that was told is known here too.
    """
    profile = Profile(app, session, layouts)

    given: dict[str, object] = {"app": app, "session": session}

    def maker(entry: Entry) -> Callable[[], RobotScreen]:
        return lambda: bring(entry.maker)(**{name: given[name] for name in entry.needs})

    makers = {entry.name: maker(entry) if entry.maker else profile.screen for entry in SCREENS}
    screens = ScreenSet(makers, session.now)
    if before is not None:
        screens.take_over(before.screens)
    shell = Shell(screens, app=app, session=session, **kwargs)
    profile.follow(shell)
    return shell
