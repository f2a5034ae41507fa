"""A map that people know beneath the robot's own: the address of a tile server is typed in, and its streets come."""

from __future__ import annotations

from typing import Any

from bridge.core.geo import Datum
from examples.demo.scene import Scene, Wait
from examples.tile_server import ATTRIBUTION, TileServer

__all__ = ["lay_streets"]

LOT = Datum(45.5069, -73.579)
"""Where the lot is, as its world has it."""
FARTHER = 4
"""So many presses make the map small enough to see the streets about the lot."""
PATIENCE = 30.0
"""Longest time for all tiles in sight [s]."""


def lay_streets(scene: Scene) -> Wait:
    """Add a tile server of this machine's in Setup, see its streets beneath the robot's map, and take them away again."""
    glass = scene.glass
    with TileServer(LOT) as tiles, scene.step("streets") as check:
        yield from glass.press_icon("layers")
        yield from glass.press("Maps in Setup", kind="QuietButton")
        yield from glass.press("Add a tile server", kind="QuietButton")
        yield from glass.write("Address", tiles.url)
        yield from glass.write("Whom the map is of", ATTRIBUTION)
        came = yield from glass.soon(lambda: glass.shows("This came from the server"), PATIENCE)
        check("a tile is seen before the server is kept", bool(came), bool(came))
        yield from glass.press("Save", kind="PrimaryButton")
        yield from glass.press("Mission", kind="NavButton")
        yield from glass.one("MissionScreen")
        for _ in range(FARTHER):
            yield from glass.press_icon("remove")
        shown = yield from glass.soon(lambda: _all_here(scene.map()), PATIENCE)
        check("its streets lie beneath the robot's map", bool(shown), bool(shown))
        check(
            "with whom they are of",
            getattr(scene.map(), "ground", None) and scene.map().ground.attribution,
            shown,
        )
        scene.report.snapshot("streets-map")
        yield from glass.press_icon("layers")
        yield from glass.press("The robot's map alone")
        alone = yield from glass.soon(lambda: scene.map().ground is None, 5)
        check("the robot's map alone", bool(alone), bool(alone))
        yield from glass.press_icon("layers")
        yield from glass.press_icon("fit_screen")


def _all_here(chart: Any) -> bool:
    """Every tile in sight has come."""
    source = getattr(chart.ground, "source", None)
    return source is not None and source.attribution == ATTRIBUTION and source.complete
