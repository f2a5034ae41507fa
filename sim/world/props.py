"""Things that stand in a world, each with its solid shapes for the physics and its visible shapes for the camera."""

from __future__ import annotations

from dataclasses import dataclass

from sim.core.meshes import is_mesh
from sim.core.shapes import Colour, Quat, Shape, Vec3, from_yaw

__all__ = ["Prop", "block", "car", "cone", "foliage", "lamp", "tree", "twigs", "wall"]

ORANGE: Colour = (1.0, 0.36, 0.04)
WHITE: Colour = (0.95, 0.95, 0.93)
CONCRETE: Colour = (0.72, 0.71, 0.68)
STEEL: Colour = (0.42, 0.45, 0.48)
GLASS: Colour = (0.10, 0.14, 0.19)
RUBBER: Colour = (0.06, 0.06, 0.07)
RIM: Colour = (0.66, 0.68, 0.70)
TRIM: Colour = (0.12, 0.12, 0.13)
BARK: Colour = (0.36, 0.26, 0.18)
LEAF: Colour = (0.25, 0.42, 0.20)

_LYING: Quat = (0.7071067811865476, 0.0, 0.0, 0.7071067811865476)


@dataclass(frozen=True, slots=True)
class Prop:
    """A thing in its own frame or, after `at`, in the world's."""

    kind: str
    """What it is, in a word: `car`, `wall`, `fruit_tree`."""
    solids: tuple[Shape, ...]
    """Shapes that bodies and lasers hit."""
    visuals: tuple[Shape, ...]
    """Shapes that cameras see."""
    position: Vec3 = (0.0, 0.0, 0.0)

    @property
    def outlines(self) -> tuple[Shape, ...]:
        """What it looks like in plain shapes: in place of a surface of its own, what bodies and lasers hit."""
        return self.solids if any(is_mesh(shape.kind) for shape in self.visuals) else self.visuals

    def at(self, x: float, y: float, yaw: float, z: float = 0.0) -> Prop:
        """The same thing standing at (x, y) [m], `z` above 0, turned to `yaw` [rad]."""
        position, rotation = (x, y, z), from_yaw(yaw)
        return Prop(
            self.kind,
            tuple(shape.at(position, rotation) for shape in self.solids),
            tuple(shape.at(position, rotation) for shape in self.visuals),
            position,
        )


def cone(height: float = 0.6, colour: Colour = ORANGE, band: Colour = WHITE) -> Prop:
    """A traffic cone of the colour with a band round it, on a square foot; `height` [m]."""
    foot = 0.03
    body = height - foot
    bottom, top = 0.38 * height, 0.06

    def slice_(start: float, end: float, colour: Colour, grow: float = 0.0) -> Shape:
        low, high = (bottom + (top - bottom) * part for part in (start, end))
        return Shape(
            "cylinder",
            (low + grow, low + grow, (end - start) * body),
            (0.0, 0.0, foot + body * (start + end) / 2),
            colour=colour,
            taper=((high + grow) / (low + grow),) * 2,
            glow=0.18,
        )

    side = bottom * 1.5
    solid = Shape(
        "cylinder", (bottom, bottom, height), (0.0, 0.0, height / 2), colour=colour, taper=(top / bottom,) * 2
    )
    plate = Shape("box", (side, side, foot), (0.0, 0.0, foot / 2), colour=colour, glow=0.12)
    bands = (slice_(0.0, 0.42, colour), slice_(0.42, 0.70, band), slice_(0.70, 1.0, colour))
    return Prop("cone", (solid,), (plate, *bands))


def wall(length: float, height: float, thickness: float) -> Prop:
    """A low concrete wall along x with a lighter coping; all in [m]."""
    size = (length, thickness, height)
    coping = (length, thickness + 0.06, 0.06)
    return Prop(
        "wall",
        (Shape("box", size, (0.0, 0.0, height / 2), colour=CONCRETE),),
        (
            Shape("box", (length, thickness, height - 0.06), (0.0, 0.0, height / 2 - 0.03), colour=CONCRETE),
            Shape("box", coping, (0.0, 0.0, height - 0.03), colour=(0.80, 0.79, 0.76)),
        ),
    )


def block(length: float, width: float, height: float, colour: Colour) -> Prop:
    """A plain box on the ground; all in [m]."""
    shape = Shape("box", (length, width, height), (0.0, 0.0, height / 2), colour=colour)
    return Prop("block", (shape,), (shape,))


