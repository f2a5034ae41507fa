"""A simulated robot as the robot side sees it: the same five verbs as a real one.

robot = make("patrol", "parking_lot", seed=1)
for topic, message in robot.read(now): ...
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from sim.backend_bullet import STEPS_PER_SECOND
from sim.camera import Camera
from sim.occupancy import occupancy
from sim.simulation import Simulation
from sim.vehicles.aqua import AQUA
from sim.vehicles.ardrone import ARDRONE
from sim.vehicles.commander import COMMANDER
from sim.vehicles.minnow import MINNOW
from sim.vehicles.model import Model
from sim.vehicles.patrol import PATROL
from sim.vehicles.scout import SCOUT
from sim.world import WORLDS, load

__all__ = ["ROBOTS", "WORLDS", "SimRobot", "make", "model_of"]

ROBOTS: dict[str, Model] = {
    "patrol": PATROL,
    "scout": SCOUT,
    "commander": COMMANDER,
    "minnow": MINNOW,
    "aqua": AQUA,
    "ardrone": ARDRONE,
}
"""The robots that can be simulated, by name."""

CAMERA_TOPIC = "/camera/image/compressed"
TRUTH_TOPIC = "/sim/ground_truth"

_SLACK = 1e-3
"""Part of a step by which `now` may fall short of it: the clock's own rounding is no reason to wait."""


class SimRobot:
    """Fits `robotside.robot.Robot`.

    Nothing moves between calls: `read(now)` does all the physics up to `now`. It never skips any, so a caller in real
    time that was held up for long gets the whole backlog computed in one call (about a fiftieth of its length without
    camera); to bound a call, hand it a `now` that is at most a little after the last one.
    Not thread-safe; calls may come from different threads, one at a time.
    """

    trouble = ""
    """It is always at hand."""

    def __init__(self, simulation: Simulation, *, camera: bool) -> None:
        """The robot of `simulation`, which it owns from now on."""
        self.simulation = simulation
        """The truth, for tests and benches."""
        self._wanted: set[str] = set()
        self._origin: float | None = None
        self.info = info_of(simulation, camera=camera)
        """Who it is."""
        cameras = simulation.vehicle.parameters.cameras
        self._camera = Camera(simulation.world, cameras[0]) if camera and cameras else None

    def drive(self, twist: Twist) -> None:
        """Go for `twist` in `base_link`, within its limits, until the next `drive` or `stop`."""
        self.manoeuvre(Manoeuvre(kind="twist", twist=twist))

    def manoeuvre(self, order: Manoeuvre) -> None:
        """Move by `order`, within its limits, until told otherwise; `info.manoeuvres` names the kinds that it knows.

        ValueError with one sentence for what it cannot do or what is no number; it then goes on as before.
        """
        _check(order)
        self.simulation.vehicle.manoeuvre(order)

    def stop(self) -> None:
        """Brake to rest as hard as the drive does."""
        self.simulation.vehicle.stop()

    def want(self, topic: str, wanted: bool) -> None:
        """Measure an on-demand topic or no longer; other topics always come."""
        if wanted:
            self._wanted.add(topic)
        else:
            self._wanted.discard(topic)

    def read(self, now: float) -> list[tuple[str, Msg]]:
        """Simulate up to `now` [s, robot clock] and give everything measured on the way, oldest first.

        The first call sets the origin, simulates nothing and gives the map and one message of each sensor. A `now`
        before the last one gives nothing.
        """
        if self._origin is None:
            self._origin = now
            return [("/map", occupancy(self.simulation.world, now)), *self._measure()]
        goal = int((now - self._origin) * STEPS_PER_SECOND + _SLACK)
        measured: list[tuple[str, Msg]] = []
        while self.simulation.steps < goal:
            self.simulation.advance()
            measured.extend(self._measure())
        if self._camera is not None:
            measured.extend((CAMERA_TOPIC, image) for image in self._camera.collect())
        return measured

    def close(self) -> None:
        """Free everything; closing twice does nothing."""
        if self._camera is not None:
            self._camera.close()
        self.simulation.close()

    def _measure(self) -> Iterator[tuple[str, Msg]]:
        simulation = self.simulation
        stamp = (self._origin or 0.0) + simulation.time
        yield from simulation.vehicle.measure(stamp, truth=TRUTH_TOPIC in self._wanted)
        if self._camera is not None and self._camera.due(simulation.steps) and CAMERA_TOPIC in self._wanted:
            for image in self._camera.shoot(simulation.vehicle.state(), stamp):
                yield CAMERA_TOPIC, image


def _check(order: Manoeuvre) -> None:
    """Raise ValueError when a part of `order` that must be a number is none, or one that may be NaN is infinite."""
    linear, angular = order.twist.linear, order.twist.angular
    needed = {
        "twist": (linear.x, linear.y, linear.z, angular.x, angular.y, angular.z),
        "steering": (order.steering,),
        "roll": (order.roll,),
        "pitch": (order.pitch,),
    }
    free = {"speed": order.speed, "throttle": order.throttle, "yaw": order.yaw, "height": order.height}
    wrong = [name for name, values in needed.items() if not all(map(math.isfinite, values))]
    wrong += [name for name, value in free.items() if math.isinf(value)]
    if wrong:
        raise ValueError(f"The {wrong[0]} of an order must be a number; the robot goes on as before.")


def info_of(simulation: Simulation, *, camera: bool) -> RobotInfo:
    """Who the simulated robot is, as it tells the handheld."""
    parameters, world = simulation.vehicle.parameters, simulation.world
    return RobotInfo(
        name=parameters.info.name,
        kind=parameters.info.kind,
        model=parameters.info.model,
        description=parameters.info.description,
        world=world.name,
        max_speed=parameters.limits.speed,
        max_yaw_rate=parameters.limits.yaw_rate,
        radius=parameters.radius,
        cameras=[each.name for each in parameters.cameras] if camera else [],
        latitude=world.datum.latitude,
        longitude=world.datum.longitude,
        camera_fov=parameters.cameras[0].field_of_view if parameters.cameras else math.nan,
        manoeuvres=list(simulation.vehicle.MANOEUVRES),
    )


def model_of(robot: str) -> Model:
    """What makes the `robot` of this name; ValueError with one sentence when there is none."""
    if robot not in ROBOTS:
        raise ValueError(f"There is no simulated robot {robot!r}; there is {', '.join(ROBOTS)}.")
    return ROBOTS[robot]


def make(
    robot: str, world: str, *, seed: int = 0, gui: bool = False, camera: bool = True, noise: bool = True
) -> SimRobot:
    """A simulated `robot` in `world`, either one of the names in `ROBOTS` and `WORLDS` or the path of a world's file.

    `seed` decides every random error; `noise` False turns them off. `gui` opens the engine's window.
    Raises ValueError with one sentence for an unknown name or a faulty file.
    """
    model = model_of(robot)
    return SimRobot(Simulation(load(world), model, seed=seed, noise=noise, gui=gui), camera=camera)
