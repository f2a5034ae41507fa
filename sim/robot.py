"""A simulated robot as the robot side sees it: the same five verbs as a real one.

robot = make("patrol", "parking_lot", seed=1)
for topic, message in robot.read(now): ...
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence

import msgspec

from bridge.core.codes import Code
from bridge.msgs import Msg
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point, Point32, Pose, Quaternion, Twist
from bridge.msgs.pilothouse_msgs import Event, Manoeuvre, Place, RobotInfo
from sim.core.order_limits import check, cut
from sim.payloads import PAYLOADS, laden, mount, reach
from sim.simulation.cameras import CAMERA_TOPIC, Cameras
from sim.simulation.mishaps import Mishaps
from sim.simulation.shared_run import SharedRun
from sim.simulation.simulation import Simulation
from sim.vehicles.aqua import AQUA
from sim.vehicles.ardrone import ARDRONE
from sim.vehicles.charging import docked
from sim.vehicles.commander import COMMANDER
from sim.vehicles.minnow import MINNOW
from sim.vehicles.model import Model, Vehicle, numbered, suits
from sim.vehicles.patrol import PATROL
from sim.vehicles.scout import SCOUT
from sim.vehicles.start_places import starts
from sim.world.occupancy import occupancy
from sim.world.tables import Start
from sim.world.world import World
from sim.world.world_files import WORLDS, load

__all__ = [
    "CAMERA_TOPIC",
    "PAYLOADS",
    "ROBOTS",
    "WORLDS",
    "SimRobot",
    "home_of",
    "make",
    "make_several",
    "model_of",
]

ROBOTS: dict[str, Model] = {
    "patrol": PATROL,
    "scout": SCOUT,
    "commander": COMMANDER,
    "minnow": MINNOW,
    "aqua": AQUA,
    "ardrone": ARDRONE,
}
"""The robots that can be simulated, by name."""

TRUTH_TOPIC = "/sim/ground_truth"
MAX_UNREAD = 50_000
"""Messages that are kept of a robot that is not read while others in its world are; the oldest go first."""


_START_TOLERANCE = 0.1
"""Distance from its start within which it counts as standing there [m]."""


class SimRobot:
    """Fits `robotside.core.robot.Robot`.

    Nothing moves between calls: `read(now)` does all the physics up to `now`. It never skips any by itself, so a caller in real
    time that was held up for long gets the whole backlog computed in one call (without camera about a thirtieth of its
    length for one robot, most of it for twenty); to bound a call, hand it a `now` that is at most a little after the last one,
    and tell it by `skip_to` of time that is given up.
    Robots that share a world move on together, whichever of them is read.
    Not thread-safe; calls may come from different threads, one at a time.
    """

    trouble = ""
    """It is always at hand."""

    def __init__(
        self,
        simulation: Simulation | SharedRun,
        *,
        camera: bool,
        number: int = 0,
        payloads: Sequence[str] = (),
    ) -> None:
        """A robot of `simulation`, which it owns from now on, alone or with the others of the run.

        `payloads` are mounted on it; ValueError with one sentence when one cannot be.
        """
        self._run = simulation if isinstance(simulation, SharedRun) else SharedRun(simulation)
        self.simulation = self._run.simulation
        """The truth, for tests and benches."""
        self._number = number
        self._vehicle = self.simulation.vehicles[number]
        self._wanted: set[str] = set()
        self._met = False
        self._unread: deque[tuple[str, Msg]] = deque(maxlen=MAX_UNREAD)
        self._excess = ""
        self.payloads = mount(self._vehicle, payloads) if payloads else {}
        """Its payloads, by name."""
        self.info = info_of(self._vehicle, self.simulation.world, camera=camera)
        self.info = msgspec.structs.replace(self.info, payloads=list(payloads))
        """Its description."""
        self._mishaps = Mishaps(self._vehicle.parameters.info, self._vehicle.scene)
        self._cameras = Cameras(self.simulation, number) if camera else None
        self._run.join(self._collect)

    @property
    def places(self) -> list[Place]:
        """The places of its world that have names, as a robot side may take them over; their ids are 0.

        Its docks are among them: where it stands when its contacts meet theirs, and the way that it faces then.
        """
        charging = self._vehicle.parameters.charging
        return [
            Place(
                name=entry.name,
                kind=entry.kind,
                floor=entry.floor,
                x=entry.x,
                y=entry.y,
                yaw=entry.angle,
                tag=entry.tag,
                note=entry.note,
            )
            for entry in self.simulation.world.places
        ] + [
            Place(name=dock.name, kind="dock", x=x, y=y, yaw=yaw, height=height)
            for dock in self.simulation.world.docks
            if dock.kind == charging.dock
            for x, y, yaw, height in [docked(charging, dock)]
        ]

    @property
    def heights(self) -> tuple[float, float]:
        """The lowest and the highest at which it can be, above the map's origin [m]."""
        return self._vehicle.heights

    def drive(self, twist: Twist) -> None:
        """Go for `twist` in `base_link`, within its limits, until the next `drive` or `stop`."""
        self.manoeuvre(Manoeuvre(kind="twist", twist=twist))

    def manoeuvre(self, order: Manoeuvre) -> None:
        """Move by `order`, within its limits, until the next order; `info.manoeuvres` names the kinds that it knows.

        A value beyond its limits is cut to them, with an event on `/events`. ValueError with one sentence for an order that it
        cannot follow or that has a value that is no number; it then goes on as before.
        """
        check(order, self.info)
        order, excess = cut(order, self.info, self.heights)
        self._vehicle.manoeuvre(order)
        if excess and not self._excess:
            self._report(Code.ORDER_CUT, excess, "info", robot=self.info.name)
        self._excess = excess

    def stop(self) -> None:
        """Brake to rest as hard as the drive does; what flies stays in the air."""
        self._vehicle.stop()

    def command(self, payload: str, order: Msg) -> None:
        """Give an order to a mounted payload; ValueError with one sentence when it is not there or cannot follow it."""
        if payload not in self.payloads:
            raise ValueError(f"{self.info.name} has no {payload.replace('_', ' ')}.")
        self.payloads[payload].command(order)

    def hold_payloads(self) -> None:
        """An arm that moves stays as it is now, and so does its gripper."""
        for payload in self.payloads.values():
            payload.hold()

    def reset(self) -> Pose:
        """Put it back to where it started, at rest, with fresh odometry: for one that turned over, sank or went astray.

        When another robot stands there by now, it stands beside it, with an event on `/events`. Returns where it stands,
        in `map`. ValueError with one sentence when there is no room.
        """
        self._vehicle.reset()
        self._mishaps.clear()
        self._excess = ""
        self._unread = deque((entry for entry in self._unread if entry[0] == "/events"), maxlen=MAX_UNREAD)
        state, start = self._vehicle.state(), self._vehicle.scene.start
        aside = math.dist(state.position[:2], (start.x, start.y))
        if aside > _START_TOLERANCE:
            name = self.info.name
            said = f"There is no room at the start of {name}: it stands {aside:.1f} m beside it."
            self._report(Code.ROBOT_BESIDE_START, said, "warn", robot=name, aside=f"{aside:.1f}")
        return Pose(Point(*state.position), Quaternion(*state.rotation))

    def _report(self, code: Code, text: str, level: str, **parameters: str) -> None:
        """Put an event on `/events`."""
        pairs = [KeyValue(key, value) for key, value in parameters.items()]
        event = Event(level=level, kind="robot", text=text, code=code.value, parameters=pairs)
        self._unread.append(("/events", event))

    def want(self, topic: str, wanted: bool) -> None:
        """Measure an on-demand topic or no longer; other topics always come."""
        if wanted:
            self._wanted.add(topic)
        else:
            self._wanted.discard(topic)

    def switch(self, topic: str, on: bool) -> None:
        """Measure what comes on `topic`, or no longer; pictures are made for who wants them."""
        self._vehicle.suite.switch(topic, on)

    def read(self, now: float) -> list[tuple[str, Msg]]:
        """Simulate up to `now` [s, robot clock] and give everything measured on the way, oldest first.

        The first call sets the origin, simulates nothing and gives the map and one message of each sensor. A `now`
        before the last one gives nothing.
        """
        if not self._met:
            self._met = True
            self._run.advance(now)
            self._unread.clear()
            top = self._vehicle.parameters.deck[2]
            return [("/map", occupancy(self.simulation.world, now, height=top)), *self._measure()]
        self._run.advance(now)
        measured = [*self._unread]
        self._unread.clear()
        if self._cameras is not None:
            measured.extend(self._cameras.collect())
        return measured

    def skip_to(self, now: float) -> None:
        """Nothing happened from the last `read` to `now` [s, robot clock], in all of its world: it goes on from there."""
        self._run.skip_to(now)

    def close(self) -> None:
        """Free everything, the world too when no other robot is in it; closing twice does nothing."""
        if self._cameras is not None:
            self._cameras.close()
        self._run.leave(self._collect)

    def _collect(self) -> None:
        if self._met and self._has_work():
            self._unread.extend(self._measure())

    def _has_work(self) -> bool:
        """Whether something is measured after this step: mostly nothing is."""
        return (
            self._vehicle.has_measurements
            or self._mishaps.is_due(self.simulation.steps)
            or not (self._cameras is None or self._cameras.are_idle(self._wanted))
        )

    def _measure(self) -> Iterator[tuple[str, Msg]]:
        simulation, vehicle, stamp = self.simulation, self._vehicle, self._run.now
        yield from vehicle.measure(stamp, truth=TRUTH_TOPIC in self._wanted)
        if self._mishaps.is_due(simulation.steps):
            for event in self._mishaps.update(vehicle.state(), vehicle.dock):
                yield "/events", event
        if self._cameras is not None:
            yield from self._cameras.shoot(self._wanted, stamp)