def lamp(height: float = 5.0) -> Prop:
    """A lamp post of `height` [m] on a round concrete foot, its arm along x."""
    foot = Shape("cylinder", (0.44, 0.44, 0.5), (0.0, 0.0, 0.25), colour=CONCRETE)
    pole = Shape("cylinder", (0.16, 0.16, height), (0.0, 0.0, height / 2), colour=STEEL, taper=(0.6, 0.6))
    stripe = Shape("cylinder", (0.455, 0.455, 0.12), (0.0, 0.0, 0.40), colour=(0.86, 0.72, 0.16))
    arm = Shape("box", (1.3, 0.07, 0.07), (0.55, 0.0, height), colour=STEEL)
    head = Shape("box", (0.6, 0.22, 0.09), (1.05, 0.0, height - 0.03), colour=(0.83, 0.85, 0.86))
    straight = Shape("cylinder", (0.16, 0.16, height), (0.0, 0.0, height / 2), colour=STEEL)
    return Prop("lamp", (foot, straight), (foot, stripe, pole, arm, head))


def foliage(size: Vec3, middle: Vec3, colour: Colour) -> tuple[Shape, ...]:
    """Leaves that fill a ball: a dense one in the shade, and round it one with gaps."""
    core: Vec3 = (size[0] * 0.84, size[1] * 0.84, size[2] * 0.84)
    red, green, blue = colour
    shade: Colour = (red * 0.72, green * 0.74, blue * 0.72)
    return (Shape("leaves", core, middle, colour=shade), twigs(size, middle, colour))


def twigs(size: Vec3, middle: Vec3, colour: Colour) -> Shape:
    """A ball of leaves that one sees through here and there."""
    return Shape("leaves", size, middle, from_yaw(1.3), colour=colour, glow=0.5)


def tree(height: float = 6.0) -> Prop:
    """A leafy tree of `height` [m]."""
    trunk = Shape(
        "cylinder", (0.34, 0.34, height * 0.5), (0.0, 0.0, height * 0.25), colour=BARK, taper=(0.7, 0.7)
    )
    lower = tuple(
        twigs((height * share,) * 3, (height * x, height * y, height * z), LEAF)
        for share, x, y, z in ((0.44, 0.15, 0.08, 0.54), (0.42, -0.13, -0.08, 0.57))
    )
    crown = (*foliage((height * 0.64,) * 3, (0.0, 0.0, height * 0.67), LEAF), *lower)
    return Prop("tree", (trunk,), (trunk, *crown))


@dataclass(frozen=True, slots=True)
class _Body:
    """The proportions of a car, all in [m]; x is forward."""

    length: float
    width: float
    belt: float
    """Height of the lower edge of the windows."""
    height: float
    cabin: tuple[float, float]
    """Rear and front end of the cabin at the belt, along x."""
    roof: tuple[float, float]
    """Length and width of the roof as a part of the cabin's."""


_BODIES = {
    "sedan": _Body(4.5, 1.78, 0.86, 1.42, (-1.75, 1.05), (0.55, 0.80)),
    "hatchback": _Body(3.9, 1.72, 0.88, 1.48, (-1.85, 0.95), (0.70, 0.82)),
    "suv": _Body(4.6, 1.88, 1.02, 1.70, (-2.15, 1.05), (0.76, 0.84)),
    "van": _Body(4.9, 1.95, 1.15, 1.98, (-2.40, 1.75), (0.84, 0.88)),
}

CAR_MODELS = tuple(_BODIES)


def car(model: str, colour: Colour) -> Prop:
    """A parked car, its nose along x; `model` is one of `CAR_MODELS`."""
    body = _BODIES[model]
    visuals = (*_hull(body, colour), *_cabin(body, colour), *_wheels(body), *_lights(body))
    rear, front = body.cabin
    solids = (
        Shape(
            "box",
            (body.length, body.width, body.belt - 0.16),
            (0.0, 0.0, (body.belt + 0.16) / 2),
            colour=colour,
        ),
        Shape(
            "box",
            (front - rear, body.width * 0.9, body.height - body.belt),
            ((front + rear) / 2, 0.0, (body.height + body.belt) / 2),
            colour=GLASS,
        ),
        *(
            Shape("box", (0.6, 0.2, 0.2), (x, y, 0.1), colour=RUBBER)
            for x in (-body.length * 0.3, body.length * 0.3)
            for y in (-body.width / 2 + 0.12, body.width / 2 - 0.12)
        ),
    )
    return Prop("car", solids, visuals)


