"""The commander: an Ackermann truck with a front laser, cameras front and rear, and statistics of its steering."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import AckermannState, Manoeuvre
from bridge.msgs.sensor_msgs import JointState
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import GRAVITY
from sim.core.shapes import from_yaw
from sim.dynamics.ackermann import AckermannDrive, body_of, footing_of
from sim.dynamics.control import given
from sim.dynamics.tyres import Ground
from sim.physics.backend_bullet import Joint, State
from sim.physics.motors import Motors
from sim.sensors.gps import Gps
from sim.sensors.laser import Laser
from sim.sensors.odometry import WheelOdometry
from sim.sensors.suite import AFTER_LASER, AFTER_WHEELS, Measurement
from sim.vehicles.commander.looks import looks
from sim.vehicles.commander.parameters import PARAMETERS, CommanderParameters
from sim.vehicles.model import Model
from sim.vehicles.scene import Scene
from sim.vehicles.wheeled import Wheeled

__all__ = ["COMMANDER", "Commander"]

WHEELS = ["rear_left", "rear_right", "front_left", "front_right"]
_MIN_STEERING = 1e-4
"""Smallest steering angle that is not straight ahead [rad]."""


class Commander(Wheeled[CommanderParameters]):
    """The truck in a world that already has its ground and its things."""

    MANOEUVRES: ClassVar[tuple[str, ...]] = ("twist", "steer", "rest")
    _drive: AckermannDrive

    def __init__(self, scene: Scene, parameters: CommanderParameters) -> None:
        """Stand still at the start."""
        start, backend = scene.start, scene.backend
        body = backend.add_wheeled(
            body_of(parameters.body, parameters.axles),
            (start.x, start.y, scene.world.bottom),
            from_yaw(start.angle),
        )
        super().__init__(scene, parameters, body)
        ground = Ground(scene.world.bottom, scene.world.ground.grip)
        footing = footing_of(parameters.body, parameters.axles, parameters.tyres)
        self._drive = AckermannDrive(parameters.axles, parameters.limits, footing, ground, backend, body)
        self.motors = Motors(parameters.motor, WHEELS[:2])
        self._joints: list[Joint] = self._drive.joints
        self._add_sensors()

    def _add_sensors(self) -> None:
        parameters, scene, suite = self.parameters, self.scene, self.suite
        start = scene.start
        self.laser_x = parameters.laser.ahead
        laser = Laser(parameters.laser, scene.backend, self.body, scene.generator("laser"))
        gps = Gps(parameters.gps, scene.world.datum, scene.generator("gps"))
        self.odometer = self._odometry = WheelOdometry(
            parameters.odometry,
            radius=parameters.axles.radius,
            base=parameters.axles.track,
            ticks=parameters.axles.ticks,
            pose=(start.x, start.y, start.angle),
            noise=scene.generator("odometry"),
        )
        self.add_bumper_and_imu()
        suite.add("odometry", parameters.odometry.rate, self._measure_wheels)
        suite.add(
            "laser", parameters.laser.rate, lambda _, at: [("/scan", laser.measure(at))], after=AFTER_WHEELS
        )
        suite.add(
            "gps",
            parameters.gps.rate,
            lambda state, at: [("/fix", gps.measure(state, at))],
            after=AFTER_LASER,
        )
        self.add_power()
        self.add_order()
        self.add_truth()

    @property
    def joints(self) -> list[Joint]:
        """The rear wheels, then knuckle and wheel front left and front right, as they are now."""
        return self._drive.joints

    def begin(self, order: Manoeuvre) -> None:
        """Take up a twist, speed and steering, or brake."""
        if order.kind == "twist":
            self._drive.set_turn(order.twist.linear.x, order.twist.angular.z)
        elif order.kind == "steer":
            throttle = given(order.throttle, 0.0) * self.parameters.limits.speed
            self._drive.set_target(given(order.speed, throttle), order.steering)
        else:
            self._drive.brake()

    def _measure_wheels(self, _: State, stamp: float) -> Iterator[Measurement]:
        self._joints = joints = self.joints
        self._odometry.update(joints[0], joints[1])
        self._work(joints, 1 / self.parameters.odometry.rate)
        yield "/odom", self._odometry.odometry(stamp)
        yield "/joint_states", self._joint_state(stamp)
        yield "/ackermann", self._ackermann(stamp)

    def _work(self, joints: list[Joint], period: float) -> None:
        """Let the motors do the work that the physics asked for, with the losses in tyres and gears."""
        parameters = self.parameters
        rolling = parameters.axles.rolling * parameters.mass * GRAVITY * parameters.axles.radius / 2
        speeds = [joint.speed for joint in joints[:2]]
        torques = [joint.torque + math.copysign(rolling, joint.speed) for joint in joints[:2]]
        power = self.motors.work(speeds, torques, period)
        self.battery.feed(power, period)

    def _joint_state(self, stamp: float) -> JointState:
        front = [f"{name}_{part}_joint" for name in WHEELS[2:] for part in ("steering", "wheel")]
        names = [*(f"{name}_wheel_joint" for name in WHEELS[:2]), *front]
        return JointState(
            Header(Time.at(stamp), "base_link"),
            names,
            Float64Array(joint.angle for joint in self._joints),
            Float64Array(joint.speed for joint in self._joints),
        )

    def _ackermann(self, stamp: float) -> AckermannState:
        axles, joints = self.parameters.axles, self._joints
        left, right = joints[2].angle, joints[4].angle
        inner, outer = math.tan(left), math.tan(right)
        middle = 2 * inner * outer / (inner + outer) if inner * outer > 0 else 0.0
        radius = axles.base / middle if abs(middle) > _MIN_STEERING else math.inf
        rims = [joints[number].speed * axles.radius for number in (0, 1, 3, 5)]
        return AckermannState(
            Header(Time.at(stamp), "base_link"),
            (rims[0] + rims[1]) / 2,
            math.atan(middle),
            radius,
            WHEELS,
            Float64Array((0.0, 0.0, left, right)),
            Float64Array(rims),
        )


COMMANDER = Model(Commander, PARAMETERS, looks, "land")
"""All that is needed to make one."""
