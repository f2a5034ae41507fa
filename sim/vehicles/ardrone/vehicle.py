"""The ardrone: a quadrotor with cameras ahead and down, inertial unit and ultrasound."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

from bridge.msgs.pilothouse_msgs import FlightState, Manoeuvre
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.shapes import Shape, from_yaw, rotate
from sim.dynamics.control import within
from sim.dynamics.quadrotor import ROTORS, QuadrotorBody, Rotors
from sim.dynamics.sixdof import Inertia, SixDof
from sim.physics.backend_bullet import State
from sim.physics.bodies import Floating
from sim.physics.motors import Motors
from sim.sensors.height import HeightRanger
from sim.sensors.suite import Measurement
from sim.vehicles.ardrone.looks import looks
from sim.vehicles.ardrone.parameters import PARAMETERS, ArdroneParameters
from sim.vehicles.ardrone.pilot import MIN_HEIGHT, MIN_UPRIGHT, Motion, Pilot
from sim.vehicles.chassis import Chassis
from sim.vehicles.model import Model
from sim.vehicles.scene import Scene

__all__ = ["ARDRONE", "Ardrone"]


WORK_STEPS = STEPS_PER_SECOND // 20
FLIGHT_RATE = 10.0
MAX_STANDING_SPEED = 0.02
"""Carried faster than this, it does not count as standing [m/s]."""
LANDING_CHARGE = 0.05
"""Below this charge it lands by itself."""


def body_of(body: QuadrotorBody) -> Floating:
    """The rigid body that the physics needs."""
    shell = Shape("box", (body.width, body.width, body.height))
    return Floating(shell, body.mass, body.inertia, (0.0, 0.0, 0.0), body.friction)


class Ardrone(Chassis[ArdroneParameters]):
    """The quadrotor in a world."""

    MANOEUVRES: ClassVar[tuple[str, ...]] = ("twist", "course", "tilt", "hover", "take_off", "land", "rest")

    def __init__(self, scene: Scene, parameters: ArdroneParameters) -> None:
        """Stand on the ground at the start, or on a raft where there is water."""
        start, own = scene.start, parameters.body
        at = (start.x, start.y, own.height / 2)
        body = scene.backend.add_floating(body_of(own), at, from_yaw(start.angle))
        super().__init__(scene, parameters, body)
        self.landings = scene.platforms
        if scene.world.water:
            raft = Shape("box", (1.0, 1.0, 0.2), (start.x, start.y, -0.1), from_yaw(start.angle))
            self.raft = scene.backend.add_static([raft])
        self.dynamics = SixDof(scene.backend, body, Inertia(own.mass, (0.0, 0.0, 0.0), own.inertia))
        self.rotors = Rotors(parameters.rotors)
        self.pilot = Pilot(parameters, at)
        self.motors = Motors(parameters.motor, ROTORS)
        self._add_sensors()

    def _add_sensors(self) -> None:
        parameters, scene, suite = self.parameters, self.scene, self.suite
        self._height = HeightRanger(
            parameters.range, scene.backend, self.body, scene.weather, scene.generator("range")
        )
        self.add_bumper_and_imu()
        self.add_reckoning(parameters.reckoning)
        suite.add(
            "range",
            parameters.range.rate,
            lambda state, at: [("/range/down", self._height.measure(state, at))],
        )
        suite.add("flight", FLIGHT_RATE, self._measure_flight)
        self.add_power()
        self.add_order()
        self.add_truth()

    @property
    def heights(self) -> tuple[float, float]:
        """From just over where it stood to its ceiling above that [m]."""
        floor = self._home[0][2]
        return floor + MIN_HEIGHT, floor + self.parameters.limits.height

    def begin(self, order: Manoeuvre) -> None:
        """Take up a twist, a course, a tilt; hover, take off or land. At rest in the air it hovers."""
        self.dynamics.update((0.0, 0.0, 0.0))
        motion = self.motion()
        if order.kind == "take_off" and motion.upright < MIN_UPRIGHT:
            name = self.parameters.info.name
            raise ValueError(f"{name} has turned over: its rotors do not start; put it upright first.")
        if self.battery.charge < LANDING_CHARGE and self.pilot.phase == "landing":
            order = Manoeuvre(kind="land")  # no order keeps it in the air until it falls
        self.pilot.begin(order, motion)

    def held(self) -> Manoeuvre:
        """The order that it follows, with the heading and the height that it keeps where the order names none."""
        return self.pilot.held

    @property
    def stands(self) -> bool:
        """It stands on the ground, rotors off, and is not carried."""
        return (
            self.pilot.phase == "landed"
            and self.grounded
            and math.hypot(*self.state().velocity) < MAX_STANDING_SPEED
        )

    @property
    def may_charge(self) -> bool:
        """Landed."""
        return self.stands

    def reset(self) -> None:
        """Stand where it started."""
        super().reset()
        self.pilot = Pilot(self.parameters, self.state().position)

    def halt(self) -> None:
        """Let the rotors stand still at once."""
        self.rotors.stop()
        self.rotors.speeds = [0.0] * len(ROTORS)

    def motion(self) -> Motion:
        """Its motion at the last update."""
        body = self.dynamics
        a, _, _, d, _, _, ux, uy, uz = body.axes
        angles = (math.atan2(uy, uz), -math.asin(within(ux, 1.0)), math.atan2(d, a))
        return Motion(body.position, body.velocity, angles, body.turning, uz)

    def before_step(self) -> None:
        """Let the rotors follow the order, and the air act on the body."""
        body, rotors = self.dynamics, self.rotors
        body.update(self.scene.weather.wind)
        wanted = None if self.battery.empty else self.pilot.fly(self.motion())
        if wanted is None:
            rotors.stop()
        else:
            rotors.command(*wanted)
        thrust, torque = rotors.step()
        weight = self.parameters.body.mass * GRAVITY
        dx, dy, dz = self.parameters.body.drag
        u, v, w = body.through
        ux, uy, uz = body.axes[6:]
        force = (-weight * ux - dx * u, -weight * uy - dy * v, thrust - weight * uz - dz * w)
        body.apply(force, torque)

    def after_step(self) -> None:
        """Update with the result of the physics step, and feed the motors."""
        super().after_step()
        if self.grounded:
            self.dynamics.update((0.0, 0.0, 0.0))
            self.pilot.touched(self.motion())
        if self._step % WORK_STEPS == 0:
            period = WORK_STEPS / STEPS_PER_SECOND
            self.battery.feed(self.motors.work(self.rotors.speeds, self.rotors.torques, period), period)
            if self.battery.charge < LANDING_CHARGE and self.pilot.phase == "flying":
                self.manoeuvre(Manoeuvre(kind="land"))

    def _measure_flight(self, state: State, stamp: float) -> Iterator[Measurement]:
        header, phase = Header(Time.at(stamp), "map"), self.pilot.phase
        if phase == "landed" and rotate(state.rotation, (0.0, 0.0, 1.0))[2] < MIN_UPRIGHT:
            phase = "turned_over"
        yield "/flight", FlightState(header, phase, self._height.last, state.velocity[2])


ARDRONE = Model(Ardrone, PARAMETERS, looks, "air")
"""All that is needed to make one."""
