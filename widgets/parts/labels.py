"""Labels: plain text, icons, section labels, values with their unit, chips."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

from kivy.input import MotionEvent
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.label import Label
from kivy.uix.widget import Widget

from widgets.core.base import (
    MAX_LABEL_LINES,
    MIN_FONT_SIZE,
    fitting_size,
    least_size,
    line_height,
    text_texture,
)
from widgets.core.surfaces import Pressable
from widgets.core.theme import theme

__all__ = [
    "Chip",
    "FittedLabel",
    "Icon",
    "Remark",
    "SectionLabel",
    "Text",
    "ValueUnit",
    "heading_fits",
    "heading_look",
    "spaced",
    "wrapped",
]

HAIR_SPACE = "\u200a"
SIGN = 19 / 15
"""Size of a chip's icon, in times of its type."""

Builder.load_string("""
<Text>:
    font_name: theme.font
    font_size: theme.size_body
    color: theme.roles[self.role]
    disabled_color: self.color
    text_size: self.width, None
    halign: 'left'
    valign: 'middle'
    size_hint_y: None
    height: self.texture_size[1]

<Remark>:
    role: 'muted'
    font_size: sp(13)
    height: self.texture_size[1] if self.text else 0
    opacity: 1 if self.text else 0

<FittedLabel>:
    font_name: theme.font
    font_size: self.largest
    disabled_color: self.color
    halign: 'center'
    valign: 'middle'
    shorten_from: 'right'

<Icon>:
    font_name: theme.icons
    font_size: theme.size_icon
    color: theme.roles[self.role]
    disabled_color: self.color
    text: icons[self.name]
    size_hint: None, None
    size: self.font_size, self.font_size

<SectionLabel>:
    text: self.title.upper() if self.close else self.spaced_title
    font_size: self.written[0]
    close: self.written[1]
    role: 'muted'
    shorten: True
    shorten_from: 'right'

<ValueUnit>:
    size_hint: None, None
    size: self.minimum_size
    spacing: self.font_size * .16
    Label:
        text: root.value
        font_name: theme.font
        font_size: root.font_size * root.share
        bold: True
        color: theme.roles[root.role]
        disabled_color: self.color
        size_hint: None, None
        size: self.texture_size
    Label:
        text: root.unit
        font_name: theme.font
        font_size: root.unit_size * root.share
        color: theme.muted
        disabled_color: self.color
        size_hint: None, None
        width: self.texture_size[0]
        height: root.font_size * root.share * 1.22
        text_size: None, self.height
        valign: 'bottom'
        padding: 0, 0, 0, (root.font_size - root.unit_size) * root.share * .2

<Chip>:
    size_hint: None, None
    narrowest: theme.least
    height: dp(34)
    width: self.minimum_width
    padding: root.edge + max(0, root.usual_width - words.texture_size[0], (root.narrowest if root.pressable else 0) - 2 * root.edge - sign.width - root.spacing - words.texture_size[0]) / 2, 0
    spacing: dp(8) if root.icon and root.text else 0
    rim: root.role if root.outlined else 'line'
    ground: 'surface' if root.outlined else 'raised'
    corner: self.height / 2
    Icon:
        id: sign
        name: root.icon or 'check'
        role: root.role
        font_size: root.sign_size
        pos_hint: {'center_y': .5}
        width: self.font_size if root.icon else 0
        opacity: 1 if root.icon else 0
    Label:
        id: words
        text: root.text
        font_name: theme.font
        font_size: root.words_size
        color: theme.roles[root.role] if root.outlined or root.tinted else theme.text
        disabled_color: self.color
        size_hint: None, 1
        width: self.texture_size[0]
""")


def spaced(text: str) -> str:
    """`text` as a label above a value: small capitals that stand a little apart."""
    return HAIR_SPACE.join(text.upper())


class Text(Label):
    """A sentence, left aligned, as tall as it needs to be in its width."""

    role = StringProperty("text")
    """Role of its colour."""


class Remark(Text):
    """A smaller text that takes no room while it says nothing."""