def info_of(vehicle: Vehicle, world: World, *, camera: bool) -> RobotInfo:
    """Description of the simulated robot for the handheld."""
    parameters = vehicle.parameters
    return RobotInfo(
        name=parameters.info.name,
        kind=parameters.info.kind,
        model=parameters.info.model,
        description=parameters.info.description,
        world=world.name,
        max_speed=parameters.limits.speed,
        max_yaw_rate=parameters.limits.yaw_rate,
        radius=max(parameters.radius, reach(vehicle)),
        cameras=[each.name for each in vehicle.cameras] if camera else [],
        latitude=world.datum.latitude,
        longitude=world.datum.longitude,
        camera_fov=vehicle.cameras[0].field_of_view if vehicle.cameras else math.nan,
        manoeuvres=list(vehicle.MANOEUVRES),
        max_climb=parameters.max_climb,
        max_tilt=parameters.max_tilt,
        max_steering=parameters.max_steering,
        min_radius=parameters.min_radius,
        laser_x=vehicle.laser_x,
        footprint=[Point32(x, y) for x, y in parameters.footprint],
    )


def model_of(robot: str) -> Model:
    """The model that makes the `robot` of this name; ValueError with one sentence when there is none."""
    if robot not in ROBOTS:
        raise ValueError(f"There is no simulated robot {robot!r}; there is {', '.join(ROBOTS)}.")
    return ROBOTS[robot]


