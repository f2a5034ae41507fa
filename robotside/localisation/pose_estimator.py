"""The pose estimator: from the first guess on it publishes where the robot is, and how sure it is of that."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, zeros36
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Bumper, PlaceCandidate, RobotInfo
from bridge.msgs.sensor_msgs import Imu, NavSatFix
from bridge.msgs.std_msgs import Header, Time
from bridge.msgs.tf2_msgs import TFMessage
from robotside.core.bus import Publish
from robotside.core.notice import Notice
from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import InLoopWorker, Worker
from robotside.kinds.registry import kind_of
from robotside.localisation.beacons import variance_of
from robotside.localisation.beginning import PLACED_REACH, Beginning
from robotside.localisation.candidates import Candidates
from robotside.localisation.explanation import Look
from robotside.localisation.field import Field
from robotside.localisation.height_and_attitude import HeightAndAttitude
from robotside.localisation.hypotheses import Hypothesis
from robotside.localisation.odometry_track import OdometryTrack
from robotside.localisation.push_watch import PushWatch
from robotside.localisation.scan_matching import Localiser
from robotside.localisation.sonar_rings import SonarRings
from robotside.localisation.whereabouts import Whereabouts, said_to_be
from robotside.records.events import Say

__all__ = ["PoseEstimator"]

CERTAIN = 8.0
"""What all other places have against the one that an operator chose, or where the robot was put (logarithm)."""

MAX_SPREAD = 0.6
"""A place that is known worse than this is not believed, where there is a laser; and one that is not believed is told as known no better [m]."""

COMPASS_PERIOD, COMPASS_SPREAD = 0.5, 0.2
"""So often such a robot believes its compass [s], and how far each time [rad]: its error changes slowly."""


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

_UNSEEN = Notice(
    Code.POSITION_UNSEEN,
    "Position unsure: the laser meets too little to tell it. Drive to where it meets more, or place the robot on the map.",
)

_ELSEWHERE = Notice(
    Code.POSITION_UNSURE,
    "Position unsure: another place on the map fits as well. Drive on slowly, or say where the robot is.",
)

_CONTRADICTED = Notice(
    Code.POSITION_UNSURE,
    "Position unsure: the satellites say another place. Place the robot on the map.",
)


class PoseEstimator:
    """Takes odometry, sweeps, fixes and compass; gives the pose in `map`, and says when it is not sure of it."""

    def __init__(self, info: RobotInfo, say: Say, publish: Publish, worker: Worker | None = None) -> None:
        """`worker` searches the whole map; without one it is done while sweeps are taken in, a bit in each."""
        self._say, self._publish = say, publish
        self._push_watch = PushWatch(rolls=kind_of(info.kind).on_the_ground)
        self._localiser: Localiser | None = None
        self._whereabouts = Whereabouts(worker or InLoopWorker(), self._take)
        self._candidates = Candidates(publish)
        self._laser_x = info.laser_x
        self._odom: Pose2 | None = None
        self._was_sure, self._swept = True, False
        self._stamp, self._faced = 0.0, -math.inf
        self._rings = SonarRings()
        self.vertical = HeightAndAttitude(info)
        """Height, roll and pitch."""
        self.on_found: Callable[[Pose2], None] = lambda _: None
        """Called when it has found by itself that it is elsewhere, with where."""
        self.track = OdometryTrack()
        """Poses in `map` of the last seconds."""
        self._beginning = Beginning(info, say, self.track, self._whereabouts)
        self._beacons = self._beginning.beacons
        self._uncertainty = self._beginning.uncertainty
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
        """The place may be believed: what is measured agrees with the map there, and with a laser at no other place as well."""
        if self._localiser is None or not self._localiser.sure:
            return False
        return not self._swept or (self._whereabouts.proven and self._localiser.spread < MAX_SPREAD)

    @property
    def by_word(self) -> bool:
        """It is where an operator has said, and nothing that its laser has seen since tells that from all other places."""
        return self._swept and self._whereabouts.by_word

    @property
    def candidates(self) -> tuple[PlaceCandidate, ...]:
        """Where the robot may be, the likeliest first, while it asks which of them it is; empty otherwise."""
        return self._candidates.all

    @property
    def pushes(self) -> bool:
        """The wheels turn against something and the robot does not get on."""
        return self._push_watch.pushes

    @property
    def fit(self) -> float:
        """Part of the last sweep that lies on the map's surfaces, 0 to 1; NaN before the first."""
        return self._localiser.fit if self._localiser else math.nan

    @property
    def spread(self) -> float:
        """The uncertainty of the place in the worst direction, one standard deviation [m]; NaN while it has no idea."""
        if self.pose is None or self._localiser is None:
            return math.nan
        return math.hypot(self._localiser.spread, math.sqrt(self._uncertainty.variance))

    @property
    def covariance(self) -> NDArray[np.float64]:
        """Of x, y [m] and yaw [rad] in `map`, 3 x 3, as told on `/pose`, while not sure of all places it may be at; NaN while it has no idea."""
        if self._localiser is None or self._localiser.pose is None:
            return np.full((3, 3), math.nan)
        scatter = None if self.sure else self._candidates.scatter(self._localiser.pose)
        return _told(self._localiser.covariance, self._uncertainty.variance, scatter)

    def set_map(self, field: Field) -> None:
        """Localise on the map of `field` from now on: from the pose that it has, if any."""
        known = self.pose
        self._localiser = Localiser(field)
        if known is not None:
            self._localiser.place(known, spread=0.3, turn=0.2)
            self._whereabouts.placed(said_to_be(known, PLACED_REACH))

    def on_fix(self, fix: NavSatFix) -> None:
        """Remember a position by satellite for the first guess."""
        placed = self._beacons.on_fix(fix)
        if placed and self._localiser and not self._by_laser:
            self._localiser.correct_place(*placed, math.sqrt(variance_of(fix)))
            self._uncertainty.fix(variance_of(fix))

    def on_imu(self, imu: Imu) -> None:
        """Remember the compass for the first guess; a robot that has no laser goes on by it."""
        self.vertical.on_imu(imu)
        if not imu.orientation_covariance[0] >= 0:
            return
        compass, stamp = imu.orientation.yaw, imu.header.stamp.seconds
        self._beacons.on_compass(compass, stamp)
        if (
            self._localiser
            and not self._by_laser
            and stamp >= self._faced + COMPASS_PERIOD
            and math.isfinite(compass)
        ):
            self._faced = stamp
            self._localiser.correct_yaw(compass, COMPASS_SPREAD)

    def on_sonar(self, arcs: NDArray[np.float64]) -> None:
        """Without a laser, correct the pose by sonars, a few rings at a time; `arcs` are ends of cones in `base_link`."""
        localiser, odom = self._localiser, self._odom
        if localiser is None or odom is None or self._swept:
            return
        self._uncertainty.on_walls_seen()
        if self._push_watch.began:
            self._rings.clear()  # they would make its place sure again while its wheels say that it leaves it
            return
        ends = self._rings.add(arcs, odom)
        if ends is not None:
            localiser.correct_by_echoes(ends)
            self._watch(localiser, _UNHEARD)

    def on_bumper(self, bumper: Bumper) -> None:
        """Remember what is in touch: without a laser it cannot be seen that the wheels turn in vain."""
        self._push_watch.on_bumper(bumper)

    def place(self, pose: Pose2, *, certain: bool = False) -> None:
        """The operator says that the robot is at `pose`; the next sweep corrects the finger's error.

        `certain` when no other place comes into question, as when one of the candidates was chosen.
        """
        if self._localiser:
            self._beginning.place(pose, self._localiser)
            against = CERTAIN if certain else 0.0
            self._whereabouts.placed(said_to_be(pose, PLACED_REACH, otherwise=against), by_word=certain)
            self._candidates.update(self._whereabouts.hypotheses, self._stamp)

    def put(self, pose: Pose2) -> None:
        """The robot was put back to `pose`, where its wheels begin to count anew."""
        self._odom = None
        self._beacons.forget()
        if self._localiser:
            self._localiser.lift()
        self.place(pose, certain=True)

    def on_odometry(self, msg: Odometry) -> None:
        """Move on by the wheels and publish the new pose."""
        self.vertical.on_odometry(msg)
        odom = Pose2.from_msg(msg.pose.pose)
        stamp = msg.header.stamp
        if self._odom is not None:
            self.odometer += odom.distance(self._odom.x, self._odom.y)
        self._odom = odom
        self.speed, self.turn = msg.twist.twist.linear.x, msg.twist.twist.angular.z
        if self._localiser is None:
            return
        # where a laser sees it nothing needs to be supposed of what is in touch
        against = math.nan if self._swept else self._push_watch.bearing(self.speed)
        self._push(self._localiser, self._localiser.predict(odom, against))
        self._uncertainty.reckon(max(msg.pose.covariance[0], msg.pose.covariance[7]))
        self._suppose(self._localiser, odom, stamp.seconds)
        pose = self._localiser.pose
        if pose is not None:
            ahead = msg.twist.twist.linear
            self.track.add(stamp.seconds, pose, Pose2(ahead.x, ahead.y, self.turn))
            self._publish_pose(stamp, pose, odom, self._localiser)

    def _push(self, localiser: Localiser, into: float) -> None:
        """The wheels went on `into` something [m]; once that is more than a touch the place is not trusted any more."""
        self._push_watch.on_step(into)
        if self.pushes:
            localiser.distrust()
            self._watch(localiser, _PUSHES)

    def _suppose(self, localiser: Localiser, odom: Pose2, stamp: float) -> None:
        """Without a laser it is where satellite and compass say, else where it has come to by its own reckoning."""
        waits = localiser.pose is not None or self._swept
        guess = self._beginning.first_guess.to_reckon(odom, stamp, waits=waits)
        if guess is not None:
            pose, spread, turn, by_satellites = guess
            localiser.place(pose, spread=spread, turn=turn)
            if not by_satellites:
                self._uncertainty.settle()

    def on_scan(self, points: Points, stamp: float) -> None:
        """Correct the pose by what the laser saw at `stamp` [s], in `base_link`."""
        localiser, self._swept, self._stamp = self._localiser, True, stamp
        if localiser is None:
            return
        look = Look.of(points, self._laser_x)
        self._beginning.on_sweep(localiser, points, look, stamp)
        now, then = localiser.pose, self.track.at(stamp)
        lag = then.inverse().then(now) if now is not None and then is not None else Pose2(0.0, 0.0, 0.0)
        if abs(lag.x) <= 0.5:
            points = lag.inverse().apply(points)
        if self._by_laser:
            localiser.correct(points)
        if self._odom is not None:
            self._judge(localiser, self._odom, points, Look.of(points, self._laser_x))

    @property
    def _by_laser(self) -> bool:
        """Its sweeps say where it is; not before one has told enough to begin with."""
        return self._swept and not self._beginning.waits

    def _judge(self, localiser: Localiser, odom: Pose2, points: Points, look: Look) -> None:
        """See whether the place may be believed, and say so when that has changed."""
        where, stamp, reason = self._whereabouts, self._stamp, _ELSEWHERE
        pose = localiser.pose
        if pose is not None and self._beacons.contradict(pose, localiser.spread**2, stamp):
            where.doubt()  # once: the search that follows weighs them
            reason = _CONTRADICTED
        if not localiser.sure:
            where.doubt()
            reason = _UNFITTING
        if not look.tells and reason is not _CONTRADICTED:
            reason = _UNSEEN
        where.on_sweep(
            localiser, points, look, odom, stamp, lambda pose: self._beacons.log_likelihood(pose, stamp)
        )
        self._candidates.update(where.hypotheses, stamp)
        if where.judged or self._beginning.waits:
            self._watch(localiser, reason)

    def _take(self, found: Hypothesis) -> None:
        """Another place than the believed one is the right one."""
        if self._localiser is None:
            return
        self._localiser.take_over(found.localiser)
        self._beacons.elsewhere()
        self.track.forget()
        pose = found.pose
        text = f"The robot has found by itself that it is at ({pose.x:.1f}, {pose.y:.1f})."
        said = Notice(Code.POSITION_FOUND, text, x=pose.x, y=pose.y)
        self._say("localisation", said, "warn", at=(pose.x, pose.y))
        self.on_found(pose)

    def _watch(self, localiser: Localiser, unsure: Notice) -> None:
        if localiser.pose is None or self.sure is self._was_sure:
            return
        self._was_sure = self.sure
        if self.sure:
            self._say("localisation", Notice(Code.POSITION_SURE, "Position sure again."), "ok")
        else:
            # who drives it against something has to see that at once
            self._say("localisation", unsure, "alarm" if self.pushes else "warn")

    def _publish_pose(self, stamp: Time, pose: Pose2, odom: Pose2, localiser: Localiser) -> None:
        said = self.vertical.posed(pose, _in_space(self.covariance))
        self._publish("/pose", PoseWithCovarianceStamped(Header(stamp, "map"), said))
        self._publish("/tf", TFMessage(self.vertical.edges(stamp, localiser.map_to_odom(), odom)))


def _told(
    filtered: NDArray[np.float64], shared: float, scatter: NDArray[np.float64] | None
) -> NDArray[np.float64]:
    """The covariance of a filter and of what it cannot see [m2]; of a place that is not sure with the `scatter` of all that it may be."""
    known = filtered + np.diag([shared, shared, 0.0])
    if scatter is None:
        return known
    lacks = max(0.0, MAX_SPREAD**2 - max(known[0, 0], known[1, 1]))
    widened: NDArray[np.float64] = known + scatter + np.diag([lacks, lacks, 0.0])
    return widened


def _in_space(plane: NDArray[np.float64]) -> list[float]:
    """The covariance of a pose in space, 6 x 6 row by row, whose x, y and yaw have that of the `plane`; 0 elsewhere."""
    covariance = zeros36()
    for row, i in enumerate((0, 1, 5)):
        for column, j in enumerate((0, 1, 5)):
            covariance[6 * i + j] = float(plane[row, column])
    return covariance
