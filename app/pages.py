"""Pages on the glass: the connect page, the inputs or the setup page, or the screens of one robot in their frame."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, cast

from app.core.optional_parts import bring
from app.link.channels import EVENT
from app.root import Root
from app.screens.connect.connect import ConnectScreen
from widgets.core.language import mark, tr

if TYPE_CHECKING:
    from app.screens.parts.lone_page import LonePage  # all these when they are shown, for a quick start
    from app.screens.shell.shell import Shell
    from app.session.session import Session

__all__ = ["LONE", "Pages", "lone_page", "toggle_help"]

LONE = {
    "inputs": (mark("Inputs"), "app.screens.inputs.screen:InputsScreen"),
    "setup": (mark("Setup"), "app.screens.setup.screen:SetupScreen"),
    "replay": (mark("Replay"), "app.screens.replay.screen:ReplayScreen"),
}
"""Screens that are there without a robot too, by name: the title of their page, and what makes them."""


def lone_page(app: Any, name: str) -> LonePage:
    """The page of `app` that is called so in `LONE`, which is imported when it is first shown."""
    from app.screens.parts.lone_page import LonePage

    title, where = LONE[name]
    return LonePage(tr(title), lambda: bring(where)(app=app), app=app)


def toggle_help(app: Any) -> None:
    """Show what keys and buttons mean over `app`'s page, or hide it; imported when it is first shown."""
    from app.screens.shell import key_help

    key_help.toggle_help(app)


class Pages:
    """One page at a time."""

    def __init__(
        self, root: Root, connect: ConnectScreen, make_lone: Callable[[str], LonePage], first_screen: str
    ) -> None:
        """`make_lone` is called when a page of `LONE` is first shown; `first_screen` is the screen that is shown of the first robot."""
        self.root, self._make_lone = root, make_lone
        self.connect = connect
        """The connect page."""
        self._lone: dict[str, LonePage] = {}
        self.shell: Shell | None = None
        """The frame round the robot's screens; None while no robot is on the glass."""
        self.screen = first_screen
        """Name of the screen that was shown last, which the next robot begins with."""
        self.on_show: Callable[[], object] = lambda: None
        """Called after another screen of the robot came onto the glass."""

    def enter(self, shell: Shell, session: Session) -> None:
        """Put a robot's screens on the glass, with everything that came before them."""
        self.shell = shell
        self.root.show_page(shell)
        for post in session.events.early:
            shell.screens.on_post(EVENT, post)
        session.events.shown = True
        self.show(self.screen)
        shell.tick()  # nothing comes onto the glass that says less than is known

    def replace(self, shell: Shell, screen: str) -> None:
        """Put other screens of the same robot in the place of those on the glass, which are closed."""
        self.shell = shell
        self.root.show_page(shell)
        self.show(screen)
        shell.tick()

    def forget_lone(self) -> tuple[str, object] | None:
        """Let go of the pages that are there without a robot; the name of the one on the glass and what was open there, if any."""
        pages, self._lone = self._lone, {}
        kept = None
        for name, page in pages.items():
            if page.parent is not None:
                kept = name, page.screen.keep()
            page.screen.leave()
        return kept

    def show(self, screen: str) -> None:
        """Put `mission`, `drive`, `tasks`, `topics` or `inputs` of the robot on the glass; KeyError for another."""
        if self.shell is None:
            raise KeyError(screen)
        self.shell.go(screen)
        self.screen = screen
        self.on_show()

    def show_lone(self, name: str) -> None:
        """Put the page of that name in `LONE` on the glass, where there is no robot; KeyError for another."""
        if name not in self._lone:
            self._lone[name] = self._make_lone(name)
        self.root.show_page(self._lone[name])
        self._lone[name].enter()

    def lone(self, name: str) -> LonePage | None:
        """The page of that name; None where it was not needed yet."""
        return self._lone.get(name)

    @property
    def screens(self) -> Mapping[str, Any]:
        """Every screen there is now by its name: `connect`, and those of the robot, each made when it is looked up."""
        connect: dict[str, Any] = {"connect": self.connect}
        if self.shell is None:
            return connect
        return ChainMap(connect, cast("dict[str, Any]", self.shell.screens))

    def screen_of(self, name: str) -> Any:
        """The screen of a name in `LONE`, with a robot or without one; None where it is not there now."""
        if self.shell is not None:
            return self.shell.screens[name]
        page = self._lone.get(name)
        return page.screen if page is not None else None

    def tick_lone(self) -> None:
        """Bring the pages up to date that are there without a robot."""
        for page in list(self._lone.values()):
            page.tick()

    def close_shell(self) -> Shell | None:
        """Let go of the robot's screens; returns their frame, None where there was none."""
        shell, self.shell = self.shell, None
        if shell is not None:
            shell.close()
        return shell

    def close_lone(self) -> None:
        """Let go of what the pages without a robot hold."""
        for page in self._lone.values():
            page.end()

    def show_connect(self) -> None:
        """Put the connect page on the glass."""
        self.root.show_page(self.connect)

    def close_question(self) -> bool:
        """Close the question that is over the page; False where there is none."""
        from app.screens.parts.dialogs import Question

        questions = [child for child in self.root.children if isinstance(child, Question)]
        if questions:
            questions[0].close()
        return bool(questions)

    def back(self) -> bool:
        """Back within the page; False where it has nowhere to go back to."""
        if self.shell is not None:
            return self.shell.back()
        return any(page.back() for page in list(self._lone.values()))
