"""A tablet for a desktop: the arrow keys lean it."""

from __future__ import annotations

import math

from app.device.motion import SimulatedMotion, motion_source
from app.inputs.motion.motion_app import MotionApp

__all__ = ["ARROWS", "SimulatedTablet"]

ARROWS = {"up": (0.0, 1.0), "down": (0.0, -1.0), "right": (1.0, 0.0), "left": (-1.0, 0.0)}
"""Keys that lean it, to the right and ahead."""
LEAN_ANGLE = math.radians(20.0)
"""How far they do [rad]."""


class SimulatedTablet:
    """In place of the device's own sensors while it is on."""

    def __init__(self, app: MotionApp) -> None:
        """`app` is asked for its `sensing` and `now`."""
        self._app = app
        self._motion: SimulatedMotion | None = None
        self._keys: set[str] = set()

    @property
    def on(self) -> bool:
        """The arrow keys lean it."""
        return self._motion is not None

    def switch(self, *, on: bool) -> None:
        """Take it for the device, or the device's own sensors again."""
        self._motion = SimulatedMotion(now=self._app.now) if on else None
        self._app.sensing.use(self._motion or motion_source(self._app.now))

    def lean(self, right: float, ahead: float) -> None:
        """Hold it so [rad]; nothing while it is off."""
        if self._motion is not None:
            self._motion.lean(right, ahead)

    def press(self, key: str) -> None:
        """That arrow key is down."""
        self._keys.add(key)
        self._lean_by_keys()

    def release(self, key: str) -> None:
        """It is up."""
        self._keys.discard(key)
        self._lean_by_keys()

    def update(self, now: float) -> None:
        """Each tick [s]: report how it is held, at once."""
        if self._motion is not None:
            self._motion.tell()
            self._app.sensing.update(now)

    def _lean_by_keys(self) -> None:
        right, ahead = (sum(ARROWS[key][axis] for key in self._keys) for axis in (0, 1))
        self.lean(right * LEAN_ANGLE, ahead * LEAN_ANGLE)
