"""Kivy without a display: call `prepare` once in a process, before anything else of Kivy is imported.

`logic`: no window system and no GL at all, a stand-in window and the mock backend; touches, bindings and
layout are real. `pixel`: real drawing by Mesa's software renderer on SDL's offscreen driver. Kivy chooses its
backend once, so a process is one or the other.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

__all__ = ["SIZE", "Stage", "TestTime", "assert_like", "difference", "prepare"]

SIZE = (1280, 800)
"""Of the window [px]."""

FRAME = 1 / 64
"""Length of a frame [s]; exact in binary, so that sums of frames do not drift."""

_QUIET = {
    "KIVY_NO_ARGS": "1",  # else Kivy reads pytest's own arguments
    "KIVY_NO_CONFIG": "1",
    "KIVY_NO_FILELOG": "1",
    "KIVY_LOG_MODE": "PYTHON",  # leaves stderr and the root logger to pytest
    "KIVY_METRICS_DENSITY": "1",
    "KIVY_METRICS_FONTSCALE": "1",
    "KIVY_DPI": "96",
}
_LOGIC = {"KIVY_GL_BACKEND": "mock", "KIVY_WINDOW": "none"}
_PIXEL = {
    "KIVY_GL_BACKEND": "sdl2",
    "SDL_VIDEODRIVER": "offscreen",
    "SDL_AUDIODRIVER": "dummy",
    "LIBGL_ALWAYS_SOFTWARE": "1",
    "GALLIUM_DRIVER": "llvmpipe",
    "LP_NUM_THREADS": "1",
}
_GRAPHICS = {"multisamples": 0, "maxfps": 0, "vsync": 0}


def prepare(mode: str, size: tuple[int, int] = SIZE) -> None:
    """Set this process up for `logic` or `pixel` tests with a window of `size` [px]."""
    os.environ.update(_QUIET)
    if mode == "logic":
        os.environ.update(_LOGIC)
    else:
        os.environ.pop("KIVY_WINDOW", None)
        os.environ.pop("DISPLAY", None)
        os.environ.update(_PIXEL)
    logging.getLogger("kivy").addHandler(
        logging.NullHandler()
    )  # else Python prints its complaints about the mock GL
    from kivy.config import Config

    for key, value in dict(_GRAPHICS, width=size[0], height=size[1]).items():
        Config.set("graphics", key, str(value))
    Config.set("kivy", "exit_on_escape", "0")
    for key, _ in Config.items("input"):
        Config.remove_option("input", key)
    if mode == "logic":
        _stand_in_window(size)


def _stand_in_window(size: tuple[int, int]) -> None:
    """Without a window Kivy ends the process at the first widget: give it one that draws nowhere."""
    import kivy.core.window as core
    from kivy.graphics.cgl import cgl_init

    class StandIn(core.WindowBase):
        def create_window(self, *args: Any) -> None:
            if not self.initialized:
                cgl_init()
            self._size = size
            super().create_window(*args)

        def flip(self) -> None:
            """Nothing to show."""

        def close(self) -> None:
            """Nothing to close."""

        def set_title(self, title: str) -> None:
            """No title bar."""

    core.Window = StandIn()


class TestTime:
    """Kivy's clock as the test wants it: it stands still until somebody adds to `now` [s]."""

    __test__ = False

    def __init__(self, now: float = 1000.0) -> None:
        self.now = now

    def __call__(self) -> float:
        return self.now


