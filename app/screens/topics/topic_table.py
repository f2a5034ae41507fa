"""Table of topics with its search and heads, and the graph that takes its place."""

from __future__ import annotations

import math
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.screens.topics.topic_figures import COLUMNS, ORDERS, Entry, bytes_text
from app.screens.topics.topic_parts import ICONS
from widgets.core.base import age_text, fitting_size
from widgets.core.geometry import DASH
from widgets.core.language import figure, mark, tr
from widgets.core.surfaces import Pressable

__all__ = ["GRAPH", "TABLE", "HeadCell", "TopicList", "row_of"]

TABLE, GRAPH = "table", "graph"
WIDE = 660.0
"""At this width each figure has its own column with room to spare [sp]."""
LEAST_SHARE = 0.77
"""Of these widths is the least at which there are columns still; narrower, the figures are in the second line of a row."""
STACKED = 360.0
"""Narrower, a row has its name alone in the first line [sp]."""
WORDS = {
    "name": mark("Name"),
    "rate": "Hz",
    "age": mark("Age"),
    "bandwidth": "B/s",
    "publishers": mark("Publ."),
    "subscribers": mark("Subscr."),
}
"""Heads of the columns."""

Builder.load_string("""
#:import tr widgets.core.language.tr
<HeadCell>:
    rim: '' if root.wide else 'line'  # where no column is below it, it is a button that puts in order
    ground: 'bg' if root.wide else 'raised'
    spacing: dp(1)
    Label:
        text: root.words
        font_name: theme.font
        font_size: root.type_size
        bold: bool(root.direction)
        color: theme.text if root.direction else theme.muted
        disabled_color: self.color
        text_size: self.size
        shorten: True
        halign: 'left' if root.leading else 'right' if root.wide else 'center'
        valign: 'middle'
    Icon:
        name: 'expand_less' if root.direction < 0 else 'expand_more'
        role: 'accent'
        font_size: sp(16)
        size_hint_x: None
        width: dp(16) if root.direction else 0
        opacity: 1 if root.direction else 0
        pos_hint: {'center_y': .5}

<TopicList>:
    orientation: 'vertical'
    spacing: dp(6)
    BoxLayout:
        size_hint_y: None
        height: search.height
        spacing: dp(8)
        TextField:
            id: search
            hint_text: tr('Search names and types')
            on_text: root.dispatch('on_search', self.text)
        IconButton:
            id: clear
            icon: 'close'
            role: 'muted'
            bare: True
            width: search.height if search.text else 0
            opacity: 1 if search.text else 0
            disabled: not search.text
            on_release: search.text = ''
        Segmented:
            id: form
            size_hint_x: None
            width: min(dp(190), root.width * .42)
            font_size: sp(15)
            pos_hint: {'center_y': .5}
            options: [('table', tr('Table')), ('graph', tr('Graph'))]
            value: root.form
            on_choose: root.form = args[1]
    BoxLayout:
        id: heads
        size_hint_y: None
        height: theme.target if root.form == 'table' else 0
        opacity: 1 if root.form == 'table' else 0
        disabled: root.form != 'table'
        padding: dp(14) if root.wide else 0, 0
        spacing: 0 if root.wide else dp(4)
    FloatLayout:
        id: frame
        RecycleView:
            id: view
            viewclass: 'TopicRow'
            pos_hint: {'x': 0, 'y': 0}
            size_hint_x: None
            width: frame.width + dp(8)  # the bar beside the cards
            bar_width: dp(3)
            bar_color: theme.muted
            bar_inactive_color: theme.line
            scroll_type: ['bars', 'content']
            RecycleBoxLayout:
                orientation: 'vertical'
                size_hint_y: None
                height: self.minimum_height
                padding: 0, 0, dp(8), 0
                default_size: None, max(theme.target, sp(44) + dp(16)) + dp(8)
                default_size_hint: 1, None
        Text:
            text: root.sentence
            role: 'muted'
            font_size: sp(15)
            pos_hint: {'x': 0, 'top': 1}
            padding: dp(6), dp(10)
""")


class HeadCell(Pressable, BoxLayout):
    """Head of a column: a press puts the lines in its order, another turns that round."""

    words = StringProperty("")
    direction = NumericProperty(0)
    """1 where the greatest is first, -1 where the least is, 0 where another column decides."""
    leading = BooleanProperty(False)
    wide = BooleanProperty(False)
    """The column of its figures is below it."""
    type_size = NumericProperty("14sp")
    """Of its word [px]."""


