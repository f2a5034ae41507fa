"""Ink: smooth shapes and texts on a canvas, in one draw call for the shapes and few instructions for the texts.

self.ink, self.words = Ink(), Words()
self.canvas.add(self.ink), self.canvas.add(self.words.canvas)
self.ink.fill(shapes)
self.words.write([Word("N", x, y, sp(16), theme.danger)])
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
from kivy.clock import Clock
from kivy.graphics import Color, InstructionGroup, Mesh, Rectangle, RenderContext
from kivy.metrics import dp

from widgets.core.base import RobotWidget, text_texture
from widgets.core.shapes import FLOATS, Shapes
from widgets.core.theme import theme

__all__ = ["Drawing", "Fading", "Ink", "Sheet", "Told", "Word", "Words", "folded", "ground", "shader", "tint"]

FAR = 100_000
"""Off every glass [px]: a word that belongs farther away, or nowhere, is put there."""
VERTEX = """
#ifdef GL_ES
precision highp float;
#endif
attribute vec2 at_place;
attribute vec2 at_local;
attribute vec4 at_form;
attribute vec4 at_ink;
varying vec2 local;
varying vec4 form;
varying vec4 ink;
uniform mat4 modelview_mat;
uniform mat4 projection_mat;
void main() {
    local = at_local;
    form = at_form;
    ink = at_ink;
    gl_Position = projection_mat * modelview_mat * vec4(at_place, 0.0, 1.0);
}
"""

FRAGMENT = """
#ifdef GL_ES
precision highp float;
#endif
varying vec2 local;
varying vec4 form;
varying vec4 ink;
uniform float strength;
uniform float seen;
float dashed(float along, float across, float half_width, float period, float half_dash) {
    float from_middle = abs(mod(along, period) - period * 0.5);
    return half_width - length(vec2(max(from_middle - half_dash, 0.0), across));
}
void main() {
    float inside = 0.0;
    if (form.x > -0.5) {
        float across = length(local) - form.x;
        inside = form.y - abs(across);
        if (form.z > 0.0) {
            inside = dashed(atan(local.y, local.x) * form.x, across, form.y, form.z, form.w);
        }
    } else if (form.x > -1.5) {
        inside = form.y - abs(local.y);
        if (form.z > 0.0) {
            inside = dashed(local.x, local.y, form.y, form.z, form.w);
        }
    } else if (form.x > -2.5) {
        inside = min(min(local.x, local.y), form.y);
    } else {
        float side = local.x * form.z - abs(local.y) * form.w;
        inside = min(form.y - length(local), side);
    }
    gl_FragColor = vec4(ink.rgb, ink.a * strength * seen * clamp(inside + 0.5, 0.0, 1.0));
}
"""

NO_VERTICES, NO_INDICES = np.zeros(FLOATS, np.float32), np.zeros(3, np.uint16)

FORMAT = [
    (b"at_place", 2, "float"),
    (b"at_local", 2, "float"),
    (b"at_form", 4, "float"),
    (b"at_ink", 4, "float"),
]


def tint(colour: Sequence[float], alpha: float) -> tuple[float, ...]:
    """A role's colour made see-through: `alpha` 0 to 1."""
    return (*colour[:3], alpha)


def shader(fragment: str, **uniforms: float) -> RenderContext:
    """A context that draws Kivy's textured rectangles with `fragment`, whose uniforms start as given."""
    context = RenderContext(fs=fragment, use_parent_projection=True, use_parent_modelview=True)
    for key, value in uniforms.items():
        context[key] = float(value)
    return context


Uniform = float | Sequence[float]


class Told(RenderContext):
    """A context whose uniforms are told only what is new to them: each telling is a pass over its instructions."""

    def __init__(self, vertex: str | None, fragment: str) -> None:
        """Without `vertex` it is Kivy's for textured rectangles."""
        sources: dict[str, Any] = {"fs": fragment} if vertex is None else {"vs": vertex, "fs": fragment}
        super().__init__(**sources, use_parent_projection=True, use_parent_modelview=True)
        self._told: dict[str, float | tuple[float, ...]] = {}

    def tell(self, name: str, value: Uniform) -> None:
        """Give a uniform its value, where that is another."""
        told = float(value) if isinstance(value, (int, float)) else tuple(map(float, value))
        if self._told.get(name) != told:
            self._told[name] = self[name] = told


