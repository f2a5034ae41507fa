"""Graph of a robot's nodes and topics with arrows, laid out in layers; it needs no app.

view = GraphView()
view.shown = shown(["/laser", "/slam"], {"/scan": ["/laser"]}, {"/scan": ["/slam"]})
view.bind(on_pick=lambda _, name: print(view.shown.boxes[name]))
"""

from __future__ import annotations

from typing import Any

import numpy as np
from kivy.clock import Clock
from kivy.graphics import MatrixInstruction, PopMatrix, PushMatrix
from kivy.graphics.transformation import Matrix
from kivy.input import MotionEvent
from kivy.metrics import dp
from kivy.properties import ObjectProperty, StringProperty
from kivy.uix.stencilview import StencilView

from widgets.core.canvas_ink import Ink, Words
from widgets.core.geometry import Points, View
from widgets.core.theme import theme
from widgets.graph.graph_ink import drawn, size_of
from widgets.graph.graph_layout import GraphLayout, lay_out
from widgets.graph.graph_model import Shown

__all__ = ["GraphView"]

MAX_SLIP = 8.0
"""How far a finger may slip and still tap [dp]."""
WHEEL_STEP, BUTTON_STEP = 1.2, 1.5
"""Zoom of one step of the wheel, and of one press of a button."""
MIN_SCALE, MAX_SCALE = 0.08, 3.0
LEGIBLE = 0.72
"""Scale at which names can be read; nothing is made smaller until a finger wishes it."""
CRISP_DELAY = 0.15
"""After the last zoom the words are written anew in their size [s]."""
REDRAWN = 1.04
"""Of the scale, up or down: less is not seen."""


