"""Traces on a canvas: their quads are scaled, widened, marked and cut to the frame by the graphics card."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from kivy.graphics import Color, InstructionGroup, Mesh

from widgets.core.canvas_ink import Fading
from widgets.plots.columns import PIECE, Columns, Quads, empty_quads, quad_indices

__all__ = ["MARK_KINDS", "TraceInk"]

MARK_KINDS = 8
"""Disc, square, triangle, diamond, cross, ring, plus, triangle upside down: kinds 1 to 8."""

VERTEX = """
#ifdef GL_ES
precision highp float;
#endif
attribute vec2 at_from;
attribute vec2 at_to;
attribute vec2 at_corner;
attribute float at_kind;
varying vec2 place;
varying vec2 one;
varying vec2 other;
varying float kind;
uniform vec2 scale;
uniform vec2 offset;
uniform vec4 frame;
uniform vec2 halves;
uniform mat4 modelview_mat;
uniform mat4 projection_mat;
void main() {
    float high = 4.0 * (frame.w - frame.y);
    one = at_from * scale + offset;
    other = at_to * scale + offset;
    one.y = clamp(one.y, frame.y - high, frame.w + high);
    other.y = clamp(other.y, frame.y - high, frame.w + high);
    kind = at_kind;
    float far = length(other - one);
    vec2 along = far > 0.001 ? (other - one) / far : vec2(1.0, 0.0);
    float reach = (at_kind > 0.5 ? halves.y : halves.x) + 1.0;
    place = (at_corner.x < 0.0 ? one : other) + reach * (along * at_corner.x + vec2(-along.y, along.x) * at_corner.y);
    gl_Position = at_kind < -0.5 ? vec4(2.0, 2.0, 2.0, 1.0) : projection_mat * modelview_mat * vec4(place, 0.0, 1.0);
}
"""

FRAGMENT = """
#ifdef GL_ES
precision highp float;
#endif
varying vec2 place;
varying vec2 one;
varying vec2 other;
varying float kind;
uniform vec4 color;
uniform vec4 frame;
uniform vec2 halves;
uniform float seen;
float triangle(vec2 p, float r) {
    return min(r * 0.55 + p.y, r * 0.48 - 0.5 * p.y - 0.866 * abs(p.x));
}
void main() {
    float inside;
    vec2 p = place - one;
    float r = halves.y;
    if (kind < 0.5) {
        vec2 way = other - one;
        float share = clamp(dot(p, way) / max(dot(way, way), 0.000001), 0.0, 1.0);
        inside = halves.x - length(p - way * share);
    } else if (kind < 1.5) {
        inside = r * 0.9 - length(p);
    } else if (kind < 2.5) {
        inside = r * 0.8 - max(abs(p.x), abs(p.y));
    } else if (kind < 3.5) {
        inside = triangle(p, r);
    } else if (kind < 4.5) {
        inside = r * 0.72 - (abs(p.x) + abs(p.y)) * 0.7071;
    } else if (kind < 5.5) {
        vec2 d = vec2(p.x + p.y, p.x - p.y) * 0.7071;
        inside = min(max(r * 0.28 - abs(d.x), r * 0.28 - abs(d.y)), r - max(abs(d.x), abs(d.y)));
    } else if (kind < 6.5) {
        inside = r * 0.26 - abs(length(p) - r * 0.66);
    } else if (kind < 7.5) {
        inside = min(max(r * 0.26 - abs(p.x), r * 0.26 - abs(p.y)), r - max(abs(p.x), abs(p.y)));
    } else {
        inside = triangle(-p, r);
    }
    float margin = kind < 0.5 ? 0.0 : r;
    float left = place.x - frame.x + margin;
    float right = frame.z - place.x + margin;
    float within = min(min(left, right), min(place.y - frame.y, frame.w - place.y) + margin + 1.0);
    gl_FragColor = vec4(color.rgb, color.a * seen * clamp(inside + 0.5, 0.0, 1.0) * clamp(within + 0.5, 0.0, 1.0));
}
"""

FORMAT = [
    (b"at_from", 2, "float"),
    (b"at_to", 2, "float"),
    (b"at_corner", 2, "float"),
    (b"at_kind", 1, "float"),
]


NO_QUADS = empty_quads(1)


class _Layer(InstructionGroup):
    """Quads of one colour, in pieces: Kivy copies each vertex of a mesh that is told anything, and most pieces are as they were."""

    def __init__(self) -> None:
        super().__init__()
        self._colour = Color()
        self._painted: tuple[float, ...] = (1.0, 1.0, 1.0, 1.0)
        self.add(self._colour)
        self._quads = NO_QUADS
        self._meshes: list[Mesh] = []
        self.show(NO_QUADS)

    def paint(self, colour: tuple[float, ...]) -> None:
        """Have this colour."""
        if colour != self._painted:
            self._colour.rgba = self._painted = colour

    def show(self, quads: Quads) -> None:
        """Draw these quads, all anew."""
        self._quads = quads
        pieces = [quads[start : start + PIECE] for start in range(0, len(quads), PIECE)]
        for mesh in self._meshes[len(pieces) :]:
            self.remove(mesh)
        del self._meshes[len(pieces) :]
        while len(self._meshes) < len(pieces):
            self._meshes.append(Mesh(fmt=FORMAT, mode="triangles"))
            self.add(self._meshes[-1])
        for mesh, piece in zip(self._meshes, pieces, strict=True):
            if len(mesh.indices) != 6 * len(piece):
                mesh.indices = quad_indices(len(piece))
            mesh.vertices = piece.reshape(-1)

    def follow(self, columns: Columns) -> None:
        """Draw the quads of a trace, which change in place: only those pieces anew that have changed."""
        if self._quads is not columns.quads:
            self.show(columns.quads)
        else:
            for piece in columns.changed:
                self._meshes[piece].vertices = columns.quads[piece * PIECE : (piece + 1) * PIECE].reshape(-1)
        columns.changed.clear()


class TraceInk(Fading):
    """All traces of one plot, or the marks of its legend. What it is given is kept and may be changed in place."""

    def __init__(self) -> None:
        super().__init__(VERTEX, FRAGMENT)
        self._layers: list[_Layer] = []
        self.place((0.0, 0.0, 1.0, 1.0), (1.0, 1.0), (0.0, 0.0))
        self.widths(1.0, 4.0)

    def place(
        self, frame: tuple[float, ...], scale: tuple[float, float], offset: tuple[float, float]
    ) -> None:
        """Cut everything to `frame`: left, low, right, top [px]; scale what the quads hold [px each], then move it [px]."""
        for name, numbers in (("frame", frame), ("scale", scale), ("offset", offset)):
            self.tell(name, numbers)

    def widths(self, line: float, mark: float) -> None:
        """Half the width of lines and of marks [px]."""
        self.tell("halves", (line, mark))

    def layers(self, count: int) -> None:
        """Draw so many layers, the first lowest; what is beyond shows nothing."""
        while len(self._layers) < count:
            self._layers.append(_Layer())
            self.add(self._layers[-1])
        for layer in self._layers[count:]:
            layer.show(NO_QUADS)

    def paint(self, layer: int, colour: Sequence[float]) -> None:
        """Give a layer its colour."""
        self._layers[layer].paint(tuple(colour))

    def fill_layer(self, layer: int, quads: Quads) -> None:
        """Show these quads on a layer."""
        self._layers[layer].show(quads)

    def draw_columns(self, layer: int, columns: Columns) -> None:
        """Show a trace on a layer: what has changed since it was drawn last."""
        self._layers[layer].follow(columns)

    def draw_marks(self, layer: int, marks: Sequence[tuple[float, float, int]]) -> None:
        """Show marks on a layer: x, y [px], kind; a kind of 0 is a short piece of a line."""
        quads = empty_quads(max(len(marks), 1))
        for quad, (x, y, kind) in zip(quads, marks, strict=False):
            quad[:, 0:4] = x, y, x, y
            quad[:, 6] = kind
        self.fill_layer(layer, np.ascontiguousarray(quads))
