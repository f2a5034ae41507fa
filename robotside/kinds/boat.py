"""The surface boat: it turns by its rudder while it makes way, and current and wind carry it."""

from __future__ import annotations

from robotside.kinds.vehicle_kind import Handling, PursuitParameters, SafeStateDefaults, VehicleKind

__all__ = ["KIND"]

KIND = VehicleKind(
    name="boat",
    description="Surface boat",
    icon="sailing",
    moves="Sails",
    holds="Keeps its place on the water",
    order_fields=("throttle", "height"),
    path_controller="course",
    # the circle of arrival is as large as waves, currents and its own way make it
    pursuit=PursuitParameters(
        goal_tolerance=1.5,
        passed_tolerance=3.0,
        lookahead=4.0,
        lookahead_time=1.0,
        deceleration=0.2,
        min_speed=0.3,
        lateral_acceleration=0.4,
    ),
    handling=Handling(braking=0.15, turning=0.3, drifts=True),
    safe_state=SafeStateDefaults("hold_heading"),
    docks="jetty",
    comes_about=True,
    at_rest=(0.15, 0.10),
    astray=4.0,
)
