"""The watch for intruders: camera and laser together give their places on the map."""

from __future__ import annotations

import math
from collections.abc import Callable, Container
from dataclasses import dataclass

import numpy as np

from bridge.core.camera_frames import picture_size
from bridge.msgs.additions import DETECTED_CLASSES
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
from robotside.perception.crop import cropped
from robotside.perception.intruder_tracker import IntruderTracker
from robotside.perception.object_tracks import ObjectTracks, Seen
from robotside.perception.sighting import Sighting
from robotside.perception.thing_detector import find_things

__all__ = ["CameraMount", "IntruderWatch"]

PERIOD = 0.2
"""Between two pictures that are searched [s]."""

MAX_DISTANCE = 7.0
"""Sightings from farther away are not placed on the map [m]."""

HEIGHTS = {"cone": (0.3, 1.0), "person": (0.5, 2.6), "car": (0.7, 3.0), "box": (0.15, 1.7)}
"""Least and greatest height of a class at the measured distance [m]."""

EDGE = 0.006
"""What comes nearer to the picture's edge is cut off by it [part of the picture]."""

MOVED = 1.0
"""An intruder that is so far from where it was told to be is told again [m]."""

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
    """Looks for things in pictures at 5 Hz, follows them and places them with the laser; some of them are intruders."""

    def __init__(
        self,
        track: OdometryTrack,
        fov: float,
        publish: Publish,
        report: Callable[[Intruder, bytes], None],
        mount: CameraMount = CameraMount(),
        worker: Worker | None = None,
        counts: Callable[[], Container[str]] = lambda: DETECTED_CLASSES,
    ) -> None:
        """`report` gets each new intruder with its picture, a JPEG file, empty where there is none; `counts` gives their classes.

        `worker` searches the pictures; without one that is done in the loop, each picture at once.
        """
        self._worker = worker or InLoopWorker()
        self._search: tuple[CompressedImage, bool, Job[list[Sighting]]] | None = None
        """The picture that is searched, whether it may be placed, and the work."""
        self._found: tuple[bytes, list[Sighting]] = (b"", [])
        """The file that was searched last, and what is in it."""
        self._track, self._publish, self._report, self._mount = track, publish, report, mount
        self._counts = counts
        self._slope = math.tan((fov if math.isfinite(fov) else 1.2) / 2)
        self.intruders = IntruderTracker()
        """All that were seen."""
        self._tracks = ObjectTracks()
        self._told: dict[int, Point] = {}
        """Where each intruder was when it was told."""
        self._next = -math.inf
        self._points: Points = np.empty((0, 2))
        self._points_stamp = -math.inf

    def forget(self) -> None:
        """Drop what was placed and not reported yet: the position was wrong."""
        self.intruders.forget()
        self._tracks.forget()

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
        size = picture_size(image.data)[1:] if sightings else (0, 0)  # nothing is seen in what cannot be read
        pose = self._track.at(stamp) if placing else None
        spotted = [self._spotted(each, pose, size[1] / size[0], stamp) for each in sightings]
        there = [each for each in spotted if each is not None]
        seen = [Seen(each.sighting, each.in_map(pose, self._mount)) for each in there]
        detections = []
        for each, one, (number, kind) in zip(there, seen, self._tracks.update(seen, stamp), strict=True):
            detections.append(_detection(each, size, stamp, number, kind))
            if one.place is not None and each.whole and each.distance < MAX_DISTANCE:
                self._place(one, each.distance, stamp, number, kind)
        header = Header(image.header.stamp, image.header.frame_id)
        self._publish("/detections", Detection2DArray(header, detections))

    def _spotted(self, sighting: Sighting, pose: Pose2 | None, ratio: float, stamp: float) -> _Spotted | None:
        """A sighting with its direction and distance; None for what is too large or too small for its class."""
        bearing = math.atan((1.0 - 2.0 * sighting.centre) * self._slope)
        distance = self._distance(sighting, bearing, pose, ratio, stamp)
        tall = sighting.height * 2.0 * self._slope * ratio * distance * math.cos(bearing)
        sides = sighting.left > EDGE and sighting.right < 1.0 - EDGE
        whole = sides and sighting.bottom < 1.0 - EDGE
        least, most = HEIGHTS[sighting.kind]
        if whole and (tall > most or (tall < least and sighting.top > EDGE)):
            return None
        return _Spotted(sighting, bearing, distance, whole)

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

    def _place(self, one: Seen, distance: float, stamp: float, track: int, kind: str) -> None:
        if one.place is None or kind not in self._counts():
            return
        x, y = one.place
        fresh = self.intruders.update(x, y, distance, stamp, one.sighting.score, kind, track)
        known = self.intruders.known
        still = all(
            math.dist((each.position.x, each.position.y), (self._told[each.id].x, self._told[each.id].y))
            < MOVED
            for each in known
            if each.id in self._told
        )
        if fresh is None and still:
            return
        self._told = {each.id: each.position for each in known}
        self._publish("/intruders", IntruderArray(Header(Time.at(stamp), "map"), known))
        if fresh is not None:
            self._report(fresh, cropped(self._found[0], one.sighting))


@dataclass(frozen=True, slots=True)
class _Spotted:
    """A sighting with what the robot knows of where it is."""

    sighting: Sighting
    bearing: float
    """From the camera [rad], positive left."""
    distance: float
    """From the camera [m]."""
    whole: bool
    """The picture's edge cuts off no more than its top."""

    @property
    def ahead(self) -> Point:
        """Its place from the camera [m]."""
        return Point(self.distance * math.cos(self.bearing), self.distance * math.sin(self.bearing), 0.0)

    def in_map(self, pose: Pose2 | None, mount: CameraMount) -> tuple[float, float] | None:
        """Its place in `map`, of a robot at `pose`; None where that, or how far it is, is not known."""
        if pose is None or not math.isfinite(self.distance):
            return None
        there = pose.then(Pose2(mount.x + self.ahead.x, self.ahead.y, 0.0))
        return there.x, there.y


def _detection(one: _Spotted, size: tuple[int, int], stamp: float, number: int, kind: str) -> Detection2D:
    sighting = one.sighting
    box = BoundingBox2D(
        Pose2D(Point2D(sighting.centre * size[0], (sighting.top + sighting.bottom) / 2 * size[1])),
        sighting.width * size[0],
        sighting.height * size[1],
    )
    what = ObjectHypothesisWithPose(
        ObjectHypothesis(kind, sighting.score), PoseWithCovariance(Pose(one.ahead))
    )
    return Detection2D(Header(Time.at(stamp), "base_link"), [what], box, str(number))


def _searched(jpeg: bytes) -> Work[list[Sighting]]:
    """The things in a picture, for a worker."""
    yield
    return find_things(jpeg)