class Fading(Told):
    """What draws by a shader of its own, with a uniform `seen` for the widget's opacity; a `Drawing` tells it that."""

    def __init__(self, vertex: str, fragment: str) -> None:
        super().__init__(vertex, fragment)
        self["seen"] = 1.0

    def see(self, opacity: float) -> None:
        """Follow the opacity of the widget, 0 to 1: Kivy keeps that from whoever has a shader of its own."""
        self["seen"] = float(opacity)


class Sheet(Mesh):
    """A pile of shapes that an `Ink` draws."""

    def __init__(self) -> None:
        super().__init__(fmt=FORMAT, mode="triangles")

    def fill(self, shapes: Shapes) -> None:
        """Show these shapes instead of those before."""
        vertices, indices = shapes.arrays()
        # Kivy's mesh cannot be emptied: nothing is drawn as a triangle without area
        self.vertices = vertices if len(vertices) else NO_VERTICES
        self.indices = indices if len(indices) else NO_INDICES


class Ink(Fading):
    """An instruction that draws `Shapes`, with edges smooth at any size."""

    def __init__(self) -> None:
        super().__init__(VERTEX, FRAGMENT)
        self.tell("strength", 1.0)
        self._mesh = self.sheet()

    def fill(self, shapes: Shapes) -> None:
        """Show these shapes instead of those before."""
        self._mesh.fill(shapes)

    def sheet(self) -> Sheet:
        """One more pile of shapes, above those before: a shader that is set once for both costs a twentieth of another ink."""
        made = Sheet()
        self.add(made)
        return made

    def fade(self, strength: float) -> None:
        """Multiply the opacity of all shapes by `strength`, 0 to 1."""
        self.tell("strength", strength)


@dataclass(slots=True)
class Word:
    """A piece of text on the canvas."""

    text: str
    x: float
    """[px]"""
    y: float
    size: float
    """Height of the type [px]."""
    colour: Sequence[float]
    bold: bool = False
    font: str = ""
    """Registered name; `Icons` shows a symbol, an empty one is the theme's."""
    anchor: tuple[float, float] = (0.5, 0.5)
    """Which point of the text (x, y) is: 0 left or bottom, 1 right or top."""


def ground(shapes: Shapes, word: Word, colour: Sequence[float]) -> None:
    """Put a small ground of `colour` behind a word, so that it can be read over lines and dots."""
    width, height = text_texture(word.text, round(word.size, 1), word.font, bold=word.bold).size
    left, y = word.x - width * word.anchor[0], word.y + height * (0.5 - word.anchor[1])
    shapes.line(np.array([[left - dp(3), y], [left + width + dp(3), y]]), height, colour)


@lru_cache(maxsize=64)
def _lines(text: str, size: float, room: float) -> tuple[str, ...]:
    spaced = " " in text
    lines: list[str] = []
    for piece in text.split() if spaced else text:
        longer = (f"{lines[-1]} {piece}" if spaced else lines[-1] + piece) if lines else piece
        if lines and text_texture(longer, size).width <= room:
            lines[-1] = longer
        else:
            lines.append(piece)
    return tuple(lines)


def folded(word: Word, room: float) -> list[Word]:
    """The word in as many lines as it takes in `room` [px], together at its anchor, the first one on top."""
    if not word.text or text_texture(word.text, word.size, word.font, bold=word.bold).width <= room:
        return [word]
    lines = _lines(word.text, word.size, room)
    step = text_texture(word.text, word.size, word.font, bold=word.bold).height
    top = word.y + (len(lines) - 1) * step * (1 - word.anchor[1])
    return [replace(word, text=line, y=top - index * step) for index, line in enumerate(lines)]


