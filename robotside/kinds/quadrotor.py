"""The quadrotor: it hovers, and goes where it leans to."""

from __future__ import annotations

from robotside.kinds.vehicle_kind import Handling, PursuitParameters, SafeStateDefaults, VehicleKind

__all__ = ["KIND"]

KIND = VehicleKind(
    name="quadrotor",
    description="Quadrotor",
    icon="mode_fan",
    moves="Flies",
    holds="Hovers where it is",
    path_controller="course",
    pursuit=PursuitParameters(
        goal_tolerance=0.3,
        passed_tolerance=0.6,
        lookahead=1.0,
        lookahead_time=0.8,
        deceleration=0.5,
        min_speed=0.15,
        lateral_acceleration=0.8,
    ),
    handling=Handling(braking=1.0, turning=2.0, sideways=True, levelling=0.5),
    safe_state=SafeStateDefaults("hover", hold_for=10.0, then="land"),
    docks="pad",
    flies=True,
    at_rest=(0.08, 0.08),
)
