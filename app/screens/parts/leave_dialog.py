"""The question before a robot is left that this handheld has in hand: what becomes of it then."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import OptionProperty, StringProperty

from app.screens.parts.dialogs import Question
from widgets.core.language import mark, tr

__all__ = ["LeaveDialog"]

REASONS = {
    "task": (
        mark("Leave {robot} while its task runs?"),
        mark("Its task goes on by itself. Nobody here sees it any more."),
    ),
    "moves": (
        mark("Leave {robot} while it moves?"),
        mark("You let go of it: it stops, and nobody here sees it any more."),
    ),
    "control": (
        mark("Leave {robot} and give control back?"),
        mark("Anybody may take control then. Nobody here sees it any more."),
    ),
}
"""Why it is asked, to the question and what becomes of the robot."""

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
            text: root.question
            bold: True
            font_size: theme.size_title
        Text:
            text: root.sentence
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
    cause = OptionProperty("control", options=list(REASONS))
    """Why it is asked: a `task` runs, the robot `moves` or is told to by a hand, or this handheld has `control` of it at rest."""
    question = StringProperty("")
    """What is asked."""
    sentence = StringProperty("")
    """What becomes of the robot then."""
    wanted = (468.0, 240.0)

    def __init__(self, on_answer: Callable[[], object], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        question, sentence = REASONS[self.cause]
        self.question, self.sentence = tr(question).format(robot=self.robot), tr(sentence)
        self._on_answer = on_answer

    def answer(self) -> None:
        """Leave it."""
        self.close()
        self._on_answer()
