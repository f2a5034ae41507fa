"""What is mounted on a vehicle by name: it measures, shines, reads and reaches; what is not mounted does not exist."""

from __future__ import annotations

import itertools
import math

import msgspec
import numpy as np
import pytest

from bridge.core.topics import topic
from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point, Twist
from bridge.msgs.pilothouse_msgs import ArmOrder, LightState, TagRead
from sim.payloads import PAYLOADS, load, mount
from sim.payloads.kinematics import Arm
from sim.robot import ROBOTS, SimRobot, make
from sim.simulation.simulation import Simulation
from sim.vehicles.minnow import MINNOW
from sim.vehicles.patrol import PATROL
from sim.vehicles.scout import SCOUT
from tests.sim.rooms import plain, room, until

FIGURES = load()
ARM = Arm(FIGURES.arm.foot, FIGURES.arm.upper, FIGURES.arm.fore, FIGURES.arm.hand, FIGURES.arm.limits)


JOINTS = ["base_yaw", "shoulder", "elbow", "wrist_pitch", "wrist_roll"]


def moved(**joints):
    """A value for each joint, 0 for those that are not named."""
    return Float64Array([joints.get(name, 0.0) for name in JOINTS])


def carrying(*payloads, model=SCOUT, world=None):
    robot = SimRobot(Simulation(world or room(8.0, 6.0), model, noise=False), camera=False, payloads=payloads)
    robot.read(0.0)
    return robot


def said(messages, name):
    return [message for told, message in messages if told == name]


def test_every_payload_can_be_mounted_on_every_robot_that_has_none_and_says_what_its_topic_promises():
    for name, model in ROBOTS.items():
        simulation = Simulation(load_world(model), model)
        vehicle = simulation.vehicle
        free = [payload for payload in PAYLOADS if payload not in vehicle.suite]
        free = [payload for payload in free if not (payload == "camera" and name == "commander")]
        on_wheels = model.parameters.info.kind in ("wheels", "ackermann")
        free = [payload for payload in free if on_wheels or payload != "line_sensor"]
        robot = SimRobot(simulation, camera=False, payloads=free)
        assert robot.info.payloads == free
        for told, message in (*robot.read(0.0), *robot.read(0.3)):
            assert type(message) is topic(told).type
        robot.close()


def load_world(model):
    return plain("[water]\ndepth = 5.0\n") if model.element == "water" else room(8.0, 6.0)


def test_what_is_not_mounted_says_nothing():
    bare = carrying()
    names = {name for name, _ in until(bare, 1.0)}
    bare.close()
    assert not names & {"/scan", "/arm", "/lights", "/tag"}
    assert bare.info.payloads == []


def test_a_mounted_laser_measures_the_room():
    robot = carrying("laser")
    scan = said(until(robot, 0.2), "/scan")[0]
    robot.close()
    assert scan.ranges[180] == pytest.approx(4.0, abs=2e-3)
    assert scan.ranges[270] == pytest.approx(3.0, abs=2e-3)


def test_a_boat_can_carry_sonars():
    robot = carrying("sonar", model=MINNOW, world=room(8.0, 6.0, extra="[water]\ndepth = 3.0\n"))
    ring = said(until(robot, 0.2), "/sonar")[0]
    robot.close()
    assert ring.ranges[0] == pytest.approx(4.0 - MINNOW.parameters.radius, abs=0.05)


def test_a_payload_that_is_there_already_or_that_nobody_knows_is_refused_in_one_sentence():
    with pytest.raises(ValueError, match="Patrol-1 has a laser already"):
        make("patrol", "parking_lot", camera=False, payloads=["laser"])
    with pytest.raises(ValueError, match="Scout-1 has an arm already"):
        make("scout", "parking_lot", camera=False, payloads=["arm", "arm"])
    with pytest.raises(
        ValueError,
        match="There is no payload 'catapult'; there is laser, sonar, ultrasound, line_sensor, camera",
    ):
        make("scout", "parking_lot", camera=False, payloads=["catapult"])
    with pytest.raises(ValueError, match="Commander-1 has a camera 'rear' already"):
        make("commander", "parking_lot", camera=False, payloads=["camera"])


