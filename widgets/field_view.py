"""Any message as a tree of its fields: names, values, types; a tap folds what has parts.

view = FieldView(type=Imu)
robot.on("/imu/data", view.show)
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable
from dataclasses import replace
from itertools import accumulate
from typing import Any

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    DictProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
    StringProperty,
)
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.widget import Widget

import widgets.labels  # noqa: F401 - its rules draw the rows
from bridge.msgs import Msg
from widgets.base import RobotWidget, age_text, text_texture
from widgets.fields import ARRAY, BRANCH, DASH, LEAF, Path, Row, describe, rows
from widgets.theme import theme

__all__ = ["FieldRow", "FieldView"]

PERIOD = 0.1
"""Between two looks at the newest message [s]: figures that change faster cannot be read."""
VEIL = {"stale": 0.3, "disabled": 0.5}
"""How much of the tree is hidden in a state, 0 to 1."""
NARROW = 560.0
"""A tree narrower than this leaves a little less room before each level [dp]."""

Builder.load_string("""
<FieldRow>:
    size_hint: None, None
    canvas.before:
        Color:
            rgba: theme.raised if root.foldable else (0, 0, 0, 0)
        RoundedRectangle:
            pos: self.x + root.indent - dp(8), self.y + dp(2)
            size: self.width - root.indent + dp(8), self.height - dp(4)
            radius: [theme.corner * .7]
        Color:
            rgba: theme.text[:3] + [.14 if root.state == 'down' else 0]
        RoundedRectangle:
            pos: self.x + root.indent - dp(8), self.y + dp(2)
            size: self.width - root.indent + dp(8), self.height - dp(4)
            radius: [theme.corner * .7]
        Color:
            rgba: theme.line if not root.foldable else (0, 0, 0, 0)
        Rectangle:
            pos: self.x + root.indent, round(self.y)
            size: self.width - root.indent - dp(12), max(1, round(theme.outline))  # less than a pixel comes and goes
    Icon:
        name: 'expand_less' if root.open else 'expand_more'
        role: 'muted'
        font_size: sp(20)
        opacity: 1 if root.foldable else 0
        center_y: root.center_y
        x: root.x + root.indent - dp(2)
    Label:
        text: root.name
        font_name: theme.font
        font_size: sp(15)
        bold: root.foldable
        color: theme.text if root.foldable else theme.muted
        disabled_color: self.color
        shorten: True
        shorten_from: 'right'
        text_size: self.size
        halign: 'left'
        valign: 'middle'
        size_hint: None, None
        size: root.name_width, root.line
        x: root.name_x
        top: root.top - root.lead
    Label:
        text: root.type
        font_name: theme.font
        font_size: sp(12.5)
        color: theme.muted
        disabled_color: self.color
        opacity: 1 if root.type_width else 0
        shorten: True
        shorten_from: 'right'
        text_size: self.size
        halign: 'left'
        valign: 'middle'
        size_hint: None, None
        size: root.type_width, root.line
        x: root.name_x + root.name_width + dp(9)
        top: root.top - root.lead - dp(1)
    Label:
        text: root.value
        font_name: theme.font
        font_size: sp(15)
        bold: True
        color: theme.text if root.kind != 'branch' else theme.muted
        disabled_color: self.color
        shorten: True
        shorten_from: 'right'
        text_size: self.size
        halign: 'right'
        valign: 'middle'
        size_hint: None, None
        size: root.value_width, root.line
        x: root.right - dp(12) - root.value_width
        top: root.top - root.lead
    Label:
        text: root.second
        font_name: theme.font
        font_size: sp(14)
        color: theme.text
        disabled_color: self.color
        shorten: True
        shorten_from: 'right'
        text_size: self.size
        halign: 'left'
        valign: 'middle'
        size_hint: None, None
        size: max(0, root.right - dp(12) - root.name_x), dp(24)
        opacity: 1 if root.second else 0
        x: root.name_x
        y: root.y + dp(6)

<FieldView>:
    ScrollView:
        id: scroll
        size_hint: None, None
        size: root.width - 2 * root.margin, root.height - 2 * root.margin - root.strip
        pos: root.x + root.margin, root.y + root.margin
        do_scroll_x: False
        bar_width: dp(3)
        bar_color: theme.muted
        bar_inactive_color: theme.line
        Widget:
            id: sheet
            size_hint: None, None
            width: scroll.width - dp(6)  # the bar beside the rows
            height: root.length
    Text:
        text: root.notice
        role: 'muted'
        font_size: sp(15)
        padding: dp(10), dp(8)
        pos_hint: {'x': 0, 'top': 1}
