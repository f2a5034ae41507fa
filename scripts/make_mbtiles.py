"""Offline map tiles of the parking lot, drawn from above.

    python scripts/make_mbtiles.py [sim/worlds/parking_lot.toml] [widgets/data/parking_lot.mbtiles]

What does not belong in the lot (the cones) is not in the picture, as in any aerial photograph of last year.
The same world gives the same file, byte for byte.
"""

from __future__ import annotations

import io
import math
import sqlite3
import sys
import tomllib
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bridge.core.geo import Datum  # noqa: E402

TILE = 256
"""Edge of a tile [pixel]."""
COVER = {17: 150.0, 18: 110.0, 19: 90.0, 20: 55.0, 21: 34.0, 22: 26.0}
"""How far from the origin each zoom level reaches to every side [m]."""
FINER = 2
"""Drawn so many times larger and then reduced, for smooth edges."""
QUALITY = 78
"""Of the JPEG tiles, 1 to 95."""
SIZES = {"sedan": (4.6, 1.8), "hatchback": (4.0, 1.75), "suv": (4.7, 1.95), "van": (5.0, 2.0)}
"""Length and width of a car [m]."""
SUN = (0.55, -0.75)
"""Where a shadow falls, in lengths of its object's height [m/m]."""

GRASS, ASPHALT, ROAD = (92, 108, 70), (84, 86, 90), (96, 97, 100)
PAINT, WALL, GLASS, POST = (214, 214, 206), (176, 172, 164), (38, 46, 56), (200, 202, 204)
LEAVES = ((54, 84, 48), (70, 102, 58), (88, 120, 70))

Place = tuple[float, float]


class Canvas:
    """A picture of a square of the ground; places are metres east and north of the origin."""

    def __init__(self, west: float, north: float, metres: float, pixels: int) -> None:
        self._west, self._north, self._scale = west, north, pixels / metres
        self.image = Image.new("RGB", (pixels, pixels), GRASS)
        self.draw = ImageDraw.Draw(self.image)

    def pixel(self, x: float, y: float) -> Place:
        """Where a place is in the picture."""
        return (x - self._west) * self._scale, (self._north - y) * self._scale

    def polygon(self, corners: list[Place], colour: tuple[int, ...]) -> None:
        """Fill a shape."""
        self.draw.polygon([self.pixel(*corner) for corner in corners], fill=colour)

    def disc(self, x: float, y: float, radius: float, colour: tuple[int, ...]) -> None:
        """Fill a circle."""
        (px, py), r = self.pixel(x, y), radius * self._scale
        self.draw.ellipse((px - r, py - r, px + r, py + r), fill=colour)

    def bar(self, x: float, y: float, size: Place, yaw: float, colour: tuple[int, ...]) -> None:
        """Fill a rectangle of length and width `size` about (x, y), its length along `yaw` [deg]."""
        self.polygon(corners(x, y, size, yaw), colour)

    def shade(self, shapes: list[list[Place]], blur: float, strength: float) -> None:
        """Darken the ground under `shapes`, with an edge `blur` [m] soft."""
        mask = Image.new("L", self.image.size, 0)
        pen = ImageDraw.Draw(mask)
        for shape in shapes:
            pen.polygon([self.pixel(*corner) for corner in shape], fill=round(255 * strength))
        mask = mask.filter(ImageFilter.GaussianBlur(blur * self._scale))
        self.image.paste((18, 20, 24), mask=mask)
        self.draw = ImageDraw.Draw(self.image)

    def mottle(self, size: float, strength: float, seed: int) -> None:
        """Make the ground lighter and darker in patches of `size` [m]; the same for the same place."""
        pixels = self.image.size[0]
        axis = (np.arange(pixels) + 0.5) / self._scale
        x, y = np.meshgrid((self._west + axis) / size, (self._north - axis) / size)
        light = 1.0 + strength * (patches(x, y, seed) - 0.5)
        array = np.asarray(self.image, np.float32) * light[..., None]
        self.image = Image.fromarray(np.clip(array, 0, 255).astype(np.uint8))
        self.draw = ImageDraw.Draw(self.image)


def corners(x: float, y: float, size: Place, yaw: float) -> list[Place]:
    """Corners of a rectangle about (x, y) turned by `yaw` [deg]."""
    cos, sin = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
    half = [(u * size[0] / 2, v * size[1] / 2) for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return [(x + cos * u - sin * v, y + sin * u + cos * v) for u, v in half]


def patches(x: np.ndarray, y: np.ndarray, seed: int) -> np.ndarray:
    """Smooth noise, 0 to 1, with one random value at each whole (x, y)."""
    column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    u, v = x - column, y - row
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)

    def at(dx: int, dy: int) -> np.ndarray:
        mixed = ((column + dx) * 374_761_393 + (row + dy) * 668_265_263 + seed * 2_147_483_647) & 0xFFFFFFFF
        mixed = ((mixed ^ (mixed >> 13)) * 1_274_126_177) & 0xFFFFFFFF
        return ((mixed ^ (mixed >> 16)) & 0xFFFF) / 65_535.0

    low = at(0, 0) * (1 - u) + at(1, 0) * u
    return low * (1 - v) + (at(0, 1) * (1 - u) + at(1, 1) * u) * v


