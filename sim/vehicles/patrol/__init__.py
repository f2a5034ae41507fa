"""The patrol robot: two wheels, a laser, a camera, an inertial unit, a satellite receiver, a bumper, a battery."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.backend_bullet import State
from sim.paint import Paint
from sim.scene import Scene
from sim.sensors.battery import DriveBattery, DriveBatteryParameters
from sim.sensors.gps import Gps, GpsParameters
from sim.sensors.imu import InertialUnit
from sim.sensors.laser import Laser, LaserParameters
from sim.sensors.line import LineCells, LineParameters
from sim.sensors.odometry import WheelOdometry
from sim.sensors.ultrasound import UltrasoundParameters, Ultrasounds
from sim.shapes import from_yaw
from sim.vehicles.chassis import Chassis
from sim.vehicles.differential import DifferentialDrive, DifferentialParameters, body_of
from sim.vehicles.model import Model
from sim.vehicles.parameters import load
from sim.vehicles.patrol.looks import looks
from sim.vehicles.suite import Measurement

__all__ = ["PARAMETERS", "PATROL", "Patrol", "PatrolParameters"]


class PatrolParameters(DifferentialParameters, frozen=True, kw_only=True):
    """The whole file."""

    battery: DriveBatteryParameters
    laser: LaserParameters
    gps: GpsParameters
    line: LineParameters
    ultrasound: UltrasoundParameters


PARAMETERS: PatrolParameters = load(Path(__file__).parent / "patrol.toml", PatrolParameters)
"""The robot's numbers."""


class Patrol(Chassis[PatrolParameters]):
    """The robot in a world that already has its ground and its things."""

    def __init__(self, scene: Scene, parameters: PatrolParameters) -> None:
        """Stand still at the start."""
        start = scene.start
        backend = scene.backend
        body = backend.add_wheeled(
            body_of(parameters), (start.x, start.y, scene.world.bottom), from_yaw(start.angle)
        )
        super().__init__(scene, parameters, body)
        self._drive = DifferentialDrive(parameters.wheels, parameters.limits, backend, body)
        self.battery = self._drive_battery = DriveBattery(parameters.battery, parameters.body.mass)
        self._add_sensors()

    def _add_sensors(self) -> None:
        parameters, scene, suite = self.parameters, self.scene, self.suite
        start = scene.start
        laser = Laser(parameters.laser, scene.backend, self.body, scene.generator("laser"))
        imu = InertialUnit(parameters.imu, scene.generator("imu"))
        gps = Gps(parameters.gps, scene.world.datum, scene.generator("gps"))
        self.odometer = self._odometry = WheelOdometry(
            parameters.odometry,
            radius=parameters.wheels.radius,
            base=parameters.wheels.base,
            ticks=parameters.wheels.ticks,
            pose=(start.x, start.y, start.angle),
            noise=scene.generator("odometry"),
        )
        suite.add("bumper", parameters.bumper.rate, self.tell_bumper)
        suite.add("imu", parameters.imu.rate, lambda state, at: [("/imu/data", imu.measure(state, at))])
        suite.add("odometry", parameters.odometry.rate, self._measure_wheels)
        suite.add("laser", parameters.laser.rate, lambda _, at: [("/scan", laser.measure(at))])
        suite.add("gps", parameters.gps.rate, lambda state, at: [("/fix", gps.measure(state, at))])
        line = LineCells(parameters.line, Paint(scene.world), scene.generator("line"))
        self._ultrasounds = Ultrasounds(
            parameters.ultrasound, scene.backend, self.body, scene.generator("ultrasound")
        )
        suite.add(
            "line_sensor", parameters.line.rate, lambda state, at: [("/line_sensor", line.measure(state, at))]
        )
        suite.add("ultrasound", parameters.ultrasound.rate, self._measure_echoes)
        suite.add(
            "battery", parameters.battery.rate, lambda _, at: [("/battery_state", self.battery.message(at))]
        )
        self.add_truth()

    def begin(self, order: Manoeuvre) -> None:
        """Take up a twist, or brake."""
        if order.kind == "twist":
            self._drive.want(order.twist)
        else:
            self._drive.brake()

    def halt(self) -> None:
        """Let the wheels stand still at once."""
        self._drive.halt()

    def push(self) -> None:
        """Let the drive come a step nearer to what is wanted."""
        if self.battery.empty:
            self._drive.brake()
        self._drive.step()

    def _measure_echoes(self, _: State, stamp: float) -> Iterator[Measurement]:
        for side, echo in self._ultrasounds.measure(stamp):
            yield f"/range/{side}", echo

    def _measure_wheels(self, _: State, stamp: float) -> Iterator[Measurement]:
        left, right = self.scene.backend.joints(self.body, 2)
        self._odometry.update(left, right)
        speed = (left.speed + right.speed) / 2 * self.parameters.wheels.radius
        self._drive_battery.work(speed, 1 / self.parameters.odometry.rate)
        yield "/odom", self._odometry.odometry(stamp)
        yield "/joint_states", self._odometry.joint_state(stamp)


PATROL = Model(Patrol, PARAMETERS, looks, "land")
"""All that is needed to make one."""
