"""The way to the inputs screen: a chip that shows by icons which methods are armed, struck through which do not work.

A brief one shows one icon and says how many there are.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.metrics import sp
from kivy.properties import BooleanProperty, ListProperty
from kivy.uix.boxlayout import BoxLayout

from app.screens.parts.method_signs import METHOD_SIGNS
from widgets.core.base import text_texture
from widgets.core.language import mark, trn
from widgets.core.surfaces import Pressable
from widgets.core.theme import theme
from widgets.parts.kit import Icon, Text

__all__ = ["InputsChip"]

NO_METHOD_ICON = "tune"
"""Icon while no method is armed."""
BRIEF_COUNT = 1
"""So many icons a brief one shows."""

Builder.load_string("""
<InputsChip>:
    size_hint: None, None
    size: self.minimum_width, dp(34)
    padding: dp(9), 0
    spacing: dp(6)
    rim: 'line'
    ground: 'raised'
    corner: self.height / 2

<MethodSign>:
    role: 'muted' if root.idle else 'warn' if root.struck else 'accent'
    font_size: sp(20)
    pos_hint: {'center_y': .5}
    canvas.after:
        Color:
            rgba: theme.raised if root.struck else (0, 0, 0, 0)
        Line:
            points: self.x + dp(1), self.top - dp(1), self.right - dp(1), self.y + dp(1)
            width: dp(2.4)
        Color:
            rgba: theme.warn if root.struck else (0, 0, 0, 0)
        Line:
            points: self.x, self.top, self.right, self.y
            width: dp(1.2)
""")


class MethodSign(Icon):
    """A method that is armed; struck through while it does not work, muted while it has nothing to work with."""

    struck = BooleanProperty(False)
    idle = BooleanProperty(False)


class InputsChip(Pressable, BoxLayout):
    """Dispatches `on_release`."""

    scan_words = mark("Inputs")
    brief = BooleanProperty(False)
    """It has room for one icon, and for how many methods there are."""
    wordless = BooleanProperty(False)
    """A brief one has no room for words either."""
    methods = ListProperty()
    """Name of each method that is armed, and whether it is well."""
    idle = ListProperty()
    """Names of those that are well and have nothing to work with, as a gamepad that is not plugged in."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.bind(methods=self._draw, idle=self._draw, brief=self._draw, wordless=self._draw)
        self._draw()

    def show(self, methods: Sequence[tuple[str, bool]], idle: Sequence[str] = ()) -> None:
        """Take over which methods are armed, and which of them have nothing to work with."""
        self.methods, self.idle = list(methods), list(idle)

    @property
    def faulty(self) -> bool:
        """A method that is armed does not work."""
        return any(not well for name, well in self.methods if name in METHOD_SIGNS)

    def _draw(self, *_: object) -> None:
        self.clear_widgets()
        told = self._told()
        shown = told[:BRIEF_COUNT] if self.brief else told
        for name, well in shown:
            self.add_widget(
                MethodSign(name=METHOD_SIGNS[name][0], struck=not well, idle=well and name in self.idle)
            )
        if not shown:
            self.add_widget(MethodSign(name=NO_METHOD_ICON, idle=True))
        if len(told) > len(shown) and not self.wordless:
            more = Text(text=_words(len(told)), font_size="14sp", size_hint_x=None)
            more.text_size = None, None
            more.pos_hint = {"center_y": 0.5}
            more.texture_update()
            more.width = more.texture_size[0]
            self.add_widget(more)

    def _told(self) -> list[tuple[str, bool]]:
        # what does not work goes before what does: it must not be the one that has no room
        return sorted((one for one in self.methods if one[0] in METHOD_SIGNS), key=self._rank)

    def width_as(self, *, brief: bool, wordless: bool) -> float:
        """How wide it would be [px] if it were so."""
        count = len(self._told())
        shown = max(1, min(count, BRIEF_COUNT) if brief else count)
        worded = count > shown and not wordless
        more = text_texture(_words(count), sp(14), theme.font).width + self.spacing if worded else 0
        return float(
            self.padding[0] + self.padding[2] + shown * (sp(20) + self.spacing) - self.spacing + more
        )

    def _rank(self, one: tuple[str, bool]) -> tuple[bool, bool, int]:
        return one[1], one[0] in self.idle, list(METHOD_SIGNS).index(one[0])

    def collide_point(self, x: float, y: float) -> bool:
        """It is hit within a whole target round it."""
        up, across = max(0.0, theme.target - self.height) / 2, max(0.0, theme.target - self.width) / 2
        return bool(self.x - across <= x <= self.right + across and self.y - up <= y <= self.top + up)


def _words(count: int) -> str:
    return trn("{count} input", "{count} inputs", count).format(count=count)
