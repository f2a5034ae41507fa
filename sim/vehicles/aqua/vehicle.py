"""The aqua: a swimmer with six fins, depth gauge, compass and camera."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.sensor_msgs import JointState
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import STEPS_PER_SECOND
from sim.core.shapes import Shape, from_yaw
from sim.dynamics.fins import LEGS, Fins
from sim.dynamics.sixdof import SixDof
from sim.dynamics.swimmer import BuoyantBox, SwimmerBody, inertia_of
from sim.physics.backend_bullet import State
from sim.physics.bodies import Floating
from sim.physics.motors import Motors
from sim.sensors.compass import FILTER_RATE, Compass
from sim.sensors.depth import DepthGauge
from sim.sensors.suite import Measurement
from sim.vehicles.aqua.looks import looks
from sim.vehicles.aqua.parameters import PARAMETERS, AquaParameters
from sim.vehicles.aqua.pilot import Pilot
from sim.vehicles.chassis import Chassis
from sim.vehicles.model import Model
from sim.vehicles.scene import Scene

__all__ = ["AQUA", "Aqua"]


WORK_STEPS = STEPS_PER_SECOND // 20
LEGS_RATE = 20.0


def body_of(body: SwimmerBody) -> Floating:
    """The rigid body that the physics needs."""
    shell = Shape("box", (body.length, body.width, body.height))
    return Floating(shell, body.mass, body.inertia, (0.0, 0.0, 0.0), body.friction)


class Aqua(Chassis[AquaParameters]):
    """The swimmer in the water of a world."""

    MANOEUVRES: ClassVar[tuple[str, ...]] = ("twist", "course", "tilt", "hover", "surface", "rest")

    def __init__(self, scene: Scene, parameters: AquaParameters) -> None:
        """Lie still at the start; where that is not under water, at the surface."""
        start, own = scene.start, parameters.body
        afloat = own.height / 2 - own.height / own.buoyancy
        at = (start.x, start.y, min(start.z, afloat))
        body = scene.backend.add_floating(body_of(own), at, from_yaw(start.angle))
        super().__init__(scene, parameters, body)
        self.float = BuoyantBox(own, scene.weather)
        self.dynamics = SixDof(scene.backend, body, inertia_of(own))
        self.fins = Fins(parameters.fins, scene.weather.density)
        self._pilot = Pilot(parameters, self.float.drag[0])
        self.motors = Motors(parameters.motor, LEGS)
        self._add_sensors()

    def _add_sensors(self) -> None:
        parameters, scene, suite = self.parameters, self.scene, self.suite
        self._compass = Compass(parameters.compass, scene.generator("compass"))
        depth = DepthGauge(parameters.depth, scene.weather, scene.generator("depth"))
        self.add_bumper_and_imu()
        self.add_reckoning(parameters.reckoning)
        suite.add("compass", FILTER_RATE, self._compass.messages)
        suite.add("depth", parameters.depth.rate, lambda state, at: [("/depth", depth.measure(state, at))])
        suite.add("legs", LEGS_RATE, self._measure_legs)
        self.add_power()
        self.add_order()
        self.add_truth()

    @property
    def heights(self) -> tuple[float, float]:
        """From over the ground, or from as deep as it is built for, to the surface [m]."""
        body = self.parameters.body
        return max(-body.rated_depth, self.scene.world.bottom + body.height), 0.0

    def begin(self, order: Manoeuvre) -> None:
        """Take up a twist, a course, a tilt, holding depth and heading, surfacing, or lying still."""
        self.dynamics.update(self.scene.weather.current)
        self._pilot.begin(order, self.dynamics, fresh=order.kind != self.order.kind)

    def held(self) -> Manoeuvre:
        """The order that it follows, with the heading and the depth that it keeps where the order names none."""
        return self._pilot.held

    def halt(self) -> None:
        """Let the fins stand still at once."""
        self._compass.restart()
        self.fins.amplitudes = [0.0] * len(LEGS)
        self.fins.rest()

    def before_step(self) -> None:
        """Let the fins follow the order, and the water act on the body."""
        body, fins = self.dynamics, self.fins
        body.update(self.scene.weather.current)
        wanted = None
        if not self.battery.empty:
            resting = self.order.kind == "rest"
            wanted = self._pilot.braking(body) if resting else self._pilot.wrench(body, self.float.wet)
        if wanted is None:
            fins.rest()
        else:
            fins.command(*wanted)
        (fx, fy, fz), (mx, my, mz) = self.float.forces(body)
        (ahead, up), (roll, pitch, yaw) = fins.step()
        wet = self.float.wet
        body.apply((fx + wet * ahead, fy, fz + wet * up), (mx + wet * roll, my + wet * pitch, mz + wet * yaw))

    def after_step(self) -> None:
        """Update with the result of the physics step, and feed the motors."""
        super().after_step()
        if self._step % WORK_STEPS == 0:
            period = WORK_STEPS / STEPS_PER_SECOND
            self.battery.feed(self.motors.work(self.fins.speeds, self.fins.torques, period), period)

    def _measure_legs(self, _: State, stamp: float) -> Iterator[Measurement]:
        names = [f"{leg}_leg_joint" for leg in LEGS]
        header = Header(Time.at(stamp), "base_link")
        yield (
            "/joint_states",
            JointState(header, names, Float64Array(self.fins.angles), Float64Array(self.fins.speeds)),
        )


AQUA = Model(Aqua, PARAMETERS, looks, "water", home="tank")
"""All that is needed to make one."""
