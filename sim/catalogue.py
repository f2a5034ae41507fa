"""Catalogue of the robots and worlds that can be simulated, for people and programs to choose from."""

from __future__ import annotations

from typing import Any

from sim.robot import ROBOTS
from sim.vehicles.model import suits
from sim.world.world_files import WORLDS, load

__all__ = ["catalogue"]


def catalogue() -> dict[str, list[dict[str, Any]]]:
    """The catalogue in plain values: `robots` and `worlds`, each world with the robots that can be in it."""
    worlds = {name: load(name) for name in WORLDS}
    return {
        "robots": [
            {
                "name": name,
                "title": model.parameters.info.name.rpartition("-")[0],
                "kind": model.parameters.info.kind,
                "description": model.parameters.info.description,
                "home": model.home,
            }
            for name, model in ROBOTS.items()
        ],
        "worlds": [
            {
                "name": name,
                "description": world.description,
                "robots": [robot for robot, model in ROBOTS.items() if suits(model, world)],
            }
            for name, world in worlds.items()
        ],
    }
