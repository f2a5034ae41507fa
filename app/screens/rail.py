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
    "control_nav": ("person", "Control"),
    "record": ("fiber_manual_record", "Record"),
    "theme": ("light_mode", "Sunlight"),
}
"""Name of each button to its icon and text; elsewhere than on a phone the third from the end is in the bar."""
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
    """Dispatches `on_press(name)` with the name of the button."""

    __events__ = ("on_press",)

    form = OptionProperty("wide", options=["wide", "short", "tall"])
    """Shape of the window, as in `app.arrange.form`."""
    buttons = ListProperty()
    """In their order."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name, (icon, text) in ENTRIES.items():
            button = NavButton(icon=icon, text=text)
            button.bind(on_release=lambda _, name=name: self.dispatch("on_press", name))
            self.ids[name] = button
            self.buttons.append(button)

    def arrange(self, rect: Rect, form: str, dp: float) -> None:
        """Put the buttons into `rect`; `dp` is one dp [px]."""
        self.form, tall = form, form == "tall"
        put(self, rect)
        buttons = [self.ids[name] for name in ENTRIES if tall or name != "control_nav"]
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

    def show(
        self, screen: str, *, recording: bool, control: tuple[str, str, str], waiting: Sequence[Event] = ()
    ) -> None:
        """Bring the looks up to date: which `screen` is on the glass, and what goes on.

        `control` is text, icon and role of the button for control; without a role it looks as the others.
        `waiting` for somebody to see to them are warnings and alarms; they are counted where they are listed.
        """
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

    def on_press(self, name: str) -> None:
        """A button was pressed."""
