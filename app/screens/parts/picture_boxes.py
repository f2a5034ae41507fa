"""What was detected as boxes in a picture; a box where the robot counts an intruder is red, and the others are not."""

from __future__ import annotations

import math

from app.link.capabilities import POSE
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import IntruderArray
from bridge.msgs.vision_msgs import Detection2DArray
from widgets import Video
from widgets.sensors.intruder_badge import direction_of

__all__ = ["FOUND", "PictureBoxes"]

FOUND = "/intruders"
"""Topic of what was found."""


class PictureBoxes:
    """In the picture of one screen."""

    def __init__(self, session: Session, dashboard: Dashboard, video: Video) -> None:
        self._session, self._video = session, video
        dashboard.bind(video, "/detections", self._show, fresh=False, empty=Detection2DArray())

    def tick(self) -> None:
        """Bring up to date which of them are counted: the robot moves, and another camera may be chosen."""
        fov, shown = self._session.robot.info.camera_fov, self._video.field_of_view
        first = self._session.cameras.shows_first
        fov = fov if fov > 0 and first else math.nan
        if fov != shown and not (math.isnan(fov) and math.isnan(shown)):
            self._video.field_of_view = fov
        counted = self._directions() if first and self._session.feeds.state(POSE) == "live" else []
        if self._video.counted != counted:
            self._video.counted = counted

    def _show(self, found: Detection2DArray) -> None:
        self._video.show(self._session.cameras.detections_shown(found))

    def _directions(self) -> list[float]:
        """Where each intruder is in `base_link` [rad], positive left; empty where that is not known."""
        found: IntruderArray | None = self._session.feeds.latest(FOUND)
        told: PoseWithCovarianceStamped | None = self._session.feeds.latest(POSE)
        if found is None or told is None:
            return []
        ways = (direction_of(told.pose.pose, one) for one in found.intruders)
        return [way for way in ways if math.isfinite(way)]
