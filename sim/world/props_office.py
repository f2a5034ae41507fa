"""What makes an office of bare walls: walls with windows and skirting, doors, lamps on the ceiling, chairs, shelves and sofas."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from sim.core.shapes import Colour, Shape, Vec3
from sim.world.props import Prop

__all__ = ["chair", "desk_things", "door", "lamp_panel", "room_wall", "shelf", "sofa"]

WOOD: Colour = (0.60, 0.45, 0.30)
DOOR: Colour = (0.55, 0.40, 0.27)
FRAME: Colour = (0.36, 0.37, 0.39)
SKIRTING: Colour = (0.42, 0.40, 0.38)
DARK: Colour = (0.13, 0.13, 0.15)
FABRIC: Colour = (0.18, 0.24, 0.33)
METAL: Colour = (0.62, 0.64, 0.66)
SCREEN: Colour = (0.30, 0.46, 0.62)
PAPER: Colour = (0.90, 0.90, 0.87)
LAMP: Colour = (1.0, 0.97, 0.88)
SPINES: tuple[Colour, ...] = (
    (0.26, 0.33, 0.45),
    (0.72, 0.70, 0.64),
    (0.30, 0.42, 0.34),
    (0.46, 0.47, 0.50),
    (0.52, 0.44, 0.50),
)

MAX_PIECE = 1.7
"""A wall is drawn in pieces of at most this length, for light is worked out at their corners [m]."""
_SKIRTING_HEIGHT = 0.09

Opening = tuple[float, float, float, float]
"""A window: where it begins and ends along the wall, and its lower and upper edge [m]."""


def room_wall(
    length: float, height: float, thickness: float, colour: Colour, windows: Sequence[Opening] = ()
) -> tuple[Shape, ...]:
    """What one sees of a wall along x round its middle, seen from within: pieces between the `windows`, frames, skirting."""
    shapes: list[Shape] = []

    def piece(start: float, end: float, low: float, high: float) -> None:
        middle: Vec3 = ((start + end) / 2, 0.0, (low + high) / 2)
        shapes.append(Shape("box", (end - start, thickness, high - low), middle, colour=colour))

    for start, end in _free(length, windows):
        piece(start, end, 0.0, height)
    for start, end, sill, head in windows:
        piece(start, end, 0.0, sill)
        piece(start, end, head, height)
        shapes.extend(_frame(start, end, sill, head, thickness))
    size = (length, thickness + 0.03, _SKIRTING_HEIGHT)
    shapes.append(Shape("box", size, (0.0, 0.0, _SKIRTING_HEIGHT / 2), colour=SKIRTING))
    return tuple(shapes)


def _free(length: float, windows: Sequence[Opening]) -> Iterator[tuple[float, float]]:
    """The stretches of a wall without a window, none longer than `MAX_PIECE`."""
    at = -length / 2
    for start, end, *_ in sorted(windows):
        yield from _pieces(at, start)
        at = end
    yield from _pieces(at, length / 2)


def _pieces(start: float, end: float) -> Iterator[tuple[float, float]]:
    count = math.ceil((end - start) / MAX_PIECE - 1e-9)
    for number in range(count):
        yield start + (end - start) * number / count, start + (end - start) * (number + 1) / count


def _frame(start: float, end: float, sill: float, head: float, thickness: float) -> Iterator[Shape]:
    """The sill, the four bars and the mullion of a window."""
    middle, span, rise, bar = (start + end) / 2, end - start, head - sill, 0.06
    yield Shape("box", (span + 0.1, thickness + 0.14, 0.04), (middle, 0.0, sill), colour=PAPER)
    for z in (sill + bar / 2, head - bar / 2):
        yield Shape("box", (span, 0.08, bar), (middle, 0.0, z), colour=FRAME)
    for x in (start + bar / 2, middle, end - bar / 2):
        yield Shape("box", (bar, 0.08, rise), (x, 0.0, (sill + head) / 2), colour=FRAME)


def door(width: float, height: float, ceiling: float, thickness: float) -> Prop:
    """A doorway in a wall along x, `width` from one end of the wall to the other [m].

    Its leaf has slid aside, along the face of the wall towards y, where it keeps nobody from passing: a picture without solids.
    """
    jamb, deep = 0.07, thickness + 0.05
    half = (width - thickness) / 2  # the walls' ends are rounded off by half their thickness
    lintel = Shape(
        "box",
        (width, thickness, ceiling - height),
        (0.0, 0.0, (ceiling + height) / 2),
        colour=(0.86, 0.85, 0.81),
    )
    posts = tuple(
        Shape("box", (jamb, deep, height), (side * (half + 0.01), 0.0, height / 2), colour=FRAME)
        for side in (-1, 1)
    )
    head = Shape("box", (2 * half + 0.09, deep, jamb), (0.0, 0.0, height), colour=FRAME)
    face = thickness / 2 + 0.015
    span = 2 * half + 0.06
    aside = half + 0.05 + span / 2
    leaf = Shape("box", (span, 0.03, height - 0.02), (aside, face, height / 2), colour=DOOR, gloss=0.12)
    panel = Shape(
        "box",
        (span * 0.5, 0.036, height * 0.4),
        (aside, face, height * 0.66),
        colour=(0.62, 0.70, 0.74),
        gloss=0.5,
    )
    grip = Shape(
        "box", (0.03, 0.05, 0.30), (aside - span / 2 + 0.1, face + 0.015, 1.0), colour=METAL, gloss=0.5
    )
    rail = Shape("box", (2 * span + 0.1, 0.05, 0.05), (span / 2 + 0.02, face, height + 0.06), colour=METAL)
    sign = Shape(
        "box", (0.22, 0.012, 0.12), (-half - 0.30, -thickness / 2 - 0.006, 1.5), colour=(0.20, 0.34, 0.50)
    )
    return Prop("door", (), (lintel, *posts, head, leaf, panel, grip, rail, sign))


def lamp_panel(length: float, width: float) -> tuple[Shape, ...]:
    """What one sees of a lamp on the ceiling from below: its frame, and the pane that shines; its upper side at z = 0."""
    return (
        Shape("box", (length + 0.06, width + 0.06, 0.03), (0.0, 0.0, -0.015), colour=METAL),
        Shape("box", (length, width, 0.03), (0.0, 0.0, -0.03), colour=LAMP, glow=1.0),
    )


def desk_things(length: float, width: float, height: float, screens: int) -> tuple[Shape, ...]:
    """What lies and stands on a table where somebody works, who sits on its side towards y."""
    shapes: list[Shape] = []
    for number in range(screens):
        x = (number - (screens - 1) / 2) * 0.58
        shapes += [
            Shape("box", (0.24, 0.16, 0.015), (x, -width * 0.22, height + 0.008), colour=DARK),
            Shape("box", (0.05, 0.03, 0.20), (x, -width * 0.25, height + 0.10), colour=DARK),
            Shape("box", (0.54, 0.03, 0.33), (x, -width * 0.22, height + 0.31), colour=DARK),
            Shape(
                "box", (0.51, 0.005, 0.30), (x, -width * 0.22 + 0.018, height + 0.31), colour=SCREEN, glow=0.7
            ),
        ]
    if screens:
        shapes += [
            Shape("box", (0.42, 0.14, 0.02), (0.0, width * 0.12, height + 0.01), colour=DARK),
            Shape("box", (0.21, 0.30, 0.025), (-length * 0.36, 0.06, height + 0.013), colour=PAPER),
            Shape(
                "cylinder",
                (0.08, 0.08, 0.09),
                (length * 0.38, 0.1, height + 0.045),
                colour=(0.30, 0.42, 0.46),
            ),
            Shape(
                "box",
                (length - 0.12, 0.02, height * 0.45),
                (0.0, -width / 2 + 0.06, height * 0.72),
                colour=WOOD,
            ),
        ]
    return tuple(shapes)


def chair() -> Prop:
    """A swivel chair that looks along x, 0.95 m tall."""
    seat = Shape("box", (0.46, 0.46, 0.08), (0.0, 0.0, 0.46), colour=FABRIC)
    back = Shape("box", (0.07, 0.42, 0.46), (-0.23, 0.0, 0.74), colour=FABRIC, taper=(1.0, 0.9))
    stem = Shape("cylinder", (0.06, 0.06, 0.36), (0.0, 0.0, 0.25), colour=METAL, gloss=0.4)
    feet = (
        Shape("box", (0.56, 0.05, 0.05), (0.0, 0.0, 0.07), colour=DARK),
        Shape("box", (0.05, 0.56, 0.05), (0.0, 0.0, 0.07), colour=DARK),
    )
    arms = tuple(Shape("box", (0.26, 0.05, 0.04), (0.0, side * 0.25, 0.66), colour=DARK) for side in (-1, 1))
    solids = (
        Shape("cylinder", (0.56, 0.56, 0.50), (0.0, 0.0, 0.25)),
        Shape("box", (0.10, 0.44, 0.48), (-0.23, 0.0, 0.73)),
    )
    return Prop("chair", solids, (seat, back, stem, *feet, *arms))


def shelf(length: float, width: float, height: float) -> Prop:
    """A bookcase along x that opens towards -y, full of folders; all in [m]."""
    solid = Shape("box", (length, width, height), (0.0, 0.0, height / 2))
    back = Shape("box", (length, 0.03, height), (0.0, width / 2 - 0.015, height / 2), colour=WOOD)
    sides = tuple(
        Shape("box", (0.03, width, height), (side * (length / 2 - 0.015), 0.0, height / 2), colour=WOOD)
        for side in (-1, 1)
    )
    floors = max(2, round(height / 0.4))
    boards = tuple(
        Shape(
            "box",
            (length - 0.06, width, 0.03),
            (0.0, 0.0, 0.03 + (height - 0.06) * number / floors),
            colour=WOOD,
        )
        for number in range(floors + 1)
    )
    return Prop("shelf", (solid,), (back, *sides, *boards, *_folders(length, width, height, floors)))


def _folders(length: float, width: float, height: float, floors: int) -> Iterator[Shape]:
    """Groups of folders of one colour, from floor to floor; here and there a place is empty."""
    step = 0.22
    count = int((length - 0.1) / step)
    for number in range(floors):
        low = 0.045 + (height - 0.06) * number / floors
        for place in range(count):
            kind = (number * 7 + place * 3) % (len(SPINES) + 2)
            if kind < len(SPINES):
                tall = 0.26 + 0.03 * (kind % 2)
                x = (place - (count - 1) / 2) * step
                size = (step - 0.03 - 0.02 * (kind % 3), width * 0.7, tall)
                yield Shape("box", size, (x, 0.02, low + tall / 2), colour=SPINES[kind])


def sofa(length: float) -> Prop:
    """A sofa of this length along y that looks along x [m]."""
    base = Shape("box", (0.80, length, 0.42), (0.0, 0.0, 0.21), colour=(0.34, 0.40, 0.38))
    back = Shape("box", (0.22, length, 0.80), (-0.29, 0.0, 0.40), colour=(0.30, 0.36, 0.34))
    arms = tuple(
        Shape("box", (0.80, 0.16, 0.60), (0.0, side * (length / 2 - 0.08), 0.30), colour=(0.30, 0.36, 0.34))
        for side in (-1, 1)
    )
    cushions = tuple(
        Shape(
            "box",
            (0.52, length / 2 - 0.20, 0.10),
            (0.10, side * (length / 4 - 0.05), 0.45),
            colour=(0.40, 0.46, 0.43),
        )
        for side in (-1, 1)
    )
    return Prop("sofa", (base, back, *arms), (base, back, *arms, *cushions))
