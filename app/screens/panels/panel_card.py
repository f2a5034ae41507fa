"""Card of a panel: its name over its widget, tabs where several lie in one place, and what an editor presses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp, mm, sp
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.label import Label
from kivy.uix.stencilview import StencilView
from kivy.uix.widget import Widget

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from widgets.core.base import MIN_FONT_SIZE
from widgets.core.canvas_ink import Ink
from widgets.core.geometry import Points
from widgets.core.shapes import Shapes
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme

__all__ = ["CardTab", "Corner", "PanelCard", "dashed"]

HEAD = 30
"""Height of the name's row while nothing is edited [dp]."""
DASH, PERIOD = 4.5, 8.0
"""Of the border of a card that is edited [dp]."""
MIN_BUTTON = 10.5
"""Width of a button beside a name [mm]."""
FIGURE = 30
"""Type of a figure that has room [sp]."""
LINE = 1.25
"""Height of a line of type, in times of its size."""
TITLE_ROOM = 110
"""Least room for a name beside the signs of its card [dp]."""
LEAST = 60
"""Height that a widget keeps below two rows of a head [dp]."""

Builder.load_string("""
<PanelCard>:
    size_hint: None, None
    rim: '' if root.editing else 'line'
    ground: 'surface'
    corner: theme.radius
    SectionLabel:
        id: heading
        title: '' if root.count > 1 else root.title if root.width - root.taken > dp(190) else root.brief
        size_hint: None, None
        x: root.x + dp(14)
        y: root.top - dp(2) - (root.name_row + self.height) / 2
        opacity: 1 if root.name_row else 0
        width: max(root.width - dp(24) - root.taken, dp(1))
    BoxLayout:
        id: stack
        size_hint: None, None
        height: root.name_row if root.count > 1 else 0
        opacity: 1 if root.name_row else 0
        x: root.x + dp(8)
        y: root.top - dp(2) - root.name_row
        width: max(root.width - dp(16) - root.taken, dp(1))
        spacing: dp(4)
    FloatLayout:
        id: place
        size_hint: None, None
        x: root.x + root.inset
        y: root.y + root.inset + beneath.height
        width: max(root.width - 2 * root.inset, dp(1))
        height: max(root.height - root.head - root.inset - dp(4) - beneath.height, dp(1))
        opacity: 0 if root.problem else .35 if root.away else 1  # what shows nothing says nothing beside the reason
    Text:
        text: root.problem
        role: 'muted'
        font_size: sp(14)
        halign: 'center'
        size_hint: None, None
        width: max(root.width - dp(24), dp(1))
        center_x: root.center_x
        center_y: place.center_y
        opacity: 1 if root.problem else 0
    Text:
        id: beneath
        text: root.beneath
        role: 'warn'
        font_size: sp(13)
        size_hint: None, None
        x: root.x + root.inset
        y: root.y + dp(6)
        width: max(root.width - 2 * root.inset, dp(1))
        height: self.texture_size[1] if root.beneath else 0
    BoxLayout:
        id: buttons
        size_hint: None, None
        size: root.signs * root.button, root.bar
        x: root.right - dp(4) - self.width
        y: root.top - dp(2) - root.head
        opacity: 1 if root.signs else 0
        disabled: not root.signs
        Icon:
            id: grip
            name: 'drag_pan'
            role: 'muted'
            font_size: sp(21)
            size_hint: None, 1
            width: root.button if root.signs > 1 else 0
            text_size: self.size
            halign: 'center'
            valign: 'middle'
            opacity: 1 if root.signs > 1 else 0
        IconButton:
            id: eye
            icon: 'visibility_off' if root.away else 'visibility'
            role: 'muted'
            bare: True
            size_hint: None, 1
            width: root.button if root.signs > 1 else 0
            opacity: 1 if root.signs > 1 else 0
            disabled: root.signs < 2
            on_release: root.dispatch('on_act', 'hide')
        IconButton:
            id: close
            icon: 'close'
            role: 'muted'
            bare: True
            size_hint: None, 1
            width: root.button if root.signs > 1 else 0
            opacity: 1 if root.signs > 1 else 0
            disabled: root.signs < 2
            on_release: root.dispatch('on_act', 'remove')
        IconButton:
            id: more
            icon: 'more_vert'
            role: 'muted'
            bare: True
            size_hint: None, 1
            width: root.button if root.signs == 1 else 0
            opacity: 1 if root.signs == 1 else 0
            disabled: root.signs != 1
            on_release: root.dispatch('on_act', 'select')

<CardTab>:
    font_name: theme.font
    font_size: sp(14)
    bold: self.chosen
    color: theme.text if self.chosen else theme.muted
    disabled_color: self.color
    shorten: True
    text_size: self.width - dp(8), self.height
    halign: 'center'
    valign: 'middle'
    canvas.before:
        Rounded:
            rgba: theme.raised if self.chosen else (0, 0, 0, 0)
            pos: self.x, self.y + dp(3)
            size: self.width, self.height - dp(6)
            radius: [theme.corner]
        Rounded:
            rgba: theme.accent if self.chosen else (0, 0, 0, 0)
            pos: self.x + dp(10), self.y + dp(3)
            size: self.width - dp(20), dp(2.5)
            radius: [dp(1.2)]

<Corner>:
    size_hint: None, None
    size: theme.target, theme.target
    canvas:
        Color:
            rgba: theme.accent
        SmoothEllipse:
            pos: self.center_x - dp(11), self.center_y - dp(11)
            size: dp(22), dp(22)
""")