def test_lights_are_as_bright_as_they_are_told_and_take_their_power():
    robot = carrying("lights")
    until(robot, 0.5)
    battery = robot.simulation.vehicle.battery
    dark = battery.power
    robot.command("lights", LightState(brightness=0.5))
    told = said(until(robot, 1.5), "/lights")[-1]
    assert told.brightness == 0.5
    assert battery.power - dark == pytest.approx(FIGURES.lights.power / 2, abs=0.2)
    for wrong in (1.5, -0.1, math.nan):
        with pytest.raises(ValueError, match="must be a number from 0 to 1"):
            robot.command("lights", LightState(brightness=wrong))
    assert said(until(robot, 1.1), "/lights")[-1].brightness == 0.5
    robot.close()


def test_an_order_for_what_is_not_mounted_is_refused():
    robot = carrying("laser")
    with pytest.raises(ValueError, match="Scout-1 has no arm"):
        robot.command("arm", ArmOrder(pose="home"))
    with pytest.raises(ValueError, match="takes no orders"):
        robot.command("laser", LightState())
    robot.close()


@pytest.mark.parametrize(
    ("payload", "order", "said"),
    [
        ("arm", LightState(brightness=0.5), "The arm takes an ArmOrder"),
        ("lights", ArmOrder(pose="home"), "The brightness of the lights must be a number"),
    ],
)
def test_an_order_for_another_payload_is_refused(payload, order, said):
    robot = carrying(payload)
    with pytest.raises(ValueError, match=said):
        robot.command(payload, order)
    robot.close()


def test_mounted_rangers_and_a_line_sensor_measure_what_is_round_and_under_it():
    line = "[[lines]]\nfrom = [-1.0, 0.0]\nto = [3.0, 0.0]\nwidth = 0.3\n"
    robot = carrying("ultrasound", "line_sensor", world=room(6.0, 5.0, extra=line))
    messages = until(robot, 0.2)
    robot.close()
    assert said(messages, "/range/front")[0].range == pytest.approx(3.0 - 0.205, abs=0.02)
    assert said(messages, "/range/left")[0].range == pytest.approx(2.5 - 0.205, abs=0.02)
    assert all(value > 0.8 for value in said(messages, "/line_sensor")[0].values)


def test_what_does_not_drive_takes_no_line_sensor():
    with pytest.raises(ValueError, match="Ardrone-1 does not drive on the ground"):
        make("ardrone", "parking_lot", camera=False, payloads=["line_sensor"])


def test_a_reader_tells_of_a_tag_once_when_it_comes_near_and_once_when_it_goes():
    world = room(12.0, 6.0, extra='[[tags]]\ntag = "card-7"\nx = 2.0\ny = 0.2\nz = 0.35\n')
    robot = carrying("tag_reader", world=world)
    robot.drive(Twist.planar(0.8, 0.0))
    read = said(until(robot, 6.0), "/tag")
    robot.close()
    assert [type(message) for message in read] == [TagRead, TagRead]
    assert [message.tag for message in read] == ["card-7", ""]


def test_a_second_camera_is_told_with_the_others():
    robot = SimRobot(Simulation(room(), PATROL), camera=True, payloads=["camera"])
    robot.close()
    assert robot.info.cameras == ["front", "rear"]


REACHED = [(0.25, 0.05, 0.10), (0.20, -0.12, 0.05), (0.15, 0.0, 0.25), (0.30, 0.10, 0.15)]


@pytest.mark.parametrize("point", REACHED)
@pytest.mark.parametrize("pitch", [0.0, 0.5, math.nan])
def test_the_inverse_puts_the_tip_where_it_is_told(point, pitch):
    angles = ARM.inverse(point, pitch)
    assert angles is not None
    reach = ARM.forward(angles)
    assert reach.tip == pytest.approx(point, abs=1e-12)
    if not math.isnan(pitch):
        assert reach.pitch == pytest.approx(pitch, abs=1e-12)


