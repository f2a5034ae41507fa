"""A map server of its own: draws the streets of a small town about a place and serves them as tiles over HTTP.

    python -m examples.tile_server --latitude 45.5069 --longitude -73.579 --port 8090

The map's address in the app is then http://127.0.0.1:8090/{z}/{x}/{y}.png. The town is invented; the same place gives the same town.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import math
import threading
from functools import lru_cache
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Self

from PIL import Image, ImageDraw, ImageFont

from bridge.core.geo import Datum

__all__ = ["ATTRIBUTION", "TileServer", "Town"]

ATTRIBUTION = "© Pilothouse's invented town"
TILE = 256
FINER = 2
"""Everything is drawn larger by this and made smaller, which smooths its edges."""
MAX_ZOOM = 20
LAND, BLOCK, PARK, WATER = "#f2efe9", "#e3dfd6", "#c8e3b0", "#a9d3de"
HOUSE, HOUSE_EDGE, ROAD, CASING, MAIN, MAIN_CASING = (
    "#d6cabd",
    "#bfae9d",
    "#ffffff",
    "#cfc9bf",
    "#fbd58c",
    "#d9a94f",
)
SQUARE, INK = "#eeeae6", "#5d5345"
BLOCK_WIDE, BLOCK_HIGH = 96.0, 72.0
"""From the middle of one street to the next [m]."""
OVER = 30.0
"""How far a street is drawn beyond the picture [m], so that its end is not seen."""
NAMES = ("Harbour", "Mill", "Church", "Garden", "Station", "Bridge", "School", "Orchard", "Market", "Lake")
FONT = Path(__file__).parents[1] / "widgets/fonts/B612-Regular.ttf"


class Town:
    """A grid of streets turned a little, with a park, a river and houses, all by arithmetic of the place."""

    def __init__(self, datum: Datum) -> None:
        """`datum` is the middle of the town."""
        self._datum = datum

    def tile(self, zoom: int, column: int, row: int) -> bytes:
        """One tile as a PNG file; rows count from the north."""
        side = TILE * FINER
        image = Image.new("RGB", (side, side), LAND)
        west, south, east, north = self._extent(zoom, column, row)
        scale = side / (east - west)
        _Brush(ImageDraw.Draw(image), west, north, scale).town((west, south, east, north))
        raw = io.BytesIO()
        image.reduce(FINER).save(raw, "PNG")
        return raw.getvalue()

    def _extent(self, zoom: int, column: int, row: int) -> tuple[float, float, float, float]:
        """West, south, east and north of a tile [m] from the middle of the town."""
        count = 2**zoom

        def place(x: int, y: int) -> tuple[float, float]:
            latitude = math.degrees(math.atan(math.sinh(math.pi * (1 - 2 * y / count))))
            return self._datum.to_local(latitude, 360 * x / count - 180)

        west, north = place(column, row)
        east, south = place(column + 1, row + 1)
        if east <= west:
            east = west + 40e6 / count
        shift_x, shift_y = BLOCK_WIDE / 2, BLOCK_HIGH / 2  # its middle is the middle of a block
        return west + shift_x, south + shift_y, east + shift_x, north + shift_y


class _Brush:
    """Draws what of the town lies in one picture."""

    def __init__(self, draw: ImageDraw.ImageDraw, west: float, north: float, scale: float) -> None:
        self._draw, self._west, self._north, self._scale = draw, west, north, scale

    def town(self, box: tuple[float, float, float, float]) -> None:
        west, south, east, north = box
        columns = range(math.floor(west / BLOCK_WIDE) - 1, math.floor(east / BLOCK_WIDE) + 2)
        rows = range(math.floor(south / BLOCK_HIGH) - 1, math.floor(north / BLOCK_HIGH) + 2)
        if len(columns) * len(rows) > 900:  # from far away only the main roads can be told apart
            self._roads([c for c in columns if c % 24 == 0][:60], [r for r in rows if r % 24 == 0][:60], box)
            return
        for column in columns:
            for row in rows:
                self._block(column, row)
        self._river(box)
        self._roads(list(columns), list(rows), box)
        if self._scale > 1.2:
            self._names(list(columns), list(rows))

    def _block(self, column: int, row: int) -> None:
        x, y = column * BLOCK_WIDE, row * BLOCK_HIGH
        if column == row == 0:
            self._box(x + 5, y + 5, x + BLOCK_WIDE - 5, y + BLOCK_HIGH - 5, SQUARE)
            return
        park = _chance(column, row, 1) < 0.12
        self._box(x + 5, y + 5, x + BLOCK_WIDE - 5, y + BLOCK_HIGH - 5, PARK if park else BLOCK)
        if self._scale < 0.8:
            return
        for index in range(8):
            east, north = x + 12 + (index % 4) * 20, y + 12 + (index // 4) * 28
            dice = _chance(column * 8 + index, row, 2)
            if park:
                radius = 2.5 + 3 * dice
                middle = self._at(east + 8, north + 10)
                self._disc(middle, radius, "#a5cf86")
            elif dice > 0.15:
                self._box(east, north, east + 10 + 6 * dice, north + 12 + 8 * dice, HOUSE, HOUSE_EDGE)

    def _river(self, box: tuple[float, float, float, float]) -> None:
        west, _, east, _ = box
        step = max(8.0, (east - west) / 40)
        line = [
            (x, -260 + 60 * math.sin(x / 310) + 18 * math.sin(x / 97))
            for x in _steps(west - step, east + step, step)
        ]
        self._line(line, 34, WATER)

    def _roads(self, columns: list[int], rows: list[int], box: tuple[float, float, float, float]) -> None:
        west, south, east, north = box
        west, south, east, north = west - OVER, south - OVER, east + OVER, north + OVER
        streets = [((c * BLOCK_WIDE, south), (c * BLOCK_WIDE, north), c % 4 == 2) for c in columns]
        streets += [((west, r * BLOCK_HIGH), (east, r * BLOCK_HIGH), r % 4 == 2) for r in rows]
        for layer in range(2):
            for start, end, main in sorted(streets, key=lambda street: street[2]):
                wide = 9.0 if main else 6.0
                colour = ((MAIN_CASING, MAIN) if main else (CASING, ROAD))[layer]
                self._line([start, end], wide + (1.6 if layer == 0 else 0.0), colour)

    def _names(self, columns: list[int], rows: list[int]) -> None:
        size = min(max(5.0 * self._scale, 15.0), 30.0)
        font = _font(round(size))
        for row in rows:
            for column in columns:
                if (column + row) % 3 == 0:
                    x, y = self._at(column * BLOCK_WIDE + BLOCK_WIDE / 2, row * BLOCK_HIGH)
                    name = f"{NAMES[row % len(NAMES)]} Street"
                    self._draw.text(
                        (x, y), name, INK, font=font, anchor="mm", stroke_width=2, stroke_fill="#ffffff"
                    )

    def _at(self, x: float, y: float) -> tuple[float, float]:
        return (x - self._west) * self._scale, (self._north - y) * self._scale

    def _box(self, west: float, south: float, east: float, north: float, colour: str, edge: str = "") -> None:
        left, top = self._at(west, north)
        right, low = self._at(east, south)
        self._draw.rectangle((left, top, right, low), colour, edge or None, FINER if edge else 0)

    def _disc(self, at: tuple[float, float], radius: float, colour: str) -> None:
        x, y, size = *at, radius * self._scale
        self._draw.ellipse((x - size, y - size, x + size, y + size), colour)

    def _line(self, line: list[tuple[float, float]], wide: float, colour: str) -> None:
        self._draw.line(
            [self._at(*place) for place in line], colour, max(FINER, round(wide * self._scale)), "curve"
        )


class _Handler(BaseHTTPRequestHandler):
    """Answers GET /z/x/y.png."""

    protocol_version = "HTTP/1.1"
    server: TileServer

    def do_GET(self) -> None:
        """One tile; 404 for whatever else."""
        self.server.answer(self)

    def log_message(self, *_: object) -> None:
        """Say nothing: an address may hold a key."""


class TileServer(ThreadingHTTPServer):
    """Serves the tiles of one town on this machine; `with TileServer(datum) as server: server.url`."""

    daemon_threads = True
    block_on_close = False

    def __init__(self, datum: Datum, port: int = 0) -> None:
        """`port` 0 takes a free one."""
        super().__init__(("127.0.0.1", port), _Handler)
        self._town = Town(datum)
        self._drawn = lru_cache(maxsize=512)(self._town.tile)
        self._thread: threading.Thread | None = None

    @property
    def url(self) -> str:
        """The address for the app's list of maps."""
        return f"http://127.0.0.1:{self.server_address[1]}/{{z}}/{{x}}/{{y}}.png"

    def tile(self, zoom: int, column: int, row: int) -> bytes:
        """What is served at that place."""
        return self._drawn(zoom, column, row)

    def answer(self, asked: BaseHTTPRequestHandler) -> None:
        """Answer one request."""
        try:
            zoom, column, row = map(int, asked.path.split("?")[0].strip("/").removesuffix(".png").split("/"))
        except ValueError:
            zoom = column = row = -1
        if not (0 <= zoom <= MAX_ZOOM and 0 <= column < 2**zoom and 0 <= row < 2**zoom):
            self.send(asked, 404, b"There is no such tile.", "text/plain")
            return
        tag = f'"{zoom}-{column}-{row}"'
        if asked.headers.get("If-None-Match") == tag:
            self.send(asked, 304, b"", "image/png", ETag=tag)
        else:
            self.send(asked, 200, self.tile(zoom, column, row), "image/png", ETag=tag)

    @staticmethod
    def send(asked: BaseHTTPRequestHandler, status: int, body: bytes, kind: str, **more: str) -> None:
        """Send an answer; a header's name has `_` for each hyphen."""
        asked.send_response(status)
        asked.send_header("Content-Type", kind)
        asked.send_header("Content-Length", str(len(body)))
        for name, value in more.items():
            asked.send_header(name.replace("_", "-"), value)
        asked.end_headers()
        asked.wfile.write(body)

    def handle_error(self, request: object, client_address: object) -> None:
        """Who hangs up in the middle of a tile is no fault."""

    def __enter__(self) -> Self:
        self._thread = threading.Thread(target=lambda: self.serve_forever(poll_interval=0.02), daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.shutdown()
        if self._thread is not None:
            self._thread.join()
        self.server_close()


def _chance(a: int, b: int, seed: int) -> float:
    """0 to 1, the same for the same numbers."""
    mixed = (a * 374_761_393 + b * 668_265_263 + seed * 2_147_483_647) & 0xFFFFFFFF
    mixed = (mixed ^ (mixed >> 13)) * 1_274_126_177 & 0xFFFFFFFF
    return ((mixed ^ (mixed >> 16)) & 0xFFFF) / 65_535


def _steps(start: float, end: float, step: float) -> list[float]:
    first = math.floor(start / step) * step
    return [first + index * step for index in range(math.ceil((end - first) / step) + 1)]


@lru_cache(maxsize=32)
def _font(size: int) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(str(FONT), size)


def main() -> None:
    """Serve until it is interrupted."""
    options = argparse.ArgumentParser(description="Serves the streets of an invented town as map tiles.")
    options.add_argument("--latitude", type=float, default=45.5069)
    options.add_argument("--longitude", type=float, default=-73.579)
    options.add_argument("--port", type=int, default=8090)
    chosen = options.parse_args()
    with TileServer(Datum(chosen.latitude, chosen.longitude), chosen.port) as server:
        print(f"Tiles at {server.url}", flush=True)
        with contextlib.suppress(KeyboardInterrupt):
            threading.Event().wait()


if __name__ == "__main__":
    main()
