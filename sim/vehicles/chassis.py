"""The common part of all vehicles: a body, its sensors, its bumper, and the orders that it takes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import ClassVar, Generic, Protocol, TypeVar

import msgspec

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import STEPS_PER_SECOND
from sim.core.shapes import Shape
from sim.physics.backend_bullet import State
from sim.physics.motors import Motors
from sim.sensors.battery import Battery
from sim.sensors.bumper import BumperRing
from sim.sensors.imu import InertialUnit
from sim.sensors.reckoning import DeadReckoning, ReckoningParameters
from sim.sensors.suite import Measure, Measurement, SensorSuite, as_odometry
from sim.vehicles.charging import ChargingContacts
from sim.vehicles.parameters import Parameters
from sim.vehicles.scene import Scene
from sim.vehicles.start_places import places
from sim.world.tables import Dock, Start

__all__ = ["Chassis"]

MANOEUVRE_RATE, MOTORS_RATE = 10.0, 5.0
CONTACTS_STEPS = STEPS_PER_SECOND // 20
"""Steps between two looks whether charging contacts meet."""
RESET_CLEARANCE = 0.05
"""Kept free round a robot that is put back [m]."""


class Odometer(Protocol):
    """An estimate of a vehicle's own motion."""

    def restart(self, pose: tuple[float, float, float]) -> None:
        """Believe to be at x, y [m], yaw [rad] in `odom`."""


P = TypeVar("P", bound=Parameters)


