"""Pairing with a robot: its code typed by big digits, or its link."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.core.clipboard import Clipboard
from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, StringProperty
from kivy.uix.textinput import TextInput

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.screens.parts.dialogs import Question
from bridge.trust.pairing import BadPairing, PairLink
from widgets.core.language import mark, tr
from widgets.parts.buttons import PushButton

__all__ = ["PairDialog"]

MAX_DIGITS = 8
"""Of a guest's code; a robot's own has six."""
MAX_PASTED = 600
"""Characters that are taken from the clipboard."""
KEYS = ("1", "2", "3", "4", "5", "6", "7", "8", "9", "Paste", "0", "backspace")
HINT = mark(
    "Type the code that the robot shows, or paste its link. A phone's camera opens the QR code by itself."
)
HINT_LINK = mark(
    "Paste the robot's link. A phone's camera opens the QR code by itself. For a code, choose the robot's card."
)

Builder.load_string("""
<PairDialog>:
    short: root.room[3] < dp(520)
    tight: root.room[3] < dp(720)
    key: max(dp(53), theme.least) if root.tight else theme.target
    Card:
        id: card
        size_hint: None, None
        width: min(dp(760) if root.short and root.types else dp(440), root.room[2] - dp(28))
        height: self.minimum_height
        pos: root.room[0] + (root.room[2] - self.width) / 2, root.room[1] + max(dp(8), (root.room[3] - self.height) / 2)
        padding: dp(14) if root.tight else dp(20)
        spacing: dp(8) if root.tight else dp(14)
        BoxLayout:
            size_hint_y: None
            height: max(dp(30), sp(30))
            spacing: dp(10)
            Icon:
                name: 'lock'
                role: 'accent'
                pos_hint: {'center_y': .5}
            Text:
                text: root.title
                bold: True
                font_size: theme.size_title
                shorten: True
                shorten_from: 'right'
                pos_hint: {'center_y': .5}
        Remark:
            text: root.problem or root.sentence
            role: 'danger' if root.problem else 'muted'
        BoxLayout:
            orientation: 'horizontal' if root.short else 'vertical'
            size_hint_y: None
            height: self.minimum_height if root.types else 0
            opacity: 1 if root.types else 0
            disabled: not root.types or root.busy
            spacing: dp(12)
            TextField:
                id: field
                font_size: sp(15) if root.is_link or not root.takes_code else min(sp(22), dp(28)) if root.short else min(sp(34), dp(40))
                height: dp(68)
                halign: 'left' if root.is_link else 'center'
                hint_text: '000 000' if root.takes_code else 'pilothouse://…'
                wrong: bool(root.problem)
                pos_hint: {'center_y': .5}
                on_text: root.problem = ''
                on_text_validate: root.answer()
            Grid:
                id: pad
                cols: 1 if not root.takes_code else 6 if root.short else 3
                spacing: dp(8)
                size_hint_x: None if root.short and root.takes_code else 1
                width: max(root.key * 6 + dp(40), card.width * .6) if root.short and root.takes_code else self.width
                row_default_height: root.key
                height: (len(self.children) + self.cols - 1) // self.cols * (root.key + dp(8)) - dp(8)
                row_force_default: True
        BoxLayout:
            size_hint_y: None
            height: root.key if root.tight else theme.target
            spacing: dp(12)
            QuietButton:
                id: cancel
                text: tr('Cancel')
                on_release: root.close()
            PrimaryButton:
                id: pair
                text: tr('Pairing …') if root.busy else tr('Pair')
                disabled: root.busy
                on_release: root.answer()
""")


class PairDialog(Question):
    """Asks for the code of one robot, for any link, or whether to pair by the link that was opened.

    `on_answer` gets what was typed, and may raise ValueError, whose sentence is shown.
    """

    wanted = (468.0, 560.0)
    title = StringProperty("")
    sentence = StringProperty(HINT)
    problem = StringProperty("")
    """Why it did not work, as a sentence."""
    busy = BooleanProperty(False)
    """An attempt goes on."""
    types = BooleanProperty(True)
    """There is something to type: no link was opened."""
    is_link = BooleanProperty(False)
    """What was typed or pasted is a link and no code."""
    short = BooleanProperty(False)
    """There is no room for the digits below the field."""
    tight = BooleanProperty(False)
    """There is room for them, and none to waste."""
    key = NumericProperty()
    """Height of a key below the field [px]."""
    takes_code = BooleanProperty(True)
    """One robot is asked about, so that its code is enough."""
    digits = NumericProperty(0)
    """So many digits were typed."""

    def __init__(
        self,
        on_answer: Callable[[str], object],
        *,
        robot: str = "",
        link: PairLink | None = None,
        problem: str = "",
        **kwargs: Any,
    ) -> None:
        """`robot` is what the robot is called, empty for any; `link` is one that was opened."""
        super().__init__(**kwargs)
        self._on_answer, self._link = on_answer, link
        self._failed = False
        self.problem = problem
        self.takes_code = bool(robot) or link is not None
        for key in KEYS if self.takes_code else ("Paste",):
            button = PushButton(
                text=key if key != "backspace" else "",
                icon="backspace" if key == "backspace" else "",
                fill="raised",
                border="line",
                ink="text",
                size_hint_y=1,
            )
            button.bind(on_release=lambda _, key=key: self.press(key))
            self.ids.pad.add_widget(button)
        self.ids.field.bind(text=self._typed)
        if link is not None:
            self.types = False
            self.title = tr("Pair with {name}?").format(name=link.name or tr("this robot"))
            self.sentence = tr(
                "Its link names {host}:{port}. Pair only if you opened the link yourself."
            ).format(host=link.host, port=link.port)
        elif robot:
            self.title = tr("Pair with {robot}").format(robot=robot)
        else:
            self.sentence = tr(HINT_LINK)

    def press(self, key: str) -> None:
        """A key below the field was pressed."""
        field = self.ids.field
        if self._failed and key.isdigit():
            field.text = ""  # the next try begins anew
        if key == "Paste":
            field.text = (Clipboard.paste() or "")[:MAX_PASTED].strip()
        elif key == "backspace":
            field.text = "" if self.is_link else field.text.rstrip()[:-1].rstrip()
        elif not self.is_link and self.digits < MAX_DIGITS:
            field.text += key

    def _typed(self, field: TextInput, text: str) -> None:
        """Put a blank into the middle of a code, so that it is read as it is said."""
        self._failed = False
        self.is_link = ":" in text
        plain = "".join(letter for letter in text if letter.isdigit())
        self.digits = len(plain)
        if not self.is_link and plain and all(letter.isdigit() or letter.isspace() for letter in text):
            grouped = " ".join(plain[start : start + 3] for start in range(0, min(len(plain), MAX_DIGITS), 3))
            if grouped != text:
                field.text = grouped

    def fail(self, problem: str) -> None:
        """The attempt failed; the next digit begins a new code."""
        self.busy, self.problem, self._failed = False, problem, True

    def answer(self) -> None:
        """Hand over the link or what was typed; stays open until pairing has ended."""
        if self.busy:
            return
        self.problem = ""
        try:
            self._on_answer(self._link.text if self._link else self.ids.field.text)
        except BadPairing as mistake:
            self.problem = str(mistake)

    def on_close(self) -> None:
        """The keyboard leaves the glass with it."""
        self.ids.field.focus = False
