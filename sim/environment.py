"""An environment of Gymnasium: a simulated robot that is to drive to a place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, SupportsFloat

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.shapes import Shape, from_yaw, rotate_back, yaw_of
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.robot import SimRobot, home_of, make_several, model_of
from sim.training.free_places import FreePlaces
from sim.training.measurements import Measurements
from sim.world.tables import Start
from sim.world.world import World
from sim.world.world_files import load

__all__ = ["DriveToGoal"]

PERIOD = 0.1
"""Of one step [s]."""
REACHED = 0.3
"""The robot is at its goal when its middle is within this, beyond its own radius [m]."""
BUMP_COST, REACHED_REWARD, STEP_COST = 5.0, 10.0, 0.01
"""Of the reward, in metres that it came nearer."""
SPARE_ROOM = 0.1
"""Kept free round a robot at starts and goals [m]."""
TAKE_OFF_HEIGHT, TAKE_OFF_TIMEOUT = 1.5, 20.0
"""Where an episode of what flies begins [m], and how long it may take to get there [s]."""
GOAL_COLOUR = (0.1, 0.7, 0.2)
RENDERED_WIDTH = 800
"""Of a picture [px]."""

Observation = dict[str, NDArray[np.float32]]


class DriveToGoal(gymnasium.Env[Observation, NDArray[np.float32]]):
    """One robot that starts at any free place and is to get to another one that it can reach; a bump ends the episode.

    Actions are speeds as parts of the robot's limits, -1 to 1: ahead and turning left, then up for what dives or flies,
    then left for what flies. Observations are `goal`, from `base_link` ahead, left and up [m], `velocity` and, with a laser or
    sonars, `ranges`. `goal` is true; the rest is measured, with the sensors' errors. The reward is how much nearer the robot
    came [m], less `STEP_COST`, less `BUMP_COST` for a bump, and `REACHED_REWARD` more at the goal. `info` has the true `pose` (x, y, z [m],
    yaw [rad]) and the `goal` in `map`, `is_success` and `bumped`. The same seed gives the same episode, bit for bit.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": round(1 / PERIOD)}

    def __init__(
        self,
        robot: str,
        world: str = "",
        *,
        payloads: Sequence[str] = (),
        distance: tuple[float, float] = (2.0, 8.0),
        time_limit: float = 60.0,
        noise: bool = True,
        render_mode: str | None = None,
    ) -> None:
        """A `robot` of `sim.robot.ROBOTS` in `world`, a name or a file, by default its home.

        Goals are `distance` from its start, at least and at most [m]; an episode is cut off after `time_limit` [s]. `noise` False
        turns the sensors' errors off. ValueError with one sentence for a name or a value that is none.
        """
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode is None or rgb_array, not {render_mode!r}.")
        near, far = distance
        if not 0 < near < far < math.inf:
            raise ValueError(
                f"distance is the least and the most, above 0 and in this order, not {distance}."
            )
        if not PERIOD <= time_limit < math.inf:
            raise ValueError(f"time_limit is at least {PERIOD:g} s, not {time_limit:g}.")
        self.render_mode = render_mode
        self._model, self._name = model_of(robot), robot
        self._world_name = world or home_of([robot])
        self._world: World = load(self._world_name)
        self._payloads, self._distance, self._noise = tuple(payloads), (near, far), noise
        self._max_steps = round(time_limit / PERIOD)
        self._radius = self._model.parameters.radius
        self._dives = self._model.element == "water" and self._model.parameters.max_climb > 0
        self._flies = self._model.element == "air"
        self._height = self._world.start.z if self._dives else TAKE_OFF_HEIGHT if self._flies else 0.0
        outline = self._model.parameters.footprint
        half_width = max((abs(y) for _, y in outline), default=self._radius)
        self._places = FreePlaces(
            self._world,
            self._radius + SPARE_ROOM,
            half_width + SPARE_ROOM,
            self._height or half_width,
            2 * half_width,
        )
        self._renderer: Renderer | None = None
        self._robot = self._built(self._world.start, 0)
        self._measured = Measurements(self._robot.info, self._robot.read(0.0))
        self._goal = (self._world.start.x, self._world.start.y, self._height)
        self._steps, self._left, self._runs = 0, 0.0, False
        self._axes = 2 + (self._dives or self._flies) + self._flies
        self.action_space = spaces.Box(-1.0, 1.0, (self._axes,), np.float32)
        reach = math.hypot(self._world.ground.length, self._world.ground.width)
        seen = {"goal": spaces.Box(-reach, reach, (3,), np.float32), **self._measured.spaces()}
        self.observation_space = spaces.Dict(seen)  # type: ignore[assignment]

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode; with a `seed` the one of that number, else the next one.

        `options` may have `start`, (x, y, yaw), and `goal`, (x, y) or (x, y, z), in `map` [m, rad]. ValueError with one sentence for an
        option that is none, and where something stands.
        """
        super().reset(seed=seed)
        start, goal = self._chosen(options or {})
        self._robot.close()
        self._robot = self._built(start, int(self.np_random.integers(2**31)))
        self._measured = Measurements(self._robot.info, self._robot.read(0.0))
        self._goal, self._steps, self._runs = goal, 0, True
        if self._flies:
            self._take_off()
        self._left = self._away()
        return self._seen(), self._info()

    def step(
        self, action: NDArray[np.float32]
    ) -> tuple[Observation, SupportsFloat, bool, bool, dict[str, Any]]:
        """Drive by `action` for `PERIOD`: what is seen then, the reward, whether it is there or bumped, whether time is up, and `info`.

        RuntimeError before the first `reset` and after the end of an episode, ValueError for an action that is none.
        """
        if not self._runs:
            raise RuntimeError("No episode runs: call reset first.")
        wanted = np.asarray(action, dtype=np.float64)
        if wanted.shape != (self._axes,) or not np.isfinite(wanted).all():
            raise ValueError(f"An action has {self._axes} finite numbers, not {action}.")
        self._robot.drive(self._twist(np.clip(wanted, -1.0, 1.0)))
        self._steps += 1
        self._pass(PERIOD)
        before, self._left = self._left, self._away()
        info = self._info()
        reward = before - self._left - STEP_COST
        reward += REACHED_REWARD * info["is_success"] - BUMP_COST * info["bumped"]
        ended = info["is_success"] or info["bumped"]
        is_late = self._steps >= self._max_steps and not ended
        self._runs = not (ended or is_late)
        return self._seen(), reward, ended, is_late, info

    def render(self) -> NDArray[np.uint8] | None:
        """The world from above, north up, with the robot and a green disc at its goal: (height, width, 3) RGB; None without a mode."""
        if self.render_mode is None:
            return None
        if self._renderer is None:
            self._renderer = Renderer(self._world, samples=4)
        ground = self._world.ground
        view = View.from_above(ground.length, ground.width, RENDERED_WIDTH)
        size = 2 * max(REACHED, self._radius)
        middle = (*self._goal[:2], max(self._goal[2], 0.02))
        disc = Shape("cylinder", (size, size, 0.04), middle, colour=GOAL_COLOUR)
        return self._renderer.render(view, (*self._robot.simulation.looks(but=-1), disc))

    def close(self) -> None:
        """Free everything; closing twice does nothing."""
        self._robot.close()
        self._runs = False
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

    def _built(self, start: Start, seed: int) -> SimRobot:
        made = make_several(
            [(self._name, start)],
            self._world_name,
            seed=seed,
            camera=False,
            noise=self._noise,
            payloads=[self._payloads],
        )
        return made[0]

    def _chosen(self, options: dict[str, Any]) -> tuple[Start, tuple[float, float, float]]:
        unknown = set(options) - {"start", "goal"}
        if unknown:
            raise ValueError(f"An episode has the options start and goal, not {min(unknown)!r}.")
        x, y, yaw = options.get("start") or (*self._places.draw(self.np_random), self._turn())
        start = Start(
            x=float(x), y=float(y), yaw=math.degrees(yaw), z=self._world.start.z if self._dives else 0.0
        )
        goal = options.get("goal") or self._places.draw_apart(self.np_random, (x, y), *self._distance)
        for what, place in (("start", (x, y)), ("goal", goal)):
            if not self._places.has_room(place[0], place[1]):
                raise ValueError(
                    f"The {what} has no room at ({place[0]:g}, {place[1]:g}): something stands there."
                )
        height = float(goal[2]) if len(goal) > 2 else self._height  # type: ignore[misc]
        return start, (float(goal[0]), float(goal[1]), height)

    def _turn(self) -> float:
        return float(self.np_random.uniform(-math.pi, math.pi))

    def _twist(self, parts: NDArray[np.float64]) -> Twist:
        info = self._robot.info
        ahead, turn, up, left = (*parts, 0.0, 0.0)[:4]
        speed = info.max_speed
        linear = Vector3(ahead * speed, left * speed, up * info.max_climb)
        return Twist(linear, Vector3(0.0, 0.0, turn * info.max_yaw_rate))

    def _take_off(self) -> None:
        """RuntimeError where it does not get up."""
        self._robot.manoeuvre(Manoeuvre(kind="take_off", height=TAKE_OFF_HEIGHT))
        for _ in range(round(TAKE_OFF_TIMEOUT / PERIOD)):
            self._pass(PERIOD)
            if abs(self._pose()[2] - TAKE_OFF_HEIGHT) < REACHED / 2:
                return
        raise RuntimeError(f"{self._robot.info.name} did not take off within {TAKE_OFF_TIMEOUT:g} s.")

    def _pass(self, period: float) -> None:
        self._measured.take(self._robot.read(self._robot.simulation.time + period))

    def _pose(self) -> tuple[float, float, float, float]:
        state = self._robot.simulation.vehicle.state()
        x, y, z = state.position
        return x, y, z, yaw_of(state.rotation)

    def _to_goal(self) -> tuple[float, float, float]:
        """The goal from the robot, in `map` [m]; level where the robot has no say in its height."""
        x, y, z, _ = self._pose()
        return self._goal[0] - x, self._goal[1] - y, self._goal[2] - z if self._dives or self._flies else 0.0

    def _away(self) -> float:
        return math.hypot(*self._to_goal())

    def _seen(self) -> Observation:
        goal = rotate_back(from_yaw(self._pose()[3]), self._to_goal())
        return {"goal": np.array(goal, dtype=np.float32), **self._measured.seen()}

    def _info(self) -> dict[str, Any]:
        return {
            "pose": self._pose(),
            "goal": self._goal,
            "is_success": self._away() < REACHED + self._radius,
            "bumped": self._robot.simulation.contacts > 0,
        }
