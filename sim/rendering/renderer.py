"""Pictures of a world by OpenGL without a window (EGL): quick enough on one CPU core for a camera at 15 Hz."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from sim.core.meshes import is_mesh
from sim.core.shapes import Colour, Shape
from sim.rendering.mipmaps import add_mipmaps
from sim.rendering.patterns import LEAVES_SIZE, leaves, web
from sim.rendering.sky import HORIZON, SIZE, ZENITH, dome, grain, panorama, seen
from sim.rendering.view import View
from sim.world.ground_picture import SUN, markings
from sim.world.lamp_light import lamp_light
from sim.world.solids import FLOATS, KINDS, mesh, rows
from sim.world.world import World

__all__ = ["NoRendererError", "Renderer", "paint"]

HAZE: Colour = (0.72, 0.78, 0.80)
DEEP: Colour = (0.10, 0.38, 0.43)
"""Colour that everything fades to under water."""
MURK = 0.23
"""One by the distance in water at which a little more than half is left of what is seen [1/m]."""
RIPPLE_PERIOD = 100.0
"""After this time what moves on water is as it was: all its speeds are hundredths of a pattern a second [s]."""
GRAIN = 0.43
"""Of the ground, how often it is repeated in a metre; `ground.frag.glsl` has it, too."""
LOOKS = ("asphalt", "water", "floor", "grass", "sand", "ceiling", "surface")
"""As `ground.frag.glsl` numbers them."""

_PLAIN = {"MURKY": 0, "INDOOR": 0, "SIGNS": 0, "GRAINED": 0, "ROWS": 0, "LINES": 0}
"""A plane without anything painted on it."""
_SHADERS = Path(__file__).parent / "shaders"
_LAYOUT = "3f 4f 3f 2f 3f 2f/i"
_FIELDS = ("position", "rotation", "size", "taper", "tint", "finish")
_MIN_APPARENT_RADIUS = 0.0032
"""Smallest radius over distance of a shape that is drawn: a pixel or so."""
_MIN_APPARENT_RADIUS_INDOORS = 0.007
"""The same under a ceiling, where many small things stand behind walls."""


class NoRendererError(RuntimeError):
    """OpenGL without a window is not to be had on this machine; the text says why."""


def _context() -> moderngl.Context:
    # Mesa's software renderer would else take every core for pictures that one core draws in 10 ms.
    os.environ.setdefault("LP_NUM_THREADS", "1")
    backend: Any = "egl"
    try:
        return moderngl.create_context(standalone=True, backend=backend)
    except Exception as fault:
        # glcontext raises plain Exception for every cause.
        raise NoRendererError(f"Pictures cannot be drawn by OpenGL here: {fault}.") from fault


def paint(world: World) -> None:
    """Paint the pictures of ground and sky beforehand, which takes most of the time that a Renderer of `world` takes."""
    markings(world)
    lamp_light(world)
    panorama()


class _Solids:
    """All shapes of one kind, polished or matt: the fixed ones as a table, and the buffer from which the visible ones are drawn."""

    def __init__(
        self,
        kind: str,
        fixed: Iterable[Shape],
        context: moderngl.Context,
        *,
        glossy: bool = False,
        least: float = _MIN_APPARENT_RADIUS,
    ) -> None:
        self._kind, self._glossy, self._context, self._least = kind, glossy, context, least
        corners, order = mesh(kind)
        self.fixed = rows(filter(self._takes, fixed))
        self._reach = _reach(self.fixed)
        self._buffer = context.buffer(reserve=max(len(self.fixed) + 64, 1) * FLOATS * 4)
        self._order = context.buffer(order)
        self._content = [
            (context.buffer(corners), "3f 3f", "corner", "normal"),
            (self._buffer, _LAYOUT, *_FIELDS),
        ]
        self._arrays: dict[moderngl.Program, moderngl.VertexArray] = {}

    def draw(self, program: moderngl.Program, view: View, moving: Sequence[Shape]) -> None:
        table = _seen_nearest_first(self.fixed, self._reach, view, self._least)
        others = rows(filter(self._takes, moving))
        if len(others):
            table = np.concatenate((table, others))
        if len(table):
            self._buffer.orphan(max(self._buffer.size, table.nbytes))
            self._buffer.write(np.ascontiguousarray(table))
            if program not in self._arrays:
                self._arrays[program] = self._context.vertex_array(
                    program, self._content, index_buffer=self._order
                )
            self._arrays[program].render(moderngl.TRIANGLES, instances=len(table))

    def _takes(self, shape: Shape) -> bool:
        return shape.kind == self._kind and (shape.gloss > 0.0) == self._glossy


def _reach(table: NDArray[np.float32]) -> NDArray[Any]:
    """Radius of the ball round each shape [m]."""
    return np.asarray(np.linalg.norm(table[:, 7:10], axis=1) / 2)


@lru_cache(maxsize=4)
def _sight(view: View) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Of a view the eye, and its axes as columns; the same for each kind of solid in a picture."""
    return np.array(view.eye, dtype=np.float32), view.axes.astype(np.float32)