class FittedLabel(Label):
    """Words that keep to their room: written smaller, down to 10 sp, then in two lines, then cut short with dots.

    Enlarged text goes on down to 10 dp before it is cut.
    """

    largest = NumericProperty("16sp")
    """Size of type where there is room [px]."""
    room = NumericProperty(0.0)
    """How wide the words may be [px]; 0 for any width."""
    lines = NumericProperty(2)
    """In so many lines they may be written."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name in ("text", "largest", "room", "lines", "bold", "font_name"):
            self.fbind(name, self._fit)
        self._fit()

    def _fit(self, *_: object) -> None:
        size, wraps, cut = self._look()
        self.font_size, self.shorten = size, cut
        self.text_size = (self.room, None) if wraps or cut else (None, None)

    def _look(self) -> tuple[float, bool, bool]:
        """Size of type [px], whether it takes more lines than one, and whether words are left out."""
        if not self.room or not self.text:
            return self.largest, False, False
        size = fitting_size(self.text.split("\n", MAX_LABEL_LINES), self.largest, self.room, bold=self.bold)
        for least in sorted(
            {min(self.largest, sp(MIN_FONT_SIZE)), min(self.largest, least_size())}, reverse=True
        ):
            if size > least or self._width(self.text, least) <= self.room:
                return max(size, least), False, False
            if self.lines > 1 and self._lines_of(least) <= self.lines:
                return least, True, False
        return least, False, True

    def _width(self, text: str, size: float) -> float:
        lines = text.split("\n", MAX_LABEL_LINES)
        return float(max(text_texture(line, size, bold=self.bold).width for line in lines))

    def _lines_of(self, size: float) -> float:
        """How many lines the words take where none of them is broken; infinity where one is too wide by itself, or for too many."""
        count, line = 1, ""
        for word in self.text.split():
            if self._width(word, size) > self.room:
                return math.inf
            longer = f"{line} {word}".strip()
            if self._width(longer, size) > self.room:
                count, longer = count + 1, word
                if count > self.lines:
                    return math.inf
            line = longer
        return count


class Icon(Label):
    """One icon."""

    name = StringProperty("check")
    """As in `widgets.core.icons`."""
    role = StringProperty("text")
    """Role of its colour."""


def heading_look(title: str, room: float, largest: float = 0.0) -> tuple[float, bool]:
    """Size of type [px], `largest` or that of all headings at most, in which one keeps to `room` [px], and whether its letters have to stand close for that."""
    largest, room = (
        largest or theme.size_label,
        max(room - dp(3), 1.0),
    )  # Kivy shortens words that fit to a pixel
    size = fitting_size([spaced(title)], largest, room)
    if text_texture(spaced(title), size, theme.font).width <= room:
        return size, False
    return fitting_size([title.upper()], largest, room), True


def heading_fits(title: str, room: float) -> bool:
    """Whether a heading is read whole in `room` [px]."""
    size, close = heading_look(title, room)
    return not close or text_texture(title.upper(), size, theme.font).width <= room - dp(3)


class SectionLabel(Text):
    """The name over a group of things or over a value, in small capitals."""

    title = StringProperty("")
    spaced_title = StringProperty("")
    look: ListProperty[Any] = ListProperty()
    """Size of its type [px] and whether its letters stand close, where what it belongs to decides that; else its own width does."""
    close = BooleanProperty(False)
    """Its letters do not stand apart."""

    def _written(self) -> tuple[float, bool]:
        return tuple(self.look) if self.look else heading_look(self.title, self.width)

    written = AliasProperty(_written, bind=["title", "width", "look"], cache=True)
    """Size of its type [px], and whether its letters stand close."""

    def on_title(self, *_: object) -> None:
        """Set the letters apart."""
        self.spaced_title = spaced(self.title)


class ValueUnit(BoxLayout):
    """A value, big and bold, with its unit small and muted after it."""

    value = StringProperty("—")
    unit = StringProperty("")
    role = StringProperty("text")
    """Role of the value's colour."""
    font_size = NumericProperty("26sp")
    """Of the value [px]."""
    unit_size = NumericProperty("15sp")
    """Of the unit [px]."""
    room = NumericProperty(0.0)
    """How wide it may be [px]: both are written smaller where they would be wider; 0 for any width."""

    def _share(self) -> float:
        value = text_texture(self.value, self.font_size, theme.font, bold=True).width
        wide = value + text_texture(self.unit, self.unit_size, theme.font).width + self.spacing
        return min(1.0, self.room / wide) if self.room else 1.0

    share = AliasProperty(
        _share, bind=["value", "unit", "font_size", "unit_size", "spacing", "room"], cache=True
    )
    """Part of their sizes that value and unit are written in, 0 to 1."""