class TopicList(BoxLayout):
    """The search and what it leaves, as a table; or in its place a graph, which its owner puts into `frame`."""

    __events__ = ("on_search", "on_order")

    sentence = StringProperty("")
    form = StringProperty(TABLE)
    """`table` or `graph`."""
    sorting: ListProperty[Any] = ListProperty(["name", False])
    """One of `ORDERS`, and whether the greatest is first."""
    wide = BooleanProperty(False)
    """Each figure has its own column."""
    share = NumericProperty(1.0)
    """Of their usual widths that the columns have, `LEAST_SHARE` to 1."""
    stacked = BooleanProperty(False)
    """A row has no room beside its name."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.table = self.ids.view.__self__  # `ids` let go of what has no parent
        self.heads: dict[str, HeadCell] = {}
        for name in ORDERS:
            cell = HeadCell(words=tr(WORDS[name]), leading=name == "name")
            cell.bind(on_release=lambda _, name=name: self.put_in_order(name))
            self.heads[name] = cell
            self.ids.heads.add_widget(cell)
        self.bind(width=self._fit, sorting=self._mark, form=self._show_form)
        self._fit()
        self._mark()

    def put_in_order(self, name: str) -> None:
        """By that column: first the greatest, but names from A on; once more the other way round."""
        before, descending = self.sorting
        self.sorting = [name, not descending if before == name else name != "name"]
        self.dispatch("on_order")

    def _mark(self, *_: object) -> None:
        chosen, descending = self.sorting
        for name, cell in self.heads.items():
            cell.direction = (1 if descending == (name != "name") else -1) if name == chosen else 0

    def _fit(self, *_: object) -> None:
        room = self.width / sp(WIDE)
        self.wide, self.share = room >= LEAST_SHARE, min(1.0, max(LEAST_SHARE, room))
        self.stacked = self.width < sp(STACKED)
        each = (self.width - dp(4) * (len(self.heads) - 1)) / len(self.heads)
        sizes = []
        for name, cell in self.heads.items():
            cell.wide = self.wide
            own = COLUMNS.get(name, 0.0) * self.share if self.wide else 0.0
            cell.size_hint_x, cell.width = (None, sp(own)) if own else (1, 0)
            if own or not self.wide:
                sizes.append(fitting_size([cell.words], sp(14), (sp(own) or each) - dp(18), bold=True))
        for cell in self.heads.values():
            cell.type_size = min(sizes)

    def _show_form(self, *_: object) -> None:
        view = self.table
        if (self.form == TABLE) != (view.parent is not None):
            (self.ids.frame.add_widget if view.parent is None else self.ids.frame.remove_widget)(view)

    def on_search(self, text: str) -> None:
        """Something else is looked for."""

    def on_order(self) -> None:
        """Another order is wanted."""


def row_of(entry: Entry, table: TopicList) -> dict[str, Any]:
    """What a `TopicRow` of that table shows of an entry, but for who chooses it."""
    wide = table.wide
    line = entry.line
    stale = line.state == "stale"
    rate = figure(entry.rate, 1) if math.isfinite(entry.rate) and entry.rate >= 0.05 else ""
    flow = " · ".join(part for part in (f"{rate} Hz" if rate else "", bytes_text(entry.bandwidth)) if part)
    ties = [DASH if math.isnan(one) else f"{one:.0f}" for one in (entry.publishers, entry.subscribers)]
    pace = "" if wide else age_text(line.age) if stale else flow
    tied = "" if wide or math.isnan(entry.publishers) else f"{ties[0]} → {ties[1]}"
    alone = table.stacked or (wide and table.share < 1.0)  # the name has its line for itself
    below = (line.use, pace, tied, line.type.rpartition("/")[2]) if alone else (line.type,)
    return {
        "name": line.name,
        "type": " · ".join(part for part in below if part),
        "icon": ICONS.get(line.type, "data_object"),
        "use": "" if alone else line.use,
        "pace": "" if alone else pace,
        "ties": "" if alone else tied,
        "stacked": alone,
        "share": table.share,
        "rate": f"{rate} Hz" if rate else DASH,
        "age": age_text(entry.age) or DASH,
        "bandwidth": bytes_text(entry.bandwidth) or DASH,
        "publishers": ties[0],
        "subscribers": ties[1],
        "wide": wide,
        "listened": line.state == "live" or math.isfinite(entry.bandwidth),
    }