def paint(canvas: Canvas, world: dict[str, Any]) -> None:
    """Draw the world from the ground upwards."""
    canvas.mottle(7.0, 0.34, 1)
    canvas.mottle(1.6, 0.16, 2)
    lot(canvas, world)
    canvas.mottle(5.0, 0.10, 3)
    canvas.mottle(0.7, 0.05, 4)
    markings(canvas, world)
    things(canvas, world)


def lot(canvas: Canvas, world: dict[str, Any]) -> None:
    """The asphalt, the road that leads past it, and the wall."""
    length, width = world["ground"]["length"], world["ground"]["width"]
    thick = world["wall"]["thickness"]
    canvas.bar(0, -width / 2 - 15, (400, 7.5), 0, ROAD)
    for x in range(-198, 200, 6):
        canvas.bar(x, -width / 2 - 15, (2.5, 0.14), 0, PAINT)
    outer = (length + 2 * thick, width + 2 * thick)
    shift = world["wall"]["height"]
    canvas.shade([corners(SUN[0] * shift, SUN[1] * shift, outer, 0)], 0.08, 0.6)
    canvas.bar(0, 0, outer, 0, WALL)
    canvas.bar(0, 0, (length, width), 0, ASPHALT)


def markings(canvas: Canvas, world: dict[str, Any]) -> None:
    """Bays, lines and arrows."""
    for row in world.get("bays", []):
        for index in range(row["count"] + 1):
            x = row["x"] + index * row["width"]
            canvas.bar(x, row["y"] + row["depth"] / 2, (row["depth"], 0.12), 90, PAINT)
    for line in world.get("lines", []):
        (x1, y1), (x2, y2) = line["from"], line["to"]
        yaw = math.degrees(math.atan2(y2 - y1, x2 - x1))
        canvas.bar((x1 + x2) / 2, (y1 + y2) / 2, (math.hypot(x2 - x1, y2 - y1), line["width"]), yaw, PAINT)
    for arrow in world.get("arrows", []):
        x, y, yaw = arrow["x"], arrow["y"], arrow["yaw"]
        cos, sin = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
        canvas.bar(x - 0.4 * cos, y - 0.4 * sin, (1.8, 0.16), yaw, PAINT)
        tip = [(1.4, 0.0), (0.4, 0.42), (0.4, -0.42)]
        canvas.polygon([(x + cos * u - sin * v, y + sin * u + cos * v) for u, v in tip], PAINT)


def things(canvas: Canvas, world: dict[str, Any]) -> None:
    """Cars, lamp posts and trees, each with its shadow."""
    cars = world.get("cars", [])
    canvas.shade([shadow(car, 1.3) for car in cars], 0.10, 0.55)
    for car in cars:
        draw_car(canvas, car)
    for lamp in world.get("lamps", []):
        canvas.shade([corners(lamp["x"] + 1.2, lamp["y"] - 1.6, (4.0, 0.14), -54)], 0.05, 0.4)
        canvas.disc(lamp["x"], lamp["y"], 0.22, POST)
    trees = world.get("trees", [])
    canvas.shade([ring(t["x"] + 1.6, t["y"] - 2.2, t["height"] * 0.36) for t in trees], 0.3, 0.5)
    for index, tree in enumerate(trees):
        draw_tree(canvas, tree, index)


def shadow(car: dict[str, Any], height: float) -> list[Place]:
    """The ground that a car's shadow covers."""
    return corners(
        car["x"] + SUN[0] * height * 0.4, car["y"] + SUN[1] * height * 0.4, SIZES[car["model"]], car["yaw"]
    )


def ring(x: float, y: float, radius: float) -> list[Place]:
    """A circle as a polygon."""
    return [
        (x + radius * math.cos(a / 12 * math.pi), y + radius * math.sin(a / 12 * math.pi)) for a in range(24)
    ]


def draw_car(canvas: Canvas, car: dict[str, Any]) -> None:
    """Body, windows and roof, seen from above."""
    length, width = SIZES[car["model"]]
    x, y, yaw = car["x"], car["y"], car["yaw"]
    body = tuple(round(255 * part) for part in car["colour"])
    dark = tuple(round(part * 0.78) for part in body)
    light = tuple(min(255, round(part * 1.1 + 12)) for part in body)
    cos, sin = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))

    def part(ahead: float, long: float, wide: float, colour: tuple[int, ...]) -> None:
        canvas.bar(
            x + cos * ahead * length, y + sin * ahead * length, (long * length, wide * width), yaw, colour
        )

    part(0, 0.94, 1.0, dark)
    part(0, 1.0, 0.86, dark)
    part(0, 0.97, 0.90, body)
    back = 0.02 if car["model"] in ("van", "suv", "hatchback") else -0.03
    roof = 0.62 if car["model"] == "van" else 0.44
    part(back - 0.06, roof + 0.16, 0.80, GLASS)
    part(back - 0.06, roof, 0.74, light)


