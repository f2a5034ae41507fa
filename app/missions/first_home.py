"""The home that a robot gets at the start, where none was ever set: the first place that it is sure of."""

from __future__ import annotations

import math

from app.link.feeds import Feeds
from app.missions.mission_editor import MissionEditor
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Checklist, PlaceArray

__all__ = ["first_home"]


def first_home(feeds: Feeds, mission: MissionEditor) -> tuple[float, float] | None:
    """Where home is to be drawn, in `map` [m]; None where there is one, where somebody has begun to edit, or the robot is not sure.

    It is only drawn, and can be undone: the robot gets it with the points, or with the way home.
    """
    if mission.stored is None or mission.stored.home is not None:
        return None
    if mission.draft.home is not None or mission.can_undo or mission.sent is not None:
        return None
    places: PlaceArray | None = feeds.latest("/places")
    if places is None or any(place.kind == "home" for place in places.places):
        return None  # the robot goes to a place of that kind
    checks: Checklist | None = feeds.latest("/checklist")
    sure = checks is not None and any(
        check.name == "position" and check.state == "ok" for check in checks.checks
    )
    pose: PoseWithCovarianceStamped | None = feeds.latest("/pose")
    if not sure or pose is None or feeds.state("/pose") != "live":
        return None
    x, y = pose.pose.pose.position.x, pose.pose.pose.position.y
    return (x, y) if math.isfinite(x) and math.isfinite(y) else None