class GraphView(StencilView):
    """Dispatches `on_pick(name)` for a tap on a box, with an empty name for one beside all boxes.

    One finger moves it, two and the wheel zoom. A new graph is fitted in until a finger has moved it.
    """

    __events__ = ("on_pick",)

    shown: ObjectProperty[Shown] = ObjectProperty(Shown({}, ()))
    """What is drawn."""
    selected = StringProperty("")
    """Box that is looked at: it, its neighbours and their arrows stand out. Empty for none."""
    search = StringProperty("")
    """Words that stand out where nothing is selected."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words, self._moved = Ink(), Words(), MatrixInstruction()
        self._fingers: dict[int, complex] = {}
        self._start, self._tapping, self._touched = 0j, False, False
        self._layout: GraphLayout | None = None
        self._laid: tuple[object, ...] = ()
        self._sizes: dict[str, tuple[float, float]] = {}
        self._drawn_scale = 1.0
        self.view = View(1 + 0j, 0j)
        """How the layout lies on the glass."""
        self.redraw = Clock.create_trigger(self._draw, -1)
        self._crisp = Clock.create_trigger(self._draw, CRISP_DELAY)
        super().__init__(**kwargs)
        for instruction in (PushMatrix(), self._moved, self._ink, self._words.canvas, PopMatrix()):
            self.canvas.add(instruction)
        self.bind(shown=self._change, selected=self.redraw, search=self.redraw)
        self.bind(pos=self._resize, size=self._resize)
        theme.bind(name=self._restyle)
        self._change()

    def on_pick(self, name: str) -> None:
        """A finger tapped a box, or beside all of them."""

    # the layout

    def _restyle(self, *_: object) -> None:
        self._laid = ()
        self._change()

    def _resize(self, *_: object) -> None:
        if self.width > 1 and self.height > 1:
            self._change()
            if not self._touched:
                self.fit()

    def _change(self, *_: object) -> None:
        """Lay out anew what is another graph, or the same on a glass of another form."""
        down = self.height > self.width
        laid = tuple(self.shown.boxes), self.shown.edges, down
        if laid != self._laid:
            self._laid = laid
            self._sizes = {name: size_of(box) for name, box in self.shown.boxes.items()}
            self._layout = lay_out(self._sizes, self.shown.edges, down=down)
            if not self._touched:
                self.fit()
        self.redraw()

    def fit(self) -> None:
        """Show everything, as small as its names can be read, from the middle."""
        self._touched = False
        if self._layout is None or not self._layout.places or self.width <= 1:
            return
        corners = self._corners(self._layout)
        box = (self.x + dp(12), self.y + dp(12), max(self.width - dp(24), 1), max(self.height - dp(24), 1))
        view = View.fitting(corners, box=box, most=1.25)
        down = self._layout.down
        self._set(view if view.scale >= LEGIBLE else self._legible(corners, box, down=down))

    @staticmethod
    def _legible(corners: Points, box: tuple[float, float, float, float], *, down: bool) -> View:
        """Where not all fits in, the beginning of the graph, whose other way is in the middle."""
        low, high = corners.min(axis=0), corners.max(axis=0)
        x, y = (low + high) / 2
        room = np.array(box[2:]) / LEGIBLE
        if down:
            y = max(y, high[1] - room[1] / 2)
        else:
            x = min(x, low[0] + room[0] / 2)
        return View.centred(x, y, at=(box[0] + box[2] / 2, box[1] + box[3] / 2), scale=LEGIBLE)

    def _corners(self, layout: GraphLayout) -> Points:
        places = np.array([layout.places[name] for name in self._sizes])
        halves = np.array([self._sizes[name] for name in self._sizes]) / 2
        return np.asarray(np.concatenate([places - halves, places + halves]))

    def reveal(self, name: str) -> None:
        """Bring a box into the middle of the glass; nothing for one that is not there."""
        if self._layout is not None and name in self._layout.places:
            px, py = self.view.to_screen(*self._layout.places[name])
            self._touched = True
            self._set(self.view.moved(self.center_x - px, self.center_y - py))

    # the view

    def zoom(self, factor: float) -> None:
        """Make larger or smaller about the middle."""
        self._touched = True
        self._set(self.view.zoomed(factor, *self.center).within(MIN_SCALE, MAX_SCALE, *self.center))

    def _set(self, view: View) -> None:
        self.view = view
        self._move()
        ratio = view.scale / self._drawn_scale
        if not 1 / REDRAWN < ratio < REDRAWN:
            self._crisp()

    def _move(self) -> None:
        factor = self.view.scale / self._drawn_scale
        matrix = Matrix().translate(self.view.offset.real, self.view.offset.imag, 0)
        self._moved.matrix = matrix.multiply(Matrix().scale(factor, factor, 1))

    def _lit(self) -> frozenset[str] | None:
        if self.selected in self.shown.boxes:
            return self.shown.beside(self.selected)
        return self.shown.found(self.search) if self.search.strip() else None

    def _draw(self, *_: object) -> None:
        if self._layout is None:
            return
        self._drawn_scale = self.view.scale
        chosen = self.selected if self.selected in self.shown.boxes else ""
        shapes, words = drawn(self.shown, self._layout, self._sizes, self._drawn_scale, self._lit(), chosen)
        self._ink.fill(shapes)
        self._words.write(words)
        self._move()

    def box_at(self, px: float, py: float) -> str:
        """Name of the box at a place of the glass [px], or of the nearest within a finger's reach; empty for none."""
        if self._layout is None:
            return ""
        x, y = self.view.to_world(px, py)
        reach = theme.target / 4 / self.view.scale
        best, found = reach, ""
        for name, (mx, my) in self._layout.places.items():
            wide, high = self._sizes[name]
            away = max(abs(x - mx) - wide / 2, abs(y - my) - high / 2, 0.0)
            if away < best:
                best, found = away, name
        return found

    # the fingers

    def on_touch_down(self, touch: MotionEvent) -> bool:
        """Take a finger that comes down on it."""
        if self.disabled or not self.collide_point(*touch.pos):
            return False
        if touch.is_mouse_scrolling:
            step = WHEEL_STEP if touch.button == "scrolldown" else 1 / WHEEL_STEP
            self._touched = True
            self._set(self.view.zoomed(step, *touch.pos).within(MIN_SCALE, MAX_SCALE, *touch.pos))
            return True
        touch.grab(self)
        self._fingers[touch.uid] = complex(*touch.pos)
        self._tapping, self._start = len(self._fingers) == 1, complex(*touch.pos)
        return True

    def on_touch_move(self, touch: MotionEvent) -> bool:
        """Follow its own fingers."""
        if touch.grab_current is not self or touch.uid not in self._fingers:
            return False
        at = complex(*touch.pos)
        if self._tapping and abs(at - self._start) <= dp(MAX_SLIP):
            return True
        before = dict(self._fingers)
        self._fingers[touch.uid] = at
        self._tapping, self._touched = False, True
        if len(before) == 1:
            change = at - before[touch.uid]
            self._set(self.view.moved(change.real, change.imag))
        elif touch.uid in list(before)[:2]:
            first, second = list(before)[:2]
            was, now = (before[first], before[second]), (self._fingers[first], self._fingers[second])
            middle = sum(now) / 2
            view = self.view.pinched(was, now, may_turn=False)
            self._set(view.within(MIN_SCALE, MAX_SCALE, middle.real, middle.imag))
        return True

    def on_touch_up(self, touch: MotionEvent) -> bool:
        """Let go, or take it as a tap."""
        if touch.grab_current is not self or touch.uid not in self._fingers:
            return False
        touch.ungrab(self)
        del self._fingers[touch.uid]
        if self._tapping:
            self._tapping = False
            self.dispatch("on_pick", self.box_at(*touch.pos))
        return True

    def let_go(self) -> None:
        """Forget all fingers: it leaves the glass."""
        self._fingers.clear()
        self._tapping = False
        self._crisp.cancel()
