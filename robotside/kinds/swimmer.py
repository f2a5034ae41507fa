"""The underwater swimmer with six fins: it keeps a depth and may lie any way up."""

from __future__ import annotations

from robotside.kinds.vehicle_kind import Handling, PursuitParameters, SafeStateDefaults, VehicleKind

__all__ = ["KIND"]

KIND = VehicleKind(
    name="hexapod",
    description="Underwater hexapod",
    icon="scuba_diving",
    moves="Swims",
    holds="Keeps its place in the water",
    path_controller="course",
    pursuit=PursuitParameters(
        goal_tolerance=0.4,
        passed_tolerance=0.8,
        lookahead=1.2,
        lookahead_time=1.0,
        deceleration=0.15,
        min_speed=0.1,
        lateral_acceleration=0.2,
    ),
    handling=Handling(braking=0.2, turning=0.6, drifts=True, glide=0.7, levelling=0.08),
    safe_state=SafeStateDefaults("hold_depth", hold_for=60.0, then="surface"),
    docks="cage",
    dives=True,
    at_rest=(0.08, 0.08),
    astray=1.5,
)
