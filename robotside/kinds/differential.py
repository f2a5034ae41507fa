"""The differential drive: a robot on two driven wheels that turns where it stands."""

from __future__ import annotations

from robotside.kinds.vehicle_kind import VehicleKind

__all__ = ["KIND"]

KIND = VehicleKind(name="wheels", description="Differential drive", on_the_ground=True, docks="front")
