"""Pages on the glass: the connect page, the inputs page, or the screens of one robot in their frame."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from app.root import Root
from app.screens.connect.connect import ConnectScreen
from app.screens.inputs.page import InputsPage
from app.screens.parts.dialogs import Question
from app.session.session import Session

if TYPE_CHECKING:
    from app.screens.shell.shell import Shell  # made when there is a robot, for a quick start

__all__ = ["Pages"]


class Pages:
    """One page at a time."""

    def __init__(self, root: Root, connect: ConnectScreen, inputs: InputsPage, first_screen: str) -> None:
        """`first_screen` is the screen that is shown of the first robot."""
        self.root, self._connect, self._inputs = root, connect, inputs
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
            shell.replay(post)
        session.events.shown = True
        self.show(self.screen)
        shell.tick()  # nothing comes onto the glass that says less than is known

    def show(self, screen: str) -> None:
        """Put `mission`, `drive`, `tasks`, `topics` or `inputs` of the robot on the glass; KeyError for another."""
        if self.shell is None:
            raise KeyError(screen)
        self.shell.go(screen)
        self.screen = screen
        self.on_show()

    def show_inputs(self) -> None:
        """Put the inputs page on the glass, where there is no robot."""
        self.root.show_page(self._inputs)
        self._inputs.enter()

    def tick_inputs(self) -> None:
        """Bring the inputs page up to date."""
        self._inputs.tick()

    def close_shell(self) -> Shell | None:
        """Let go of the robot's screens; returns their frame, None where there was none."""
        shell, self.shell = self.shell, None
        if shell is not None:
            shell.close()
        return shell

    def show_connect(self) -> None:
        """Put the connect page on the glass."""
        self.root.show_page(self._connect)

    def close_question(self) -> bool:
        """Close the question that is over the page; False where there is none."""
        questions = [child for child in self.root.children if isinstance(child, Question)]
        if questions:
            questions[0].close()
        return bool(questions)

    def back(self) -> bool:
        """Back within the page; False where it has nowhere to go back to."""
        if self.shell is not None:
            return self.shell.back()
        return self._inputs.back()
