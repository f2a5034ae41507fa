"""The buttons by which one goes from screen to screen: at a side, or along the lower one of a phone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.metrics import sp
from kivy.properties import BooleanProperty, ListProperty, OptionProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

from app.layout.arrange import Rect
from app.screens.parts.placing import put
from app.screens.parts.screen_table import MORE, SCREENS, beyond, tabs
from bridge.msgs.pilothouse_msgs import Event
from widgets.core.base import fitting_size, line_height
from widgets.core.language import mark, tr
from widgets.core.surfaces import Edged
from widgets.core.theme import theme
from widgets.parts.kit import NavButton, PushButton

__all__ = ["Rail"]

TALKS = {
    "ready": (mark("Hold to talk"), "accent"),
    "listening": (mark("Listens"), "ink_accent"),
    "loud": (mark("Too loud"), "warn"),
    "wrong": (mark("Hold to talk"), "warn"),
}
"""How voice stands, to the words of the button to talk and the role of its icon. The button is there while voice is on."""
BAR_HEIGHT = 60
"""Height of the bar of a phone without the button to talk [dp]."""
NEED = 43
"""Height of an icon and its word, one above the other [sp]."""
MIN_TALK_HEIGHT = 66
"""Height of the button to talk on a phone's side [dp]."""
MAX_TALK_HEIGHT = 120
"""Height of the button to talk where there is room [dp]."""
Builder.load_string("""
<Rail>:
    size_hint: None, None
    edge: 'top' if root.form == 'tall' else 'left' if root.at_right else 'right'

<TalkButton>:
    icon: 'mic'
    text: root.words if root.flow == 'horizontal' else root.words.replace(' ', '\\n', 1)
    fill: 'accent' if root.sign == 'listening' else 'raised'
    border: 'accent' if root.sign in ('ready', 'listening') else 'warn'
    rim_width: dp(2)
    padding: dp(4), 0
    ink: 'ink_accent' if root.sign == 'listening' else 'text'
""")


class TalkButton(PushButton):
    """Raised from what is beside it, because it is held and leads nowhere."""

    sign = OptionProperty("ready", options=list(TALKS))
    """How voice stands."""
    words = StringProperty("")

    def on_sign(self, *_: object) -> None:
        """Say it."""
        words, self.ink_icon = TALKS[self.sign]
        self.words = tr(words)


