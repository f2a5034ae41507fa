"""Steps for what takes more than a press, as large buttons: two switches work a map or a stick with them.

pad = ScanPad(title="Map", rows=[[PadKey("up", "Up", "arrow_upward", repeats=True)], [PadKey("done", "Done", "check")]])
pad.bind(on_key=lambda _, name: print(name))
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the words
from widgets.core.language import mark
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme
from widgets.parts.buttons import QuietButton

__all__ = ["PadButton", "PadKey", "ScanPad"]

Builder.load_string("""
<PadButton>:
    border: 'accent' if root.on else 'line'
    ink: 'accent' if root.on else 'text'
    padding: dp(4), 0

<ScanPad>:
    orientation: 'vertical'
    size_hint: None, None
    height: self.minimum_height
    padding: dp(10)
    spacing: dp(8)
    rim: 'accent'
    ground: 'surface'
    corner: theme.radius
    Text:
        id: title
        text: root.title
        bold: True
        font_size: sp(15)
        height: self.texture_size[1] if self.text else 0
    Remark:
        text: root.remark
        role: root.remark_role
    BoxLayout:
        id: grid
        orientation: 'vertical'
        size_hint_y: None
        height: self.minimum_height
        spacing: dp(6)
""")


@dataclass(frozen=True, slots=True)
class PadKey:
    """One button."""

    name: str
    """What `on_key` says."""
    text: str = ""
    icon: str = ""
    words: str = ""
    """What it does, where its text is short; the text when empty."""
    repeats: bool = False
    """Is pressed several times in a row."""
    on: bool = False
    """What it switches is on."""
    able: bool = True
    wide: float = 1.0
    """How many ordinary keys it takes the room of."""


class PadButton(QuietButton):
    """One of them."""

    name = StringProperty("")
    scan_words = StringProperty("")
    """What it does, in words."""
    repeats = BooleanProperty(False)
    on = BooleanProperty(False)
    """What it switches is on."""


class ScanPad(Outlined, BoxLayout):
    """Dispatches `on_key(name)` for the key that was pressed. Its keys are scanned row by row, as they stand."""

    __events__: tuple[str, ...] = ("on_key",)

    title = StringProperty("")
    """What it works."""
    remark = StringProperty("")
    """How that stands; empty for nothing."""
    remark_role = StringProperty("muted")
    rows = ListProperty()
    """Lists of `PadKey`, from the top."""
    high = NumericProperty(0)
    """Of a key [px]; 0 as high as a finger needs."""

    def _least(self) -> float:
        keys = max((sum(key.wide for key in row) for row in self.rows), default=1)
        return float(keys * theme.target * 1.1 + dp(40))

    least = AliasProperty(_least, bind=["rows"], cache=True)
    """So wide it must be, that a finger finds its keys too [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self.keys: dict[str, PadButton] = {}
        """The buttons by the names of their keys."""
        super().__init__(**kwargs)
        self.fbind("rows", self._write)
        self.fbind("high", self._write)
        self._write()

    def _write(self, *_: object) -> None:
        """Keys that are there already stay the same widgets: a mark that is on one stays on it."""
        grid, kept, self.keys = self.ids.grid, self.keys, {}
        for line in grid.children[:]:
            line.clear_widgets()
        grid.clear_widgets()
        for row in self.rows:
            high = self.high or theme.target
            line = BoxLayout(size_hint_y=None, height=high, spacing=dp(6))
            for key in row:
                button = kept.get(key.name) or self._made(key.name)
                self._label(button, key, high)
                self.keys[key.name] = button
                line.add_widget(button)
            grid.add_widget(line)

    def _made(self, name: str) -> PadButton:
        button = PadButton(name=name)
        button.bind(on_release=lambda one: self.dispatch("on_key", one.name))
        return button

    def _label(self, button: PadButton, key: PadKey, high: float) -> None:
        button.text, button.icon, button.on = key.text, key.icon, key.on
        button.scan_words = key.words or key.text
        button.repeats, button.disabled = key.repeats, not key.able
        button.flow = "vertical" if key.icon and key.text else "horizontal"
        button.height, button.size_hint_x = high, key.wide

    def on_key(self, name: str) -> None:
        """The key of that name was pressed."""

    def on_touch_down(self, touch: Any) -> bool:
        """Nothing behind it gets a finger."""
        return bool(super().on_touch_down(touch) or self.collide_point(*touch.pos))


STICK = [
    [
        PadKey("left", mark("Left"), "arrow_back", repeats=True),
        PadKey("ahead", mark("Ahead"), "arrow_upward", repeats=True),
        PadKey("right", mark("Right"), "arrow_forward", repeats=True),
    ],
    [
        PadKey("half", mark("Slow"), "speed", on=True),
        PadKey("back", mark("Back"), "arrow_downward", repeats=True),
        PadKey("done", mark("Done"), "check"),
    ],
]
"""For the samples here."""


def samples() -> dict[str, Callable[[], Widget]]:
    """A stick's, one that says how things stand, one of a few keys, some that cannot be pressed."""

    def make(wide: float = 360, **kwargs: Any) -> Callable[[], Widget]:
        return lambda: ScanPad(width=dp(wide), **{"title": "Stick", "rows": STICK, **kwargs})

    two = [[PadKey("no", "Not now", "close"), PadKey("yes", "Release STOP", "lock_open")]]
    dull = [
        [
            PadKey("less", "Less", "remove", able=False),
            PadKey("more", "More", "add"),
            PadKey("done", "Done", "check"),
        ]
    ]
    return {
        "stick": make(),
        "remark": make(remark="Drives for 1 s at each press."),
        "narrow": make(250),
        "two": make(title="STOP is pressed", rows=two),
        "not able": make(title="Speed", remark="0.20 m/s", rows=dull),
    }
