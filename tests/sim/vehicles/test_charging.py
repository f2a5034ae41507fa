"""Charging contacts: they meet where they really are, and nowhere else."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.sensor_msgs import BatteryState
from sim.core.shapes import compose, from_yaw
from sim.physics.backend_bullet import State
from sim.robot import ROBOTS, make
from sim.vehicles.charging import TOLERANCES, ChargingContacts, docked
from sim.world.tables import Dock

CHARGING, DISCHARGING, NOT_CHARGING = (
    BatteryState.POWER_SUPPLY_STATUS_CHARGING,
    BatteryState.POWER_SUPPLY_STATUS_DISCHARGING,
    BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING,
)
REST = (0.0, 0.0, 0.0)


def state(x, y, z, yaw, tilt=0.0):
    return State(
        (x, y, z), compose(from_yaw(yaw), (math.sin(tilt / 2), 0.0, 0.0, math.cos(tilt / 2))), REST, REST
    )


def off(name, ahead=0.0, aside=0.0, above=0.0, turned=0.0):
    """Whether the contacts of the robot meet the dock's when they are so far off [m], turned about them [rad]."""
    own = ROBOTS[name].parameters.charging
    dock = Dock(3.0, -2.0, 60.0, name="it", kind=own.dock, z={"pad": 0.4, "cage": -1.5}.get(own.dock, 0.0))
    yaw = dock.angle + turned
    x = dock.x + math.cos(dock.angle) * ahead - math.sin(dock.angle) * aside
    y = dock.y + math.sin(dock.angle) * ahead + math.cos(dock.angle) * aside
    x -= math.cos(yaw) * own.contacts[0] - math.sin(yaw) * own.contacts[1]
    y -= math.sin(yaw) * own.contacts[0] + math.cos(yaw) * own.contacts[1]
    on_wheels = own.dock in ("contacts", "jetty")
    z = above + (0.0 if on_wheels else dock.z - own.contacts[2])
    return ChargingContacts(own, [dock]).dock_at(state(x, y, z, yaw)) is dock


@pytest.mark.parametrize("name", sorted(ROBOTS))
def test_they_meet_within_the_tolerance_of_the_dock_and_not_beyond_it(name):
    allowed = TOLERANCES[ROBOTS[name].parameters.charging.dock]
    bit = 1e-3
    assert off(name)
    assert off(name, ahead=-allowed.short + bit)
    assert not off(name, ahead=-allowed.short - bit)
    assert off(name, ahead=allowed.beyond - bit)
    assert not off(name, ahead=allowed.beyond + bit)
    for side in (1, -1):
        assert off(name, aside=side * (allowed.aside - bit))
        assert not off(name, aside=side * (allowed.aside + bit))
    assert not off(name, above=allowed.above + bit)
    if math.isfinite(allowed.askew):
        for side in (1, -1):
            assert off(name, turned=side * (allowed.askew - bit))
            assert not off(name, turned=side * (allowed.askew + bit))
    assert off(name, turned=math.pi) == (name == "ardrone")


def test_a_drone_may_land_in_a_circle_round_the_middle():
    assert off("ardrone", ahead=0.17, aside=0.17)
    assert not off("ardrone", ahead=0.19, aside=0.19)


def test_they_meet_no_dock_of_another_kind():
    own = ROBOTS["patrol"].parameters.charging
    x, y, yaw, _ = docked(own, pad := Dock(0.0, 0.0, name="pad", kind="pad"))
    assert ChargingContacts(own, [pad]).dock_at(state(x, y, 0.0, yaw)) is None


@pytest.fixture
def patrol():
    robot = make("patrol", "office", camera=False, noise=False)
    robot.read(0.0)
    yield robot
    robot.close()


def statuses(measured):
    return [message.power_supply_status for topic, message in measured if topic == "/battery_state"]


def put_before(robot, back):
    """Put it before its dock, `back` from where its contacts meet the dock's [m]."""
    (dock,) = (place for place in robot.places if place.kind == "dock")
    own = robot.simulation.vehicle
    at = dock.x - math.cos(dock.yaw) * back, dock.y - math.sin(dock.yaw) * back, own.state().position[2]
    robot.simulation.backend.place(own.body, at, from_yaw(dock.yaw))


