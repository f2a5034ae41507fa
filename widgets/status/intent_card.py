"""Command that was understood and not yet done: a bar that acts unless cancelled, or a question that waits for a yes.

card = IntentCard()
card.ask(words="Go home", who="mic", heard="Voice: go home, 82 %", question=True)
card.bind(on_command=lambda _, name: intents.answer(name == "yes"))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.core.language import tr
from widgets.parts.buttons import PushButton
from widgets.status.notice_card import NoticeCard

__all__ = ["IntentCard"]

Builder.load_string("""
<Drain>:
    size_hint_y: None
    height: dp(5)
    canvas:
        Color:
            rgba: theme.raised
        Rectangle:
            pos: self.pos
            size: self.size
        Color:
            rgba: theme.roles[root.role]
        Rectangle:
            pos: self.pos
            size: self.width * root.left, self.height

<IntentCard>:
    padding: dp(14), dp(9) if root.tiny else dp(13)
""")


class Drain(Widget):
    """How much of the time is left, as a bar that runs dry."""

    left = NumericProperty(1.0)
    """1 to 0."""
    role = StringProperty("accent")


class IntentCard(NoticeCard):
    """Dispatches `on_command(name)`: `yes` or `no`."""

    question = BooleanProperty(False)
    """It waits for a yes; else it is done when `left` has run out."""
    words = StringProperty("")
    """What will be done, as on a button."""
    heard = StringProperty("")
    """Who understood what, and how surely."""
    seconds = NumericProperty(0.0)
    """Time until it is done, or until it lapses without an answer [s]."""
    left = NumericProperty(1.0)
    """The same as a share of all the time there is, 1 to 0."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._drain = Drain()
        self.fbind("left", self._drain.setter("left"))
        self.fbind("role", self._drain.setter("role"))
        no, yes = self.add_below((tr("No"), "close", False), (tr("Yes"), "check", True))
        self._rows: dict[bool, tuple[PushButton, ...]] = {
            True: (no, yes),
            False: tuple(self.add_below((tr("Cancel"), "close", True))),
        }
        self.add_widget(self._drain)
        for buttons in self._rows.values():
            for button in buttons:
                name = "yes" if button is yes else "no"
                button.bind(on_release=lambda _, name=name: self.dispatch("on_command", name))
        for name in ("question", "words", "heard", "seconds", "tiny"):
            self.fbind(name, self._write)
        self._write()

    def ask(self, *, words: str, who: str, heard: str, question: bool) -> None:
        """Show what was understood, and by the method with the icon `who`; `count` shows the time that is left."""
        self.words, self.icon, self.heard, self.question = words, who, heard, question
        self.left, self.open = 1.0, True

    def count(self, left: float, whole: float) -> None:
        """So much is left of the whole time [s]."""
        self.seconds = math.ceil(max(0.0, left))
        self.left = max(0.0, min(1.0, left / whole)) if whole > 0 else 0.0

    def _write(self, *_: object) -> None:
        self.role = "warn" if self.question else "accent"
        left = f" · {self.seconds:.0f} s" if self.seconds else ""
        self.headline = f"{self.words}?{left}" if self.question else f"{self.words} in {self.seconds:.0f} s"
        self.said = self.heard
        for question, buttons in self._rows.items():
            row = buttons[0].parent
            wanted = question == self.question
            if wanted != (row.parent is self):
                self.add_widget(row, index=1) if wanted else self.remove_widget(row)
            for button in buttons:
                button.meaning = self.words


def samples() -> dict[str, Callable[[], Widget]]:
    """Waiting to be cancelled, nearly done, asking, on a phone."""

    def make(width: str = "420dp", left: float = 1.4, **kwargs: Any) -> Callable[[], Widget]:
        told: dict[str, Any] = {
            "words": "Resume",
            "who": "mobile_vibrate",
            "heard": "Shake, up and down: 91 % sure.",
            "question": False,
            **kwargs,
        }

        def build() -> Widget:
            card = IntentCard(size_hint_x=None, width=width)
            card.ask(**told)
            card.count(left, 5.0 if told["question"] else 2.0)
            return card

        return build

    asks: dict[str, Any] = {
        "words": "Start patrol",
        "who": "mic",
        "heard": "Voice, “start patrol”: 82 % sure. Yes or no, by any method.",
        "question": True,
    }
    return {
        "waits": make(),
        "nearly": make(left=0.2),
        "asks": make(left=4.2, **asks),
        "phone": make("330dp", left=3.1, **asks),
    }
