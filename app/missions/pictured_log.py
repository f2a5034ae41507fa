"""The list of events with the pictures of intruders in it."""

from __future__ import annotations

from typing import Any

from app.missions.intruder_pictures import IntruderPictures
from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event
from widgets import EventLog

__all__ = ["PicturedLog"]


class PicturedLog(EventLog):
    """Shows the picture of an intruder as soon as it comes."""

    def __init__(self, intruders: IntruderPictures, **kwargs: Any) -> None:
        super().__init__(size_hint_y=1, **kwargs)
        self._intruders = intruders
        intruders.listeners.append(self._show_pictures)

    def show(self, event: Event) -> None:
        """Put an event into the list."""
        super().show(event)
        if event.code == Code.INTRUDER_FOUND:
            self._show_pictures()

    def _show_pictures(self) -> None:
        self.pictures = self._intruders.newest()
