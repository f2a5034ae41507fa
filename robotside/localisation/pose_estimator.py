"""The pose estimator: from the first guess on it publishes where the robot is, and how sure it is of that."""

from __future__ import annotations

import bisect
import math
from collections import deque

import numpy as np
from numpy.typing import NDArray

from bridge.core.codes import Code
from bridge.core.geo import Datum
from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import (
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Transform,
    TransformStamped,
    Vector3,
    zeros36,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Bumper, RobotInfo
from bridge.msgs.sensor_msgs import Imu, NavSatFix
from bridge.msgs.std_msgs import Header, Time
from bridge.msgs.tf2_msgs import TFMessage
from robotside.core.bus import Publish
from robotside.core.notice import Notice
from robotside.core.pose2 import ORIGIN, Points, Pose2
from robotside.kinds.registry import kind_of
from robotside.localisation.position_uncertainty import PositionUncertainty
from robotside.localisation.scan_matching import Field, Localiser
from robotside.records.events import Say

__all__ = ["OdometryTrack", "PoseEstimator"]

FIXES_AVERAGED = 5
"""Satellite fixes averaged for the first guess."""

FIX_TIMEOUT = 3.0
"""Without fix and compass for this long the robot supposes to stand at the map's origin [s]."""

GUESS_REACH, GUESS_YAW = 4.0, 0.35
"""The largest error of a guess by satellite and compass [m, rad]."""

PLACED_REACH, PLACED_YAW = 1.0, 0.5
"""The largest error of a pose that an operator sets on the map [m, rad]."""


FIX_SPREAD = 1.0
"""How far a single fix is trusted by a robot that has no laser [m]: its error changes slowly."""


COMPASS_PERIOD, COMPASS_SPREAD = 0.5, 0.2
"""So often such a robot believes its compass [s], and how far each time [rad]: its error changes slowly."""

SONAR_RINGS = 4
"""Of sonars that are laid on the map together."""


_NO_IDEA = Notice(
    Code.POSITION_LOST,
    "No fix or compass: the robot assumes the map's origin. Place it on the map.",
)

MAX_PUSH = 0.3
"""Distance that the wheels may turn against an obstacle before it is reported [m]."""

_PUSHES = Notice(
    Code.POSITION_UNSURE,
    "Position unsure: the wheels turn against an obstacle. Drive away from it.",
)

_UNHEARD = Notice(
    Code.POSITION_UNSURE,
    "Position unsure: the sonars do not match the map. Place the robot on the map.",
)

_UNFITTING = Notice(
    Code.POSITION_UNSURE,
    "Position unsure: the laser does not match the map. Place the robot on the map.",
)

_NO_LASER = Notice(
    Code.POSITION_BY_WHEELS,
    "No laser: the position may drift. Place the robot on the map when it is off.",
)


MAX_AHEAD = 0.1
"""A pose is told for a moment so long after the newest odometry at most [s]: twice the time until the next."""


class OdometryTrack:
    """The last seconds of poses, to ask where the robot was when a sensor measured."""

    def __init__(self) -> None:
        self._poses: deque[tuple[float, Pose2]] = deque(maxlen=60)
        self._velocity = ORIGIN

    def add(self, stamp: float, pose: Pose2, velocity: Pose2 = ORIGIN) -> None:
        """Remember `pose` at `stamp` [s], and the `velocity` from there on, ahead and left [m/s] and turning [rad/s]; NaN for unknown."""
        self._poses.append((stamp, pose))
        self._velocity = velocity if math.isfinite(sum(velocity)) else ORIGIN

    def forget(self) -> None:
        """The remembered path was wrong."""
        self._poses.clear()

    def at(self, stamp: float) -> Pose2 | None:
        """The pose at `stamp` [s], between its neighbours, or a little after the newest one as it went on from there; else the nearest one."""
        poses = self._poses
        if not poses:
            return None
        after = bisect.bisect_left(poses, stamp, key=lambda entry: entry[0])
        if after == 0:
            return poses[0][1]
        if after == len(poses):
            newest, pose = poses[-1]
            since = min(stamp - newest, MAX_AHEAD)
            return pose.then(Pose2(*(part * since for part in self._velocity)))
        (start, a), (end, b) = poses[after - 1], poses[after]
        part = (stamp - start) / (end - start) if end > start else 0.0
        return Pose2(
            a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), wrap(a.yaw + part * wrap(b.yaw - a.yaw))
        )


