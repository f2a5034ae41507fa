"""Brings the feeds to the widgets of one screen: messages when they come, age and state ten times a second."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.link.feeds import Feeds
from bridge.msgs import Msg

__all__ = ["AGE_STEP", "Dashboard"]

AGE_STEP = 0.5
"""Ages closer than this look the same [s]: nothing is drawn anew for less."""
EMPTY_TIMEOUT = 1.0
"""What has an `empty` message is taken off the glass when it is older than this [s]."""


@dataclass(frozen=True)
class _Binding:
    widget: Any
    topic: str
    show: Callable[[Any], None]
    fresh: bool
    always: bool
    empty: Msg | None


class Dashboard:
    """The widgets of one screen and the topics that they show."""

    def __init__(self, feeds: Feeds) -> None:
        self._feeds = feeds
        self._bindings: list[_Binding] = []
        self.active = False
        """The screen is on the glass; while it is not, messages are left out and the newest shown on return."""

    def bind(
        self,
        widget: Any,
        topic: str,
        show: Callable[[Any], None] | None = None,
        *,
        fresh: bool = True,
        always: bool = False,
        empty: Msg | None = None,
    ) -> None:
        """Show `topic` on `widget`, by its own `show` unless another is given.

        With `fresh` the widget's age and state follow this topic; `always` delivers while the screen is away.
        `empty` takes the place of a message over a second old or of a lost link, where the old one would deceive.
        """
        self._bindings.append(_Binding(widget, topic, show or widget.show, fresh, always, empty))

    def deliver(self, topic: str, message: Msg) -> None:
        """A message came."""
        for binding in self._bindings:
            if binding.topic == topic and (self.active or binding.always):
                binding.show(message)
                if binding.fresh:
                    self._refresh(binding)

    def enter(self) -> None:
        """The screen comes onto the glass: show the newest of everything."""
        self.active = True
        for binding in self._bindings:
            message = self._feeds.latest(binding.topic)
            if message is not None and not binding.always:
                binding.show(message)
        self.tick()

    def leave(self) -> None:
        """The screen leaves the glass."""
        self.active = False

    def tick(self) -> None:
        """Bring age and state of every widget up to date."""
        for binding in self._bindings:
            if binding.fresh:
                self._refresh(binding)
            if binding.empty is not None and not self._believed(binding.topic):
                binding.show(binding.empty)

    def _believed(self, topic: str) -> bool:
        return math.isnan(self._feeds.lost_at) and self._feeds.age(topic) <= EMPTY_TIMEOUT

    def _refresh(self, binding: _Binding) -> None:
        widget, state = binding.widget, self._feeds.state(binding.topic)
        age = self._feeds.age(binding.topic)
        if state == "stale" and not abs(age - widget.age) < AGE_STEP:
            widget.age = age
        if widget.state != "alarm" or state != "live":
            widget.state = state