def test_a_robot_that_creeps_to_its_dock_charges_before_it_bumps_and_no_longer_when_it_drives_off(patrol):
    put_before(patrol, 0.14)
    patrol.drive(Twist.planar(0.08, 0.0))
    assert statuses(patrol.read(1.2)) == [DISCHARGING]
    now = 1.2
    while CHARGING not in (told := statuses(patrol.read(now := now + 0.025))):
        assert now < 3.0
    patrol.stop()
    assert told == [CHARGING], "told at once, with no wait for the next second"
    patrol.read(now + 2.0)
    battery = patrol.simulation.vehicle.battery
    assert patrol.simulation.vehicle.dock.name == "dock"
    assert patrol.simulation.contacts == 0
    assert battery.current > 0
    charge = battery.charge
    patrol.read(now + 4.0)
    assert battery.charge > charge
    patrol.drive(Twist.planar(-0.3, 0.0))
    told = [
        message
        for topic, message in patrol.read(now + 4.5)
        if topic == "/battery_state" and message.power_supply_status == DISCHARGING
    ]
    assert patrol.simulation.vehicle.dock is None
    assert told[0].current < 0


def test_a_dock_without_current_is_touched_and_does_not_charge(patrol):
    patrol.simulation.dead_docks.add("dock")
    put_before(patrol, 0.0)
    assert statuses(patrol.read(0.5))[-1] == NOT_CHARGING
    patrol.simulation.dead_docks.clear()
    assert statuses(patrol.read(1.0))[-1] == CHARGING


@pytest.mark.parametrize(
    ("name", "world"),
    [
        *((name, world) for name in ("patrol", "scout", "commander") for world in ("parking_lot", "orchard")),
        ("scout", "office"),
        *((name, world) for name in ("minnow", "aqua") for world in ("lake", "tank")),
        *(("ardrone", world) for world in ("parking_lot", "office", "orchard", "lake", "tank")),
    ],
)
def test_in_each_world_each_robot_has_one_dock_at_which_it_charges(name, world):
    robot = make(name, world, camera=False, noise=False)
    robot.read(0.0)
    (place,) = (each for each in robot.places if each.kind == "dock")
    (dock,) = (each for each in robot.simulation.world.docks if each.name == place.name)
    own = robot.simulation.vehicle
    height = (
        own.state().position[2]
        if dock.kind in ("contacts", "jetty")
        else dock.z - own.parameters.charging.contacts[2]
    )
    robot.simulation.backend.place(own.body, (place.x, place.y, height), from_yaw(place.yaw))
    assert not robot.simulation.backend.is_crowded(own.body, -0.005)
    told = statuses(robot.read(0.5))
    robot.close()
    assert CHARGING in told


def put_at_dock(name, world):
    """The robot where it charges, after half a second there; its dock, and the vehicle."""
    robot = make(name, world, camera=False, seed=2)
    robot.read(0.0)
    (place,) = (each for each in robot.places if each.kind == "dock")
    (dock,) = (each for each in robot.simulation.world.docks if each.name == place.name)
    own = robot.simulation.vehicle
    afloat = dock.kind == "jetty"
    height = own.state().position[2] if afloat else dock.z - own.parameters.charging.contacts[2]
    robot.simulation.backend.place(own.body, (place.x, place.y, height), from_yaw(place.yaw))
    robot.read(0.5)
    assert own.dock is dock
    return robot, dock, own


@pytest.mark.slow
@pytest.mark.parametrize("world", ["lake", "tank"])
def test_a_boat_at_rest_stays_in_its_berth_and_charges_in_waves_wind_and_current(world):
    robot, dock, own = put_at_dock("minnow", world)
    lost = 0
    for half in range(1, 41):
        robot.read(0.5 + half / 2)
        lost += own.dock is not dock
    robot.close()
    assert lost == 0
    assert own.battery.current > 0


@pytest.mark.slow
@pytest.mark.parametrize("world", ["lake", "tank"])
def test_a_swimmer_that_holds_its_depth_stays_in_its_cage_and_charges(world):
    robot, dock, own = put_at_dock("aqua", world)
    robot.manoeuvre(Manoeuvre(kind="hover", yaw=dock.angle, height=dock.z))
    lost = 0
    for half in range(1, 41):
        robot.read(0.5 + half / 2)
        lost += own.dock is not dock
    robot.close()
    assert lost == 0
    assert own.battery.current > 0


@pytest.mark.parametrize("world", ["tank", "office"])
def test_a_drone_charges_only_while_it_stands_on_its_pad_which_is_no_obstacle(world):
    robot, dock, own = put_at_dock("ardrone", world)
    robot.manoeuvre(Manoeuvre(kind="take_off"))
    robot.read(0.6)
    assert own.state().position[2] - dock.z < 0.08, "its contacts are still where they meet"
    assert own.battery.status == DISCHARGING
    robot.read(4.0)
    assert own.state().position[2] > dock.z + 0.5
    assert own.battery.status == DISCHARGING
    robot.manoeuvre(Manoeuvre(kind="land"))
    robot.read(12.0)
    assert own.pilot.phase == "landed"
    assert own.dock is dock
    assert own.battery.status == CHARGING
    assert own.bumper.bumps == 0
    robot.close()