def dashed(points: Points, colour: Sequence[float], width: float) -> Shapes:
    """A line in dashes through these points [px]."""
    shapes = Shapes()
    shapes.dashes(points, width, colour, period=dp(PERIOD), dash=dp(DASH))
    return shapes


class CardTab(ButtonBehavior, Label):
    """One panel of a stack."""

    chosen = BooleanProperty(False)


class Corner(Widget):
    """What the selected card is made larger or smaller by."""


class Clip(StencilView):
    """Shows nothing beyond its edges."""


class PanelCard(Outlined, FloatLayout):
    """Dispatches `on_act(what)` for `hide`, `remove` and `select`, and `on_tab(index)` for another panel of its stack."""

    __events__ = ("on_act", "on_tab")

    title = StringProperty("")
    brief = StringProperty("")
    """Its name where there is little room."""
    problem = StringProperty("")
    """Why its widget shows nothing, in one sentence; empty for none."""
    beneath = StringProperty("")
    """What is said below its widget, in one sentence; empty for nothing."""
    editing = BooleanProperty(False)
    selected = BooleanProperty(False)
    """It is the one that the inspector is about."""
    away = BooleanProperty(False)
    """It is hidden while nothing is edited."""
    count = NumericProperty(1)
    """Panels in its stack."""
    indices: ListProperty[int] = ListProperty()
    """Of the panels of its stack in the view, the one in sight among them."""
    shown = NumericProperty(-1)
    """Index of the panel in sight."""
    widget = ObjectProperty(None, allownone=True)
    """What it shows."""
    inset = NumericProperty("10dp")
    head = NumericProperty(f"{HEAD}dp")
    """Height of the row with its name [px]."""
    signs = NumericProperty(0)
    """How many signs its head has while it is edited: three to move, hide and remove it, one that opens these where it is narrow."""
    bar = NumericProperty(0)
    """Height of the row with the signs [px]."""
    name_row = NumericProperty(f"{HEAD}dp")
    """Height of the row with its name, which is the signs' own where both fit side by side; 0 where there is no room [px]."""
    button = NumericProperty(0)
    """Width of one of its buttons [px]."""
    taken = NumericProperty(0)
    """What the signs take of the width of the row with its name [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink = Ink()
        self._clip: Clip | None = None
        super().__init__(**kwargs)
        self.canvas.after.add(self._ink)
        self.ids.place.bind(pos=self._lay, size=self._lay)
        self.bind(pos=self._draw, size=self._draw, editing=self._draw, selected=self._draw)
        self.bind(size=self._fit, editing=self._fit, count=self._fit)
        theme.bind(name=self._draw, target=self._fit)
        self._fit()

    def put(self, widget: Widget | None) -> None:
        """Show that widget in the place of the one before."""
        self.ids.place.clear_widgets()
        self.widget = widget
        if widget is not None:
            # what is laid out of parts does not grow smaller than they are
            self._clip = Clip() if isinstance(widget, BoxLayout) else None
            self.ids.place.add_widget(self._clip or widget)
            if self._clip is not None:
                self._clip.add_widget(widget)
            self._lay()

    def name_tabs(self, titles: Sequence[str], chosen: int) -> None:
        """The panels of its stack by their names, and which of them is in sight."""
        tabs = self.ids.stack
        self.count = len(titles)
        tabs.clear_widgets()
        if len(titles) < 2:
            return
        for number, title in enumerate(titles):
            tab = CardTab(text=title, chosen=number == chosen)
            tab.bind(on_release=lambda _, number=number: self.dispatch("on_tab", number))
            tabs.add_widget(tab)

    def _fit(self, *_: object) -> None:
        """The same head for every card: the signs beside the name, below it, or alone, as far as there is room."""
        self.button = theme.target if theme.gloves else mm(MIN_BUTTON)
        self.signs = 0 if not self.editing else 3 if self.width >= 3 * self.button + dp(8) else 1
        row = max(dp(HEAD), self.button)
        self.bar = row if self.signs else 0
        beside = self.width >= self.signs * self.button + dp(TITLE_ROOM)
        self.taken = self.signs * self.button if beside else 0
        if not self.signs or beside:
            self.head = self.name_row = row if self.signs or self.count > 1 else dp(HEAD)
            return
        self.name_row = dp(HEAD) if self.height >= row + dp(HEAD + LEAST) else 0
        self.head = row + self.name_row

    def _lay(self, *_: object) -> None:
        """The widget fills its place, or stands in the middle where it has a height of its own."""
        place, widget = self.ids.place, self.widget
        if widget is None:
            return
        if self._clip is not None:
            self._clip.size_hint = (None, None)
            self._clip.pos, self._clip.size = place.pos, place.size
        if widget.size_hint_y is None and getattr(widget, "own_height", False):
            # what is above its own type is not there on a low card
            widget.font_size = max(min(sp(FIGURE), place.height / LINE), sp(MIN_FONT_SIZE))
            figure = widget.font_size * LINE
            widget.width = place.width
            widget.x, widget.y = place.x + dp(4), place.y + (place.height - figure) / 2
        else:
            widget.size_hint = (None, None)
            widget.pos, widget.size = place.pos, place.size

    def _draw(self, *_: object) -> None:
        if not self.editing:
            self._ink.fill(Shapes())
        elif self.selected:
            shapes = Shapes()
            shapes.line(self._outline(), dp(3.5), theme.accent)
            self._ink.fill(shapes)
        else:
            self._ink.fill(dashed(self._outline(), theme.muted, dp(1.3)))

    def _outline(self) -> Points:
        """The border's middle, closed, its corners round [px]."""
        import numpy as np

        radius, rim = theme.radius, dp(1)
        quarter = np.linspace(0.0, np.pi / 2, 6)
        corners = []
        for number, (x, y) in enumerate(
            (
                (self.right - radius, self.top - radius),
                (self.x + radius, self.top - radius),
                (self.x + radius, self.y + radius),
                (self.right - radius, self.y + radius),
            )
        ):
            turned = quarter + number * np.pi / 2
            way = np.stack([np.cos(turned), np.sin(turned)], axis=1) * (radius - rim)
            corners.append(way + np.array([x, y]))
        outline = np.concatenate(corners)
        return np.concatenate([outline, outline[:1]])

    def on_touch_down(self, touch: Any) -> bool:
        """While it is edited no finger reaches its widget: nothing there may drive."""
        if not self.editing:
            return bool(super().on_touch_down(touch))
        if self.signs and self.ids.buttons.collide_point(*touch.pos):
            return bool(self.ids.buttons.dispatch("on_touch_down", touch))
        tabs = self.ids.stack
        if self.count > 1 and tabs.collide_point(*touch.pos):
            return bool(tabs.dispatch("on_touch_down", touch))
        return False

    def let_go(self) -> None:
        """Let go of the theme: it is on the glass no longer."""
        theme.unbind(name=self._draw, target=self._fit)

    def on_act(self, what: str) -> None:
        """A button of its was pressed."""

    def on_tab(self, index: int) -> None:
        """Another panel of its stack was chosen."""