class Rail(Edged, FloatLayout):
    """Dispatches `on_press(name)` with the name of the button, and `on_talk(down)` while the one to talk is held."""

    __events__ = ("on_press", "on_talk")

    form = OptionProperty("wide", options=["wide", "short", "tall"])
    """Shape of the window, as in `app.layout.arrange.form`."""
    at_right = BooleanProperty(False)
    """It is at the right of a window that is not upright, not at the left."""
    buttons = ListProperty()
    """In their order."""
    voice = OptionProperty("", options=["", *TALKS])
    """How voice stands; empty while it is off."""
    talks = BooleanProperty(False)
    """The button to talk is there, for which an upright window has a row of its own."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._rect, self._dp = Rect(0, 0, 1, 1), 1.0
        for entry in SCREENS:
            if entry.edge or entry.name == MORE:
                button = NavButton(icon=entry.icon, text=tr(entry.words))
                button.bind(on_release=lambda _, name=entry.name: self.dispatch("on_press", name))
                self.ids[entry.name] = button
                self.buttons.append(button)
        self.ids["talk"] = talk = TalkButton(size_hint=(None, None))
        talk.on_sign()
        talk.bind(state=lambda _, state: self.dispatch("on_talk", state == "down"))

    def arrange(self, rect: Rect, form: str, dp: float) -> None:
        """Put the buttons into `rect`; `dp` is one dp [px]."""
        self.form, tall = form, form == "tall"
        self._rect, self._dp = rect, dp
        put(self, rect)
        buttons = [self.ids[entry.name] for entry in tabs(form)]
        self.clear_widgets()
        for button in [*buttons, *([self.ids.talk] if self.talks else [])]:
            self.add_widget(button)
            button.pos_hint = {}
        if tall:
            self._along(buttons, rect, dp)
        else:
            self._below_each_other(buttons, rect, dp)
        inner = buttons[0].inner
        high = max(12.5 * dp, (inner - max(24 * dp, inner * 0.55)) / line_height())
        room = min(button.width for button in buttons) - 6 * dp
        size = fitting_size([button.text for button in buttons], min(sp(12.5), high), room)
        for button in buttons:
            button.type_size = size

    def _along(self, buttons: Sequence[Any], rect: Rect, dp: float) -> None:
        """Along the lower edge, the button to talk in a row above them."""
        step = rect.width / len(buttons)
        bar = max(BAR_HEIGHT * dp, theme.least)
        for index, button in enumerate(buttons):
            edge = max(3 * dp, min(10 * dp, (bar - sp(NEED)) / 2 + 2 * dp))
            button.framed, button.padding = False, (0, edge, 0, edge - dp)
            button.size = min(step, 96 * dp), bar
            button.pos = rect.x + step * index + (step - button.width) / 2, rect.y
        talk, low = self.ids.talk, rect.y + bar
        talk.flow = "horizontal"
        talk.size = min(rect.width - 24 * dp, 560 * dp), max(rect.top - low - 10 * dp, 44 * dp)
        talk.pos = rect.x + (rect.width - talk.width) / 2, low + 2 * dp

    def _below_each_other(self, buttons: Sequence[Any], rect: Rect, dp: float) -> None:
        """Along the side from its upper end, the button to talk at the lower."""
        talk, gap = self.ids.talk, 8 * dp
        room = rect.height - 24 * dp - ((MIN_TALK_HEIGHT * dp + gap) if self.talks else 0)
        least = theme.least
        step = min(max(72 * dp, least), room / len(buttons))
        high = min(max(64 * dp, least), step)
        for index, button in enumerate(buttons):
            # what is lower than its icon and its word need gives up its edges first
            edge = max(0.0, min(10 * dp, (high - sp(NEED)) / 2))
            button.framed, button.padding = True, (0, edge, 0, max(0.0, edge - dp))
            button.size = rect.width - 12 * dp, high
            button.pos = rect.x + 6 * dp, rect.top - 12 * dp - high - index * step
        low = rect.y + 12 * dp
        top = rect.top - 12 * dp - high - (len(buttons) - 1) * step - gap
        talk.flow = "vertical"
        talk.size = rect.width - 6 * dp, max(MIN_TALK_HEIGHT * dp, min(MAX_TALK_HEIGHT * dp, top - low))
        talk.pos = rect.x + 3 * dp, low

    def show(self, screen: str, *, waiting: Sequence[Event] = (), talk: str = "") -> None:
        """Bring the looks up to date: which `screen` is on the glass, and what goes on.

        `waiting` for somebody to see to them are the warnings and alarms that ask for something, as of `Logbook.asking`; they are
        counted where they are listed.
        `talk` is how voice stands, of `TALKS`, empty while it is off.
        """
        self.voice = talk
        self.ids.talk.sign = talk or "ready"
        if bool(talk) != self.talks:
            self.talks = bool(talk)
            self.arrange(self._rect, self.form, self._dp)
        tasks = self.ids.tasks
        tasks.count = len(waiting)
        tasks.urgent = any(event.level == "alarm" for event in waiting)
        lit = MORE if screen in {entry.name for entry in beyond(self.form)} else screen
        for entry in SCREENS:
            if entry.name in self.ids:
                self.ids[entry.name].active = entry.name == lit

    def on_talk(self, down: bool) -> None:
        """The button to talk was pressed, or let go."""

    def on_press(self, name: str) -> None:
        """A button was pressed."""
