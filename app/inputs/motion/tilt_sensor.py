"""Gravity for the tilt: from the device's own fusion, or made of its acceleration where that is all there is."""

from __future__ import annotations

from collections.abc import Callable

from app.device.motion import Axes, Kind
from app.inputs.motion.motion_app import MotionApp
from app.inputs.motion.tilt import Level, Tilt, turned

__all__ = ["MIN_RATE", "TiltSensor"]

MIN_RATE = 10.0
"""Below this rate [Hz] a hand is ahead of what the sensor tells."""


class TiltSensor:
    """Feeds a `Tilt` while it listens, and costs nothing while it does not."""

    def __init__(self, app: MotionApp, tilt: Tilt) -> None:
        """`app` is asked for its `sensing`."""
        self._app, self._tilt = app, tilt
        self.turn = 0
        """How the screen is turned [quarters]."""
        self._level: Level | None = None
        """Makes gravity of the acceleration, where the device does not tell it."""
        self._forgets: list[Callable[[], None]] = []

    @property
    def is_listening(self) -> bool:
        """It listens to the device's sensors."""
        return bool(self._forgets)

    @property
    def fault(self) -> str:
        """Why this device cannot be tilted, as a sentence; empty where it can."""
        sensing = self._app.sensing
        return "" if sensing.possible else str(sensing.sentence)

    @property
    def trouble(self) -> str:
        """What is wrong with the samples, as a sentence; empty while all is well, or too early to tell."""
        kind: Kind = "gravity" if self._level is None else "acceleration"
        health = self._app.sensing.health(kind, MIN_RATE)
        return "" if health.fault in ("", "waiting", "paused") else str(health.sentence)

    def listen(self, *, on: bool) -> None:
        """Listen where that is possible, or no more."""
        wanted = on and self._app.sensing.possible
        if wanted and not self._forgets:
            self._begin()
        elif not wanted:
            self.close()

    def close(self) -> None:
        """Listen no more; the next `listen` begins anew."""
        for forget in self._forgets:
            forget()
        self._forgets = []

    def _begin(self) -> None:
        sensing = self._app.sensing
        fused = sensing.has("gravity")
        self._level = None if fused else Level()
        self._forgets = [sensing.listen("acceleration", self._feel)] if sensing.has("acceleration") else []
        if fused:
            self._forgets.append(sensing.listen("gravity", self._feed))
            self._do_without_fusion()

    def _do_without_fusion(self) -> None:
        """Gravity that the system refuses is made of the acceleration, where there is that."""
        if self._app.sensing.health("gravity").fault == "refused" and len(self._forgets) > 1:
            self._forgets.pop()()
            self._level = Level()

    def _feed(self, t: float, up: Axes) -> None:
        self._tilt.feed(t, turned(up, self.turn))

    def _feel(self, t: float, a: Axes) -> None:
        self._tilt.feel(t, a)
        if self._level is not None:
            self._feed(t, self._level(t, a))
