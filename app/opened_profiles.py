"""Layouts that come from outside: a link that the system opens with this app, or a file dropped on its window; each is asked about."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from kivy.clock import Clock
from kivy.core.window import Window

from app.layout.layout import Layout, LayoutError
from app.profiles.profile_choice import ProfileChoice
from app.profiles.profile_link import BadProfileLink, text_of_link
from app.robot_trust import RobotTrust
from widgets.core.language import tr

if TYPE_CHECKING:
    from app.screens.panels.sharing.take_in_dialog import (
        TakeInDialog,
    )  # when something is opened, for a quick start

__all__ = ["OpenedProfiles"]

LOOK_PERIOD = 0.5
"""Between two looks whether the robot is there that a layout waits for [s]."""
SUFFIX = ".toml"


class OpenedProfiles:
    """Holds one layout at most: the newest. Nothing is kept or used before somebody says so. Everything here happens in the UI thread."""

    def __init__(self, app: Any, profiles: ProfileChoice, trust: RobotTrust) -> None:
        """`trust` is told of every link that is opened, and hands on those of layouts."""
        self._app, self._profiles = app, profiles
        self._found: Layout | None = None
        self.dialog: TakeInDialog | None = None
        """The question that is on the glass."""
        self._look = Clock.schedule_interval(self._ask_again, LOOK_PERIOD)
        self._look.cancel()
        trust.on_profile = self.open_link

    def begin(self) -> None:
        """Take files that are dropped on the window from now on."""
        Window.bind(on_drop_file=self._dropped)

    def close(self) -> None:
        """Take nothing any longer."""
        Window.unbind(on_drop_file=self._dropped)
        self._look.cancel()
        self._found = None

    def open_link(self, link: str) -> None:
        """Somebody opened the link of a layout: show what is in it, and ask."""
        try:
            self._open(lambda: text_of_link(link))
        except BadProfileLink as mistake:
            self._app.say(str(mistake), "danger")

    def open_file(self, path: Path) -> None:
        """The same for a file."""
        if path.suffix.lower() != SUFFIX:
            self._app.say(
                tr("{name} is no layout: the file of one ends in {suffix}.").format(
                    name=path.name, suffix=SUFFIX
                ),
                "warn",
            )
            return
        self._open(lambda: self._profiles.store.text(path))

    def _dropped(self, _window: object, name: bytes | str, *_: object) -> None:
        self.open_file(Path(name.decode(errors="replace") if isinstance(name, bytes) else name))

    def _open(self, read: Any) -> None:
        self._found = None
        try:
            self._found = self._profiles.store.read("imported", read())
        except LayoutError as error:
            self._ask(error)
        else:
            self._ask()

    @property
    def _session(self) -> Any:
        """The session with the robot on the glass, once it is known which one it is; None without one."""
        session = self._app.session
        if session is None or self._app.shell is None:
            return None
        return session if session.robot.foreign or session.robot.introduced else None

    def _ask(self, error: LayoutError | None = None) -> None:
        from app.screens.panels.sharing.take_in_dialog import TakeInDialog

        before, self.dialog = self.dialog, None
        if before is not None:
            before.close()
        session = self._session
        name = "" if session is None else session.robot.name
        self.dialog = dialog = TakeInDialog(self._found, name, error.faults if error is not None else ())
        dialog.bind(on_use=lambda _: self._use(), on_close=self._closed)
        self._app.root.add_widget(dialog)
        self._look.cancel()
        if self._found is not None and session is None:
            self._look()  # it is asked about again over the first robot that answers

    def _ask_again(self, _: float) -> None:
        if self._found is not None and self._session is not None:
            self._ask()

    def _use(self) -> None:
        session, found, dialog = self._session, self._found, self.dialog
        if session is None or found is None or dialog is None:
            return
        try:
            self._profiles.adopt(session.robot.info, found)
        except OSError as error:
            dialog.fail(
                tr("The profile could not be saved: {reason}.").format(reason=error.strerror or error)
            )
            return
        panels = self._app.screens.get("panels")
        if panels is not None:
            panels.editor.imported()
        dialog.close()

    def _closed(self, dialog: TakeInDialog) -> None:
        if dialog is not self.dialog:
            return
        self.dialog = None
        if self._session is not None:  # it was asked about over a robot, and that was the answer
            self._found = None