def wrapped(name: str, room: float, size: float) -> str:
    """`name` in bold type of `size` broken into lines of `room` [px] after a `/` or `_` where that is possible."""
    lines, line = [], ""
    for piece in re.findall(r"[^/_]*[/_]|[^/_]+", name):
        if line.strip("/_") and text_texture(line + piece, size, theme.font, bold=True).width > room:
            lines.append(line)
            line = ""
        line += piece
    return "\n".join([*lines, line])


class Chip(Pressable, BoxLayout):
    """A pill with an icon and a few words, as wide as they are. A finger may press it where `pressable` is set."""

    icon = StringProperty("")
    """Name of the icon; empty for none."""
    text = StringProperty("")
    role = StringProperty("muted")
    """Role of the icon's colour, and of the text and the border where `outlined`."""
    outlined = BooleanProperty(False)
    """What stands out: border and text in `role`."""
    tinted = BooleanProperty(False)
    """Text in `role`."""
    pressable = BooleanProperty(False)
    edge = NumericProperty("13dp")
    """Left of the icon and right of the words [px]."""
    narrowest = NumericProperty(0)
    """Its least width where it is pressed [px]."""
    largest = NumericProperty("15sp")
    """Size of its type where it is high enough [px]."""
    usual = StringProperty("")
    """The longest words it usually holds; it is never narrower than they are, so that its neighbours stand still."""

    def _words_size(self) -> float:
        return float(min(self.largest, self.height / line_height()))

    words_size = AliasProperty(_words_size, bind=["height", "largest"], cache=True)
    """Of its type [px]: it is no higher than the pill."""

    def _sign_size(self) -> float:
        return float(min(self.largest * SIGN, self.height * 0.78))

    sign_size = AliasProperty(_sign_size, bind=["height", "largest"], cache=True)
    """Of its icon [px]."""

    def _usual_width(self) -> float:
        return float(text_texture(self.usual, self.words_size, theme.font).width) if self.usual else 0.0

    usual_width = AliasProperty(_usual_width, bind=["usual", "words_size"], cache=True)
    """Of those words [px]."""

    def width_with(
        self, words: str, usual: str = "", *, edge: float = math.nan, high: float = 0.0, largest: float = 0.0
    ) -> float:
        """How wide it would be [px] with these words, and no narrower than with the `usual` ones.

        `edge`, height `high` and size of type `largest` [px] are its own where they are not given.
        """
        high, edge = high or self.height, self.edge if math.isnan(edge) else edge
        largest = largest or self.largest
        size = min(largest, high / line_height())
        written = max((text_texture(one, size, theme.font).width for one in (words, usual) if one), default=0)
        sign = min(largest * SIGN, high * 0.78) if self.icon else 0.0
        gap = dp(8) if self.icon and words else 0.0
        return float(max(2 * edge + sign + gap + written, self.narrowest if self.pressable else 0))

    def collide_point(self, x: float, y: float) -> bool:
        """A pressable chip is hit within a whole target above and below its middle; it is no narrower than the least target."""
        reach = max(0.0, theme.target - self.height) / 2 if self.pressable else 0.0
        return self.x <= x <= self.right and self.y - reach <= y <= self.top + reach

    def on_touch_down(self, touch: MotionEvent) -> bool:
        """Leave the finger alone unless this one is there to be pressed."""
        return bool(self.pressable and super().on_touch_down(touch))


def _row(*children: Widget, width: str = "360dp") -> Widget:
    row = BoxLayout(spacing="14dp", size_hint=(None, None), width=width, height="56dp")
    for child in children:
        child.pos_hint = {"center_y": 0.5}
        row.add_widget(child)
    row.add_widget(Widget())
    return row


def samples() -> dict[str, Callable[[], Widget]]:
    """Each kind of text in the states that it knows."""
    return {
        "chips": lambda: _row(
            Chip(icon="bolt", text="87 %", role="ok"),
            Chip(icon="wifi", text="12 ms · 0 lost", role="ok"),
            Chip(icon="autorenew", text="AUTO · patrol", role="plan", outlined=True),
            Chip(text="driven by tablet-B", role="warn", tinted=True),
            width="700dp",
        ),
        "values": lambda: _row(
            ValueUnit(value="0.62", unit="m/s"),
            ValueUnit(value="—", unit="m"),
            ValueUnit(value="−12", unit="°", role="warn"),
            ValueUnit(value="0.42", unit="m/s", room=dp(66)),
        ),
        "labels": lambda: _row(
            SectionLabel(title="Next WP"), Text(text="Driving to point 3.", size_hint_x=2)
        ),
    }
