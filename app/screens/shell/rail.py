"""The buttons by which one goes from screen to screen: at the left edge, or along the lower one of a phone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, ListProperty, OptionProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

from app.layout.arrange import Rect
from app.screens.parts.placing import put
from app.screens.parts.themes import THEMES
from bridge.msgs.pilothouse_msgs import Event
from widgets.core.surfaces import Edged
from widgets.core.theme import theme
from widgets.parts.kit import NavButton, PushButton

__all__ = ["Rail"]

ENTRIES = {
    "drive": ("sports_esports", "Drive"),
    "mission": ("map", "Mission"),
    "tasks": ("list", "Tasks"),
    "topics": ("data_object", "Topics"),
    "setup": ("tune", "Setup"),
    "talk": ("mic", "Talk"),
    "control_nav": ("person", "Control"),
    "record": ("fiber_manual_record", "Record"),
    "theme": ("light_mode", "Sunlight"),
}
"""Name of each button to its icon and text; elsewhere than on a phone the third from the end is in the bar on top. The one to
talk is there while voice is on."""
TALKS = {
    "ready": ("Hold to talk", "accent"),
    "listening": ("Listens", "ink_accent"),
    "loud": ("Too loud", "warn"),
    "wrong": ("Hold to talk", "warn"),
}
"""How voice stands, to the words of the button to talk and the role of its icon."""
BAR_HEIGHT = 60
"""Height of the bar of a phone without the button to talk [dp]."""
MIN_TALK_HEIGHT = 66
"""Height of the button to talk on a phone's side [dp]."""
MAX_TALK_HEIGHT = 120
"""Height of the button to talk where there is room [dp]."""
MIN_STEP = 54
"""Along the lower edge, for a count beside an icon [dp]."""
UPPER_COUNT = 5
"""As many stand at the upper end of the edge, the others at the lower."""

Builder.load_string("""
<Rail>:
    size_hint: None, None
    edge: 'top' if root.form == 'tall' else 'right'

<TalkButton>:
    icon: 'mic'
    text: root.words if root.flow == 'horizontal' else root.words.replace(' to ', ' to\\n').replace('Too ', 'Too\\n')
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
    words = StringProperty(TALKS["ready"][0])

    def on_sign(self, *_: object) -> None:
        """Say it."""
        self.words, self.ink_icon = TALKS[self.sign]


class Rail(Edged, FloatLayout):
    """Dispatches `on_press(name)` with the name of the button, and `on_talk(down)` while the one to talk is held."""

    __events__ = ("on_press", "on_talk")

    form = OptionProperty("wide", options=["wide", "short", "tall"])
    """Shape of the window, as in `app.layout.arrange.form`."""
    buttons = ListProperty()
    """In their order."""
    voice = OptionProperty("", options=["", *TALKS])
    """How voice stands; empty while it is off."""
    talks = BooleanProperty(False)
    """The button to talk is there, for which an upright window has a row of its own."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._rect, self._dp = Rect(0, 0, 1, 1), 1.0
        for name, (icon, text) in ENTRIES.items():
            button: PushButton | NavButton
            if name == "talk":
                button = talk = TalkButton(size_hint=(None, None))
                talk.on_sign()
                talk.bind(state=lambda _, state: self.dispatch("on_talk", state == "down"))
            else:
                button = NavButton(icon=icon, text=text)
                button.bind(on_release=lambda _, name=name: self.dispatch("on_press", name))
            self.ids[name] = button
            self.buttons.append(button)

    def arrange(self, rect: Rect, form: str, dp: float) -> None:
        """Put the buttons into `rect`; `dp` is one dp [px]."""
        self.form, tall = form, form == "tall"
        self._rect, self._dp = rect, dp
        put(self, rect)
        # where there is no room for it, the robot's settings lead there
        cramped = rect.width < MIN_STEP * (len(ENTRIES) - 1) * dp if tall else form == "short" and self.talks
        absent = ("control_nav" if not tall else "", "setup" if cramped else "", "talk")
        buttons = [self.ids[name] for name in ENTRIES if name not in absent]
        self.clear_widgets()
        for button in [*buttons, *([self.ids.talk] if self.talks else [])]:
            self.add_widget(button)
            button.pos_hint = {}
        if tall:
            self._along(buttons, rect, dp)
        else:
            self._below_each_other(buttons, rect, dp)

    def _along(self, buttons: Sequence[Any], rect: Rect, dp: float) -> None:
        """Along the lower edge, the button to talk in a row above them."""
        step = rect.width / len(buttons)
        for index, button in enumerate(buttons):
            button.framed, button.padding = False, (0, 10 * dp, 0, 9 * dp)
            button.size = min(step, 82 * dp), BAR_HEIGHT * dp
            button.pos = rect.x + step * index + (step - button.width) / 2, rect.y
        talk, low = self.ids.talk, rect.y + BAR_HEIGHT * dp
        talk.flow = "horizontal"
        talk.size = min(rect.width - 24 * dp, 560 * dp), max(rect.top - low - 10 * dp, 44 * dp)
        talk.pos = rect.x + (rect.width - talk.width) / 2, low + 2 * dp

    def _below_each_other(self, buttons: Sequence[Any], rect: Rect, dp: float) -> None:
        """Along the left edge, the button to talk between the upper and the lower ones."""
        talk, gap = self.ids.talk, 8 * dp
        room = rect.height - 24 * dp - ((MIN_TALK_HEIGHT * dp + 2 * gap) if self.talks else 0)
        step = min(72 * dp, room / len(buttons))
        upper = UPPER_COUNT - (self.ids.setup not in buttons)
        high, lower = min(64 * dp, step), len(buttons) - upper
        for index, button in enumerate(buttons):
            # what is lower than its icon and its word need gives up its edges first
            edge = max(0.0, min(10 * dp, (high - 43 * dp) / 2))
            button.framed, button.padding = True, (0, edge, 0, max(0.0, edge - dp))
            button.size = rect.width - 12 * dp, high
            if index >= upper:
                button.pos = rect.x + 6 * dp, rect.y + 12 * dp + (len(buttons) - 1 - index) * step
            else:
                button.pos = rect.x + 6 * dp, rect.top - 12 * dp - high - index * step
        low = rect.y + 12 * dp + (lower - 1) * step + high + gap
        top = rect.top - 12 * dp - high - (upper - 1) * step - gap
        talk.flow = "vertical"
        talk.size = rect.width - 6 * dp, max(MIN_TALK_HEIGHT * dp, min(MAX_TALK_HEIGHT * dp, top - low))
        talk.pos = rect.x + 3 * dp, low + (top - low - talk.height) / 2

    def show(
        self,
        screen: str,
        *,
        recording: bool,
        control: tuple[str, str, str],
        waiting: Sequence[Event] = (),
        talk: str = "",
    ) -> None:
        """Bring the looks up to date: which `screen` is on the glass, and what goes on.

        `control` is text, icon and role of the button for control; without a role it looks as the others.
        `waiting` for somebody to see to them are warnings and alarms; they are counted where they are listed.
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
        for name in ENTRIES:
            if name != "talk":
                self.ids[name].active = name == screen
        icon, text, _ = THEMES[theme.name]
        self.ids.theme.icon, self.ids.theme.text = icon, text
        self.ids.record.tint = "danger" if recording else ""
        self.ids.record.icon = "fiber_manual_record_fill" if recording else "fiber_manual_record"
        nav = self.ids.control_nav
        nav.text, nav.icon, nav.tint = control

    def on_talk(self, down: bool) -> None:
        """The button to talk was pressed, or let go."""

    def on_press(self, name: str) -> None:
        """A button was pressed."""