class Words:
    """A set of texts that is rewritten as a whole; instructions are made once, and told only what is new."""

    def __init__(self) -> None:
        self.canvas = InstructionGroup()
        self._slots: list[tuple[Color, Rectangle]] = []
        self._tones: list[tuple[float, ...]] = []
        self._places: list[tuple[int, int]] = []
        self._anchors: list[tuple[float, float]] = []
        """Of each slot its colour, where its rectangle is, and from there to where its word is [px]."""
        self._shown = 0
        self.texts: list[str] = []
        """What is written now."""

    def write(self, words: Iterable[Word], strength: float = 1.0) -> None:
        """Show these texts instead of those before; `strength` multiplies their opacity."""
        shown = [word for word in words if word.text]
        for index, word in enumerate(shown):
            self._put(index, word, strength)
        self.texts, count = [word.text for word in shown], len(shown)
        for _, rectangle in self._slots[count : self._shown]:
            rectangle.size = 0, 0
        self._shown = count

    def move(self, points: Sequence[Sequence[float]]) -> None:
        """Move the texts that are written, in their order, to these points [px]; nothing else of them changes."""
        for index, (x, y) in enumerate(points[: self._shown]):
            aside, above = self._anchors[index]
            self._place(index, x - aside, y - above)

    def slide(self, across: Sequence[float], up: float, strengths: Sequence[float]) -> None:
        """Move the texts that are written, in their order, along a line `up` [px], and give each its opacity, 0 to 1."""
        slots = zip(self._slots, self._anchors, across, strengths, strict=False)
        for index, ((colour, _), (aside, above), x, strength) in enumerate(slots):
            hue = self._tones[index]
            if hue[3] != strength:
                self._tones[index] = (hue[0], hue[1], hue[2], strength)
                colour.a = strength
            if strength:
                self._place(index, x - aside, up - above)

    def _put(self, index: int, word: Word, strength: float) -> None:
        if index == len(self._slots):
            self._add()
        colour, rectangle = self._slots[index]
        texture = text_texture(word.text, round(word.size, 1), word.font, bold=word.bold)
        red, green, blue, alpha = word.colour
        tone = red, green, blue, alpha * strength
        if tone != self._tones[index]:
            colour.rgba = self._tones[index] = tone
        width, height = size = texture.size
        if rectangle.texture is not texture:
            rectangle.texture = texture
            rectangle.size = size
        elif rectangle.size != size:
            rectangle.size = size
        aside, above = self._anchors[index] = width * word.anchor[0], height * word.anchor[1]
        self._place(index, word.x - aside, word.y - above)

    def _place(self, index: int, x: float, y: float) -> None:
        known = abs(x) < FAR and abs(y) < FAR  # not so for NaN either: robots tell places that are none
        place = (round(x), round(y)) if known else (-FAR, -FAR)
        if place != self._places[index]:
            self._slots[index][1].pos = self._places[index] = place

    def _add(self) -> None:
        self._slots.append((Color(1, 1, 1, 1), Rectangle(pos=(0, 0), size=(0, 0))))
        self._tones.append((1.0, 1.0, 1.0, 1.0))
        self._places.append((0, 0))
        self._anchors.append((0.0, 0.0))
        for instruction in self._slots[-1]:
            self.canvas.add(instruction)


def _see(group: InstructionGroup, opacity: float) -> None:
    for part in group.children:
        if isinstance(part, Fading):
            part.see(opacity)
        elif isinstance(part, InstructionGroup):
            _see(part, opacity)


def _changed(redraw: Callable[[], object], unknown: set[str], name: str, _: object, value: object) -> None:
    """Kivy tells of each NaN as of something new; what is as unknown as before looks as before."""
    still = isinstance(value, float) and math.isnan(value)
    if still and name in unknown:
        return
    (unknown.add if still else unknown.discard)(name)
    redraw()


class Drawing(RobotWidget):
    """A robot widget that draws itself anew, once before the next frame, when something it shows has changed.

    A subclass names its properties in `drawn_from` and draws in `draw`.
    """

    drawn_from: ClassVar[tuple[str, ...]] = ()
    """Properties whose change calls for a new drawing, besides place, size, state and theme."""

    def __init__(self, **kwargs: Any) -> None:
        self.redraw = Clock.create_trigger(self._draw_now, -1)
        super().__init__(**kwargs)
        unknown: set[str] = set()
        for name in ("pos", "size", "state", *self.drawn_from):
            self.fbind(name, _changed, self.redraw, unknown, name)
        self.fbind("opacity", self._on_opacity)
        theme.bind(name=self._on_theme, gloves=self._on_theme)
        self.redraw()

    def _on_theme(self, *_: object) -> None:
        self.redraw()

    def _on_opacity(self, *_: object) -> None:
        _see(self.canvas, self.opacity)

    def _draw_now(self, *_: object) -> None:
        if self.width > 1 and self.height > 1:
            self.draw()
        if self.opacity != 1:  # ink that is new does not know of it yet
            self._on_opacity()

    def draw(self) -> None:
        """Bring the canvas up to date. Called at most once a frame."""
        raise NotImplementedError(f"{type(self).__name__} does not say how it is drawn")