def _hull(body: _Body, colour: Colour) -> tuple[Shape, ...]:
    length, width, belt = body.length, body.width, body.belt
    waist = belt - 0.26
    return (
        Shape("box", (length * 0.985, width * 0.96, 0.14), (0.0, 0.0, 0.25), colour=TRIM),
        Shape("box", (length, width, waist - 0.28), (0.0, 0.0, (waist + 0.28) / 2), colour=colour, gloss=0.5),
        Shape(
            "box",
            (length * 0.99, width * 0.99, belt - waist),
            (0.0, 0.0, (belt + waist) / 2),
            colour=colour,
            taper=(0.955, 0.90),
            gloss=0.6,
        ),
    )


def _cabin(body: _Body, colour: Colour) -> tuple[Shape, ...]:
    rear, front = body.cabin
    middle, span, rise = (front + rear) / 2, front - rear, body.height - body.belt
    width = body.width * 0.90
    tx, ty = body.roof
    glass = Shape(
        "box",
        (span, width, rise),
        (middle, 0.0, body.belt + rise / 2),
        colour=GLASS,
        taper=body.roof,
        gloss=1.0,
    )
    roof = Shape(
        "box",
        (span * tx + 0.10, width * ty + 0.06, 0.07),
        (middle, 0.0, body.height),
        colour=colour,
        taper=(0.93, 0.90),
        gloss=0.6,
    )
    pillars = tuple(
        Shape(
            "box",
            (0.09, width + 0.012, rise),
            (middle + offset, 0.0, body.belt + rise / 2),
            colour=colour,
            taper=(1.0, ty),
            gloss=0.3,
        )
        for offset in (-span * tx * 0.30, span * tx * 0.10)
    )
    return (glass, roof, *pillars)


def _wheels(body: _Body) -> tuple[Shape, ...]:
    shapes: list[Shape] = []
    radius = 0.32
    for x in (-body.length * 0.30, body.length * 0.31):
        for side in (-1, 1):
            y = side * (body.width / 2 - 0.10)
            shapes.append(Shape("cylinder", (0.76, 0.76, 0.222), (x, y, radius + 0.03), _LYING, TRIM))
            shapes.append(Shape("cylinder", (0.64, 0.64, 0.235), (x, y, radius), _LYING, RUBBER))
            shapes.append(Shape("cylinder", (0.40, 0.40, 0.245), (x, y, radius), _LYING, RIM, gloss=0.6))
            shapes.append(Shape("cylinder", (0.12, 0.12, 0.255), (x, y, radius), _LYING, TRIM))
    return tuple(shapes)


def _lights(body: _Body) -> tuple[Shape, ...]:
    nose, tail = body.length / 2, -body.length / 2
    height, side = body.belt - 0.24, body.width / 2 - 0.24
    shapes = [
        Shape("box", (0.04, 0.9, 0.12), (nose, 0.0, height - 0.03), colour=TRIM),
        Shape("box", (0.03, 0.52, 0.11), (nose + 0.01, 0.0, 0.40), colour=WHITE),
        Shape("box", (0.03, 0.52, 0.11), (tail - 0.01, 0.0, height - 0.10), colour=WHITE),
        Shape("box", (0.06, body.width * 0.9, 0.14), (tail, 0.0, 0.33), colour=TRIM),
    ]
    for sign in (-1, 1):
        shapes.append(
            Shape("box", (0.05, 0.34, 0.13), (nose, sign * side, height), colour=(0.93, 0.94, 0.90), glow=0.4)
        )
        shapes.append(
            Shape(
                "box", (0.05, 0.28, 0.18), (tail, sign * side, height), colour=(0.62, 0.05, 0.07), glow=0.35
            )
        )
        mirror_x = body.cabin[1] - 0.32
        shapes.append(
            Shape(
                "box",
                (0.12, 0.20, 0.14),
                (mirror_x, sign * (body.width / 2 + 0.04), body.belt + 0.04),
                colour=TRIM,
            )
        )
    return tuple(shapes)