def make(
    robot: str,
    world: str,
    *,
    seed: int = 0,
    gui: bool = False,
    camera: bool = True,
    noise: bool = True,
    payloads: Sequence[str] = (),
) -> SimRobot:
    """A simulated `robot` in `world`, either one of the names in `ROBOTS` and `WORLDS` or the path of a world's file.

    `seed` decides every random error; `noise` False turns them off. `gui` opens the engine's window. `payloads` are
    names of `PAYLOADS` that are mounted on it.
    Raises ValueError with one sentence for an unknown name or a faulty file.
    """
    model = laden(model_of(robot), payloads)
    simulation = Simulation(load(world), model, seed=seed, noise=noise, gui=gui)
    try:
        return SimRobot(simulation, camera=camera, payloads=payloads)
    except ValueError:
        simulation.close()
        raise


def make_several(
    robots: Sequence[str | tuple[str, Start]],
    world: str,
    *,
    seed: int = 0,
    gui: bool = False,
    camera: bool = True,
    noise: bool = True,
    payloads: Sequence[Sequence[str]] = (),
    draws_beside: bool = False,
) -> list[SimRobot]:
    """Several robots in one `world`, each by its name or with the place where it starts; they see and bump into each other.

    Those without a place stand beside the world's own start, where there is room. The second one of a kind is called
    `Patrol-2`, and so on. `payloads` has the names of what each carries, in their order; empty for nothing. `draws_beside` has
    pictures drawn in a process of their own, a little later and not the same in each run: where time is real.
    Raises ValueError like `make`.
    """
    loaded = load(world)
    entries = [(entry, None) if isinstance(entry, str) else entry for entry in robots]
    if not entries:
        raise ValueError("A world needs one robot at least.")
    carried = payloads or [()] * len(entries)
    models = numbered([model_of(name) for name, _ in entries])
    models = [laden(model, names) for model, names in zip(models, carried, strict=True)]
    placed = zip(models, starts(loaded, models, [start for _, start in entries]), strict=True)
    run = SharedRun(Simulation(loaded, *placed, seed=seed, gui=gui, noise=noise, draws_beside=draws_beside))
    made: list[SimRobot] = []
    try:
        for number, names in zip(range(len(models)), carried, strict=True):
            made.append(SimRobot(run, camera=camera, number=number, payloads=names))
    except ValueError:
        for robot in made:
            robot.close()
        run.simulation.close()
        raise
    return made


def home_of(robots: Sequence[str]) -> str:
    """The world that suits the `robots` of these names best: the home of one of them.

    ValueError with one sentence when there is none in which all of them can be.
    """
    models = [model_of(name) for name in robots]
    homes = list(dict.fromkeys(model.home for model in models))
    for home in homes:
        if all(suits(model, load(home)) for model in models):
            return home
    raise ValueError(
        f"There is no world for {' and '.join(dict.fromkeys(robots))} together: some need dry land, some water."
    )