class Chassis(Generic[P]):
    """A vehicle of the figures `P`; each kind has a subclass with its drive, its forces and its sensors."""

    MANOEUVRES: ClassVar[tuple[str, ...]] = ("twist", "rest")
    """The orders that it knows."""

    def __init__(self, scene: Scene, parameters: P, body: int) -> None:
        """At rest; `body` is its number in the physics."""
        self.scene, self.parameters, self.body = scene, parameters, body
        self.bumper = BumperRing()
        self.suite = SensorSuite()
        self.cameras = list(parameters.cameras)
        self.laser_x = 0.0
        """Distance of its laser ahead of `base_link` [m]."""
        self.attached: list[Callable[[], tuple[Shape, ...]]] = []
        self.battery = Battery(parameters.battery, parameters.charging.current)
        self._contacts = ChargingContacts(parameters.charging, scene.world.docks)
        self.motors: Motors
        self.order = Manoeuvre(kind="rest")
        """The order that it follows."""
        self.odometer: Odometer | None = None
        """Its estimate of its own motion; None for a vehicle without one."""
        home = scene.backend.state(body)
        self._home = home.position, home.rotation
        self.raft = -1
        """Number of the raft that it stands on where there is no ground, and which is no obstacle; -1 for none."""
        self.landings: frozenset[int] = frozenset()
        """Numbers of the bodies that it lands on, and which are no obstacles for it."""
        self.grounded = False
        """Its shell touches the ground or something else."""
        self.dock: Dock | None = None
        """The dock whose contacts it touches; None when it touches none."""
        self._step = 0

    @property
    def heights(self) -> tuple[float, float]:
        """The lowest and the highest at which it can be, above the map's origin [m]; of one that keeps no height, any."""
        return -math.inf, math.inf

    def drive(self, twist: Twist) -> None:
        """Go for `twist` until the next order."""
        self.manoeuvre(Manoeuvre(kind="twist", twist=twist))

    def stop(self) -> None:
        """Come to rest."""
        self.manoeuvre(Manoeuvre(kind="rest"))

    def manoeuvre(self, order: Manoeuvre) -> None:
        """Move by `order` until the next order; ValueError with one sentence when it cannot, which changes nothing."""
        known = self.MANOEUVRES
        if order.kind not in known:
            name = self.parameters.info.name
            raise ValueError(f"{name} knows no manoeuvre {order.kind!r}; it knows {', '.join(known)}.")
        self.begin(order)
        self.order = order

    def reset(self) -> None:
        """Go back to the start, at rest, and believe to be there; beside it when another robot stands there by now.

        ValueError with one sentence when there is no room, which changes no more than that it stands still.
        """
        backend, (x, y, z), rotation = self.scene.backend, *self._home
        start, was = self.scene.start, self.state()
        for place in self._starts(z):
            aside = place.x - start.x, place.y - start.y
            backend.place(self.body, (x + aside[0], y + aside[1], z), rotation)
            if not backend.is_crowded(self.body, RESET_CLEARANCE, but=self.raft):
                break
        else:
            backend.place(self.body, was.position, was.rotation)
            raise ValueError(f"{self.parameters.info.name} is not put back: there is no room at its start.")
        if self.odometer is not None:
            self.odometer.restart((place.x, place.y, start.angle))
        self.stop()
        self.halt()

    def _starts(self, height: float) -> Iterator[Start]:
        """Its start, and the places beside it; where there is no ground but a raft, that alone."""
        scene, radius = self.scene, self.parameters.radius
        if self.raft >= 0:
            return iter((scene.start,))
        return places(scene.world, scene.start, radius, height)

    def held(self) -> Manoeuvre:
        """The order that it follows, with the heading and the height that it keeps where the order names none."""
        return self.order

    @property
    def stands(self) -> bool:
        """It knows that it stands on the ground, motors off, so that its speed log is ignored."""
        return False

    def halt(self) -> None:
        """Let wheels, fins, propellers and rotors stand still at once, as they never do by themselves."""
        raise NotImplementedError

    def begin(self, order: Manoeuvre) -> None:
        """Take up an order of a known kind."""
        raise NotImplementedError

    def before_step(self) -> None:
        """Act on the body for the physics step that follows."""
        raise NotImplementedError

    def after_step(self) -> None:
        """Update with the result of the physics step."""
        self._step += 1
        backend = self.scene.backend
        touched = backend.touching(self.body)
        footing = (backend.ground, self.raft, *self.landings)
        contacts = [contact for contact in touched if contact.body not in footing]
        if self._step % CONTACTS_STEPS == 0:
            self._meet_dock()
        self.grounded = bool(touched)
        self.bumper.update(self._step, contacts, self.state() if contacts else None)

    def _meet_dock(self) -> None:
        """Connect the battery to the dock that it touches, and to none when it touches none."""
        self.dock = dock = self._contacts.dock_at(self.state()) if self.may_charge else None
        if dock is None:
            self.battery.connect(None)
        else:
            self.battery.connect(dock.power if dock.name not in self.scene.dead_docks else 0.0)

    @property
    def may_charge(self) -> bool:
        """Its contacts are where a dock's can meet them: those of one that flies are not before it has landed."""
        return True

    def state(self) -> State:
        """True pose and motion, in `map`."""
        return self.scene.backend.state(self.body)

    @property
    def has_measurements(self) -> bool:
        """`measure` has something to give after this step; else it need not be called."""
        return self.bumper.changed or self.battery.changed or self.suite.anything_due(self._step)

    def measure(self, stamp: float, *, truth: bool) -> Iterator[Measurement]:
        """Measurements that are due after this step, with `stamp` [s]; ground truth only when `truth` asks for it."""
        if self.bumper.changed and not self.suite.is_due("bumper", self._step):
            yield "/bumper", self.bumper.message(stamp)
        if self.battery.changed and not self.suite.is_due("battery", self._step):
            yield "/battery_state", self.battery.message(stamp)
        for topic, message in self.suite.measure(self._step, self.state, stamp):
            if truth or topic != "/sim/ground_truth":
                yield topic, message

    def add_bumper_and_imu(self) -> None:
        """Add the bumper and the inertial unit."""
        parameters = self.parameters
        imu = InertialUnit(parameters.imu, self.scene.generator("imu"))
        self.suite.add("bumper", parameters.bumper.rate, self._measure_bumper)
        self.suite.add("imu", parameters.imu.rate, lambda state, at: [("/imu/data", imu.measure(state, at))])

    def add_reckoning(self, figures: ReckoningParameters) -> None:
        """Add the odometry of a vehicle without wheels."""
        start = self.scene.start
        self.odometer = reckoning = DeadReckoning(
            figures, (start.x, start.y, start.angle), self.scene.generator("reckoning")
        )
        self.suite.add("odometry", figures.rate, self._reckon(reckoning))

    def _reckon(self, reckoning: DeadReckoning) -> Measure:
        return lambda state, at: [("/odom", reckoning.measure(state, at, stands=self.stands))]

    def add_power(self) -> None:
        """Add the messages of motors and battery."""
        rate = self.parameters.battery.rate
        self.suite.add("motors", MOTORS_RATE, lambda _, at: [("/motors", self.motors.message(at))])
        self.suite.add("battery", rate, lambda _, at: [("/battery_state", self.battery.message(at))])

    def add_truth(self) -> None:
        """Add the ground truth."""
        self.suite.add(
            "truth",
            self.parameters.truth.rate,
            lambda state, stamp: [("/sim/ground_truth", as_odometry(state, stamp))],
        )

    def add_order(self) -> None:
        """Add the message of the order that it follows."""
        self.suite.add("manoeuvre", MANOEUVRE_RATE, self._measure_order)

    def _measure_bumper(self, _: State, stamp: float) -> Iterator[Measurement]:
        """A change is also published at once, by `measure`."""
        yield "/bumper", self.bumper.message(stamp)

    def _measure_order(self, state: State, stamp: float) -> Iterator[Measurement]:
        yield "/manoeuvre", msgspec.structs.replace(self.held(), header=Header(Time.at(stamp), "map"))
