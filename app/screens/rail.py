"""The buttons by which one goes from screen to screen: at the left edge, or along the lower one of a phone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.properties import ListProperty, OptionProperty
from kivy.uix.floatlayout import FloatLayout

from app.arrange import Rect
from app.screens.connect import THEMES
from app.screens.placing import put
from bridge.msgs.pilothouse_msgs import Event
from widgets.kit import NavButton
from widgets.theme import theme

__all__ = ["Rail"]

ENTRIES = {
    "drive": ("sports_esports", "Drive"),
    "mission": ("map", "Mission"),
    "tasks": ("list", "Tasks"),
    "topics": ("data_object", "Topics"),
    "talk": ("mic", "Talk"),
    "control_nav": ("person", "Control"),
    "record": ("fiber_manual_record", "Record"),
    "theme": ("light_mode", "Sunlight"),
}
"""Name of each button to its icon and text; elsewhere than on a phone the third from the end is in the bar. To talk there is one
while voice is on."""
TALKS = {"ready": "accent", "listening": "ok", "loud": "warn", "wrong": "warn"}
"""How voice stands, to the role of the button to talk."""
TALL = 120
"""Height of the button to talk where there is room [dp]."""
UPPER = 4
"""As many stand at the upper end of the edge, the others at the lower."""

Builder.load_string("""
<Rail>:
    size_hint: None, None
    canvas.before:
        Color:
            rgba: theme.surface
        Rectangle:
            pos: self.pos
            size: self.size
        Color:
            rgba: theme.line
        Rectangle:
            pos: (self.x, self.top - theme.outline) if root.form == 'tall' else (self.right - theme.outline, self.y)
            size: (self.width, theme.outline) if root.form == 'tall' else (theme.outline, self.height)
""")


class Rail(FloatLayout):
    """Dispatches `on_press(name)` with the name of the button, and `on_talk(down)` while the one to talk is held."""

    __events__ = ("on_press", "on_talk")

    form = OptionProperty("wide", options=["wide", "short", "tall"])
    """Shape of the window, as in `app.arrange.form`."""
    buttons = ListProperty()
    """In their order."""
    voice = OptionProperty("", options=["", *TALKS])
    """How voice stands; empty while it is off."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._rect, self._dp = Rect(0, 0, 1, 1), 1.0
        for name, (icon, text) in ENTRIES.items():
            button = NavButton(icon=icon, text=text)
            if name == "talk":
                button.bind(state=lambda _, state: self.dispatch("on_talk", state == "down"))
            else:
                button.bind(on_release=lambda _, name=name: self.dispatch("on_press", name))
            self.ids[name] = button
            self.buttons.append(button)

    def arrange(self, rect: Rect, form: str, dp: float) -> None:
        """Put the buttons into `rect`; `dp` is one dp [px]."""
        self.form, tall = form, form == "tall"
        self._rect, self._dp = rect, dp
        put(self, rect)
        absent = ("control_nav" if not tall else "", "talk" if not self.voice else "")
        buttons = [self.ids[name] for name in ENTRIES if name not in absent]
        self.clear_widgets()
        step = rect.width / len(buttons) if tall else min(72 * dp, (rect.height - 24 * dp) / len(buttons))
        high = min(64 * dp, step)
        for index, button in enumerate(buttons):
            self.add_widget(button)
            button.framed = not tall
            button.size = (min(step, 82 * dp), rect.height) if tall else (rect.width - 12 * dp, high)
            button.pos_hint = {}
            if tall:
                button.pos = (rect.x + step * index + (step - button.width) / 2, rect.y)
            elif index >= UPPER:
                button.pos = (rect.x + 6 * dp, rect.y + 12 * dp + (len(buttons) - 1 - index) * step)
            else:
                button.pos = (rect.x + 6 * dp, rect.top - 12 * dp - high - index * step)
        more = self._grow(dp) if form == "wide" and self.voice else 0.0
        self.ids.talk.padding = 0, 10 * dp + more, 0, 9 * dp + more

    def _grow(self, dp: float) -> float:
        """Where there is room the button to talk is found without looking; returns what it has more above and below [px]."""
        talk, low, top = self.ids.talk, self.ids.record.top + 8 * dp, self.ids.topics.y - 8 * dp
        before = talk.height
        talk.height = max(before, min(TALL * dp, top - low))
        talk.y = low + (top - low - talk.height) / 2
        return float(talk.height - before) / 2

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
        if bool(talk) != bool(self.voice):
            self.voice = talk
            self.arrange(self._rect, self.form, self._dp)
        self.voice = talk
        button = self.ids.talk
        button.tint, button.active = TALKS.get(talk, ""), talk == "listening"
        button.text = {"listening": "Listens", "loud": "Too loud"}.get(talk, "Talk")
        tasks = self.ids.tasks
        tasks.count = len(waiting)
        tasks.urgent = any(event.level == "alarm" for event in waiting)
        for name in ENTRIES:
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
