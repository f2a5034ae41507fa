"""Cost of a large grid, `python -m bench.support.map_costs ours|naive`: one line of JSON."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable
from typing import Any

os.environ.update(
    KIVY_GL_BACKEND="sdl2",
    SDL_VIDEODRIVER="offscreen",
    SDL_AUDIODRIVER="dummy",
    LIBGL_ALWAYS_SOFTWARE="1",
    GALLIUM_DRIVER="llvmpipe",
    KIVY_NO_ARGS="1",
    KIVY_NO_CONFIG="1",
    KIVY_NO_FILELOG="1",
    KIVY_NO_CONSOLELOG="1",
    KIVY_METRICS_DENSITY="1",
    KIVY_DPI="96",
)
os.environ.pop("DISPLAY", None)

COLUMNS, ROWS, RESOLUTION = 3200, 1680, 0.05
SIZE = 1280, 800
RUNS = 3
"""The least of so many runs counts: what disturbs only adds."""
PATIENCE = 30.0
"""[s]"""


def message(number: int) -> bytes:
    """A building with rooms, doors and pillars, as CBOR; another with each number."""
    import numpy as np

    from bridge.codec import to_cbor
    from bridge.msgs.arrays import Int8Array
    from bridge.msgs.geometry_msgs import Point, Pose
    from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid

    cells = np.full((ROWS, COLUMNS), -1, np.int8)
    cells[100:1580, 100:3100] = 0
    cells[100:1580:148, 100:3100] = cells[100:1580, 100 : 3100 : 200 + number] = 100
    cells[160:1580:148, 110 : 3100 : 200 + number] = 0
    places = np.random.default_rng(number).integers((110, 110), (1570, 3090), (4000, 2))
    cells[places[:, 0], places[:, 1]] = 100
    origin = Pose(Point(-COLUMNS * RESOLUTION / 2, -ROWS * RESOLUTION / 2))
    info = MapMetaData(resolution=RESOLUTION, width=COLUMNS, height=ROWS, origin=origin)
    return to_cbor(OccupancyGrid(info=info, data=Int8Array(cells.tobytes())))


def naive(widget: Any) -> Callable[[Any], Any]:
    """Shows a grid the other way; gives its texture."""
    import numpy as np
    from kivy.graphics import Rectangle
    from kivy.graphics.texture import Texture

    table = np.zeros((256, 4), np.uint8)
    table[:101, :3] = np.linspace(30, 200, 101)[:, None]
    table[:128, 3] = 255

    def show(grid: Any) -> Any:
        cells = np.frombuffer(grid.data, np.int8).reshape(grid.info.height, grid.info.width)
        known = np.argwhere(cells >= 0)
        widget.extent = known.min(axis=0), known.max(axis=0)
        texture = Texture.create(size=(grid.info.width, grid.info.height), colorfmt="rgba")
        texture.blit_buffer(table[cells.view(np.uint8)].reshape(-1), colorfmt="rgba", bufferfmt="ubyte")
        widget.canvas.clear()
        with widget.canvas:
            Rectangle(size=SIZE, texture=texture)
        return texture

    return show


def on_glass(way: str) -> Any:
    """The widget that shows the grids, alone on the glass; RuntimeError without OpenGL."""
    from kivy.base import EventLoop
    from kivy.core.window import Window
    from kivy.graphics.cgl import cgl_get_backend_name
    from kivy.graphics.opengl import glFinish
    from kivy.uix.widget import Widget

    from widgets import GridMap

    if cgl_get_backend_name() == "mock":
        raise RuntimeError("There is no OpenGL here.")
    Window.size = SIZE
    shown = GridMap(size=SIZE) if way == "ours" else Widget(size=SIZE)
    Window.add_widget(shown)
    for _ in range(5):
        EventLoop.idle()
    glFinish()
    return shown


def measured(way: str, number: int) -> dict[str, float]:
    """One grid, from its bytes to the glass."""
    from kivy.base import EventLoop
    from kivy.core.window import Window
    from kivy.graphics.opengl import glFinish

    from bridge.codec import from_builtins, from_cbor
    from bridge.msgs.nav_msgs import OccupancyGrid

    shown = on_glass(way)
    show = naive(shown) if way == "naive" else None
    data = message(number)
    start, longest = time.perf_counter(), 0.0
    grid = from_builtins(from_cbor(data), OccupancyGrid)  # in the app it is the link's thread that decodes
    decoded = time.thread_time()
    frame = time.perf_counter()
    textures = [show(grid)] if show is not None else []
    if way == "ours":
        shown.show(grid)
    while time.perf_counter() - start < PATIENCE:
        EventLoop.idle()
        glFinish()
        longest, frame = max(longest, time.perf_counter() - frame), time.perf_counter()
        if way == "naive" or not shown.picture.busy:
            break
    EventLoop.idle()
    glFinish()
    found = {
        "on_glass": time.perf_counter() - start,
        "main_thread": 1000 * (time.thread_time() - decoded),
        "longest_frame": 1000 * longest,
    }
    if way == "ours":
        textures = shown.picture.textures
        shown.close()
    found["memory"] = (
        sum(wide * high * (2 if way == "ours" else 4) for wide, high in (t.size for t in textures)) / 1e6
    )
    Window.remove_widget(shown)
    return found


def main(way: str) -> None:
    """Print the least of each figure."""
    from kivy.base import EventLoop

    EventLoop.ensure_window()
    if EventLoop.status != "started":
        EventLoop.start()
    runs = [measured(way, number) for number in range(RUNS)]
    sys.stdout.write(json.dumps({name: min(run[name] for run in runs) for name in runs[0]}) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
