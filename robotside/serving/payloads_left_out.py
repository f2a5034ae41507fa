"""Payloads that a robot was brought up without: each goes off as soon as the robot has told of it."""

from __future__ import annotations

from collections.abc import Collection

from robotside.core.refusal import Refusal
from robotside.serving.payload_switches import PayloadSwitches
from robotside.station.station import Station

__all__ = ["MAX_LOOKS", "PayloadsLeftOut"]

MAX_LOOKS = 10
"""So often it is looked, once a second: what a robot has not told of by then it has not, and what is needed stays on."""
_SECOND = "/diagnostics"
"""The topic that comes once a second."""


class PayloadsLeftOut:
    """Works through the payloads that are to be off, and ends by itself."""

    def __init__(self, switches: PayloadSwitches, station: Station, keys: Collection[str]) -> None:
        """`keys` are those of the table. One that stays on is an event with the reason."""
        self._switches, self._station = switches, station
        self._left = list(dict.fromkeys(keys))
        self._looks = 0
        if self._left:
            self._end = station.bus.subscribe(_SECOND, self._look, replay=False)

    def _look(self, *_: object) -> None:
        self._looks += 1
        for key in tuple(self._left):
            try:
                self._switches.leave_out(key)
            except Refusal as refusal:
                if self._looks < MAX_LOOKS:
                    continue
                self._station.events.say("control", refusal.notice, "warn")
            self._left.remove(key)
        if not self._left:
            self._end()
