"""The minnow: a boat with rudder and throttle, satellite receiver, compass and camera."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RudderState
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import STEPS_PER_SECOND
from sim.core.shapes import Shape, from_yaw, yaw_of
from sim.dynamics.boat import BoatController, BoatDrive
from sim.dynamics.control import filled, given
from sim.dynamics.hull import Hull, HullParameters, inertia_of
from sim.dynamics.sixdof import SixDof
from sim.physics.backend_bullet import State
from sim.physics.bodies import Floating
from sim.physics.motors import Motors
from sim.sensors.compass import FILTER_RATE, Compass
from sim.sensors.gps import Gps
from sim.sensors.suite import Measurement
from sim.vehicles.chassis import Chassis
from sim.vehicles.minnow.looks import looks
from sim.vehicles.minnow.parameters import PARAMETERS, MinnowParameters
from sim.vehicles.model import Model
from sim.vehicles.scene import Scene

__all__ = ["MINNOW", "Minnow"]


WORK_STEPS = STEPS_PER_SECOND // 20
RUDDER_RATE = 10.0
_STILL_SPEED = 0.03
"""It lies still when it is slower than this [m/s]."""


def body_of(hull: HullParameters) -> Floating:
    """The rigid body that the physics needs."""
    shell = Shape("box", (hull.length, hull.beam, hull.depth), (0.0, 0.0, hull.depth / 2 - hull.draft))
    return Floating(shell, hull.mass, hull.inertia, hull.centre_of_mass, hull.friction)


class Minnow(Chassis[MinnowParameters]):
    """The boat on the water of a world."""

    MANOEUVRES: ClassVar[tuple[str, ...]] = ("twist", "steer", "course", "hover", "rest")

    def __init__(self, scene: Scene, parameters: MinnowParameters) -> None:
        """Float still at the start."""
        start, weather = scene.start, scene.weather
        body = scene.backend.add_floating(
            body_of(parameters.hull), (start.x, start.y, 0.0), from_yaw(start.angle)
        )
        super().__init__(scene, parameters, body)
        self.hull = Hull(parameters.hull, weather)
        self.dynamics = SixDof(scene.backend, body, inertia_of(parameters.hull))
        own, hull = parameters.propeller, parameters.hull
        self.works = BoatDrive(own, parameters.rudder, hull.length, weather.density)
        """Propeller and rudder."""
        self._controller = BoatController(parameters.limits, hull.damping[0] / own.thrust, self.works)
        self._course = start.angle
        self.motors = Motors(parameters.motor, ["propeller"])
        self._add_sensors()

    def _add_sensors(self) -> None:
        parameters, scene, suite = self.parameters, self.scene, self.suite
        gps = Gps(parameters.gps, scene.world.datum, scene.generator("gps"))
        self._compass = Compass(parameters.compass, scene.generator("compass"))
        self.add_bumper_and_imu()
        self.add_reckoning(parameters.reckoning)
        suite.add("gps", parameters.gps.rate, lambda state, at: [("/fix", gps.measure(state, at))])
        suite.add("compass", FILTER_RATE, self._compass.messages)
        suite.add("rudder", RUDDER_RATE, self._measure_rudder)
        self.add_power()
        self.add_order()
        self.add_truth()

    def begin(self, order: Manoeuvre) -> None:
        """Take up a twist, throttle and rudder, a course, waiting on a course, or lying still."""
        present = yaw_of(self.state().rotation)
        if order.kind != self.order.kind:
            self._controller.ease()
            self._course = present
        if order.kind in ("course", "hover"):
            self._course = given(order.yaw, self._course)

    def held(self) -> Manoeuvre:
        """The order that it follows, with the course that it keeps where the order names none."""
        order = self.order
        return filled(order, self._course) if order.kind in ("course", "hover") else order

    def halt(self) -> None:
        """Let propeller and rudder stand still at once."""
        self._compass.restart()
        works = self.works
        works.throttle = works.thrust = works.wanted = works.angle = 0.0

    def before_step(self) -> None:
        """Let rudder and propeller follow the order, and water and wind act on the hull."""
        body, works = self.dynamics, self.works
        body.update(self.scene.weather.current)
        if self.battery.empty:
            works.throttle = 0.0
        else:
            self._steer(body)
        (fx, fy, fz), (mx, my, mz) = self.hull.forces(body)
        (thrust, side, _), moment = works.step(body.through[0])
        wet = self.hull.wet
        body.apply((fx + wet * thrust, fy + wet * side, fz), (mx, my, mz + wet * moment))

    def after_step(self) -> None:
        """Update with the result of the physics step, and feed the motors."""
        super().after_step()
        if self._step % WORK_STEPS == 0:
            speed, torque = self.works.turning
            power = self.motors.work([speed], [torque], WORK_STEPS / STEPS_PER_SECOND)
            self.battery.feed(power, WORK_STEPS / STEPS_PER_SECOND)

    def _steer(self, body: SixDof) -> None:
        order, works, controller = self.order, self.works, self._controller
        speed, turning = body.through[0], body.turning[2]
        kind = order.kind
        if kind == "steer":
            works.wanted = order.steering
            works.throttle = self._throttle(order, speed)
        elif kind == "twist":
            twist: Twist = order.twist
            works.throttle = controller.throttle_for(twist.linear.x, speed)
            if abs(twist.angular.z) > 0.02 and abs(works.throttle) < controller.STEERING_WAY:
                works.throttle = controller.STEERING_WAY
            controller.turn(twist.angular.z, turning, speed)
        elif kind in ("course", "hover"):
            works.throttle = self._throttle(order, speed) if kind == "course" else 0.0
            controller.course(yaw_of(body.rotation), self._course, turning, speed)
        else:
            works.wanted = 0.0
            works.throttle = controller.throttle_for(0.0, speed) if abs(speed) > _STILL_SPEED else 0.0

    def _throttle(self, order: Manoeuvre, speed: float) -> float:
        if math.isnan(order.speed):
            return given(order.throttle, 0.0)
        return self._controller.throttle_for(order.speed, speed)

    def _measure_rudder(self, _: State, stamp: float) -> Iterator[Measurement]:
        works = self.works
        yield (
            "/rudder",
            RudderState(
                Header(Time.at(stamp), "base_link"), works.angle, works.wanted, works.throttle, works.thrust
            ),
        )


MINNOW = Model(Minnow, PARAMETERS, looks, "water", home="lake")
"""All that is needed to make one."""
