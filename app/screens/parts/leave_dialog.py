"""The question before a robot that moves is left: what becomes of it then."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, StringProperty

from app.screens.parts.dialogs import Question

__all__ = ["LeaveDialog"]

Builder.load_string("""
#:import tr widgets.core.language.tr
<LeaveDialog>:
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
            text: (tr('Leave {robot} while its task runs?') if root.tasked else tr('Leave {robot} while it moves?')).format(robot=root.robot)
            bold: True
            font_size: theme.size_title
        Text:
            text: tr('Its task goes on by itself. Nobody here sees it any more.') if root.tasked else tr('You let go of it: it stops, and nobody here sees it any more.')
            role: 'muted'
            font_size: sp(15)
        BoxLayout:
            size_hint_y: None
            height: theme.target
            spacing: dp(12)
            QuietButton:
                id: leave
                text: tr('Leave')
                on_release: root.answer()
            PrimaryButton:
                id: stay
                text: tr('Stay')
                on_release: root.close()
""")


class LeaveDialog(Question):
    """Calls `on_answer` when the robot is to be left; closed any other way, nothing changes."""

    robot = StringProperty("")
    """Its name."""
    tasked = BooleanProperty(False)
    """A task moves it, and not a hand."""
    wanted = (468.0, 240.0)

    def __init__(self, on_answer: Callable[[], object], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._on_answer = on_answer

    def answer(self) -> None:
        """Leave it."""
        self.close()
        self._on_answer()