class Stage:
    """The process's one window with nothing on it, on a clock that the test moves."""

    _permanent: ClassVar[list[Any] | None] = None

    def __init__(self) -> None:
        from kivy.base import EventLoop
        from kivy.clock import Clock
        from kivy.core.window import Window

        self.window, self.clock, self.loop = Window, Clock, EventLoop
        if EventLoop.status != "started":
            for event in Clock.get_events():
                if not event.loop:  # left by widgets of tests without a stage; these are not to be kept
                    Clock.unschedule(event)
            EventLoop.start()
            Stage._permanent = list(Clock.get_events())
        self._real_time = Clock.time
        self.time = TestTime()
        self.clear()
        Clock.time = self.time
        Clock._max_fps = 0
        Clock._last_tick = self.time.now

    def close(self) -> None:
        """Empty the window and give Kivy its own clock back."""
        self.clear()
        self.clock.time = self._real_time
        self.clock._last_tick = self._real_time()

    def clear(self) -> None:
        """Take away every widget, touch, animation and clock event that a test brought."""
        from kivy.animation import Animation

        for animation in list(Animation._instances):
            animation._unregister()
            animation._widgets.clear()
            animation._clock_uninstall()
        for widget in self.window.children[:]:
            self.window.remove_widget(widget)
        self.loop.touches.clear()
        for event in self.clock.get_events():
            if not any(event is kept for kept in Stage._permanent or ()):
                self.clock.unschedule(event)

    def show(self, widget: Any, size: tuple[float, float] | None = None) -> Any:
        """Put `widget` into the window, `size` [px] at the lower left corner, and lay it out."""
        if size:
            widget.size_hint, widget.size, widget.pos = (None, None), size, (0, 0)
        self.window.add_widget(widget)
        self.frames(2)
        return widget

    def frames(self, count: int = 1, period: float = FRAME) -> None:
        """Let `count` frames of `period` [s] pass."""
        for _ in range(count):
            self.time.now += period
            self.loop.idle()

    def run_for(self, seconds: float, period: float = FRAME) -> None:
        """Let so much of the test's time pass, frame by frame."""
        self.frames(round(seconds / period), period)

    def touch(self, x: float, y: float) -> Any:
        """A finger over (x, y) [px, window]; `touch_down()`, `touch_move(x, y)` and `touch_up()` are its verbs."""
        from kivy.tests.common import UnitTestTouch

        return UnitTestTouch(x, y)

    def tap(self, x: float, y: float) -> None:
        """A finger down and up again at (x, y) [px, window]."""
        self.drag([(x, y)])

    def drag(self, points: Iterable[tuple[float, float]], frames: int = 1) -> None:
        """A finger down at the first of `points` [px, window], along the others, up at the last."""
        first, *others = points
        touch = self.touch(*first)
        touch.touch_down()
        self.frames(frames)
        for point in others:
            touch.touch_move(*point)
            self.frames(frames)
        touch.touch_up()
        self.frames(1)

    def key(self, code: int, text: str | None = None, modifiers: Iterable[str] = ()) -> None:
        """A key of `code` pressed and let go."""
        self.window.dispatch("on_key_down", code, code, text, list(modifiers))
        self.frames()
        self.window.dispatch("on_key_up", code, code)
        self.frames()

    def pixels(self, widget: Any = None) -> np.ndarray:
        """(height, width, 4) RGBA bytes, top row first, of `widget`, or of what was shown last."""
        # export_as_image takes the canvas out of the window first; drawn from inside the window it would stay there
        texture = (widget or self.window.children[0]).export_as_image().texture
        width, height = texture.size
        return np.frombuffer(texture.pixels, np.uint8).reshape(height, width, 4).copy()


def difference(got: np.ndarray, want: np.ndarray, tolerance: int = 24) -> float:
    """Share of pixels, 0 to 1, that differ by more than `tolerance` of 255 in a channel; 1 for unlike sizes."""
    if got.shape != want.shape:
        return 1.0
    return float((np.abs(got.astype(np.int16) - want.astype(np.int16)) > tolerance).any(-1).mean())


def assert_like(got: np.ndarray, path: Path, tolerance: int = 24, share: float = 0.002) -> None:
    """Compare with the picture at `path`; `UPDATE_PICTURES=1` in the environment accepts what was drawn."""
    from PIL import Image

    if os.environ.get("UPDATE_PICTURES"):
        path.parent.mkdir(parents=True, exist_ok=True)
        Image.fromarray(got).save(path)
    with Image.open(path) as picture:
        want = np.asarray(picture.convert("RGBA"))
    off = difference(got, want, tolerance)
    if off > share:
        Image.fromarray(got).save(path.with_suffix(".got.png"))
    assert off <= share, f"{off:.2%} of the pixels differ from {path.name}, allowed {share:.2%}"
