"""Charging contacts of a vehicle, and when they meet those of a dock: by where they really are."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from sim.core.parameters import Positive, Table
from sim.core.shapes import Vec3, place, yaw_of
from sim.physics.backend_bullet import State
from sim.world.tables import Dock, DockKind

__all__ = ["TOLERANCES", "ChargingContacts", "ChargingParameters", "Tolerance", "docked"]


class ChargingParameters(Table, frozen=True, kw_only=True):
    """The `[charging]` table of a vehicle's file."""

    dock: DockKind
    """The kind of dock that fits it."""
    contacts: Vec3
    """Middle of its contacts, or of its coil, in `base_link` [m]."""
    current: Positive
    """Most that its battery takes [A]."""


class Tolerance(NamedTuple):
    """How far a vehicle's contacts may be off a dock's, and its direction."""

    short: float
    """Before the dock's [m]: springs, or the field of a coil, reach so far."""
    beyond: float
    """Pressed in [m]."""
    aside: float
    """[m]"""
    below: float
    """[m]"""
    above: float
    """[m]"""
    askew: float
    """[rad]"""


TOLERANCES: dict[DockKind, Tolerance] = {
    "contacts": Tolerance(0.02, 0.02, 0.04, 0.0, 0.30, math.radians(10)),
    "jetty": Tolerance(0.15, 0.05, 0.20, 0.30, 0.30, math.radians(20)),
    "pad": Tolerance(0.25, 0.25, 0.25, 0.04, 0.04, math.inf),
    "cage": Tolerance(0.15, 0.05, 0.15, 0.15, 0.15, math.radians(20)),
}
"""Of each kind: sprung contacts on upright rails 0.30 m high, a sprung arm at the waterline, plates under the feet, coils."""


_MAX_OFF = 0.5
"""No dock is met whose contacts are farther off than this [m]."""


class ChargingContacts:
    """The contacts of one vehicle in a world."""

    def __init__(self, parameters: ChargingParameters, docks: Sequence[Dock]) -> None:
        """Of a vehicle that may charge at those of the `docks` that are of its kind."""
        self._contacts = parameters.contacts
        self._tolerance = TOLERANCES[parameters.dock]
        self._reach = math.hypot(*parameters.contacts) + _MAX_OFF
        """From `base_link` to a dock that its contacts may meet, along x and along y [m]."""
        self._docks = [
            (dock, math.cos(dock.angle), math.sin(dock.angle))
            for dock in docks
            if dock.kind == parameters.dock
        ]

    def dock_at(self, state: State) -> Dock | None:
        """The dock whose contacts meet its own in this state; None when none do."""
        here = state.position
        for dock, cosine, sine in self._docks:
            if abs(here[0] - dock.x) > self._reach or abs(here[1] - dock.y) > self._reach:
                continue
            x, y, z = place(self._contacts, here, state.rotation)
            if self._meets(dock, cosine, sine, (x - dock.x, y - dock.y, z - dock.z), yaw_of(state.rotation)):
                return dock
        return None

    def _meets(self, dock: Dock, cosine: float, sine: float, off: Vec3, yaw: float) -> bool:
        allowed = self._tolerance
        beyond, aside = cosine * off[0] + sine * off[1], cosine * off[1] - sine * off[0]
        if dock.kind == "pad":  # it is round
            near = math.hypot(beyond, aside) <= allowed.aside
        else:
            near = -allowed.short <= beyond <= allowed.beyond and abs(aside) <= allowed.aside
        askew = abs(math.remainder(yaw - dock.angle, math.tau))
        return near and -allowed.below <= off[2] <= allowed.above and askew <= allowed.askew


def docked(parameters: ChargingParameters, dock: Dock) -> tuple[float, float, float, float]:
    """Where `base_link` is when the contacts meet: x, y [m], yaw [rad] and height [m], halfway from where they first do to where they touch.

    The height is 0, for any, but under water.
    """
    ahead, left, up = parameters.contacts
    short = 0.0 if dock.kind == "pad" else TOLERANCES[dock.kind].short / 2
    cosine, sine = math.cos(dock.angle), math.sin(dock.angle)
    back, height = ahead + short, dock.z - up if dock.kind == "cage" else 0.0
    return dock.x - cosine * back + sine * left, dock.y - sine * back - cosine * left, dock.angle, height