def _seen_nearest_first(
    table: NDArray[np.float32], reach: NDArray[Any], view: View, least: float
) -> NDArray[np.float32]:
    """The shapes that the view can see and that are large enough to be worth it, in drawing order.

    Those that hide others come first, so that no hidden pixel is coloured.
    """
    if not len(table):
        return table
    eye, axes = _sight(view)
    offset = table[:, :3] - eye
    found = np.arange(len(table)) if view.flat else _visible(offset @ axes, reach, view, least)
    offset = offset[found]
    offset *= offset
    return np.asarray(table[found[np.argsort(offset.sum(axis=1), kind="stable")]])


def _visible(seen: NDArray[Any], reach: NDArray[Any], view: View, least: float) -> NDArray[np.int64]:
    """Which shapes at these places, to the right, up and back of the eye [m], are in sight and large enough."""
    half_x, half_y = view.half_extent
    ahead = -seen[:, 2]
    sides = np.abs(seen[:, :2])
    inside = sides[:, 0] < ahead * half_x + reach * math.hypot(1, half_x)
    inside &= sides[:, 1] < ahead * half_y + reach * math.hypot(1, half_y)
    inside &= ahead > -reach
    inside &= reach > ahead * least
    return np.flatnonzero(inside)


class Renderer:
    """Draws one world. Calls may come from different threads, one at a time."""

    def __init__(self, world: World, *, samples: int = 0) -> None:
        """Prepare the pictures of `world`; 4 `samples` a pixel smooth the edges but cost ten times the time.

        Raises NoRendererError.
        """
        self._context = _context()
        self._samples = min(samples, self._context.max_samples)
        self._pixels = np.empty((0, 0, 4), dtype=np.uint8)
        self._targets: dict[tuple[int, int], tuple[moderngl.Framebuffer, moderngl.Framebuffer]] = {}
        with self._context:
            self._prepare(world)

    def render(self, view: View, moving: Sequence[Shape] = ()) -> NDArray[np.uint8]:
        """Picture of the world and of the `moving` shapes from `view`: (height, width, 3) RGB, top row first."""
        return self.draw(view, moving)[:, :, :3].copy()

    def draw(self, view: View, moving: Sequence[Shape] = ()) -> NDArray[np.uint8]:
        """The same with a fourth byte a pixel that means nothing, and only until it draws again: quicker than `render`."""
        width, height = view.size
        with self._context:
            drawn, resolved = self._target(view.size)
            drawn.use()
            self._under = self._world.water is not None and not view.flat and view.eye[2] < 0.0
            drawn.clear(*(DEEP if self._under else HAZE), 1.0)
            self._draw(view, moving)
            if resolved is not drawn:
                self._context.copy_framebuffer(resolved, drawn)
            if self._pixels.shape != (height, width, 4):
                self._pixels = np.empty((height, width, 4), dtype=np.uint8)
            resolved.read_into(self._pixels, components=4, alignment=1)
        return self._pixels

    def close(self) -> None:
        """Free the context; closing twice does nothing."""
        self._context.release()

    def _prepare(self, world: World) -> None:
        context = self._context
        self._world, self._under = world, False
        self._made: dict[tuple[str, tuple[tuple[str, int], ...]], moderngl.Program] = {}
        self._square = context.buffer(
            np.array([-1, -1, 1, -1, 1, 1, -1, -1, 1, 1, -1, 1], dtype=np.float32).tobytes()
        )
        self._sky = self._program("sky")
        corners, order = dome()
        self._sky_array = context.vertex_array(
            self._sky, [(context.buffer(corners), "3f 2f", "direction", "mark")], context.buffer(order)
        )
        self._planes: dict[moderngl.Program, moderngl.VertexArray] = {}
        least = _MIN_APPARENT_RADIUS_INDOORS if world.ceiling else _MIN_APPARENT_RADIUS
        self._solids = [
            (glossy, _Solids(kind, world.visuals, context, glossy=glossy, least=least))
            for glossy in (False, True)
            for kind in _kinds(world)
        ]
        self._leaves = _Solids("leaves", world.visuals, context)
        self._overhead = _Solids("box", world.overhead, context, least=0.02)
        self._load_textures(world)

    def _program(self, name: str, **constants: int) -> moderngl.Program:
        """The program of this name with these constants, made when it is first asked for."""
        key = (name, tuple(constants.items()))
        if key not in self._made:
            head = "".join(f"\n#define {constant} {value}" for constant, value in constants.items())
            vertex, fragment = (
                _source(f"{name}.{stage}.glsl").replace("#version 330", f"#version 330{head}", 1)
                for stage in ("vert", "frag")
            )
            made = self._context.program(vertex_shader=vertex, fragment_shader=fragment)
            self._set_constants(made)
            self._made[key] = made
        return self._made[key]

    def _set_constants(self, program: moderngl.Program) -> None:
        """Set the uniforms that stay the same for this world."""
        world = self._world
        length = float(np.linalg.norm(SUN))
        for name, value in {
            "panorama": 2,
            "markings": 0,
            "grain": 1,
            "lamplight": 3,
            "leaves": 4,
            "extent": (world.ground.length, world.ground.width),
            "sun": tuple(part / length for part in SUN),
            "zenith": ZENITH,
            "horizon": HORIZON,
            "murk": MURK,
        }.items():
            _set(program, name, value)
        if "rows" in program:
            _paint_lines(program, world)

    def _load_textures(self, world: World) -> None:
        size, data = markings(world)
        if _grained(world):
            data = _with_grain(world, size, data)
        self._markings = self._context.texture(size, 2, data, alignment=1)
        self._markings.repeat_x = self._markings.repeat_y = False
        # Mesa's software renderer looks four bytes up quicker than one.
        channels = np.repeat((grain() * 255).astype(np.uint8).reshape(-1, 1), 4, axis=1)
        if world.water:
            channels[:, 1] = (web() * 255).reshape(-1)
        pattern = channels.tobytes()
        self._grain = self._context.texture((256, 256), 4, pattern)
        for unit, (texture, its) in enumerate(((self._markings, data), (self._grain, pattern))):
            add_mipmaps(texture, its, unit)
            # Both are soft: one level of detail gives way to the next unseen, and a look-up costs half.
            texture.filter = (moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR)
        size, light = lamp_light(world)
        self._lamplight = self._context.texture(size, 1, light, alignment=1)
        self._lamplight.repeat_x = self._lamplight.repeat_y = False
        self._lamplight.use(3)
        self._leaf_picture = self._context.texture((LEAVES_SIZE,) * 2, 4, leaves())
        add_mipmaps(self._leaf_picture, leaves(), 4)
        self._leaf_picture.filter = (moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR)
        self._panorama = self._context.texture(SIZE, 4, panorama())
        self._panorama.repeat_y = False
        self._panorama.use(2)

    def _ground(self, view: View) -> moderngl.Program:
        """Draws the visible ground: from under water its bottom."""
        world = self._world
        marked = bool(world.bays or world.lines)
        program = self._program(
            "ground",
            LOOK=LOOKS.index("sand" if self._under else world.ground.look),
            MURKY=int(self._under),
            INDOOR=int(world.ceiling is not None),
            SIGNS=int(bool(world.arrows)),
            GRAINED=int(_grained(world)),
            ROWS=max(len(world.bays), 1) if marked else 0,
            LINES=max(len(world.lines), 1) if marked else 0,
        )
        # a map shows what lies under water
        _set(program, "level", world.bottom if self._under or (world.water and view.flat) else 0.0)
        return program

    def _target(self, size: tuple[int, int]) -> tuple[moderngl.Framebuffer, moderngl.Framebuffer]:
        if size not in self._targets:
            context = self._context
            colour = context.renderbuffer(size, 3, samples=self._samples)
            depth = context.depth_renderbuffer(size, samples=self._samples)
            drawn = context.framebuffer([colour], depth)
            resolved = context.framebuffer([context.renderbuffer(size, 3)]) if self._samples else drawn
            self._targets[size] = drawn, resolved
        return self._targets[size]

    def _draw(self, view: View, moving: Sequence[Shape]) -> None:
        context = self._context
        context.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        # The picture is drawn upside down, which turns the triangles round.
        context.front_face = "cw"
        matrix = np.ascontiguousarray(view.matrix().T, dtype=np.float32).tobytes()
        inside = {"MURKY": int(self._under), "INDOOR": int(self._world.ceiling is not None)}
        for glossy, solids in self._solids:
            program = self._program("solid", GLOSSY=int(glossy), **inside)
            self._aim(program, view, matrix)
            solids.draw(program, view, moving)
        if self._below(view):
            self._overhead.draw(self._program("solid", GLOSSY=0, **inside), view, ())
        if len(self._leaves.fixed):
            program = self._program("leaves")
            self._aim(program, view, matrix)
            self._leaves.draw(program, view, ())
        context.enable_only(moderngl.DEPTH_TEST)
        for program, centre, reach in self._levels(view):
            self._aim(program, view, matrix)
            program["centre"], program["reach"] = centre, reach
            if program not in self._planes:
                self._planes[program] = context.vertex_array(program, [(self._square, "2f", "corner")])
            self._planes[program].render()
        if not (view.flat or self._under):
            self._aim(self._sky, view, matrix)
            # The dome lies at the very end of the depth range.
            context.depth_func = "<="
            first, count = seen(*view.round)
            self._sky_array.render(moderngl.TRIANGLES, count, first=first)
            context.depth_func = "<"

    def _below(self, view: View) -> bool:
        """The view is from under the ceiling."""
        ceiling = self._world.ceiling
        return ceiling is not None and not view.flat and view.eye[2] < ceiling.height

    def _levels(self, view: View) -> Iterator[tuple[moderngl.Program, tuple[float, float], float]]:
        """The level planes that are seen: what draws each, its middle and how far it reaches [m]."""
        middle = (view.eye[0], view.eye[1])
        yield self._ground(view), middle, 390.0
        ceiling, ground = self._world.ceiling, self._world.ground
        if ceiling is not None and self._below(view):
            program = self._program("ground", LOOK=LOOKS.index("ceiling"), **_PLAIN)
            _set(program, "level", ceiling.height - 0.01)
            yield program, (0.0, 0.0), max(ground.length, ground.width) / 2
        if self._under:
            program = self._program("ground", LOOK=LOOKS.index("surface"), **_PLAIN | {"MURKY": 1})
            _set(program, "level", 0.0)
            yield program, middle, 390.0

    def _aim(self, program: moderngl.Program, view: View, matrix: bytes) -> None:
        uniform: Any = program["view_projection"]
        uniform.write(matrix)
        _set(program, "eye", view.eye)
        _set(program, "time", view.time % RIPPLE_PERIOD)
        _set(program, "haze", DEEP if self._under else HAZE)


