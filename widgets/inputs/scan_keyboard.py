"""Keyboard for two switches: rows of letters, the frequent ones first, and whole words that are likely.

keyboard = ScanKeyboard(title="Search", text="of", words=["Office 12", "Lab"])
keyboard.bind(on_type=lambda _, text: field.setter("text")(field, text), on_enter=lambda _: field.dispatch("on_text_validate"))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.metrics import dp, sp
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.core.language import mark, tr
from widgets.core.theme import theme
from widgets.inputs.scan_keys import COLUMNS, completed, guesses, laid_out
from widgets.inputs.scan_pad import PadKey, ScanPad

__all__ = ["ScanKeyboard"]

CURSOR = "|"
"""Stands behind what was typed."""
NAMED = {
    " ": mark("Space"),
    ".": mark("Dot"),
    ":": mark("Colon"),
    "-": mark("Hyphen"),
    "/": mark("Slash"),
    ",": mark("Comma"),
    "'": mark("Apostrophe"),
}
"""Letters that have a spoken name."""
SHOWN = {" ": "space"}
MIN_ROOMY_KEY_HEIGHT, MIN_KEY_HEIGHT = 40.0, 26.0
"""A key is no higher where there are many, and never lower [dp]."""


class ScanKeyboard(ScanPad):
    """Dispatches `on_type(text)` with each change, `on_enter` and `on_done`.

    Its first row holds what is needed most: the likely words, to delete, to be done.
    """

    __events__ = ("on_type", "on_enter", "on_done")

    text = StringProperty("")
    """What was typed so far."""
    words: ListProperty[str] = ListProperty()
    """What is likely to be typed, the likeliest first."""
    kind = OptionProperty("text", options=["text", "url", "number", "tel"])
    """What is typed: decides which letters come first."""
    capital = BooleanProperty(False)
    """The next letter is a capital."""
    room = NumericProperty(0)
    """Height that there is for it [px]; 0 for as much as it likes."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name in ("text", "words", "kind", "capital", "room"):
            self.fbind(name, self._lay)
        self._lay()

    def _lay(self, *_: object) -> None:
        letters = laid_out(self.kind, COLUMNS)
        self.remark = f"{self.text[-30:]}{CURSOR}"
        self.remark_role = "text"
        likely = guesses(self.text, self.words)
        rows = [self._first(), *([self._likely(likely)] if likely else [])]
        rows += [[self._letter(letter) for letter in line] for line in letters]
        spare = self.room - sp(15) * 3 - dp(40)
        high = theme.target if not self.room else min(theme.target, spare / len(rows) - dp(6))
        self.high = max(dp(MIN_KEY_HEIGHT), min(high, max(dp(MIN_ROOMY_KEY_HEIGHT), high)))
        self.rows = rows

    @staticmethod
    def _likely(words: list[str]) -> list[PadKey]:
        return [
            PadKey(f"word{number}", word, words=tr("Word {word}").format(word=word))
            for number, word in enumerate(words)
        ]

    def _first(self) -> list[PadKey]:
        return [
            PadKey("enter", tr("Done"), "", wide=1.4),
            PadKey("delete", "", "backspace", tr("Delete a letter"), repeats=True, able=bool(self.text)),
            PadKey("capital", "aA", "", tr("Capital letter"), on=self.capital),
            PadKey("clear", "", "delete_sweep", tr("Delete all"), able=bool(self.text)),
            PadKey("leave", "", "close", tr("Leave as it is now")),
        ]

    def _letter(self, letter: str) -> PadKey:
        said = letter.upper() if self.capital else letter
        name = tr(NAMED.get(letter, said))
        return PadKey(f"letter{letter}", SHOWN.get(letter, said), "", name)

    def on_key(self, name: str) -> None:
        """A key was pressed."""
        if name == "enter":
            self.dispatch("on_enter")
        elif name == "leave":
            self.dispatch("on_done")
        elif name == "capital":
            self.capital = not self.capital
        elif name == "delete":
            self._type(self.text[:-1])
        elif name == "clear":
            self._type("")
        elif name.startswith("word"):
            self._type(completed(self.text, self.keys[name].text))
        else:
            letter = name.removeprefix("letter")
            self._type(self.text + (letter.upper() if self.capital else letter))
            self.capital = False

    def _type(self, text: str) -> None:
        if text != self.text:
            self.text = text
            self.dispatch("on_type", text)

    def on_type(self, text: str) -> None:
        """What is typed is `text` now."""

    def on_enter(self) -> None:
        """It is complete."""

    def on_done(self) -> None:
        """Nothing more is typed."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Empty, with words that are likely, for addresses, for numbers, low."""

    def make(wide: float = 392, **kwargs: Any) -> Callable[[], Widget]:
        return lambda: ScanKeyboard(width=dp(wide), **{"title": "Search", **kwargs})

    return {
        "empty": make(),
        "likely": make(text="to of", words=["Office 12", "Office 9", "Lab"]),
        "address": make(title="Address", kind="url", text="192.168.", words=["192.168.1.7:9090"]),
        "number": make(title="Seconds", kind="number", text="12"),
        "capital": make(text="L", capital=True),
        "low": make(800, room=dp(380)),
    }
