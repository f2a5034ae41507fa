"""Nothing counts on more braking than the ground gives, and no command takes a bend faster than it holds."""

from __future__ import annotations

from dataclasses import replace

import msgspec
import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.config import BadConfig, LimitSettings, parse
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import KINDS
from robotside.limits.grip_limit import BEND_SHARE, BRAKING_SHARE, braked_by, held_in_bend
from robotside.limits.limits import LimitKeeper
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import REACTION_TIME, PlanarVelocity, reach
from sim.world.surfaces import GRIP

TRUCK = RobotInfo(
    kind="ackermann",
    name="Truck",
    max_speed=5.0,
    max_yaw_rate=1.4,
    radius=2.6,
    min_radius=3.5,
    max_steering=0.52,
    manoeuvres=["twist", "steer", "rest"],
)
WHEELS = RobotInfo(kind="wheels", name="Patrol", max_speed=0.7, max_yaw_rate=1.9, radius=0.2)
HERE = MeasuredState(Pose2(0.0, 0.0, 0.0))
GRAVITY = 9.81
SQUARE = ((-50.0, -50.0), (50.0, -50.0), (50.0, 50.0), (-50.0, 50.0))


@pytest.mark.parametrize("kind", [name for name, kind in KINDS.items() if kind.on_the_ground])
def test_what_a_kind_counts_on_holds_on_the_most_slippery_ground(kind):
    """Whose grip nobody has told."""
    assert KINDS[kind].handling.braking < 0.8 * min(GRIP.values()) * GRAVITY


@pytest.mark.parametrize("grip", [0.05, 0.1, 0.2, 0.65])
def test_the_way_to_rest_is_never_reckoned_with_more_than_friction_gives(grip):
    for kind in KINDS.values():
        handling = braked_by(replace(kind.handling, braking=6.0), grip)
        assert handling.braking <= BRAKING_SHARE * grip * GRAVITY
        fast = PlanarVelocity(4.0, 0.0, 0.0)
        assert reach(fast, fast, handling) >= 4.0 * REACTION_TIME + 4.0**2 / (2 * grip * GRAVITY)


def test_a_fence_is_kept_from_farther_away_where_it_is_slippery():
    """Even when the file promises more braking than its own grip gives."""
    near = MeasuredState(Pose2(40.0, 0.0, 0.0))
    speeds = {}
    for grip in (None, 0.65, 0.1):
        keeper = LimitKeeper(LimitSettings(keep_in=(SQUARE,), braking=3.0, grip=grip), TRUCK)
        speeds[grip] = keeper.clamp(Twist.planar(5.0, 0.0), near).twist.linear.x
    assert speeds[None] == speeds[0.65] > 1.5 * speeds[0.1] > 0.0
    room = 50.0 - 40.0 - 2.6
    assert speeds[0.1] ** 2 / (2 * 0.1 * GRAVITY) < room


@pytest.mark.parametrize("grip", [0.2, 0.35])
@pytest.mark.parametrize(("speed", "turn"), [(4.0, 1.1), (5.0, 0.8), (-4.0, 1.1)])
def test_a_truck_goes_into_a_bend_no_faster_than_its_share_of_the_grip_and_stays_on_its_arc(
    grip, speed, turn
):
    done = LimitKeeper(LimitSettings(grip=grip), TRUCK).clamp(Twist.planar(speed, turn), HERE).twist
    assert abs(done.linear.x * done.angular.z) == pytest.approx(BEND_SHARE * grip * GRAVITY)
    assert done.angular.z / done.linear.x == pytest.approx(turn / speed)


def test_one_that_turns_where_it_stands_turns_on_as_told_and_goes_slower():
    done = LimitKeeper(LimitSettings(grip=0.1), WHEELS).clamp(Twist.planar(0.7, 1.9), HERE).twist
    assert done.angular.z == 1.9
    assert done.linear.x == pytest.approx(BEND_SHARE * 0.1 * GRAVITY / 1.9)


def test_an_order_by_steering_angle_is_slowed_too():
    keeper = LimitKeeper(LimitSettings(grip=0.2), TRUCK)
    done = keeper.keep(Manoeuvre(kind="steer", speed=4.0, steering=0.5), HERE).order
    speed = done.speed if isinstance(done, Manoeuvre) else done.linear.x
    assert 0.5 < speed < 2.5


def test_without_a_grip_and_on_the_straight_a_command_is_left_alone():
    quick = Twist.planar(5.0, 1.0)
    assert held_in_bend(quick, KINDS["ackermann"].handling, None) == quick
    straight = Twist.planar(5.0, 0.1)
    assert held_in_bend(straight, KINDS["ackermann"].handling, 0.2) == straight
    assert LimitKeeper(LimitSettings(), TRUCK).clamp(quick, HERE).twist == quick


def test_a_boat_has_no_grip():
    boat = msgspec.structs.replace(TRUCK, kind="boat")
    quick = Twist.planar(5.0, 1.0)
    assert LimitKeeper(LimitSettings(grip=0.1), boat).clamp(quick, HERE).twist == quick


@pytest.mark.parametrize("value", ["0", "-0.5", "3", "nan"])
def test_a_grip_that_no_ground_has_is_refused(value):
    with pytest.raises(BadConfig, match="grip"):
        parse(f"[limits]\ngrip = {value}\n", "robot.toml")
