"""A tap on control: it is taken or asked for at once, and given back only after a question, as a finger may slip."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.widget import Widget

from app.screens.parts.dialogs import Question
from app.session.session import Session
from widgets.core.language import mark, tr

__all__ = ["ControlToggle", "GiveBackDialog"]

NO_CONTROL = mark("This robot has no control handling: any pushed stick drives it.")

Builder.load_string("""
<GiveBackDialog>:
    Card:
        id: card
        size_hint: None, None
        width: min(dp(440), root.room[2] - dp(28))
        height: self.minimum_height
        x: root.room[0] + (root.room[2] - self.width) / 2
        y: max(root.room[1] + dp(8), root.room[1] + (root.room[3] - self.height) / 2)
        padding: dp(20)
        spacing: dp(14)
        Text:
            text: tr('Give control of {robot} back?').format(robot=root.robot)
            bold: True
            font_size: theme.size_title
        Text:
            text: tr('You drive it no longer, and anybody may take control. A task goes on by itself.')
            role: 'muted'
            font_size: sp(15)
        BoxLayout:
            size_hint_y: None
            height: theme.target
            spacing: dp(12)
            QuietButton:
                id: give_back
                text: tr('Give back')
                on_release: root.answer()
            PrimaryButton:
                id: keep
                text: tr('Keep control')
                on_release: root.close()
""")


class GiveBackDialog(Question):
    """Calls `on_answer` when control is to be given back; left any other way, it is kept."""

    robot = StringProperty("")
    """Name of the robot."""
    wanted = (468.0, 240.0)

    def __init__(self, on_answer: Callable[[], object], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._on_answer = on_answer

    def answer(self) -> None:
        """Give it back."""
        self.close()
        self._on_answer()


class ControlToggle:
    """What a tap on control does."""

    def __init__(self, session: Session, say: Callable[..., None]) -> None:
        """`say` is `Shell.say`."""
        self._session, self._say = session, say
        self.dialog: GiveBackDialog | None = None
        """Asks whether control is to be given back; None while nothing is asked."""

    def toggle(self, page: Widget) -> None:
        """Take control or ask for it, or take back that it is asked for; before giving it up, ask over `page`.

        A robot without any control says so.
        """
        if self._session.control == "none":
            self._say(tr(NO_CONTROL), "info", about="control")
        elif self._session.control == "mine":
            self.dialog = GiveBackDialog(self._give_back, robot=self._session.robot.name)
            page.add_widget(self.dialog)
        else:
            self._session.authority.toggle()

    def tick(self) -> None:
        """Take the question away when control is gone anyway."""
        if self.dialog is not None and self._session.control != "mine":
            self.dialog.close()
            self.dialog = None

    def _give_back(self) -> None:
        if self._session.control == "mine":  # it may be somebody else's by now
            self._session.authority.release()
