"""The signs painted on a world's ground and the shadows that its things throw there, as one picture."""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterable, Sequence
from functools import lru_cache

from PIL import Image, ImageChops, ImageDraw, ImageFilter

from sim.core.shapes import Shape, Vec3
from sim.world.lamp_light import lamp_light
from sim.world.tables import Spot
from sim.world.world import World

__all__ = ["SUN", "arrow_corners", "markings"]

RESOLUTION = 0.02
"""Edge of a pixel [m]."""
SUN: Vec3 = (-0.46, -0.52, 0.72)
"""Direction of the sun; unit length to a hundredth."""

_SHADOW_DEPTH = 0.48
"""Part of the light that a shadow takes."""
_CONTACT_DEPTH = 0.55
"""Part of the light that is lost right under a thing that nearly touches the ground."""
_ARROW = ((-1.1, 0.08), (0.4, 0.08), (0.4, 0.32), (1.2, 0.0), (0.4, -0.32), (0.4, -0.08), (-1.1, -0.08))

Point = tuple[float, float]


class _Sheet:
    """A grey picture over the whole ground that takes places in [m]."""

    def __init__(self, world: World) -> None:
        self._length, self._width = world.ground.length, world.ground.width
        size = (round(self._length / RESOLUTION), round(self._width / RESOLUTION))
        self.image = Image.new("L", size, 0)
        self._draw = ImageDraw.Draw(self.image)

    def polygon(self, corners: Sequence[Point]) -> None:
        """Fill a polygon; row 0 is the south edge."""
        pixels = [
            ((x + self._length / 2) / RESOLUTION, (y + self._width / 2) / RESOLUTION) for x, y in corners
        ]
        self._draw.polygon(pixels, fill=255)

    def blurred(self, radius: float) -> Image.Image:
        """The picture, blurred by `radius` [m]."""
        return self.image.filter(ImageFilter.GaussianBlur(radius / RESOLUTION))


def markings(world: World) -> tuple[tuple[int, int], bytes]:
    """Size in pixels and two bytes a pixel, row by row from the south-west corner: signs, and light left by shadows."""
    size, packed = _painted(world)
    return size, zlib.decompress(packed)


@lru_cache(maxsize=4)
def _painted(world: World) -> tuple[tuple[int, int], bytes]:
    """The same, compressed to a twentieth, to be kept while no camera needs it."""
    if world.water:
        return (1, 1), zlib.compress(bytes((0, 255)))  # nothing is painted on it, and no shadow falls
    paint = _signs(world).blurred(0.012)
    shapes = tuple(shape for prop in world.props for shape in prop.outlines)
    sunny = () if world.ground.look == "floor" else shapes
    shadow = _shadows(world, sunny).blurred(0.03).point(lambda v: int(255 - _SHADOW_DEPTH * v))
    contact = _contacts(world, shapes).blurred(0.16).point(lambda v: int(255 - _CONTACT_DEPTH * v))
    light = ImageChops.multiply(shadow, contact)
    if world.ceiling:
        size, lamps = lamp_light(world)
        light = ImageChops.multiply(
            light, Image.frombytes("L", size, lamps).resize(light.size, Image.Resampling.BILINEAR)
        )
    return paint.size, zlib.compress(Image.merge("LA", (paint, light)).tobytes(), 1)


def _signs(world: World) -> _Sheet:
    sheet = _Sheet(world)
    for arrow in world.arrows:
        sheet.polygon(arrow_corners(arrow))
    return sheet


def arrow_corners(arrow: Spot) -> list[Point]:
    """The outline of an arrow painted at that spot, anticlockwise [m]."""
    return [_from_spot(arrow, corner) for corner in _ARROW]


def _from_spot(spot: Spot, point: Point) -> Point:
    cosine, sine = math.cos(spot.angle), math.sin(spot.angle)
    return (spot.x + cosine * point[0] - sine * point[1], spot.y + sine * point[0] + cosine * point[1])


def _shadows(world: World, shapes: Iterable[Shape]) -> _Sheet:
    """Shadows: the outline of each shape, seen from the sun, laid on the ground."""
    sheet = _Sheet(world)
    for shape in shapes:
        falls = [(x - SUN[0] / SUN[2] * z, y - SUN[1] / SUN[2] * z) for x, y, z in shape.corners()]
        sheet.polygon(_hull(falls))
    return sheet


def _contacts(world: World, shapes: Iterable[Shape]) -> _Sheet:
    """The ground under what stands on it or hangs just above it."""
    sheet = _Sheet(world)
    for shape in shapes:
        corners = shape.corners()
        if min(z for _, _, z in corners) < 0.3:
            sheet.polygon(_hull([(x, y) for x, y, _ in corners]))
    return sheet


def _hull(points: Iterable[Point]) -> list[Point]:
    """The convex hull, anticlockwise (Andrew's monotone chain)."""
    ordered = sorted(set(points))
    return _half_hull(ordered)[:-1] + _half_hull(ordered[::-1])[:-1]


def _half_hull(points: Iterable[Point]) -> list[Point]:
    hull: list[Point] = []
    for x, y in points:
        while len(hull) > 1 and _turn(hull[-2], hull[-1], (x, y)) <= 0:
            hull.pop()
        hull.append((x, y))
    return hull


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