def _kinds(world: World) -> list[str]:
    """The kinds of solids to draw: the plain ones, and each surface that a model of the world has."""
    own = dict.fromkeys(shape.kind for shape in world.visuals if is_mesh(shape.kind))
    return [*(kind for kind in KINDS if kind != "leaves"), *own]


def _paint_lines(program: moderngl.Program, world: World) -> None:
    """Hand the painted lines over; a world without any of one sort gets one far away."""
    rows_ = [(row.x, row.y, row.width, row.depth) for row in world.bays] or [(1e6, 1e6, 1.0, 1.0)]
    lines = [(*line.start, *line.end, line.width) for line in world.lines] or [(1e6, 1e6, 1e6 + 1, 1e6, 0.1)]
    lengths = [math.hypot(c - a, d - b) for a, b, c, d, _ in lines]
    _fill(program, "rows", rows_)
    _fill(program, "bays", [(row.count, 1 / row.width) for row in world.bays] or [(1.0, 1.0)])
    _fill(
        program,
        "lines",
        [(a, b, (c - a) / way, (d - b) / way) for (a, b, c, d, _), way in zip(lines, lengths, strict=True)],
    )
    _fill(program, "widths", [(line[4] / 2, way) for line, way in zip(lines, lengths, strict=True)])


def _grained(world: World) -> bool:
    """The grain of the ground is fine enough on the picture of its shadows, which has room for it."""
    return world.ground.look == "floor" and not world.arrows