""")


def _width(text: str, size: float, *, bold: bool = False) -> float:
    """Of a text [px], with the little that Kivy wants before it shortens none of it; 0 for none."""
    return text_texture(text, size, theme.font, bold=bold).width + dp(1) + 3.0 if text else 0.0


class FieldRow(ButtonBehavior, Widget):
    """One line of the tree. A finger presses it where there is something to fold."""

    kind = StringProperty(LEAF)
    name = StringProperty("")
    type = StringProperty("")
    """ROS type."""
    value = StringProperty("")
    second = StringProperty("")
    """What stands on a line of its own."""
    open = BooleanProperty(False)
    foldable = BooleanProperty(False)
    depth = NumericProperty(0)
    step = NumericProperty("16dp")
    """Farther in for each level [px]."""

    path: Path = ()
    widest = NumericProperty(0.0)
    """Of the values that this field has had [px]: the type does not come and go with the length of a figure."""

    def _indent(self) -> float:
        return dp(10) + self.depth * self.step

    indent = AliasProperty(_indent, bind=["depth", "step"], cache=True)
    """From the left edge to the line's beginning [px]."""

    def _name_x(self) -> float:
        return float(self.x + self.indent + (dp(22) if self.foldable else 0))

    name_x = AliasProperty(_name_x, bind=["x", "indent", "foldable"], cache=True)

    def _line(self) -> float:
        return float(dp(26) if self.kind == ARRAY else self.height)

    line = AliasProperty(_line, bind=["kind", "height"], cache=True)
    """Height of the first line [px]."""

    def _lead(self) -> float:
        return float(dp(5)) if self.kind == ARRAY else 0.0

    lead = AliasProperty(_lead, bind=["kind"], cache=True)

    def _widths(self) -> tuple[float, float, float]:
        """Of name, type and value [px]: the value first, then the name; the type where there is room for all of it."""
        room = self.x + self.width - dp(12) - self.name_x
        value = min(_width(self.value, sp(15), bold=True), room * 0.7)
        name = _width(self.name, sp(15), bold=self.foldable)
        name = max(0.0, min(name, room - value - (dp(10) if value else 0)))
        spare = room - max(value, min(self.widest, room * 0.7)) - name - dp(19)
        kind = _width(self.type, sp(12.5))
        return name, kind if kind <= spare else 0.0, value

    widths = AliasProperty(
        _widths, bind=["width", "name_x", "value", "name", "type", "foldable", "widest"], cache=True
    )

    def _name_width(self) -> float:
        return float(self.widths[0])

    def _type_width(self) -> float:
        return float(self.widths[1])

    def _value_width(self) -> float:
        return float(self.widths[2])

    name_width = AliasProperty(_name_width, bind=["widths"], cache=True)
    type_width = AliasProperty(_type_width, bind=["widths"], cache=True)
    value_width = AliasProperty(_value_width, bind=["widths"], cache=True)

    def on_touch_down(self, touch: Any) -> bool:
        """Leave the finger to the list where nothing can be folded."""
        return bool(self.foldable and super().on_touch_down(touch))


