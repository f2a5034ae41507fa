"""The patrol robot: two wheels, laser, camera, inertial unit, satellite receiver, line and ultrasonic sensors, bumper."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.std_msgs import Header, Time
from sim.backend_bullet import STEPS_PER_SECOND, Bullet, State, Wheeled
from sim.paint import Paint
from sim.schedule import Schedule
from sim.sensors.battery import Battery
from sim.sensors.bumper import BumperRing
from sim.sensors.gps import Gps
from sim.sensors.imu import InertialUnit
from sim.sensors.laser import Laser
from sim.sensors.line import LineCells
from sim.sensors.noise import Noise
from sim.sensors.odometry import WheelOdometry
from sim.sensors.ultrasound import Ultrasounds
from sim.shapes import Shape, from_yaw, rotate_back
from sim.vehicles.drive import DifferentialDrive
from sim.vehicles.model import Model
from sim.vehicles.parameters import Parameters, load
from sim.vehicles.patrol.looks import looks
from sim.world import World

__all__ = ["PARAMETERS", "PATROL", "Patrol"]

PARAMETERS: Parameters = load(Path(__file__).parent / "patrol.toml")
"""The robot's numbers."""

SETTLING = STEPS_PER_SECOND // 2
"""Steps after which the body stands still on its wheels."""

Measurement = tuple[str, Msg]
"""A topic and what is said on it."""


def body_of(parameters: Parameters) -> Wheeled:
    """The rigid body that the physics needs."""
    body, wheels, casters = parameters.body, parameters.wheels, parameters.casters
    height = body.height - body.clearance
    middle = (body.height + body.clearance) / 2
    return Wheeled(
        shell=Shape("cylinder", (2 * body.radius, 2 * body.radius, height), (0.0, 0.0, middle)),
        mass=body.mass,
        inertia=body.inertia,
        centre_of_mass=(0.0, 0.0, body.centre_of_mass),
        wheels=((0.0, wheels.base / 2, wheels.radius), (0.0, -wheels.base / 2, wheels.radius)),
        wheel_radius=wheels.radius,
        wheel_mass=wheels.mass,
        wheel_friction=wheels.friction,
        casters=((casters.offset, 0.0, casters.radius), (-casters.offset, 0.0, casters.radius)),
        caster_radius=casters.radius,
        caster_mass=casters.mass,
        friction=body.friction,
    )


class Patrol:
    """The robot in a world that already has its ground and its things."""

    def __init__(
        self, backend: Bullet, world: World, *, seed: int, noise: bool, parameters: Parameters
    ) -> None:
        """Stand still at the world's start; with `noise` False every sensor is exact."""
        self._backend, self._world, self.parameters = backend, world, parameters
        start = world.start
        self.body = backend.add_wheeled(body_of(parameters), (start.x, start.y, 0.0), from_yaw(start.angle))
        """Its number in the physics."""
        self._drive = DifferentialDrive(parameters.wheels, parameters.limits, backend, self.body)
        self.battery = Battery(parameters.battery, parameters.body.mass)
        self.bumper = BumperRing()
        self._make_sensors(seed, noise)
        for _ in range(SETTLING):
            backend.step()
        self._step = 0

    def _make_sensors(self, seed: int, on: bool) -> None:
        parameters, start = self.parameters, self._world.start
        self._laser = Laser(parameters.laser, self._backend, self.body, Noise(seed, "laser", on=on))
        self._imu = InertialUnit(parameters.imu, Noise(seed, "imu", on=on))
        self._line = LineCells(parameters.line, Paint(self._world), Noise(seed, "line", on=on))
        self._ultrasounds = Ultrasounds(
            parameters.ultrasound, self._backend, self.body, Noise(seed, "ultrasound", on=on)
        )
        self._gps = Gps(parameters.gps, self._world.datum, Noise(seed, "gps", on=on))
        self._odometry = WheelOdometry(
            parameters.odometry,
            radius=parameters.wheels.radius,
            base=parameters.wheels.base,
            ticks=parameters.wheels.ticks,
            pose=(start.x, start.y, start.angle),
            noise=Noise(seed, "odometry", on=on),
        )
        self._schedule = Schedule(
            {
                "imu": parameters.imu.rate,
                "odometry": parameters.odometry.rate,
                "laser": parameters.laser.rate,
                "gps": parameters.gps.rate,
                "bumper": parameters.bumper.rate,
                "line": parameters.line.rate,
                "ultrasound": parameters.ultrasound.rate,
                "battery": parameters.battery.rate,
                "truth": parameters.truth.rate,
            }
        )

    def drive(self, twist: Twist) -> None:
        """Go for `twist` until told otherwise."""
        self._drive.want(twist)

    def stop(self) -> None:
        """Brake to rest."""
        self._drive.brake()

    def advance(self) -> None:
        """One physics step."""
        if self.battery.empty:
            self._drive.brake()
        self._drive.step()
        self._backend.step()
        self._step += 1
        contacts = self._backend.touching(self.body)
        self.bumper.update(self._step, contacts, self.state() if contacts else None)

    def state(self) -> State:
        """Where it really is and how it moves, in `map`."""
        return self._backend.state(self.body)

    def measure(self, stamp: float, *, truth: bool) -> Iterator[Measurement]:
        """What is due after this step, with `stamp` [s]; ground truth only when `truth` asks for it."""
        due = self._schedule.due(self._step)
        if "bumper" in due or self.bumper.changed:
            yield "/bumper", self.bumper.message(stamp)
        if not due:
            return
        state = self.state()
        if "imu" in due:
            yield "/imu/data", self._imu.measure(state, stamp)
        if "odometry" in due:
            yield from self._measure_wheels(stamp)
        if "laser" in due:
            yield "/scan", self._laser.measure(stamp)
        if "gps" in due:
            yield "/fix", self._gps.measure(state, stamp)
        yield from self._measure_near(due, state, stamp)
        if "battery" in due:
            yield "/battery_state", self.battery.message(stamp)
        if truth and "truth" in due:
            yield "/sim/ground_truth", ground_truth(state, stamp)

    def _measure_near(self, due: tuple[str, ...], state: State, stamp: float) -> Iterator[Measurement]:
        """The ground under it and what is close by."""
        if "line" in due:
            yield "/line", self._line.measure(state, stamp)
        if "ultrasound" in due:
            for side, echo in self._ultrasounds.measure(stamp):
                yield f"/ultrasound/{side}", echo

    def _measure_wheels(self, stamp: float) -> Iterator[Measurement]:
        left, right = self._backend.joints(self.body, 2)
        self._odometry.update(left, right)
        speed = (left.speed + right.speed) / 2 * self.parameters.wheels.radius
        self.battery.work(speed, 1 / self.parameters.odometry.rate)
        yield "/odom", self._odometry.odometry(stamp)
        yield "/joint_states", self._odometry.joint_state(stamp)


PATROL = Model(Patrol, PARAMETERS, looks)
"""All that is needed to make one."""


def ground_truth(state: State, stamp: float) -> Odometry:
    """A body's true `state` as a message, `map` to `base_link`."""
    ahead = rotate_back(state.rotation, state.velocity)
    turning = rotate_back(state.rotation, state.turning)
    return Odometry(
        Header(Time.at(stamp), "map"),
        "base_link",
        PoseWithCovariance(Pose(Point(*state.position), Quaternion(*state.rotation))),
        TwistWithCovariance(Twist(Vector3(*ahead), Vector3(*turning))),
    )
