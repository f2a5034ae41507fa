"""A robot on two driven wheels: what all of the kind share besides figures and sensors of their own."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TypeVar

from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.shapes import from_yaw
from sim.dynamics.differential import DifferentialDrive, DifferentialParameters, body_of
from sim.physics.backend_bullet import GRAVITY, State
from sim.physics.motors import Motors
from sim.sensors.odometry import WheelOdometry
from sim.sensors.suite import Measurement
from sim.vehicles.scene import Scene
from sim.vehicles.wheeled import Wheeled

__all__ = ["TwoWheeled"]

D = TypeVar("D", bound=DifferentialParameters)


class TwoWheeled(Wheeled[D]):
    """The robot in a world that already has its ground and its things; each model adds its own sensors."""

    _drive: DifferentialDrive

    def __init__(self, scene: Scene, parameters: D) -> None:
        """Stand still at the start, with bumper, inertial unit, odometry, motors and battery."""
        start, backend = scene.start, scene.backend
        body = backend.add_wheeled(
            body_of(parameters), (start.x, start.y, scene.world.bottom), from_yaw(start.angle)
        )
        super().__init__(scene, parameters, body)
        self._drive = DifferentialDrive(parameters.wheels, parameters.limits, backend, body)
        self.motors = Motors(parameters.motor, ["left", "right"])
        self.odometer = self._odometry = WheelOdometry(
            parameters.odometry,
            radius=parameters.wheels.radius,
            base=parameters.wheels.base,
            ticks=parameters.wheels.ticks,
            pose=(start.x, start.y, start.angle),
            noise=scene.generator("odometry"),
        )
        mass = parameters.body.mass + 2 * parameters.wheels.mass + 2 * parameters.casters.mass
        self._rolling = parameters.rolling.resistance * mass * GRAVITY * parameters.wheels.radius / 2
        self._add_common()
        self.add_own()
        self.add_order()
        self.add_truth()

    def add_own(self) -> None:
        """Add the sensors that only this model has."""
        raise NotImplementedError

    def begin(self, order: Manoeuvre) -> None:
        """Take up a twist, or brake."""
        if order.kind == "twist":
            self._drive.want(order.twist)
        else:
            self._drive.brake()

    def _add_common(self) -> None:
        parameters, suite = self.parameters, self.suite
        self.add_bumper_and_imu()
        suite.add("odometry", parameters.odometry.rate, self._measure_wheels)
        self.add_power()

    def _measure_wheels(self, _: State, stamp: float) -> Iterator[Measurement]:
        joints = self.scene.backend.joints(self.body, 2)
        self._odometry.update(*joints)
        speeds = [joint.speed for joint in joints]
        torques = [joint.torque + math.copysign(self._rolling, joint.speed) for joint in joints]
        period = 1 / self.parameters.odometry.rate
        self.battery.feed(self.motors.work(speeds, torques, period), period)
        yield "/odom", self._odometry.odometry(stamp)
        yield "/joint_states", self._odometry.joint_state(stamp)
