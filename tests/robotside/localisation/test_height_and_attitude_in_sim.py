"""Where each simulated robot says it is, in three dimensions, against where it truly is."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Point, PoseWithCovarianceStamped, Quaternion, Twist, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.tf2_msgs import TFMessage
from sim.robot import TRUTH_TOPIC, make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

WORLDS = {
    "patrol": "parking_lot",
    "scout": "office",
    "commander": "parking_lot",
    "minnow": "lake",
    "aqua": "tank",
    "ardrone": "parking_lot",
}
RISES = {"aqua": Manoeuvre(kind="hover", height=-1.5), "ardrone": Manoeuvre(kind="take_off", height=2.0)}
SIGMAS = 4.0
"""The truth lies within so many of the told deviations, in each of some hundred messages."""


def matrix(place: Point | Vector3, turned: Quaternion) -> NDArray[np.float64]:
    """A transform as homogeneous coordinates have it."""
    x, y, z, w = turned.x, turned.y, turned.z, turned.w
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = place.x, place.y, place.z
    return made


class Told(Run):
    """A robot with a list of what it says of its place and what is true then."""

    def __init__(self, name: str, state: Path) -> None:
        super().__init__(make(name, WORLDS[name], seed=2, camera=False), state)
        self.robot.want(TRUTH_TOPIC, True)
        self.poses: dict[float, PoseWithCovarianceStamped] = {}
        self.trees: dict[float, TFMessage] = {}
        self.truths: dict[float, Odometry] = {}

    def listen(self) -> None:
        for topic in ("/pose", "/tf", "/sim/ground_truth"):
            self.station.bus.subscribe(topic, self._hear, replay=False)

    def _hear(self, topic: str, msg: Msg) -> None:
        if isinstance(msg, PoseWithCovarianceStamped):
            self.poses[msg.header.stamp.seconds] = msg
        elif isinstance(msg, TFMessage):
            self.trees[msg.transforms[0].header.stamp.seconds] = msg
        elif isinstance(msg, Odometry):
            self.truths[msg.header.stamp.seconds] = msg


@pytest.fixture(params=WORLDS)
def told(request: pytest.FixtureRequest, tmp_path: Path) -> Told:
    name: str = request.param
    run = Told(name, tmp_path)
    if name in RISES:
        run.robot.manoeuvre(RISES[name])
        run.wait(9.0)
    run.listen()
    for _ in range(100):
        stick = Twist(Vector3(0.4, 0.0, 0.0), Vector3(0.0, 0.0, 0.25))
        run.station.on_message(run.anna, "/cmd_vel", stick, None)
        run.wait(0.05)
    run.station.close()
    assert len(run.poses) > 80
    return run


def test_the_pose_is_true_within_what_it_says_in_height_roll_and_pitch(told: Told) -> None:
    checked = 0
    for stamp, msg in told.poses.items():
        truth = told.truths.get(stamp)
        if truth is None:
            continue
        checked += 1
        pose, real, covariance = msg.pose.pose, truth.pose.pose, msg.pose.covariance
        errors = (
            pose.position.z - real.position.z,
            pose.orientation.roll - real.orientation.roll,
            pose.orientation.pitch - real.orientation.pitch,
        )
        for error, variance, limit in zip(errors, covariance[14:29:7], (0.3, 0.1, 0.1), strict=True):
            assert variance > 0, f"it says exact: {errors}"
            assert abs(error) < SIGMAS * math.sqrt(variance), (errors, list(covariance[14:29:7]))
            assert abs(error) < limit
    assert checked > 20


def test_the_edges_compose_to_the_pose_and_the_edge_of_odometry_does_not_jump(told: Told) -> None:
    before = None
    for stamp, msg in told.poses.items():
        to_odom, to_base = told.trees[stamp].transforms
        assert (to_odom.header.frame_id, to_odom.child_frame_id) == ("map", "odom")
        assert (to_base.header.frame_id, to_base.child_frame_id) == ("odom", "base_link")
        edges = [matrix(edge.transform.translation, edge.transform.rotation) for edge in (to_odom, to_base)]
        pose = matrix(msg.pose.pose.position, msg.pose.pose.orientation)
        assert edges[0] @ edges[1] == pytest.approx(pose, abs=1e-9)
        assert edges[0][2, :2] == pytest.approx((0.0, 0.0), abs=1e-9), "the correction keeps the vertical"
        if before is not None:
            assert np.abs(edges[1][:3, 3] - before[:3, 3]).max() < 0.2
        before = edges[1]
