"""The Ackermann truck: it steers its front wheels, and brakes with them straight."""

from __future__ import annotations

from robotside.kinds.vehicle_kind import Handling, PursuitParameters, SafeStateDefaults, VehicleKind

__all__ = ["KIND"]

KIND = VehicleKind(
    name="ackermann",
    description="Ackermann truck",
    icon="agriculture",
    path_controller="lattice",
    # its lattice ends a path where it is to stand, so no circle of arrival
    pursuit=PursuitParameters(
        goal_tolerance=0.0,
        passed_tolerance=0.0,
        lookahead=1.3,
        lookahead_time=0.5,
        deceleration=0.6,
        min_speed=0.4,
        lateral_acceleration=0.8,
    ),
    handling=Handling(braking=1.5, turning=1.0, steers=True),
    safe_state=SafeStateDefaults("brake_straight"),
    on_the_ground=True,
    docks="front",
)