class PoseEstimator:
    """Takes odometry, sweeps, fixes and compass; gives the pose in `map`, and says when it is not sure of it."""

    def __init__(self, info: RobotInfo, say: Say, publish: Publish) -> None:
        self._say, self._publish = say, publish
        has_place = not (math.isnan(info.latitude) or math.isnan(info.longitude))
        self._datum = Datum(info.latitude, info.longitude) if has_place else None
        self._localiser: Localiser | None = None
        self._uncertainty = PositionUncertainty()
        self._fixes: deque[tuple[float, float]] = deque(maxlen=FIXES_AVERAGED)
        self._compass = math.nan
        self._since = math.nan
        self._search: tuple[Pose2, float, float] | None = None
        self._odom: Pose2 | None = None
        self._was_sure = True
        self._begun = math.nan
        self._swept = False
        self._faced = -math.inf
        self._rings: list[NDArray[np.float64]] = []
        self._rolls = kind_of(info.kind).on_the_ground
        self._touch: Bumper | None = None
        self._pushed = 0.0
        self.track = OdometryTrack()
        """Poses in `map` of the last seconds."""
        self.odometer = 0.0
        """All that was driven since the start, by the wheels [m]."""
        self.speed = self.turn = 0.0
        """As the wheels measure [m/s], [rad/s]."""

    @property
    def pose(self) -> Pose2 | None:
        """In `map`; None while it has no idea."""
        return self._localiser.pose if self._localiser else None

    @property
    def sure(self) -> bool:
        """The laser agrees with the map."""
        return self._localiser is not None and self._localiser.sure

    @property
    def pushes(self) -> bool:
        """The wheels turn against something and the robot does not get on."""
        return self._pushed > MAX_PUSH

    @property
    def fit(self) -> float:
        """Part of the last sweep that lies on the map's surfaces, 0 to 1; NaN before the first."""
        return self._localiser.fit if self._localiser else math.nan

    @property
    def spread(self) -> float:
        """The uncertainty of the place in the worst direction, one standard deviation [m]; NaN while it has no idea."""
        if self.pose is None or self._localiser is None:
            return math.nan
        return math.sqrt(_worst(self._localiser.covariance) + self._uncertainty.variance)

    def set_map(self, field: Field) -> None:
        """Localise on the map of `field` from now on: from the pose that it has, if any."""
        known = self.pose
        self._localiser = Localiser(field)
        if known is not None:
            self._localiser.place(known, spread=0.3, turn=0.2)

    def on_fix(self, fix: NavSatFix) -> None:
        """Remember a position by satellite for the first guess."""
        if self._datum and fix.status.status >= 0 and math.isfinite(fix.latitude + fix.longitude):
            self._fixes.append(self._datum.to_local(fix.latitude, fix.longitude))
            if self._localiser and not self._swept:
                self._localiser.correct_place(*self._fixes[-1], FIX_SPREAD)
                self._uncertainty.fix(_variance(fix))

    def on_imu(self, imu: Imu) -> None:
        """Remember the compass for the first guess; a robot that has no laser goes on by it."""
        if not imu.orientation_covariance[0] >= 0:
            return
        self._compass = imu.orientation.yaw
        stamp = imu.header.stamp.seconds
        if (
            self._localiser
            and not self._swept
            and stamp >= self._faced + COMPASS_PERIOD
            and math.isfinite(self._compass)
        ):
            self._faced = stamp
            self._localiser.correct_yaw(self._compass, COMPASS_SPREAD)

    def on_sonar(self, arcs: NDArray[np.float64]) -> None:
        """Without a laser, correct the pose by sonars, a few rings at a time; `arcs` are ends of cones in `base_link`."""
        localiser, odom = self._localiser, self._odom
        if localiser is None or odom is None or self._swept:
            return
        self._uncertainty.on_walls_seen()
        if self._pushed:
            self._rings.clear()  # they would make its place sure again while its wheels say that it leaves it
            return
        self._rings.append(odom.apply(arcs.reshape(-1, 2)).reshape(arcs.shape))
        if len(self._rings) == SONAR_RINGS:
            ends = np.concatenate(self._rings)
            self._rings.clear()
            localiser.correct_by_echoes(odom.inverse().apply(ends.reshape(-1, 2)).reshape(ends.shape))
            self._watch(localiser, _UNHEARD)

    def on_bumper(self, bumper: Bumper) -> None:
        """Remember what is in touch: without a laser it cannot be seen that the wheels turn in vain."""
        self._touch = bumper if bumper.pressed and self._rolls else None

    def place(self, pose: Pose2) -> None:
        """The operator says that the robot is at `pose`; the next sweep corrects the finger's error."""
        if self._localiser:
            self._localiser.place(pose, spread=0.3, turn=0.2)
            self._uncertainty.settle()
            self._search = (pose, PLACED_REACH, PLACED_YAW)

    def put(self, pose: Pose2) -> None:
        """The robot was put back to `pose`, where its wheels begin to count anew."""
        self._odom = None
        self._fixes.clear()
        if self._localiser:
            self._localiser.lift()
        self.place(pose)

    def on_odometry(self, msg: Odometry) -> None:
        """Move on by the wheels and publish the new pose."""
        odom = Pose2.from_msg(msg.pose.pose)
        stamp = msg.header.stamp
        if self._odom is not None:
            self.odometer += odom.distance(self._odom.x, self._odom.y)
        self._odom = odom
        self.speed, self.turn = msg.twist.twist.linear.x, msg.twist.twist.angular.z
        if self._localiser is None:
            return
        self._push(self._localiser, self._localiser.predict(odom, self._against()))
        self._uncertainty.reckon(max(msg.pose.covariance[0], msg.pose.covariance[7]))
        self._suppose(odom, stamp.seconds)
        pose = self._localiser.pose
        if pose is not None:
            ahead = msg.twist.twist.linear
            self.track.add(stamp.seconds, pose, Pose2(ahead.x, ahead.y, self.turn))
            self._publish_pose(stamp, pose, odom, self._localiser)

    def _against(self) -> float:
        """Bearing of what it may push against [rad]; NaN for nothing, and where a laser sees better. One without a bearing lies ahead of its way."""
        if self._touch is None or self._swept:
            return math.nan
        bearing = self._touch.bearing
        return bearing if math.isfinite(bearing) else 0.0 if self.speed >= 0 else math.pi

    def _push(self, localiser: Localiser, into: float) -> None:
        """The wheels went on `into` something [m]; once that is more than a touch the place is not trusted any more."""
        self._pushed = self._pushed + into if into > 0 else 0.0
        if self.pushes:
            localiser.distrust()
            self._watch(localiser, _PUSHES)

    def _suppose(self, odom: Pose2, stamp: float) -> None:
        """Without a laser it is where satellite and compass say, else where it has come to by its own reckoning."""
        if math.isnan(self._begun):
            self._begun = stamp
        localiser = self._localiser
        if (
            localiser is None
            or localiser.pose is not None
            or self._swept
            or stamp - self._begun < FIX_TIMEOUT
        ):
            return
        if len(self._fixes) == FIXES_AVERAGED and not math.isnan(self._compass):
            x, y = (sum(axis) / FIXES_AVERAGED for axis in zip(*self._fixes, strict=True))
            localiser.place(Pose2(x, y, self._compass), spread=1.0, turn=0.1)
        else:
            localiser.place(odom, spread=0.3, turn=0.1)
            self._uncertainty.settle()
        self._say("localisation", _NO_LASER)

    def on_scan(self, points: Points, stamp: float) -> None:
        """Correct the pose by what the laser saw at `stamp` [s], in `base_link`."""
        localiser, self._swept = self._localiser, True
        self._uncertainty.on_walls_seen()
        if localiser is None:
            return
        if self._search is None and localiser.pose is None:
            self._search = self._guess(stamp)
        if self._search is not None and len(points):
            guess, reach, turn = self._search
            self._search = None
            localiser.search(points, guess, reach=reach, turn=turn)
            self.track.forget()  # else the way from the old belief to this one counts as driven since the sweep
        now, then = localiser.pose, self.track.at(stamp)
        lag = then.inverse().then(now) if now is not None and then is not None else Pose2(0.0, 0.0, 0.0)
        localiser.correct(points if abs(lag.x) > 0.5 else lag.inverse().apply(points))
        self._watch(localiser, _UNFITTING)

    def _guess(self, stamp: float) -> tuple[Pose2, float, float] | None:
        if math.isnan(self._since):
            self._since = stamp
        if len(self._fixes) == FIXES_AVERAGED and not math.isnan(self._compass):
            x, y = (sum(axis) / FIXES_AVERAGED for axis in zip(*self._fixes, strict=True))
            return Pose2(x, y, self._compass), GUESS_REACH, GUESS_YAW
        if stamp - self._since > FIX_TIMEOUT:
            self._say("localisation", _NO_IDEA, "warn")
            return Pose2(0.0, 0.0, 0.0), GUESS_REACH, math.pi
        return None

    def _watch(self, localiser: Localiser, unsure: Notice) -> None:
        if localiser.pose is None or localiser.sure is self._was_sure:
            return
        self._was_sure = localiser.sure
        if localiser.sure:
            self._say("localisation", Notice(Code.POSITION_SURE, "Position sure again."), "ok")
        else:
            # who drives it against something has to see that at once
            self._say("localisation", unsure, "alarm" if self.pushes else "warn")

    def _publish_pose(self, stamp: Time, pose: Pose2, odom: Pose2, localiser: Localiser) -> None:
        covariance = zeros36()
        spread = localiser.covariance
        for row, i in enumerate((0, 1, 5)):
            for column, j in enumerate((0, 1, 5)):
                covariance[6 * i + j] = float(spread[row, column])
        covariance[0] += self._uncertainty.variance
        covariance[7] += self._uncertainty.variance
        header = Header(stamp, "map")
        said = PoseWithCovariance(pose.to_msg(), covariance)
        self._publish("/pose", PoseWithCovarianceStamped(header, said))
        edges = [
            _edge(header, "odom", localiser.map_to_odom()),
            _edge(Header(stamp, "odom"), "base_link", odom),
        ]
        self._publish("/tf", TFMessage(edges))


def _worst(covariance: NDArray[np.float64]) -> float:
    """Variance of the place in its worst direction [m2]: the larger eigenvalue of the block of x and y.

    Written out, at a sixth of the cost of LAPACK's answer: it is asked for with every step.
    """
    along, across, both = covariance.item(0, 0), covariance.item(1, 1), covariance.item(1, 0)
    return (along + across) / 2.0 + math.hypot((along - across) / 2.0, both)


def _variance(fix: NavSatFix) -> float:
    """Of a fix, along each axis [m2]; a usual one when it does not say."""
    said = max(fix.position_covariance[0], fix.position_covariance[4])
    return said if fix.position_covariance_type and math.isfinite(said) and said > 0 else FIX_SPREAD**2


def _edge(header: Header, child: str, pose: Pose2) -> TransformStamped:
    placed = pose.to_msg()
    return TransformStamped(header, child, Transform(Vector3(pose.x, pose.y, 0.0), placed.orientation))