def _with_grain(world: World, size: tuple[int, int], data: bytes) -> bytes:
    """The `markings` with the grain in place of the signs, of which there are none."""
    pattern = grain()
    soft = (pattern + np.roll(pattern, 1, 0) + np.roll(pattern, 1, 1) + np.roll(pattern, (1, 1), (0, 1))) / 4
    columns, lines = (
        (((np.arange(count) + 0.5) / count - 0.5) * extent * GRAIN % 1.0 * len(soft)).astype(int)
        for count, extent in zip(size, (world.ground.length, world.ground.width), strict=True)
    )
    both = np.frombuffer(data, dtype=np.uint8).reshape(size[1], size[0], 2).copy()
    both[:, :, 0] = soft[np.ix_(lines, columns)] * 255
    return both.tobytes()


def _source(name: str) -> str:
    """A shader's text with what it includes."""
    lines = (_SHADERS / name).read_text("utf-8").splitlines()
    return "\n".join(_source(line.split('"')[1]) if line.startswith("#include") else line for line in lines)


def _set(program: moderngl.Program, name: str, value: Any) -> None:
    """Set a uniform, if this program looks at it."""
    if name in program:
        program[name] = value


def _fill(program: moderngl.Program, name: str, values: Any) -> None:
    """Set a uniform from many numbers."""
    uniform: Any = program[name]
    uniform.write(np.ascontiguousarray(values, dtype=np.float32).tobytes())
