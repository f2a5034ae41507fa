"""Board of panels: cards on a grid that is scrolled, and, while it is edited, moved and resized by a finger with snapping."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, NumericProperty, OptionProperty
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.scrollview import ScrollView

from app.layout.panel_grid import COLUMNS, FORMS, ROWS, Place, clamped, height_of
from app.screens.panels.panel_card import Corner, PanelCard
from widgets.core.base import Control
from widgets.core.canvas_ink import Ink
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["Board"]

GAP = 7
"""Half the room between two cards [dp]."""
SLOP = 8
"""A finger that went less far has tapped [dp]."""
MAX_DOTS = 4000

Builder.load_string("""
<Board>:
    do_scroll_x: False
    bar_width: dp(4)
    bar_color: theme.muted
    bar_inactive_color: theme.line
    scroll_type: ['bars', 'content']

<Ground>:
    size_hint: 1, None
""")


class Ground(FloatLayout):
    """What the cards lie on."""


class Board(ScrollView):
    """Dispatches `on_select(card)`, None for none, and `on_place(card, place)` when a finger has moved or resized one."""

    __events__ = ("on_select", "on_place")

    form = OptionProperty("wide", options=FORMS)
    editing = BooleanProperty(False)
    whole = NumericProperty(0)
    """Height that the rows of the form fill, where that is more than its own: it ends above a sheet then [px]."""
    rows = NumericProperty(1)
    """Of the grid that are filled."""

    def __init__(self, **kwargs: Any) -> None:
        self.cards: list[PanelCard] = []
        """In the order of the view."""
        self._places: list[Place] = []
        self._finger: tuple[Any, PanelCard, str, tuple[float, float], bool] | None = None
        """The touch, the card, `move` or `size`, where it came down, whether it has gone anywhere."""
        super().__init__(**kwargs)
        self.ground = Ground()
        self._dots, self._ghost = Ink(), Ink()
        self.ground.canvas.before.add(self._dots)
        self.ground.canvas.after.add(self._ghost)
        self.add_widget(self.ground)
        self.corner = Corner()
        self.selected: PanelCard | None = None
        self.bind(size=self._lay, editing=self._lay, form=self._lay)
        theme.bind(name=self._draw_dots)

    def close(self) -> None:
        """Let go of the theme."""
        theme.unbind(name=self._draw_dots)
        self.clear()

    def clear(self) -> None:
        """Take all cards away."""
        for card in self.cards:
            card.let_go()
        self.cards, self._places = [], []
        self.ground.clear_widgets()
        self._drop()
        self.selected = None

    def arrange(self, cards: Sequence[tuple[PanelCard, Place]]) -> None:
        """Show these cards in these places; those that are there already only move."""
        if [card for card, _ in cards] != self.cards:
            self.clear()
            self.cards = [card for card, _ in cards]
            for card in self.cards:
                self.ground.add_widget(card)
        self._places = [place for _, place in cards]
        self._lay()

    def select(self, card: PanelCard | None) -> None:
        """Mark a card, or none."""
        self.selected = card
        for one in self.cards:
            one.selected = one is card
        if self.corner.parent is not None:
            self.ground.remove_widget(self.corner)
        if card is not None:
            self.ground.add_widget(self.corner)
            self._place_corner()

    def place_of(self, card: PanelCard) -> Place:
        """Where a card lies [cells]."""
        return self._places[self.cards.index(card)]

    # cells and pixels

    @property
    def cell(self) -> tuple[float, float]:
        """Width and height of a cell [px]."""
        margin = dp(GAP) * 2
        return (self.width - 2 * margin) / COLUMNS[self.form], (
            max(self.whole, self.height) - 2 * margin
        ) / ROWS[self.form]

    def _box(self, place: Place) -> tuple[float, float, float, float]:
        """Left, low, width and height of a place on the ground [px]."""
        across, up = self.cell
        margin, gap = dp(GAP) * 2, dp(GAP)
        left = margin + place.left * across + gap
        top = self.ground.height - margin - place.top * up - gap
        width, height = place.width * across - 2 * gap, place.height * up - 2 * gap
        return self.ground.x + left, self.ground.y + top - height, width, height

    def _lay(self, *_: object) -> None:
        if self.width <= 1 or self.height <= 1:
            return
        self.rows = max(height_of(self._places) + (2 if self.editing else 0), ROWS[self.form])
        self.ground.height = self.cell[1] * self.rows + 4 * dp(GAP)
        self.ground.width = self.width
        self.do_scroll_y = self.ground.height > self.height + 1
        for card, place in zip(self.cards, self._places, strict=True):
            x, y, width, height = self._box(place)
            card.pos, card.size = (x, y), (width, height)
        self._place_corner()
        self._draw_dots()

    def _place_corner(self) -> None:
        if self.selected is not None:
            self.corner.center = self.selected.right - dp(6), self.selected.y + dp(6)

    def _draw_dots(self, *_: object) -> None:
        if not self.editing or self.width <= 1:
            self._dots.fill(Shapes())
            return
        across, up = self.cell
        margin = dp(GAP) * 2
        xs = margin + np.arange(COLUMNS[self.form] + 1) * across
        ys = self.ground.height - margin - np.arange(min(self.rows, MAX_DOTS // (len(xs) or 1)) + 1) * up
        grid = np.array([(x, y) for y in ys for x in xs])
        shapes = Shapes()
        shapes.discs(grid + np.array(self.ground.pos), dp(1.4), theme.line)
        self._dots.fill(shapes)

    def in_sight(self, card: PanelCard) -> bool:
        """Any of it is within the board as it is scrolled now."""
        low = (self.ground.height - self.height) * min(max(self.scroll_y, 0.0), 1.0)
        if not self.do_scroll_y:
            return True
        y = card.y - self.ground.y
        return bool(y < low + self.height - 1 and y + card.height > low + 1)

    def reveal(self, card: PanelCard) -> None:
        """Scroll as far as it takes to have the whole card in sight, or its upper part where it is too high."""
        room = self.ground.height - self.height
        if room <= 0:
            return
        margin, now = dp(GAP) * 2, room * min(max(self.scroll_y, 0.0), 1.0)
        low, top = card.y - self.ground.y - margin, card.top - self.ground.y + margin
        wanted = min(now, low) if low < now else max(now, top - self.height)
        self.scroll_y = min(max(max(wanted, top - self.height) if wanted < now else wanted, 0.0), room) / room

    # fingers

    def on_touch_down(self, touch: Any) -> bool:
        """A control takes its finger before the board scrolls; while it is edited a card does."""
        if not self.collide_point(*touch.pos) or touch.is_mouse_scrolling:
            return bool(super().on_touch_down(touch))
        card = self._card_at(touch)
        if card is None and self.editing:
            self.dispatch("on_select", None)
        if card is not None and (self.editing or isinstance(card.widget, Control)):
            touch.push()
            touch.apply_transform_2d(self.to_local)
            taken = self._take(card, touch)
            touch.pop()
            if taken:
                return True
        return bool(super().on_touch_down(touch))

    def _card_at(self, touch: Any) -> PanelCard | None:
        x, y = self.to_local(*touch.pos)
        if self.selected is not None and self.corner.collide_point(x, y):
            return self.selected
        return next((card for card in reversed(self.cards) if card.collide_point(x, y)), None)

    def _take(self, card: PanelCard, touch: Any) -> bool:
        if self.editing and card is self.selected and self.corner.collide_point(*touch.pos):
            return self._begin(card, "size", touch)
        if card.on_touch_down(touch):
            return True
        return self._begin(card, "move", touch) if self.editing else False

    def _begin(self, card: PanelCard, how: str, touch: Any) -> bool:
        if self._finger is None:
            touch.grab(self)
            self._finger = touch, card, how, tuple(touch.pos), False
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """Show where the card would come to lie."""
        if self._finger is None or self._finger[0] is not touch:
            return bool(super().on_touch_move(touch))
        if touch.grab_current is not self:
            return True
        place = self._aimed(touch)
        if place is not None:
            self._show_ghost(place)
        return True

    def _aimed(self, touch: Any) -> Place | None:
        """Where the card would come to lie; None while the finger only taps."""
        if self._finger is None:
            return None
        _, card, how, (x, y), gone = self._finger
        here = self.to_local(*touch.pos)
        right, down = here[0] - x, y - here[1]
        if not gone and max(abs(right), abs(down)) < dp(SLOP):
            return None
        self._finger = (touch, card, how, (x, y), True)
        across, up = self.cell
        cells, rows = round(right / across), round(down / up)
        place = self.place_of(card)
        if how == "size":
            width = min(max(place.width + cells, 1), COLUMNS[self.form] - place.left)
            return clamped(place._replace(width=width, height=place.height + rows), self.form)
        return clamped(place._replace(left=place.left + cells, top=place.top + rows), self.form)

    def _show_ghost(self, place: Place) -> None:
        x, y, width, height = self._box(place)
        shapes = Shapes()
        corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
        shapes.polygon(corners, (*theme.accent[:3], 0.22))
        shapes.line(np.array([*corners, corners[0]]), dp(2), theme.accent)
        self._ghost.fill(shapes)

    def on_touch_up(self, touch: Any) -> bool:
        """Put the card there; a tap selects it."""
        if self._finger is None or self._finger[0] is not touch:
            return bool(super().on_touch_up(touch))
        if touch.grab_current is not self:
            return True
        touch.ungrab(self)
        place, card = self._aimed(touch), self._finger[1]
        self._drop()
        self.dispatch("on_select", card)
        if place is not None and place != self.place_of(card):
            self.dispatch("on_place", card, place)
        return True

    def _drop(self) -> None:
        self._finger = None
        self._ghost.fill(Shapes())

    def on_select(self, card: PanelCard | None) -> None:
        """A finger has tapped a card, or beside all."""

    def on_place(self, card: PanelCard, place: Place) -> None:
        """A finger has put a card there."""