class FieldView(RobotWidget, FloatLayout):
    """The fields of the newest message. Only what is in sight has widgets, and they are brought up to date ten times a second."""

    accepts = (Msg,)

    message = ObjectProperty(None, allownone=True, comparator=lambda one, other: one is other)
    """The newest; None before the first."""
    type = ObjectProperty(None, allownone=True)
    """Class of what is awaited: before the first message its fields are shown with dashes. None for any."""
    now = NumericProperty(math.nan)
    """The robot's clock [s]; NaN leaves ages away."""
    folds = DictProperty()
    """Paths that a finger has opened (True) or folded (False)."""
    lines = ListProperty()
    """Rows of the tree, as `widgets.fields.rows` gives them."""
    edges = ListProperty([0.0])
    """Where each row begins from the top, and where the last one ends [px]."""

    def _length(self) -> float:
        return float(self.edges[-1])

    length = AliasProperty(_length, bind=["edges"], cache=True)
    """Height of the whole tree [px]."""

    def _margin(self) -> float:
        return float(dp(6)) if self.state == "alarm" else 0.0

    margin = AliasProperty(_margin, bind=["state"], cache=True)
    """Between the tree and the outline of an alarm [px]."""

    def _strip(self) -> float:
        return float(dp(28)) if self.state == "alarm" or self.badge else 0.0

    strip = AliasProperty(_strip, bind=["state", "badge"], cache=True)
    """Room above the tree for its age or the sign of an alarm [px], so that they hide nothing."""

    aged = BooleanProperty(True)
    """Says how old it is; False where somebody beside it does."""

    def _badge(self) -> str:
        return age_text(self.age) if self.aged and self.state == "stale" else ""

    badge = AliasProperty(_badge, bind=["state", "age", "aged"], cache=True)

    def _badge_pos(self) -> tuple[float, float]:
        width, height = self.badge_size
        return self.right - width - dp(6), self.top - dp(14) - height / 2

    badge_pos = AliasProperty(_badge_pos, bind=["badge_size", "pos", "size"], cache=True)

    def _veil(self) -> list[float]:
        return [*theme.surface[:3], VEIL.get(self.state, 0.0)]

    veil = AliasProperty(_veil, bind=["state"])
    """Thin: what is old is still to be read."""

    def _notice(self) -> str:
        if self.message is None:
            return "" if self.lines else "Nothing has come yet."
        return "" if self.lines else "This message has no fields."

    notice = AliasProperty(_notice, bind=["message", "lines"], cache=True)

    def __init__(self, **kwargs: Any) -> None:
        self._pool: list[FieldRow] = []
        self._soon = Clock.create_trigger(self._renew, PERIOD)
        self._at_once = Clock.create_trigger(self._renew, -1)
        self._place_soon = Clock.create_trigger(self._place, -1)
        self._write_soon = Clock.create_trigger(self._place, PERIOD)
        super().__init__(**kwargs)
        self.fbind("message", self._on_news)
        for name in ("type", "folds", "size"):
            self.fbind(name, self._at_once)
        self.fbind("now", self._write_soon)
        theme.bind(target=self._follow_target)
        self.ids.scroll.bind(scroll_y=self._place_soon)
        self.ids.sheet.bind(pos=self._place_soon, size=self._place_soon)
        self._at_once()

    def _follow_target(self, *_: object) -> None:
        self._at_once()

    def show(self, msg: Msg) -> None:
        """Take over a message of any type."""
        self.message = msg

    def _on_news(self, *_: object) -> None:
        if not self.lines or self.message is None:
            self._at_once()
        else:
            self._soon()

    def fold(self, path: Path) -> None:
        """Open what is folded at `path`, or fold it."""
        row = next((row for row in self.lines if row.path == path), None)
        if row is not None and row.kind == BRANCH:
            self.folds[path] = not row.open

    def _renew(self, *_: object) -> None:
        """Bring tree and figures up to the newest message."""
        message = self.message if self.message is not None else self.type() if self.type else None
        found = rows(message, self.folds) if message is not None else []
        if self.message is None:  # what has not come needs no second line
            found = [replace(row, kind=LEAF) if row.kind == ARRAY else row for row in found]
        heights = [self._height(row) for row in found]
        edges = [0.0, *accumulate(heights)]
        self.lines = found
        if edges != list(self.edges):
            self.edges = edges
        self._place()

    def _height(self, row: Row) -> float:
        return float(theme.target if row.kind == BRANCH else dp(60) if row.kind == ARRAY else dp(38))

    def _place(self, *_: object) -> None:
        """Lay rows where the eye is; those beyond the edges have no widget."""
        sheet, edges = self.ids.sheet, list(self.edges)
        over = max(0.0, edges[-1] - self.ids.scroll.height) * (1.0 - self.ids.scroll.scroll_y)
        first = max(0, bisect_right(edges, over) - 1)
        last = min(len(self.lines), bisect_left(edges, over + self.ids.scroll.height))
        shown = self.lines[first:last]
        self._fill_pool(len(shown))
        for widget, index in zip(self._pool, range(first, last), strict=False):
            widget.size = sheet.width, edges[index + 1] - edges[index]
            widget.pos = sheet.x, sheet.top - edges[index + 1]
            self._write(widget, self.lines[index])

    def _fill_pool(self, count: int) -> None:
        sheet = self.ids.sheet
        while len(self._pool) < count:
            row = FieldRow()
            row.bind(on_release=lambda row: self.fold(row.path))
            self._pool.append(row)
        for index, row in enumerate(self._pool):
            if index < count and row.parent is None:
                sheet.add_widget(row)
            elif index >= count and row.parent is not None:
                sheet.remove_widget(row)

    def _write(self, widget: FieldRow, row: Row) -> None:
        value, second = describe(row, self.now)
        if self.message is None and row.kind != BRANCH:
            value, second = DASH, ""
        if widget.path != row.path:
            widget.path, widget.widest = row.path, 0.0
        widget.kind, widget.depth = row.kind, row.depth
        widget.step = dp(16 if self.width > dp(NARROW) else 12)
        widget.foldable, widget.open = row.kind == BRANCH, row.open
        widget.name, widget.type = row.name, row.type
        widget.value, widget.second = value, second
        widget.widest = max(widget.widest, _width(value, sp(15), bold=True))


def samples() -> dict[str, Callable[[], Widget]]:
    """Small and large messages, a type made at run time, every state."""
    from widgets.field_samples import battery, cells, diagnostics, imu, picture, scan

    def make(message: Msg | None = None, size: tuple[str, str] = ("388dp", "560dp"), **kwargs: Any) -> Any:
        def build() -> Widget:
            view = FieldView(size_hint=(None, None), size=size, **kwargs)
            if message is not None:
                view.show(message)
            return view

        return build

    return {
        "imu": make(imu(), state="live", now=1763719271.2),
        "scan": make(scan(), state="live"),
        "diagnostics": make(diagnostics(), state="live", folds={("status", 0): True}),
        "learned": make(cells(), ("388dp", "300dp"), state="live"),
        "picture": make(picture(), ("388dp", "180dp"), state="live"),
        "wide": make(imu(), ("700dp", "420dp"), state="live"),
        "never": make(type=type(battery()), size=("388dp", "300dp")),
        "nothing known": make(size=("388dp", "120dp")),
        "stale": make(battery(), ("388dp", "300dp"), state="stale", age=12.0),
        "alarm": make(battery(), ("388dp", "300dp"), state="alarm"),
        "disabled": make(battery(), ("388dp", "300dp"), state="disabled"),
    }