def test_of_random_angles_nearly_all_hands_are_found_again():
    """Those that reach back over the foot with a limit in the way are not."""
    draws, found = np.random.default_rng(3), 0
    for _ in range(400):
        angles = tuple(float(draws.uniform(low, high)) for low, high in FIGURES.arm.limits)
        reach = ARM.forward(angles)
        again = ARM.inverse(reach.tip, reach.pitch)
        if again is not None:
            found += 1
            assert ARM.allowed((*again, 0.0))
            assert ARM.forward(again).tip == pytest.approx(reach.tip, abs=1e-9)
    assert found >= 390


def test_what_is_out_of_reach_has_no_angles():
    assert ARM.inverse((0.6, 0.0, 0.1)) is None
    assert ARM.inverse((0.39, 0.0, 0.0765), 1.2) is None


def test_stretched_it_reaches_as_far_as_its_maker_says():
    """380 mm from the first joint."""
    length, rise = ARM.elbows
    straight = ARM.points((0.0, rise, -rise, 0.0))[3]
    assert straight[0] - FIGURES.arm.foot[0] == pytest.approx(length + 0.124 + 0.126)
    assert straight[0] - FIGURES.arm.foot[0] == pytest.approx(0.380, abs=2e-3)


def test_the_arm_goes_to_its_named_poses_no_faster_than_its_joints():
    robot = carrying("arm")
    before = said(until(robot, 0.1), "/arm")[-1]
    assert before.pose == before.poses[0] == "rest"
    for pose in before.poses[1:]:
        robot.command("arm", ArmOrder(pose=pose))
        way = said(until(robot, 2.0), "/arm")
        steps = [
            abs(b - a) * 20.0
            for one, other in itertools.pairwise(way)
            for a, b in zip(one.angles, other.angles, strict=True)
        ]
        assert max(steps) <= FIGURES.arm.speed + 1e-6
        assert way[-1].pose == pose
        assert list(way[-1].angles) == pytest.approx(FIGURES.arm.poses[pose])
    robot.close()


def test_held_on_its_way_the_arm_stays_there_gripper_and_all():
    robot = carrying("arm", "lights")
    robot.command("arm", ArmOrder(pose="stretch", gripper=0.0))
    until(robot, 0.4)
    robot.hold_payloads()
    before, after = (said(until(robot, 0.5), "/arm")[-1] for _ in range(2))
    robot.close()
    assert list(after.angles) == list(before.angles) == list(before.wanted)
    assert before.gripper == after.gripper > 0.0
    assert after.pose == ""


def test_the_arm_takes_its_tip_to_a_point_of_the_robots_frame():
    robot = carrying("arm")
    robot.command("arm", ArmOrder(point=Point(0.28, 0.10, 0.45), pitch=0.2, gripper=0.02))
    told = said(until(robot, 2.5), "/arm")[-1]
    robot.close()
    assert (told.tip.x, told.tip.y, told.tip.z) == pytest.approx((0.28, 0.10, 0.45), abs=1e-9)
    assert told.pitch == pytest.approx(0.2, abs=1e-9)
    assert told.gripper == pytest.approx(0.02)
    assert not told.touching


