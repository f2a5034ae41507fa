"""The watch for intruders: camera and laser together give their places on the map."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance
from bridge.msgs.pilothouse_msgs import Intruder, IntruderArray
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time
from bridge.msgs.vision_msgs import (
    BoundingBox2D,
    Detection2D,
    Detection2DArray,
    ObjectHypothesis,
    ObjectHypothesisWithPose,
    Point2D,
    Pose2D,
)
from robotside.core.bus import Publish
from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import InLoopWorker, Job, Work, Worker
from robotside.localisation.odometry_track import OdometryTrack
from robotside.perception.cone_detector import Sighting, find_cones
from robotside.perception.intruder_tracker import IntruderTracker

__all__ = ["CameraMount", "IntruderWatch"]

PERIOD = 0.2
"""Between two pictures that are searched [s]."""

MAX_DISTANCE = 7.0
"""Sightings from farther away are not placed on the map [m]."""

CONE_HEIGHT = (0.35, 0.95)
"""Least and greatest height of a cone at the measured distance [m]."""

MAX_SWEEP_AGE = 1.0
"""Laser points older than this against the picture are not used [s]."""


@dataclass(frozen=True, slots=True)
class CameraMount:
    """Where the camera sits in `base_link`, looking straight ahead."""

    x: float = 0.08
    """[m]"""
    z: float = 0.36
    """Height above the ground [m]."""


class IntruderWatch:
    """Looks for cones in pictures at 5 Hz and places them with the laser."""

    def __init__(
        self,
        track: OdometryTrack,
        fov: float,
        publish: Publish,
        report: Callable[[Intruder], None],
        mount: CameraMount = CameraMount(),
        worker: Worker | None = None,
    ) -> None:
        """`worker` searches the pictures; without one that is done in the loop, each picture at once."""
        self._worker = worker or InLoopWorker()
        self._search: tuple[CompressedImage, bool, Job[list[Sighting]]] | None = None
        """The picture that is searched, whether it may be placed, and the work."""
        self._found: tuple[bytes, list[Sighting]] = (b"", [])
        """The file that was searched last, and what is in it."""
        self._track, self._publish, self._report, self._mount = track, publish, report, mount
        self._slope = math.tan((fov if math.isfinite(fov) else 1.2) / 2)
        self.intruders = IntruderTracker()
        """All that were seen."""
        self._next = -math.inf
        self._points: Points = np.empty((0, 2))
        self._points_stamp = -math.inf

    def on_scan(self, points: Points, stamp: float) -> None:
        """Keep the laser's end points, in `map`, measured at `stamp` [s]."""
        self._points, self._points_stamp = points, stamp

    def on_image(self, image: CompressedImage, *, placing: bool) -> None:
        """Search a picture, if it is time and none is being searched; `placing` is False while the position is not to be trusted."""
        stamp = image.header.stamp.seconds
        if stamp < self._next or self._search is not None:
            return
        self._next = max(self._next + PERIOD, stamp)
        if image.data is self._found[0]:  # it came out the same
            self._report_found(image, placing=placing)
            return
        self._search = image, placing, self._worker.submit(_searched(image.data))
        self.update(placing=placing)

    def update(self, *, placing: bool) -> None:
        """Take in what was found, once the picture is searched; call it in each step, with `placing` as it is by now."""
        if self._search is None or not self._search[2].poll():
            return
        (image, placed, job), self._search = self._search, None
        self._found = image.data, job.result()
        self._report_found(image, placing=placed and placing)

    def _report_found(self, image: CompressedImage, *, placing: bool) -> None:
        stamp, sightings = image.header.stamp.seconds, self._found[1]
        size = jpeg_size(image.data)
        pose = self._track.at(stamp) if placing else None
        detections = [self._detection(sighting, pose, size, stamp) for sighting in sightings]
        header = Header(image.header.stamp, image.header.frame_id)
        self._publish("/detections", Detection2DArray(header, [d for d in detections if d is not None]))

    def _detection(
        self, sighting: Sighting, pose: Pose2 | None, size: tuple[int, int], stamp: float
    ) -> Detection2D | None:
        ratio = size[1] / size[0]
        bearing = math.atan((1.0 - 2.0 * sighting.centre) * self._slope)
        distance = self._distance(sighting, bearing, pose, ratio, stamp)
        tall = sighting.height * 2.0 * self._slope * ratio * distance * math.cos(bearing)
        whole = sighting.left > 0.0 and sighting.right < 1.0 and sighting.bottom < 1.0
        if whole and not CONE_HEIGHT[0] < tall < CONE_HEIGHT[1]:
            return None
        place = Point(distance * math.cos(bearing), distance * math.sin(bearing), 0.0)
        if pose is not None and whole and distance < MAX_DISTANCE:
            self._place(pose, place, distance, stamp, sighting.score)
        what = ObjectHypothesis("cone", sighting.score)
        box = BoundingBox2D(
            Pose2D(Point2D(sighting.centre * size[0], (sighting.top + sighting.bottom) / 2 * size[1])),
            sighting.width * size[0],
            sighting.height * size[1],
        )
        where = PoseWithCovariance(Pose(place))
        return Detection2D(Header(Time.at(stamp), "base_link"), [ObjectHypothesisWithPose(what, where)], box)

    def _distance(
        self, sighting: Sighting, bearing: float, pose: Pose2 | None, ratio: float, stamp: float
    ) -> float:
        """From the camera [m]: the laser's at this bearing, or where the ground is at the lower edge."""
        drop = (2.0 * sighting.bottom - 1.0) * self._slope * ratio
        ground = self._mount.z / drop / math.cos(bearing) if drop > 0.01 else math.inf
        if pose is None or abs(stamp - self._points_stamp) > MAX_SWEEP_AGE:
            return ground
        eye = pose.then(Pose2(self._mount.x, 0.0, 0.0))
        seen = eye.inverse().apply(self._points)
        ranges, bearings = np.hypot(seen[:, 0], seen[:, 1]), np.arctan2(seen[:, 1], seen[:, 0])
        half = math.atan(sighting.width * self._slope) + 0.02
        fits = (np.abs(bearings - bearing) < half) & (np.abs(ranges - ground) < 0.35 * ground + 0.3)
        return float(ranges[fits].min()) + 0.05 if fits.any() else ground

    def _place(self, pose: Pose2, place: Point, distance: float, stamp: float, score: float) -> None:
        there = pose.then(Pose2(self._mount.x + place.x, place.y, 0.0))
        fresh = self.intruders.update(there.x, there.y, distance, stamp, score)
        if fresh is None:
            return
        self._publish("/intruders", IntruderArray(Header(Time.at(stamp), "map"), self.intruders.known))
        self._report(fresh)


def _searched(jpeg: bytes) -> Work[list[Sighting]]:
    """The cones in a picture, for a worker."""
    yield
    return find_cones(jpeg)


def jpeg_size(jpeg: bytes) -> tuple[int, int]:
    """Width and height [pixel] that a JPEG file's header says; 640 x 480 when it has none."""
    at = 2
    while at + 9 < len(jpeg) and jpeg[at] == 0xFF:
        if 0xC0 <= jpeg[at + 1] <= 0xCF and jpeg[at + 1] not in (0xC4, 0xC8, 0xCC):
            return int.from_bytes(jpeg[at + 7 : at + 9], "big"), int.from_bytes(jpeg[at + 5 : at + 7], "big")
        at += 2 + int.from_bytes(jpeg[at + 2 : at + 4], "big")
    return 640, 480
