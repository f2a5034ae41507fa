"""Help for the keys of a keyboard and the buttons of a gamepad: caps beside words, in columns that fit the room.

help = KeyHelp()
help.groups = [("Driving", [(["W", "A", "S", "D"], "Drive while held")])]
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.label import Label
from kivy.uix.widget import Widget

from widgets.core.base import Control
from widgets.core.language import tr
from widgets.core.surfaces import Outlined
from widgets.parts.column import Column
from widgets.parts.labels import Text
from widgets.parts.rows import group_label

__all__ = ["KeyCap", "KeyHelp"]

MIN_COLUMN_WIDTH = 260.0
"""A column of it is no narrower [dp]."""
MAX_COLUMNS = 4
"""Columns."""
MIN_ROWS_TOGETHER = 2
"""So many rows of a group stand together at least."""
Group = tuple[str, list[tuple[list[str], str]]]
"""Title, and rows: caps, and what they do."""

Builder.load_string("""
<KeyCap>:
    size_hint: None, None
    size: max(dp(30), self.texture_size[0] + dp(14)), dp(30)
    font_name: theme.font
    font_size: sp(14)
    bold: True
    color: theme.ink_danger if root.grave else theme.text
    disabled_color: self.color
    ground: 'danger' if root.grave else 'raised'
    rim: 'danger' if root.grave else 'line'
    rim_width: 1.5
    corner: dp(7)
    pos_hint: {'center_y': .5}

<HelpRow>:
    size_hint_y: None
    height: max(dp(38), words.height + dp(8))
    spacing: dp(10)
    BoxLayout:
        id: caps
        size_hint_x: None
        width: max(self.minimum_width, dp(92))
        spacing: dp(4)
    Text:
        id: words
        text: root.words
        font_size: sp(15)
        role: 'danger' if root.grave else 'text'
        bold: root.grave
        pos_hint: {'center_y': .5}

<KeyHelp>:
    Roll:
        BoxLayout:
            id: columns
            size_hint_y: None
            height: self.minimum_height
            spacing: dp(24)
            on_height: root.whole = self.height
""")


def flow(groups: Sequence[Group], columns: int) -> list[list[Group]]:
    """`groups` in their order in so many columns, as low as can be; a long group goes on, by its name, in the next column."""
    most = sum(len(rows) + 1 for _, rows in groups)
    for high in range(max(2 * MIN_ROWS_TOGETHER, most // columns), max(2 * MIN_ROWS_TOGETHER, most) + 1):
        made = _pour(groups, high)
        if len(made) <= columns:
            return made
    return [list(groups)] if groups else []


def _pour(groups: Sequence[Group], high: int) -> list[list[Group]]:
    """Columns of at most `high` lines, 4 or more, a name being one; a part of a group is never a single row."""
    made: list[list[Group]] = [[]] if groups else []
    left = high
    for title, rows in groups:
        rest = list(rows)
        while rest:
            fits = len(rest) if left > len(rest) else min(left - 1, len(rest) - MIN_ROWS_TOGETHER)
            if fits < min(MIN_ROWS_TOGETHER, len(rest)) and left < high:
                made.append([])
                left = high
                continue
            made[-1].append((title, rest[:fits]))
            rest, left = rest[fits:], left - fits - 1
    return made


class KeyCap(Outlined, Label):
    """One key or button."""

    grave = BooleanProperty(False)
    """It is STOP."""


class HelpRow(BoxLayout):
    """Caps, and what they do."""

    words = StringProperty("")
    grave = BooleanProperty(False)

    def __init__(self, caps: list[str], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for cap in caps:
            self.ids.caps.add_widget(KeyCap(text=cap, grave=self.grave))


class KeyHelp(Control, BoxLayout):
    """Scrolls where it is higher than its room; asks for nothing."""

    groups = ListProperty()
    """Title of each group and its rows: caps, and what they do. What does `STOP` looks grave."""
    whole = NumericProperty(0)
    """How high it is without scrolling [px]."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._count = 0

    def on_kv_post(self, _: Widget) -> None:
        """Its rule is applied: what it shows can be built."""
        self.bind(groups=self._build, width=self._fit)
        self._build()

    def _columns(self) -> int:
        return max(1, min(MAX_COLUMNS, int((self.width + dp(24)) // dp(MIN_COLUMN_WIDTH + 24))))

    def _fit(self, *_: object) -> None:
        if self._columns() != self._count:
            self._build()

    def _build(self, *_: object) -> None:
        """Groups one below the other, column after column, all about as high."""
        self._count = self._columns()
        columns, before = [], ""
        for groups in flow(self.groups, self._count):
            columns.append(Column(spacing=dp(2), pos_hint={"top": 1}))
            for title, rows in groups:
                columns[-1].add_widget(group_label(f"{title}, continued" if title == before else title))
                before = title
                for caps, words in rows:
                    columns[-1].add_widget(HelpRow(caps, words=words, grave=words == "STOP"))
        self.ids.columns.clear_widgets()
        for column in columns:
            self.ids.columns.add_widget(column)
        if not self.groups:
            self.ids.columns.add_widget(
                Text(text=tr("No keys are assigned."), role="muted", font_size="15sp")
            )


def samples() -> dict[str, Callable[[], Widget]]:
    """On a phone, in two columns, with nothing."""
    groups = [
        ("STOP", [(["Esc", "Space"], "STOP")]),
        ("Driving", [(["W", "A", "S", "D"], "Drive while held"), (["Shift"], "Slower, held with them")]),
        ("Robot", [(["P"], "Pause or resume"), (["B"], "Go home"), (["Page Up"], "Take off")]),
        ("Gamepad", [(["B"], "STOP"), (["Left stick"], "Left control"), (["Start"], "Pause or resume")]),
    ]

    def make(width: str, height: str, shown: list[Any]) -> Callable[[], Widget]:
        return lambda: KeyHelp(groups=shown, size_hint=(None, None), size=(width, height))

    return {
        "phone": make("340dp", "480dp", groups),
        "two columns": make("680dp", "300dp", groups),
        "nothing": make("340dp", "60dp", []),
    }
