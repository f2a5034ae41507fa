"""Which robots are simulated, and where: what there is to choose from, and a choice that can always be had."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import msgspec

from widgets.core.language import tr

__all__ = ["SimulationChoice", "SimulatorOptions", "SimulatedRobot", "SimulatedWorld"]


class SimulatedRobot(msgspec.Struct, frozen=True):
    """A robot that can be simulated."""

    name: str
    """As in `patrol`."""
    title: str
    """For people."""
    kind: str
    """As in `RobotInfo.kind`."""
    description: str
    home: str
    """Name of the world that it is put into unless another one is chosen."""
    icon: str = ""
    """As in `RobotInfo.icon`."""


class SimulatedWorld(msgspec.Struct, frozen=True):
    """A world that robots can be in."""

    name: str
    description: str
    robots: list[str]
    """Those that can be in it."""

    @property
    def title(self) -> str:
        """For people."""
        return self.name.replace("_", " ").capitalize()


class SimulatorOptions(msgspec.Struct, frozen=True):
    """All that can be simulated."""

    robots: list[SimulatedRobot]
    worlds: list[SimulatedWorld]

    @classmethod
    def read(cls, text: str) -> SimulatorOptions:
        """What `python -m robotside offer --json` said; ValueError when that is not to be understood."""
        offered = msgspec.convert(json.loads(text), cls)
        if not offered.robots:
            raise ValueError(tr("There is no robot that could be simulated."))
        return offered

    def robot(self, name: str) -> SimulatedRobot | None:
        """The robot of that name."""
        return next((robot for robot in self.robots if robot.name == name), None)

    def fitting(self, robots: tuple[str, ...]) -> list[SimulatedWorld]:
        """The worlds that all of these can be in."""
        return [world for world in self.worlds if set(robots) <= set(world.robots)]


@dataclass(frozen=True, slots=True)
class SimulationChoice:
    """At least one robot, and a world that all of them can be in."""

    robots: tuple[str, ...] = ("patrol",)
    world: str = ""
    """Empty for the robots' home."""

    @classmethod
    def remembered(cls, value: Any) -> SimulationChoice:
        """From what `kept` gave; the usual one when that is not to be understood."""
        try:
            robots, world = tuple(value["robots"]), value["world"]
        except (TypeError, KeyError):
            return cls()
        if robots and isinstance(world, str) and all(isinstance(name, str) for name in robots):
            return cls(robots, world)
        return cls()

    @property
    def kept(self) -> dict[str, Any]:
        """As a JSON value, to remember it."""
        return {"robots": list(self.robots), "world": self.world}

    def within(self, offered: SimulatorOptions) -> SimulationChoice:
        """What of it there is; the first robot when there is nothing of it."""
        robots = tuple(name for name in self.robots if offered.robot(name)) or (offered.robots[0].name,)
        while len(robots) > 1 and not offered.fitting(robots):
            robots = robots[:-1]
        return _placed(SimulationChoice(robots, self.world), offered)

    def tapped(self, robot: str, offered: SimulatorOptions) -> SimulationChoice:
        """With `robot` or without it; those who cannot be in one world with a new one are let go."""
        if robot in self.robots:
            others = tuple(name for name in self.robots if name != robot)
            return _placed(SimulationChoice(others, self.world), offered) if others else self
        kept: tuple[str, ...] = (robot,)
        for name in self.robots:
            if offered.fitting((*kept, name)):
                kept = (*kept, name)
        in_order = tuple(each.name for each in offered.robots if each.name in kept)
        return _placed(SimulationChoice(in_order, self.world), offered, robot)

    def moved(self, world: str, offered: SimulatorOptions) -> SimulationChoice:
        """The same robots in another world; as it is when they cannot be there."""
        fits = any(each.name == world for each in offered.fitting(self.robots))
        return SimulationChoice(self.robots, world) if fits else self


def _placed(choice: SimulationChoice, offered: SimulatorOptions, first: str = "") -> SimulationChoice:
    """In the world that it says if that fits, else in the home of one of the robots, of `first` before others."""
    fitting = [world.name for world in offered.fitting(choice.robots)]
    homes = [robot.home for name in (first, *choice.robots) if (robot := offered.robot(name))]
    wanted = [choice.world, *homes, *fitting]
    return SimulationChoice(choice.robots, next((name for name in wanted if name in fitting), ""))
