"""The wall round a world's ground and the partitions inside it: plain outdoors, with windows and skirting under a ceiling."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from sim.world.props import Prop, block, wall
from sim.world.props_office import Opening, room_wall
from sim.world.tables import Ceiling, Ground, Partition, Wall, Window

__all__ = ["outer_walls", "partition"]

PLASTER = (0.88, 0.87, 0.83)


def outer_walls(
    ground: Ground, its: Wall, bottom: float, ceiling: Ceiling | None, windows: Sequence[Window]
) -> tuple[Prop, ...]:
    """The four walls round the `ground`, standing on its `bottom` [m]; their solids are the same with and without windows."""
    thick, height, quarter = its.thickness, its.height - bottom, math.pi / 2
    north, east = (ground.width + thick) / 2, (ground.length + thick) / 2
    sides = ((0.0, north, 0.0), (0.0, -north, 0.0), (east, 0.0, quarter), (-east, 0.0, quarter))
    openings = _openings(ground, windows)
    made = []
    for number, (x, y, yaw) in enumerate(sides):
        plain = wall(ground.width if yaw else ground.length + 2 * thick, height, thick)
        if ceiling:
            length = plain.solids[0].size[0]
            plain = replace(plain, visuals=room_wall(length, height, thick, PLASTER, openings[number]))
        made.append(plain.at(x, y, yaw, bottom))
    return tuple(made)


def _openings(ground: Ground, windows: Sequence[Window]) -> list[list[Opening]]:
    """The windows in the walls in the north, the south, the east and the west."""
    found: list[list[Opening]] = [[], [], [], []]
    for window in windows:
        away = (
            *(abs(side * ground.width / 2 - window.y) for side in (1, -1)),
            *(abs(side * ground.length / 2 - window.x) for side in (1, -1)),
        )
        nearest = away.index(min(away))
        along = window.x if nearest < 2 else window.y
        found[nearest].append((along - window.width / 2, along + window.width / 2, window.sill, window.head))
    return found


def partition(entry: Partition, ceiling: Ceiling | None) -> Prop:
    """The wall from one point to the other, its ends rounded off by half its thickness."""
    (x0, y0), (x1, y1) = entry.start, entry.end
    length = math.dist(entry.start, entry.end) + entry.width
    made = block(length, entry.width, entry.height, entry.colour)
    if ceiling:
        made = replace(made, visuals=room_wall(length, entry.height, entry.width, entry.colour))
    return made.at((x0 + x1) / 2, (y0 + y1) / 2, math.atan2(y1 - y0, x1 - x0))
