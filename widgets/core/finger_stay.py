"""A finger that stays where it came down, as it is told from one that has left while a frame was drawn."""

from __future__ import annotations

from collections.abc import Callable

from kivy.clock import Clock

__all__ = ["FingerStay"]

_LOOKS = 2
"""Frames after the time is over before it counts: a finger that left while one was drawn is read by then, and was a tap."""


class FingerStay:
    """Waits for one finger at a time."""

    def __init__(self, on_stayed: Callable[[], object], duration: float) -> None:
        """`on_stayed` is called once a finger has stayed for `duration` [s]."""
        self._on_stayed = on_stayed
        self._waiting = Clock.create_trigger(lambda _: self._ripen(), duration)
        self._reading = Clock.create_trigger(lambda _: self._read(), 0, interval=True)
        self._looks = 0

    @property
    def waiting(self) -> bool:
        """It has begun, and neither is its time over nor was it ended."""
        return bool(self._waiting.is_triggered or self._reading.is_triggered)

    def begin(self) -> None:
        """A finger came down."""
        self._waiting()

    def end(self) -> None:
        """It moved, or left, or another one came."""
        self._waiting.cancel()
        self._reading.cancel()

    def _ripen(self) -> None:
        self._looks = _LOOKS
        self._reading()

    def _read(self) -> None:
        if self._looks > 0:
            self._looks -= 1
            return
        self._reading.cancel()
        self._on_stayed()
