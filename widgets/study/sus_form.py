"""System usability scale: ten sentences with five steps of agreement, none answered beforehand.

form = SusForm()
form.answers  # {"1": 4, "2": 1, …}
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import StringProperty
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the sentences
from widgets.core.theme import theme
from widgets.parts.choices import Segmented
from widgets.study.questionnaire import AnswerRow, AnswerSheet

__all__ = ["ITEMS", "SusForm", "samples"]

ITEMS = (
    "I think that I would like to use this app frequently.",
    "I found this app unnecessarily complex.",
    "I thought this app was easy to use.",
    "I think that I would need the support of a technical person to be able to use this app.",
    "I found the various functions in this app were well integrated.",
    "I thought there was too much inconsistency in this app.",
    "I would imagine that most people would learn to use this app very quickly.",
    "I found this app very awkward to use.",
    "I felt very confident using this app.",
    "I needed to learn a lot of things before I could get going with this app.",
)
"""The sentences of the scale (Brooke 1996, free to use with that source), with `app` for `system`."""
STEPS = ("1", "2", "3", "4", "5")

Builder.load_string("""
<SusItem>:
    padding: dp(12), dp(9), dp(12), dp(9)
    spacing: dp(5)
    Text:
        text: root.sentence
        font_size: sp(16)
    BoxLayout:
        size_hint_y: None
        height: left.height
        Remark:
            id: left
            text: 'Strongly disagree'
        Remark:
            text: 'Strongly agree'
            halign: 'right'
    Remark:
        text: 'No answer yet' if root.lacking else ''
        role: 'warn'
        bold: True
""")


class SusItem(AnswerRow):
    """One sentence and five steps: the answer is 1 to 5."""

    sentence = StringProperty("")

    def __init__(self, number: int, **kwargs: Any) -> None:
        super().__init__(name=str(number), sentence=f"{number}. {ITEMS[number - 1]}", **kwargs)
        self.steps = Segmented(options=list(STEPS), height=max(theme.target, dp(46)))
        self.steps.bind(on_choose=lambda _, value: self.answer(int(value)))
        self.add_widget(self.steps, index=2)

    def on_value(self, _: Widget, value: float) -> None:
        """Show it among the steps."""
        self.steps.value = f"{value:.0f}"


class SusForm(AnswerSheet):
    """Dispatches `on_command(item, value)` with each answer: the item's number as text, and 1 to 5."""

    def __init__(self, now: Callable[[], float] = time.monotonic, **kwargs: Any) -> None:
        """`now` times the answers [s]."""
        rows = {str(number): SusItem(number) for number in range(1, len(ITEMS) + 1)}
        super().__init__(rows, now, **kwargs)


def samples() -> dict[str, Callable[[], Widget]]:
    """Without answers, with some, with some that lack."""

    def made(
        some: int = 0, width: float = 460, *, lacking: bool = False, **more: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            form = SusForm(size_hint=(None, None), width=dp(width), **more)
            for number, item in enumerate(list(form.rows.values())[:some]):
                item.answer((4, 2, 5, 1, 3)[number % 5])
            if lacking:
                form.mark_unanswered()
            return form

        return build

    return {
        "live": made(),
        "full": made(10),
        "lacking": made(7, lacking=True),
        "narrow": made(3, 340),
        "disabled": made(2, state="disabled"),
    }