@pytest.mark.parametrize(
    ("order", "why"),
    [
        (ArmOrder(pose="dance"), "knows no pose 'dance'; it knows rest, home, stretch, look_down"),
        (ArmOrder(point=Point(2.0, 0.0, 0.4)), r"does not reach \(2.00, 0.00, 0.40\)"),
        (ArmOrder(point=Point(0.2, 0.0, 0.2), pitch=math.inf), r"does not reach \(0.20, 0.00, 0.20\)"),
        (ArmOrder(angles=moved(elbow=9.0)), "joint elbow goes from -0.94 to 1.38 rad, not to 9 rad"),
        (
            ArmOrder(angles=moved(wrist_roll=math.nan)),
            "wrist_roll goes from -2.83 to 2.83 rad, not to nan rad",
        ),
        (ArmOrder(angles=Float64Array((0.0, 0.0))), f"has 5 joints, {', '.join(JOINTS)}; 2 are given"),
        (ArmOrder(increments=moved(elbow=0.2)), "-0.94 to 1.38 rad, not to 1.45 rad, which is 1.25 and 0.2"),
        (ArmOrder(increments=moved(base_yaw=-3.0)), "base_yaw goes from -2.83 to 2.83 rad, not to -3 rad"),
        (
            ArmOrder(increments=moved(shoulder=math.nan)),
            "joint shoulder goes from -1.79 to 1.57 rad, not to nan",
        ),
        (
            ArmOrder(increments=moved(shoulder=math.inf)),
            "joint shoulder goes from -1.79 to 1.57 rad, not to inf",
        ),
        (ArmOrder(increments=Float64Array((0.1,) * 6)), "has 5 joints, .*; 6 are given"),
        (ArmOrder(pose="home", gripper=0.5), "gripper opens from 0 to 0.075 m, not 0.5 m"),
        (
            ArmOrder(pose="home", increments=moved(elbow=0.1)),
            "one goal: a pose, a point, angles, or increments",
        ),
        (
            ArmOrder(point=Point(0.2, 0.0, 0.2), angles=moved()),
            "one goal: a pose, a point, angles, or increments",
        ),
    ],
)
def test_what_the_arm_cannot_do_is_refused_in_one_sentence_and_changes_nothing(order, why):
    robot = carrying("arm")
    wanted = list(said(until(robot, 0.1), "/arm")[-1].wanted)
    with pytest.raises(ValueError, match=why):
        robot.command("arm", order)
    assert list(said(until(robot, 0.1), "/arm")[-1].wanted) == wanted
    robot.close()


def test_increments_are_added_to_where_each_joint_goes_so_that_two_presses_are_twice_as_far():
    robot = carrying("arm")
    start = said(until(robot, 0.1), "/arm")[-1]
    assert start.joints == JOINTS
    for _ in range(2):  # the second while the first is under way
        robot.command("arm", ArmOrder(increments=moved(base_yaw=0.4, shoulder=0.1, wrist_roll=-0.2)))
        until(robot, 0.1)
    there = said(until(robot, 1.0), "/arm")[-1]
    assert list(there.angles) == pytest.approx([0.8, -1.4, 1.25, 0.35, -0.4])
    robot.close()


def test_held_on_its_way_the_arm_counts_increments_from_where_it_stays():
    robot = carrying("arm")
    robot.command("arm", ArmOrder(angles=Float64Array((2.0, *FIGURES.arm.poses["rest"][1:]))))
    until(robot, 0.3)
    robot.hold_payloads()
    held = said(until(robot, 0.1), "/arm")[-1].angles[0]
    robot.command("arm", ArmOrder(increments=moved(base_yaw=0.1)))
    assert said(until(robot, 0.5), "/arm")[-1].angles[0] == pytest.approx(held + 0.1)
    robot.close()


def test_the_hand_turns_about_its_own_length_and_stays_turned_when_the_tip_goes_elsewhere():
    robot = carrying("arm")
    robot.command("arm", ArmOrder(pose="home"))
    before = said(until(robot, 2.0), "/arm")[-1]
    fingers = [shape.position for shape in robot.payloads["arm"].shapes()[-2:]]
    robot.command("arm", ArmOrder(increments=moved(wrist_roll=math.pi / 2)))
    after = said(until(robot, 2.0), "/arm")[-1]
    assert (after.tip, after.pitch) == (before.tip, before.pitch)
    assert after.pose == ""
    apart = [abs(a - b) for a, b in zip(*fingers, strict=True)]
    turned = [
        abs(a - b) for a, b in zip(*(s.position for s in robot.payloads["arm"].shapes()[-2:]), strict=True)
    ]
    assert apart == pytest.approx([0.0, FIGURES.arm.gripper[1] + 0.012, 0.0], abs=1e-9)
    assert turned[1] == pytest.approx(0.0, abs=1e-9)
    assert math.hypot(*turned) == pytest.approx(apart[1])
    robot.command("arm", ArmOrder(point=Point(0.28, 0.10, 0.45)))
    there = said(until(robot, 2.5), "/arm")[-1]
    assert (there.tip.x, there.tip.y, there.tip.z) == pytest.approx((0.28, 0.10, 0.45), abs=1e-9)
    assert there.angles[4] == pytest.approx(math.pi / 2)
    robot.close()


