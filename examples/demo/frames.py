"""Skipped frames, so that a processor without a graphics card has time for the story."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count

from kivy.core.window import Window

__all__ = ["seldom_drawn"]


@contextmanager
def seldom_drawn(one_in: int) -> Iterator[None]:
    """Only one in so many of the window's frames is really drawn until the end of the block; the first one is.

    Input and layout go on with every frame, and `examples.demo.report.picture` draws skipped frames.
    """
    frames, left_out = count(), False

    def draw(_: object) -> bool:
        nonlocal left_out
        left_out = next(frames) % one_in != 0
        return left_out  # true keeps the event from the window itself

    def flip(_: object) -> bool:
        return left_out

    Window.bind(on_draw=draw, on_flip=flip)
    try:
        yield
    finally:
        Window.unbind(on_draw=draw, on_flip=flip)
