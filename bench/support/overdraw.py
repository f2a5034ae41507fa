"""Overdraw: how many pixels are shaded for one frame, and by which widgets.

OpenGL counts them itself, what is blended to nothing and what is hidden later included: a software renderer spends as much
on those as on what is seen.
"""

from __future__ import annotations

import ctypes
from collections import Counter
from collections.abc import Callable
from typing import Any

from kivy.graphics import Callback
from kivy.uix.widget import Widget

from app.device import sdl_library

__all__ = ["Overdraw"]

SAMPLES_PASSED = 0x8914
"""GL_SAMPLES_PASSED"""
QUERY_RESULT = 0x8866
"""GL_QUERY_RESULT: waits until it is there."""


class Overdraw:
    """Counts in the thread that draws, while its window is there."""

    def __init__(self, window: Any) -> None:
        """`window` is Kivy's. OSError where its OpenGL cannot count."""
        self._window = window
        names, name = ctypes.POINTER(ctypes.c_uint), ctypes.c_uint
        self._make = _function(b"glGenQueries", ctypes.c_int, names)
        self._delete = _function(b"glDeleteQueries", ctypes.c_int, names)
        self._begin = _function(b"glBeginQuery", name, name)
        self._end = _function(b"glEndQuery", name)
        self._read = _function(b"glGetQueryObjectuiv", name, name, names)
        self._stack: list[str] = []
        self._spans: list[tuple[str, ctypes.c_uint]] = []

    def frame(self) -> Counter[str]:
        """Draw one frame; pixels shaded for it by the name of the widget's class, `window` for what is none's."""
        marked = [(widget, *self._mark(widget)) for child in self._window.children for widget in child.walk()]
        try:
            self._stack = ["window"]
            self._open()
            self._window.canvas.ask_update()
            self._window.on_draw()
            self._end(SAMPLES_PASSED)
            return self._counts()
        finally:
            for widget, first, last in marked:
                widget.canvas.before.remove(first)
                widget.canvas.after.remove(last)
            self._stack, self._spans = [], []

    def _mark(self, widget: Widget) -> tuple[Callback, Callback]:
        first = Callback(lambda _: self._switch(lambda: self._stack.append(type(widget).__name__)))
        last = Callback(lambda _: self._switch(self._stack.pop))
        widget.canvas.before.insert(0, first)
        widget.canvas.after.add(last)
        return first, last

    def _switch(self, change: Callable[[], object]) -> None:
        self._end(SAMPLES_PASSED)
        change()
        self._open()

    def _open(self) -> None:
        name = ctypes.c_uint()
        self._make(1, ctypes.byref(name))
        self._spans.append((self._stack[-1], name))
        self._begin(SAMPLES_PASSED, name)

    def _counts(self) -> Counter[str]:
        found: Counter[str] = Counter()
        for owner, name in self._spans:
            count = ctypes.c_uint()
            self._read(name, QUERY_RESULT, ctypes.byref(count))
            self._delete(1, ctypes.byref(name))
            found[owner] += count.value
        return +found


def _function(name: bytes, *takes: Any) -> Callable[..., None]:
    library = sdl_library()
    if library is None:
        raise OSError("There is no SDL, whose OpenGL could count.")
    find = library.SDL_GL_GetProcAddress
    find.restype, find.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    address = find(name)
    if not address:
        raise OSError(f"This OpenGL has no {name.decode()}.")
    made: Callable[..., None] = ctypes.CFUNCTYPE(None, *takes)(address)
    return made
