"""The system usability scale: ten sentences, each agreed to or not in five steps, none answered beforehand.

form = SusForm()
form.answers  # {"1": 4, "2": 1, …}
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.labels  # noqa: F401 - its rules draw the sentences
from widgets.base import Control
from widgets.choices import Segmented
from widgets.column import Column
from widgets.frames import Outlined
from widgets.theme import theme

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
    ground: 'surface'
    rim: 'warn' if root.lacking else 'line'
    corner: theme.radius
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


class SusItem(Outlined, Column):
    """One sentence and five steps."""

    sentence = StringProperty("")
    answer = NumericProperty(0)
    """1 to 5; 0 for none."""
    lacking = BooleanProperty(False)
    """It was asked for and has no answer."""

    def __init__(self, number: int, **kwargs: Any) -> None:
        super().__init__(sentence=f"{number}. {ITEMS[number - 1]}", **kwargs)
        self.steps = Segmented(options=list(STEPS), height=max(theme.target, dp(46)))
        self.steps.bind(on_choose=lambda _, value: self.choose(int(value)))
        self.add_widget(self.steps, index=2)

    def choose(self, value: int) -> None:
        """Give an answer, 1 to 5."""
        self.answer, self.lacking, self.steps.value = value, False, str(value)


class SusForm(Control, BoxLayout):
    """Dispatches `on_command(item, value)` with each answer: the item's number as text, and 1 to 5."""

    veiled = False

    complete = BooleanProperty(False)
    """Every item has an answer."""

    def __init__(self, now: Callable[[], float] = time.monotonic, **kwargs: Any) -> None:
        """`now` times the answers [s]."""
        super().__init__(**{"orientation": "vertical", "spacing": dp(8), "size_hint_y": None, **kwargs})
        self._now, self._shown = now, now()
        self.bind(minimum_height=self.setter("height"))
        self.order: list[str] = []
        """The items in the order in which they were answered first."""
        self.seconds: dict[str, float] = {}
        """Item to the time of its last answer since the form was shown [s]."""
        self.items = [SusItem(number) for number in range(1, len(ITEMS) + 1)]
        for number, item in enumerate(self.items, 1):
            item.fbind("answer", self._answered, str(number))
            self.add_widget(item)

    @property
    def answers(self) -> dict[str, int]:
        """Number of the item as text to its answer, of those that have one."""
        return {str(number): int(item.answer) for number, item in enumerate(self.items, 1) if item.answer}

    def _answered(self, key: str, _: Widget, value: int) -> None:
        if not value:
            return
        if key not in self.order:
            self.order.append(key)
        self.seconds[key] = round(self._now() - self._shown, 3)
        self.complete = len(self.order) == len(ITEMS)
        self.dispatch("on_command", key, value)

    def miss(self) -> list[str]:
        """Mark the items without an answer, and tell their numbers."""
        for item in self.items:
            item.lacking = not item.answer
        return [str(number) for number, item in enumerate(self.items, 1) if item.lacking]

    def begin(self) -> None:
        """Show it anew: without answers, and from now on timed."""
        self.order, self.seconds, self._shown, self.complete = [], {}, self._now(), False
        for item in self.items:
            item.answer, item.lacking, item.steps.value = 0, False, ""


def samples() -> dict[str, Callable[[], Widget]]:
    """Without answers, with some, with some that lack."""

    def made(
        some: int = 0, width: float = 460, *, lacking: bool = False, **more: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            form = SusForm(size_hint=(None, None), width=dp(width), **more)
            for number, item in enumerate(form.items[:some]):
                item.choose((4, 2, 5, 1, 3)[number % 5])
            if lacking:
                form.miss()
            return form

        return build

    return {
        "live": made(),
        "full": made(10),
        "lacking": made(7, lacking=True),
        "narrow": made(3, 340),
        "disabled": made(2, state="disabled"),
    }
