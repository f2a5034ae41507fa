"""What the app is watched by, from a thread of its own: time spent, frames, pictures; on its screens and in a pocket."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

import psutil

__all__ = ["Watching", "count_frames", "in_ui"]

T = TypeVar("T")


def in_ui(work: Callable[[], T]) -> T:
    """Call `work` in the UI thread and wait for what it gives."""
    from kivy.clock import Clock

    done, result = threading.Event(), []

    def call(_: float) -> None:
        result.append(work())
        done.set()

    Clock.schedule_once(call, 0)
    if not done.wait(20):
        raise TimeoutError("The UI thread does not answer.")
    return result[0]


class Watching:
    """Of an `app`; each method's result is its answer to a question of the bench."""

    app: Any

    def __init__(self) -> None:
        self._frames = count_frames()
        self.pictures: list[tuple[float, float]] = []
        """When each was shown, and its stamp [s]."""

    def watch(self, seconds: float) -> dict[str, Any]:
        """Look on for a while: the main thread's share of a core, memory, frames and pictures."""
        self.pictures.clear()
        before, began = in_ui(self._spent), time.monotonic()
        time.sleep(seconds)
        after, lasted = in_ui(self._spent), time.monotonic() - began
        return {
            "main": (after["main"] - before["main"]) / lasted,
            "process": (after["process"] - before["process"]) / lasted,
            "frames": (after["frames"] - before["frames"]) / lasted,
            "rss": psutil.Process().memory_info().rss,
            "pictures": list(self.pictures),
        }

    def show(self, screen: str) -> dict[str, Any]:
        """Put a screen of the robot on the glass."""
        in_ui(lambda: self.app.show(screen))
        return {}

    def put_away(self) -> dict[str, Any]:
        """As SDL tells it when the activity is paused: from then on the UI thread stands within SDL."""
        from kivy.clock import Clock
        from kivy.core.window import Window

        Clock.schedule_once(lambda _: Window._event_filter("app_willenterbackground"), 0)
        return {}

    def drawn(self) -> dict[str, Any]:
        """Frames so far, from this thread: the UI thread may stand still."""
        return {"frames": next(self._frames)}

    def overdraw(self) -> dict[str, float]:
        """How often each pixel of the glass is shaded for one frame."""
        return {"times": in_ui(_overdraw)}

    def _spent(self) -> dict[str, float]:
        return {"main": time.thread_time(), "process": time.process_time(), "frames": next(self._frames)}


def _overdraw() -> float:
    from kivy.core.window import Window

    from bench.support.overdraw import Overdraw

    return sum(Overdraw(Window).frame().values()) / (Window.width * Window.height)


def count_frames() -> Iterator[int]:
    """How many frames were drawn since the first was asked for; Kivy itself counts those that are left out as well."""
    from kivy.core.window import Window

    kind, drawn = type(Window), [0]
    draw = kind.on_draw

    def on_draw(window: Any) -> None:
        drawn[0] += 1
        draw(window)

    kind.on_draw = on_draw
    while True:
        yield drawn[0]
