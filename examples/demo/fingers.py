"""Fingers on the screen: they reach the app through Kivy's own input loop, as those of a touch screen do."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Generator, Iterable
from itertools import pairwise

from kivy.core.window import Window
from kivy.input.motionevent import MotionEvent
from kivy.input.provider import MotionEventProvider

__all__ = ["Finger", "Hand", "Point"]

Point = tuple[float, float]
STEPS = 8
"""Moves between two corners of a drag."""


class Finger(MotionEvent):
    """One touch."""

    def __init__(self, number: int, place: Point) -> None:
        super().__init__("demo", number, place, is_touch=True, type_id="touch")

    def depack(self, args: Point) -> None:
        """Take a place on the screen, each coordinate from 0 to 1."""
        self.sx, self.sy = args
        self.profile = ["pos"]
        super().depack(args)


class Hand(MotionEventProvider):
    """An input device: each request is carried out at the next frame, one move a frame for each finger."""

    def __init__(self) -> None:
        super().__init__("demo", "")
        self._waiting: deque[tuple[str, Finger, Point | None]] = deque()
        self._count = 0

    def start(self) -> None:
        """Nothing to open."""

    def stop(self) -> None:
        """Nothing to close."""

    def update(self, dispatch_fn: Callable[[str, MotionEvent], None]) -> None:
        """Called by Kivy before each frame."""
        moved: set[int] = set()
        while self._waiting and self._waiting[0][1].uid not in moved:
            kind, finger, place = self._waiting.popleft()
            if place is not None and kind == "update":
                finger.move(place)
            if kind == "end":
                finger.update_time_end()
            moved.add(finger.uid)
            dispatch_fn(kind, finger)

    @property
    def busy(self) -> bool:
        """Something asked of it has not happened yet."""
        return bool(self._waiting)

    def down(self, at: Point) -> Finger:
        """Put a finger down at `at` [px, window]."""
        self._count += 1
        finger = Finger(self._count, _share(at))
        self._waiting.append(("begin", finger, None))
        return finger

    def move(self, finger: Finger, to: Point) -> None:
        """Move it to `to` [px, window]."""
        self._waiting.append(("update", finger, _share(to)))

    def up(self, finger: Finger) -> None:
        """Lift it."""
        self._waiting.append(("end", finger, None))

    def tap(self, at: Point) -> Generator[None, None, None]:
        """A finger down and up; done when Kivy has seen both."""
        yield from self.drag([at], hold=0)  # on a slow machine a frame more is a long tap

    def drag(self, path: Iterable[Point], hold: int = 2) -> Generator[None, None, None]:
        """A finger down at the first point of `path`, on to the others, up after `hold` more frames."""
        corners = list(path)
        finger = self.down(corners[0])
        for one, two in pairwise(corners):
            for step in range(1, STEPS + 1):
                part = step / STEPS
                self.move(finger, (one[0] + (two[0] - one[0]) * part, one[1] + (two[1] - one[1]) * part))
        for _ in range(hold):
            yield
        while self._waiting:
            yield
        self.up(finger)
        while self._waiting:
            yield
        yield


def _share(place: Point) -> Point:
    width, height = Window.size
    return place[0] / max(width - 1, 1), place[1] / max(height - 1, 1)