def draw_tree(canvas: Canvas, tree: dict[str, Any], index: int) -> None:
    """A crown of leaves with the light on its sunny side."""
    radius = tree["height"] * 0.36
    for layer, colour in enumerate(LEAVES):
        shrink = 1.0 - 0.28 * layer
        for bump in range(7):
            angle = bump * math.tau / 7 + index + layer
            x = tree["x"] - 0.22 * layer * radius + math.cos(angle) * radius * 0.55 * shrink
            y = tree["y"] + 0.26 * layer * radius + math.sin(angle) * radius * 0.55 * shrink
            canvas.disc(x, y, radius * 0.52 * shrink, colour)


class Mercator:
    """Tiles of one zoom level, and the square of ground that each shows."""

    def __init__(self, datum: Datum, zoom: int) -> None:
        self._datum, self._count = datum, 2**zoom
        self.metres = self._edge()
        """Edge of a tile on the ground [m]."""

    def position(self, east: float, north: float) -> Place:
        """Column and row from the top, with fractions, of a place [m]."""
        latitude, longitude = self._datum.to_geographic(east, north)
        angle = math.radians(latitude)
        down = (1 - math.log(math.tan(angle) + 1 / math.cos(angle)) / math.pi) / 2
        return (longitude + 180) / 360 * self._count, down * self._count

    def _edge(self) -> float:
        return 100.0 / (self.position(50, 0)[0] - self.position(-50, 0)[0])

    def tiles(self, reach: float) -> Iterator[tuple[int, int, float, float]]:
        """Column, row from the top, and the west and north edge [m] of each tile within `reach` [m] of the origin."""
        column, row = self.position(0, 0)
        span = reach / self.metres
        for x in range(math.floor(column - span), math.floor(column + span) + 1):
            for y in range(math.floor(row - span), math.floor(row + span) + 1):
                yield x, y, (x - column) * self.metres, (row - y) * self.metres


def tile(world: dict[str, Any], west: float, north: float, metres: float) -> bytes:
    """One tile as a JPEG file."""
    margin = 16
    wide = metres * (TILE + 2 * margin) / TILE
    edge = metres * margin / TILE
    canvas = Canvas(west - edge, north + edge, wide, (TILE + 2 * margin) * FINER)
    paint(canvas, world)
    small = canvas.image.reduce(FINER).crop((margin, margin, margin + TILE, margin + TILE))
    raw = io.BytesIO()
    small.save(raw, "JPEG", quality=QUALITY, optimize=True)
    return raw.getvalue()


def write(source: Path, target: Path) -> int:
    """Draw all tiles of the world in `source` into the MBTiles file `target`; gives how many they are."""
    world = tomllib.loads(source.read_text())
    place = world["datum"]
    datum = Datum(place["latitude"], place["longitude"])
    rows = []
    for zoom, reach in COVER.items():
        grid = Mercator(datum, zoom)
        for x, y, west, north in grid.tiles(reach):
            rows.append((zoom, x, 2**zoom - 1 - y, tile(world, west, north, grid.metres)))
    target.parent.mkdir(parents=True, exist_ok=True)
    target.unlink(missing_ok=True)
    with closing(sqlite3.connect(target)) as file, file:
        file.execute("CREATE TABLE metadata (name TEXT, value TEXT)")
        file.execute(
            "CREATE TABLE tiles (zoom_level INTEGER, tile_column INTEGER, tile_row INTEGER, tile_data BLOB, "
            "PRIMARY KEY (zoom_level, tile_column, tile_row)) WITHOUT ROWID"
        )
        file.executemany("INSERT INTO metadata VALUES (?, ?)", metadata(world, datum).items())
        file.executemany("INSERT INTO tiles VALUES (?, ?, ?, ?)", rows)
    return len(rows)


def metadata(world: dict[str, Any], datum: Datum) -> dict[str, str]:
    """What the file says about itself, as in the MBTiles specification 1.3."""
    reach = max(COVER.values())
    south, west = datum.to_geographic(-reach, -reach)
    north, east = datum.to_geographic(reach, reach)
    return {
        "name": world["name"],
        "description": world["description"],
        "type": "baselayer",
        "version": "1",
        "format": "jpg",
        "minzoom": str(min(COVER)),
        "maxzoom": str(max(COVER)),
        "bounds": f"{west:.6f},{south:.6f},{east:.6f},{north:.6f}",
        "center": f"{datum.longitude:.6f},{datum.latitude:.6f},20",
        "attribution": "Drawn from the simulated world",
    }


def main(args: list[str]) -> int:
    """Write the file and say how large it is."""
    source = Path(args[0]) if args else ROOT / "sim/worlds/parking_lot.toml"
    target = Path(args[1]) if len(args) > 1 else ROOT / "widgets/data/parking_lot.mbtiles"
    count = write(source, target)
    print(f"{target.name}: {count} tiles, {target.stat().st_size / 1000:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
