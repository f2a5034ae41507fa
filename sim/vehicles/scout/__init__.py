"""The scout: a SuperScout with sixteen sonars, a bumper ring and odometry."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.backend_bullet import GRAVITY, State
from sim.motors import Motors
from sim.scene import Scene
from sim.sensors.battery import Battery
from sim.sensors.imu import InertialUnit
from sim.sensors.odometry import WheelOdometry
from sim.sensors.sonar import Sonar, SonarParameters
from sim.shapes import from_yaw
from sim.vehicles.chassis import Chassis
from sim.vehicles.differential import DifferentialDrive, DifferentialParameters, body_of
from sim.vehicles.model import Model
from sim.vehicles.parameters import Motor, Positive, Table, load
from sim.vehicles.scout.looks import looks
from sim.vehicles.suite import Measurement

__all__ = ["PARAMETERS", "SCOUT", "Scout", "ScoutParameters"]

MOTORS_RATE = 5.0


class Rolling(Table, frozen=True, kw_only=True):
    """What tyres and gears take."""

    resistance: Positive
    """As a part of the weight."""


class ScoutParameters(DifferentialParameters, frozen=True, kw_only=True):
    """The whole file."""

    motor: Motor
    rolling: Rolling
    sonar: SonarParameters


PARAMETERS: ScoutParameters = load(Path(__file__).parent / "scout.toml", ScoutParameters)
"""The robot's numbers."""


class Scout(Chassis[ScoutParameters]):
    """The robot in a world that already has its ground and its things."""

    def __init__(self, scene: Scene, parameters: ScoutParameters) -> None:
        """Stand still at the start."""
        start, backend = scene.start, scene.backend
        body = backend.add_wheeled(
            body_of(parameters), (start.x, start.y, scene.world.bottom), from_yaw(start.angle)
        )
        super().__init__(scene, parameters, body)
        self._drive = DifferentialDrive(parameters.wheels, parameters.limits, backend, body)
        self.battery = Battery(parameters.battery)
        self.motors = Motors(parameters.motor, ["left", "right"])
        self._add_sensors()

    def _add_sensors(self) -> None:
        parameters, scene, suite = self.parameters, self.scene, self.suite
        start = scene.start
        sonar = Sonar(parameters.sonar, scene.backend, self.body, scene.generator("sonar"))
        imu = InertialUnit(parameters.imu, scene.generator("imu"))
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
        suite.add("sonar", parameters.sonar.rate, lambda _, at: [("/sonar", sonar.measure(at))])
        suite.add("motors", MOTORS_RATE, lambda _, at: [("/motors", self.motors.message(at))])
        suite.add(
            "battery", parameters.battery.rate, lambda _, at: [("/battery_state", self.battery.message(at))]
        )
        self.add_order()
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

    def _measure_wheels(self, _: State, stamp: float) -> Iterator[Measurement]:
        joints = self.scene.backend.joints(self.body, 2)
        self._odometry.update(*joints)
        own = self.parameters
        mass = own.body.mass + 2 * own.wheels.mass + 2 * own.casters.mass
        rolling = own.rolling.resistance * mass * GRAVITY * own.wheels.radius / 2
        speeds = [joint.speed for joint in joints]
        torques = [joint.torque + math.copysign(rolling, joint.speed) for joint in joints]
        period = 1 / own.odometry.rate
        self.battery.feed(self.motors.work(speeds, torques, period), period)
        yield "/odom", self._odometry.odometry(stamp)
        yield "/joint_states", self._odometry.joint_state(stamp)


SCOUT = Model(Scout, PARAMETERS, looks, "land", home="office")
"""All that is needed to make one."""
