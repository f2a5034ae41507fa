"""Events of Kivy's clock that have the loop turn at once, where that can be woken."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.clock import Clock

__all__ = ["wake_trigger", "waking"]


def waking(act: Callable[[], object], period: float = 0.0, *, interval: bool = False) -> Any:
    """An event that calls `act` in the UI thread after `period` [s], as an `interval` again and again: called it begins, `cancel` ends it."""
    make: Any = (
        getattr(Clock, "create_trigger_free", None) if hasattr(Clock, "get_min_free_timeout") else None
    )
    return (make or Clock.create_trigger)(lambda _: act(), period, interval=interval)


def wake_trigger(act: Callable[[], object]) -> Callable[[], object]:
    """A function for any thread, after which `act` is called in the UI thread as soon as that is free."""
    trigger: Callable[[], object] = waking(act)
    return trigger
