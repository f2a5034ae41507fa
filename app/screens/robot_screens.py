"""The screens of one robot in their frame, made when there is a robot to show, and each screen when it is first looked at."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from app.core.optional_parts import bring
from app.layout.layout import Layout
from app.link.feeds import Post
from app.profiles.profile_choice import ProfileChoice
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

    def __init__(self, app: Host, session: Session, profiles: ProfileChoice) -> None:
        """`profiles` give the robot's own, or the one of its model and kind."""
        self._app, self._session, self._profiles = app, session, profiles
        self.layout = self._wanted()
        """The one that is on the glass."""

    def _wanted(self) -> Layout:
        return self._profiles.of(self._session.robot.info)

    def screen(self) -> DriveScreen | DiveScreen:
        """Make its screen."""
        made: DriveScreen | DiveScreen = bring(DRIVE[self.layout.arrangement])(
            self.layout, app=self._app, session=self._session
        )
        return made

    def follow(self, shell: Shell) -> None:
        """Have `shell` show another one when the robot turns out to be something else, and say what is wrong with a layout."""

        def hear(channel: str, _: Post) -> None:
            if channel == "/robot/info":
                look()

        def look() -> None:
            before, self.layout = self.layout, self._wanted()
            if _drive_part(self.layout) != _drive_part(before):
                shell.replace("drive")
                tell()

        def tell() -> None:
            if self._profiles.mistake:
                shell.say(self._profiles.mistake, "warn")

        def let_go() -> None:
            if self._profiles.on_change is look:  # else another frame has come in its place
                self._profiles.on_change = lambda: None

        shell.follow(hear)
        self._profiles.on_change = look
        shell.at_close.append(let_go)
        tell()


def robot_shell(
    app: Host, session: Session, profiles: ProfileChoice, before: Shell | None = None, **kwargs: Any
) -> Shell:
    """The frame with every screen in it; `profiles` give the drive screen of a robot and its views.

    `before` is the one in whose place it comes, None for the first: what that was told is known here too.
    """
    profile = Profile(app, session, profiles)

    given: dict[str, object] = {"app": app, "session": session, "profiles": profiles}

    def maker(entry: Entry) -> Callable[[], RobotScreen]:
        return lambda: bring(entry.maker)(**{name: given[name] for name in entry.needs})

    makers = {entry.name: maker(entry) if entry.maker else profile.screen for entry in SCREENS}
    screens = ScreenSet(makers, session.now)
    if before is not None:
        screens.take_over(before.screens)
    shell = Shell(screens, app=app, session=session, **kwargs)
    profile.follow(shell)
    return shell


def _drive_part(layout: Layout) -> Layout:
    """The layout without what the drive screen does not show."""
    return replace(layout, name="", title="", robots=(), views=())
