"""Catalogue of the robots and worlds that can be simulated, for people and programs to choose from."""

from __future__ import annotations

from typing import Any

from sim.payloads import PAYLOADS, laden
from sim.robot import ROBOTS
from sim.vehicles.model import Model, suits
from sim.world.world_files import WORLDS, load

__all__ = ["catalogue"]

_SAME_AS = {"line": "line_sensor", "rear": "camera"}
"""What some vehicles have of their own, by the payload that is the same; a camera ahead is no payload."""


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
                "payloads": _payloads(model),
                "own": _own(model),
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


def _payloads(model: Model) -> list[str]:
    """Names of the payloads that such a robot can carry, each by itself, and has not got already."""
    own = {_SAME_AS.get(name, name) for name in model.parameters.__struct_fields__ if name != "camera"}
    return [name for name in PAYLOADS if name not in own and _carries(model, name)]


def _own(model: Model) -> list[str]:
    """Payloads that such a robot has of its own and can do without."""
    fields = model.parameters.__struct_fields__
    return ["camera", *(_SAME_AS[name] for name in ("line",) if name in fields)]


def _carries(model: Model, name: str) -> bool:
    if name == "line_sensor" and model.element != "land":
        return False
    try:
        laden(model, [name])
    except ValueError:
        return False
    return True