def with_joints(count):
    """Figures of an arm that has the first `count` joints."""
    arm = FIGURES.arm
    return msgspec.structs.replace(
        FIGURES,
        arm=msgspec.structs.replace(
            arm,
            joints=arm.joints[:count],
            limits=arm.limits[:count],
            poses={name: angles[:count] for name, angles in arm.poses.items()},
        ),
    )


def test_an_arm_with_four_joints_moves_as_well():
    simulation = Simulation(plain(), SCOUT, noise=False)
    arm = mount(simulation.vehicle, ["arm"], with_joints(4))["arm"]
    arm.command(ArmOrder(point=Point(0.28, 0.10, 0.45), pitch=0.2))
    state = next(iter(arm._move(None, 0.0)))[1]
    assert (state.joints, len(state.angles), len(arm.shapes())) == (JOINTS[:4], 4, 10)
    arm.command(ArmOrder(increments=Float64Array((0.1, 0.0, 0.0, 0.0))))
    with pytest.raises(ValueError, match="has 4 joints, base_yaw, .*; 5 are given"):
        arm.command(ArmOrder(increments=moved(base_yaw=0.1)))
    simulation.close()


@pytest.mark.parametrize("count", [3, 0])
def test_an_arm_with_too_few_joints_is_refused(count):
    simulation = Simulation(plain(), SCOUT)
    with pytest.raises(ValueError, match="four or five joints, and limits for each"):
        mount(simulation.vehicle, ["arm"], with_joints(count))
    simulation.close()


def test_a_robot_with_an_arm_touches_an_orange_of_the_tree():
    robot = make("patrol", "orchard", camera=False, noise=False, payloads=["arm"])
    oranges = [
        shape.position
        for prop in robot.simulation.world.props
        if prop.kind == "fruit_tree" and math.dist(prop.position[:2], (3.0, 0.0)) < 0.1
        for shape in prop.solids
        if shape.kind == "sphere"
    ]
    x, y, z = min((orange for orange in oranges if orange[2] > 0.5), key=lambda orange: orange[2])
    vehicle = robot.simulation.vehicle
    robot.simulation.backend.place(vehicle.body, (x - 0.35, y, 0.0), (0.0, 0.0, 0.0, 1.0))
    robot.read(0.0)
    touched = []
    for short in (0.12, 0.045):
        robot.command("arm", ArmOrder(point=Point(0.35 - short, 0.0, z)))
        touched.append(said(until(robot, 2.0), "/arm")[-1].touching)
    robot.close()
    assert touched == [False, True]


def test_a_fault_in_the_figures_is_named_with_file_and_key(tmp_path):
    file = tmp_path / "own.toml"
    file.write_text("[laser]\nat = 3\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"own\.toml, line 2: laser\.at"):
        load(file)


def test_a_pose_beyond_the_joints_is_refused_before_anything_moves():
    arm = msgspec.structs.replace(FIGURES.arm, poses={"broken": (0.0, 9.0, 0.0, 0.0)})
    simulation = Simulation(plain(), SCOUT)
    with pytest.raises(ValueError, match="pose 'broken' is beyond the limits"):
        mount(simulation.vehicle, ["arm"], msgspec.structs.replace(FIGURES, arm=arm))
    simulation.close()


HOMES = {"commander": "parking_lot", "minnow": "lake", "aqua": "tank"}


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_says_how_large_it_is_with_what_is_mounted(name):
    """Rangers sit on its edge, half of their 3 cm beyond it; everything else lies within, the arm as it is folded at first."""
    own = ROBOTS[name].parameters.radius
    for payload in PAYLOADS:
        try:
            robot = make(name, HOMES.get(name, "office"), camera=False, payloads=[payload])
        except ValueError:
            continue  # it has one, or cannot carry it
        said = robot.info.radius
        robot.close()
        beyond = math.hypot(own + 0.015, 0.015) if payload == "ultrasound" else own
        assert said == pytest.approx(beyond, abs=1e-9), payload
