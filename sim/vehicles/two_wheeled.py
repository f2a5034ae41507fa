"""The common part of all robots on two driven wheels, beside their own parameters and sensors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Self, TypeVar

from msgspec.structs import replace

from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY
from sim.core.load import Load, with_loads
from sim.core.parameters import CameraParameters
from sim.core.shapes import from_yaw
from sim.dynamics.differential import (
    Body,
    Casters,
    DifferentialDrive,
    DifferentialLimits,
    Rolling,
    Wheels,
    body_of,
)
from sim.physics.backend_bullet import Joint, State
from sim.physics.motors import Motors
from sim.sensors.odometry import OdometryParameters, WheelOdometry
from sim.sensors.suite import Measurement
from sim.vehicles.parameters import Parameters
from sim.vehicles.scene import Scene
from sim.vehicles.wheeled import Wheeled

__all__ = ["TwoWheeled", "TwoWheeledParameters"]


class TwoWheeledParameters(Parameters, frozen=True, kw_only=True):
    """Parameters of all robots with two driven wheels."""

    body: Body
    wheels: Wheels
    casters: Casters
    limits: DifferentialLimits
    rolling: Rolling
    odometry: OdometryParameters
    camera: CameraParameters

    @property
    def radius(self) -> float:
        """Of the circle round `base_link` that the body fits in [m]."""
        return self.body.radius

    @property
    def deck(self) -> tuple[float, float, float]:
        """Mounting place of payloads, in `base_link` [m]."""
        return (0.0, 0.0, self.body.height)

    def laden(self, loads: Sequence[Load]) -> Self:
        """Heavier, and higher or farther ahead in its balance."""
        body = self.body
        mass, (x, _, z), inertia = with_loads(
            body.mass, (body.ahead, 0.0, body.centre_of_mass), body.inertia, loads
        )
        heavier = replace(body, mass=mass, ahead=x, centre_of_mass=z, inertia=inertia)
        return replace(self, body=heavier)

    @property
    def cameras(self) -> tuple[CameraParameters, ...]:
        """It has one."""
        return (self.camera,)


D = TypeVar("D", bound=TwoWheeledParameters)


class TwoWheeled(Wheeled[D]):
    """The robot in a world that already has its ground and its things; each model adds its own sensors."""

    _drive: DifferentialDrive

    def __init__(self, scene: Scene, parameters: D) -> None:
        """Stand still at the start, with bumper, inertial unit, odometry, motors and battery."""
        start, backend = scene.start, scene.backend
        body = backend.add_wheeled(
            body_of(parameters.body, parameters.wheels, parameters.casters),
            (start.x, start.y, scene.world.bottom),
            from_yaw(start.angle),
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

    @property
    def joints(self) -> list[Joint]:
        """The left and the right wheel, as they are now."""
        return self.scene.backend.joints(self.body, 2)

    def add_own(self) -> None:
        """Add the sensors that only this model has."""
        raise NotImplementedError

    def begin(self, order: Manoeuvre) -> None:
        """Take up a twist, or brake."""
        if order.kind == "twist":
            self._drive.set_target(order.twist)
        else:
            self._drive.brake()

    def _add_common(self) -> None:
        parameters, suite = self.parameters, self.suite
        self.add_bumper_and_imu()
        suite.add("odometry", parameters.odometry.rate, self._measure_wheels)
        self.add_power()

    def _measure_wheels(self, _: State, stamp: float) -> Iterator[Measurement]:
        joints = self.joints
        self._odometry.update(*joints)
        speeds = [joint.speed for joint in joints]
        torques = [joint.torque + math.copysign(self._rolling, joint.speed) for joint in joints]
        period = 1 / self.parameters.odometry.rate
        self.battery.feed(self.motors.work(speeds, torques, period), period)
        yield "/odom", self._odometry.odometry(stamp)
        yield "/joint_states", self._odometry.joint_state(stamp)
