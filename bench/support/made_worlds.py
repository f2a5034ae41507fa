"""Worlds that are made up, and the people, cones, cars and boxes that are put into them: for a detector to learn from and be judged by."""

from __future__ import annotations

import math
from typing import Any

import msgspec
import numpy as np

from sim.core.shapes import beside
from sim.world.props import CAR_MODELS
from sim.world.props_people import POSTURES
from sim.world.tables import (
    Barrel,
    Bays,
    Block,
    Car,
    Ceiling,
    Cone,
    Datum,
    FruitTree,
    Ground,
    Lamp,
    Partition,
    Person,
    Shelf,
    Sofa,
    Spot,
    Start,
    Table,
    Tree,
    Wall,
    Window,
)
from sim.world.world import World

__all__ = ["JUDGED", "free", "made_world", "peopled"]

Colour = tuple[float, float, float]
Random = np.random.Generator

JUDGED: tuple[Colour, ...] = (
    (0.85, 0.15, 0.15),
    (0.10, 0.45, 0.25),
    (0.95, 0.85, 0.30),
    (0.92, 0.92, 0.90),
    (0.08, 0.08, 0.10),
    (0.45, 0.20, 0.50),
    (1.00, 0.40, 0.06),
    (0.30, 0.55, 0.80),
    (0.55, 0.45, 0.35),
    (0.75, 0.95, 0.20),
    (0.50, 0.52, 0.55),
    (0.10, 0.20, 0.45),
)
"""Colours of clothes, cars and boxes that only judging has."""
APART = 0.14
"""What is learnt from is at least so far from each of them, red, green and blue together."""
SKINS: tuple[Colour, ...] = ((0.80, 0.62, 0.50), (0.55, 0.38, 0.27), (0.35, 0.23, 0.16), (0.92, 0.76, 0.66))
CONES: tuple[tuple[Colour, Colour], ...] = (
    ((1.0, 0.36, 0.04), (0.95, 0.95, 0.93)),
    ((0.95, 0.30, 0.10), (0.90, 0.90, 0.88)),
    ((0.95, 0.85, 0.10), (0.10, 0.10, 0.10)),
    ((0.90, 0.12, 0.10), (0.95, 0.95, 0.93)),
    ((0.15, 0.30, 0.85), (0.95, 0.95, 0.93)),
    ((0.60, 0.90, 0.15), (0.95, 0.95, 0.93)),
)
JUDGED_CONES: tuple[tuple[Colour, Colour], ...] = (
    ((1.0, 0.42, 0.10), (0.92, 0.92, 0.95)),
    ((0.90, 0.26, 0.03), (0.95, 0.90, 0.75)),
    ((0.85, 0.78, 0.05), (0.90, 0.90, 0.90)),
    ((0.10, 0.45, 0.75), (0.90, 0.90, 0.90)),
)


def made_world(rng: Random, *, indoor: bool) -> World:
    """Ground, walls and furniture or trees, without what is looked for."""
    length, width = rng.uniform(14, 22), rng.uniform(12, 18)
    look = "floor" if indoor else str(rng.choice(["asphalt", "asphalt", "grass", "floor"]))
    parts: dict[str, Any] = _rooms(rng, length, width) if indoor else _outdoors(rng, length, width)
    high = 2.6 if indoor else float(rng.uniform(0.3, 3.0))
    wall = Wall(high, 0.2) if indoor or rng.random() < 0.7 else None
    return World(
        "made up",
        "",
        Datum(45.0, 0.0),
        Ground(round(length, 1), round(width, 1), look),  # type: ignore[arg-type]  # a look, by the list above
        Start(0.0, 0.0),
        wall=wall,
        **parts,
    )


def _spots(rng: Random, length: float, width: float, most: int) -> list[dict[str, float]]:
    return [
        {
            "x": float(rng.uniform(-0.46, 0.46) * length),
            "y": float(rng.uniform(-0.46, 0.46) * width),
            "yaw": float(rng.uniform(0, 360)),
        }
        for _ in range(rng.integers(0, most + 1))
    ]


def _tone(rng: Random, low: float, high: float) -> Colour:
    grey = rng.uniform(low, high)
    red, green, blue = np.clip(grey + rng.normal(0, 0.06, 3), 0, 1)
    return float(red), float(green), float(blue)


def _rooms(rng: Random, length: float, width: float) -> dict[str, Any]:
    paint = _tone(rng, 0.5, 0.95)
    walls = []
    for _ in range(rng.integers(2, 6)):
        x, y = rng.uniform(-0.45, 0.45) * length, rng.uniform(-0.45, 0.45) * width
        along, reach = bool(rng.integers(2)), rng.uniform(2, 6)
        end = (min(x + reach, 0.48 * length), y) if along else (x, min(y + reach, 0.48 * width))
        if math.dist((x, y), end) > 0.5:
            walls.append(Partition((float(x), float(y)), (float(end[0]), float(end[1])), colour=paint))
    lamps = tuple(
        (float(x), float(y))
        for x in np.arange(-length / 2 + 2, length / 2, 4)
        for y in np.arange(-width / 2 + 2, width / 2, 4)
    )
    return {
        "ceiling": Ceiling(2.6, lamps),
        "partitions": tuple(walls),
        "tables": tuple(
            Table(**spot, screens=int(rng.integers(0, 3)), length=float(rng.uniform(0.9, 1.8)))
            for spot in _spots(rng, length, width, 5)
        ),
        "chairs": tuple(Spot(**spot) for spot in _spots(rng, length, width, 6)),
        "sofas": tuple(Sofa(**spot) for spot in _spots(rng, length, width, 2)),
        "shelves": tuple(
            Shelf(**spot, height=float(rng.uniform(1.0, 2.1))) for spot in _spots(rng, length, width, 4)
        ),
        "windows": tuple(
            Window(float(x), width / 2) for x in np.arange(-length / 2 + 2, length / 2 - 1, 3.5)
        ),
        "blocks": _pillars(rng, length, width),
    }


def _outdoors(rng: Random, length: float, width: float) -> dict[str, Any]:
    bays = ()
    if rng.random() < 0.5:
        bays = (Bays(-length / 2 + 1, -width / 4, int(length / 2.5) - 1, 2.5, 4.8),)
    return {
        "bays": bays,
        "lamps": tuple(Lamp(**spot) for spot in _spots(rng, length, width, 3)),
        "trees": tuple(
            Tree(**spot, height=float(rng.uniform(2.5, 7)))
            for spot in _spots(rng, length * 1.6, width * 1.6, 8)
        ),
        "fruit_trees": tuple(
            FruitTree(**spot, fruits=int(rng.integers(0, 40)), height=float(rng.uniform(1.4, 2.6)))
            for spot in _spots(rng, length, width, 5)
        ),
        "blocks": _pillars(rng, length, width),
        "tables": tuple(Table(**spot) for spot in _spots(rng, length, width, 1)),
    }


def _pillars(rng: Random, length: float, width: float) -> tuple[Block, ...]:
    """Pillars, kerbs and hoardings: none is a box that somebody has left."""
    found = []
    for spot in _spots(rng, length, width, 4):
        size = ((0.4, 0.4, 2.6), (2.5, 0.2, 0.15), (3.0, 0.1, 1.2), (1.8, 0.8, 2.0))[rng.integers(4)]
        long, wide, high = (float(part * rng.uniform(0.8, 1.3)) for part in size)
        colour = _tone(rng, 0.3, 0.9) if rng.random() < 0.6 else _any(rng)
        if max(long, wide, high) > 1.35:
            found.append(Block(**spot, length=long, width=wide, height=high, colour=colour))
    return tuple(found)


def _any(rng: Random) -> Colour:
    """A colour that is not judged by."""
    while True:
        red, green, blue = (float(part) for part in rng.random(3))
        if all(math.dist((red, green, blue), other) > APART for other in JUDGED):
            return red, green, blue


def _colour(rng: Random, *, judging: bool) -> Colour:
    return JUDGED[rng.integers(len(JUDGED))] if judging else _any(rng)


def _changed(rng: Random, colour: Colour, spread: float) -> Colour:
    red, green, blue = np.clip(np.array(colour) * (1 + rng.normal(0, spread, 3)), 0, 1)
    return float(red), float(green), float(blue)


def free(world: World, x: float, y: float, room: float) -> bool:
    """Nothing that stands on the ground is nearer to (x, y) than `room` [m]."""
    return not any(
        beside(solid, x, y) < room for solid in world.solids if solid.position[2] - solid.size[2] / 2 < 1.0
    )


def peopled(bare: World, rng: Random, *, judging: bool) -> World:
    """The world with people, cones, cars and boxes in it: some by themselves, some in front of others."""
    fields: dict[str, list[Any]] = {
        "people": [],
        "cones": [],
        "cars": [],
        "barrels": [],
        "blocks": list(bare.blocks),
    }
    wanted = {
        "people": int(rng.integers(4, 9)),
        "cones": int(rng.integers(4, 9)),
        "cars": 0 if bare.ceiling else int(rng.integers(1, 5)),
        "blocks": int(rng.integers(2, 5)),
        "barrels": int(rng.integers(1, 4)),
    }
    half = bare.ground.length / 2 - 0.8, bare.ground.width / 2 - 0.8
    inner = min(half[0], 10.0), min(half[1], 8.0)
    centre = (0.0, 0.0) if judging is False else _centre(rng, half, inner)
    places: list[tuple[float, float, float]] = []
    for name in ("cars", "people", "cones", "blocks", "barrels"):
        for _ in range(wanted[name]):
            place = _place(rng, bare, places, (centre, inner), 2.7 if name == "cars" else 0.35)
            if place is None:
                continue
            places.append((*place, 2.5 if name == "cars" else 0.3))
            fields[name].append(_thing(name, rng, place, judging=judging))
    return msgspec.structs.replace(bare, **{name: tuple(rows) for name, rows in fields.items()})


def _centre(rng: Random, half: tuple[float, float], inner: tuple[float, float]) -> tuple[float, float]:
    x, y = (float(rng.uniform(-1, 1)) * (whole - part) for whole, part in zip(half, inner, strict=True))
    return x, y


def _place(
    rng: Random,
    bare: World,
    places: list[tuple[float, float, float]],
    within: tuple[tuple[float, float], tuple[float, float]],
    room: float,
) -> tuple[float, float] | None:
    (cx, cy), (half_x, half_y) = within
    for _ in range(40):
        if places and rng.random() < 0.4:  # close to another, to hide it or be hidden
            x, y, size = places[rng.integers(len(places))]
            turn, away = rng.uniform(-math.pi, math.pi), size + room + rng.uniform(0.15, 1.0)
            x, y = x + away * math.cos(turn), y + away * math.sin(turn)
        else:
            x, y = cx + rng.uniform(-half_x, half_x), cy + rng.uniform(-half_y, half_y)
        inside = max(abs(x - cx) - half_x, abs(y - cy) - half_y) < 0
        if (
            inside
            and free(bare, x, y, room)
            and all(math.dist((x, y), other[:2]) > room + other[2] for other in places)
        ):
            return float(x), float(y)
    return None


def _thing(name: str, rng: Random, place: tuple[float, float], *, judging: bool) -> Any:
    spot: dict[str, Any] = {"x": place[0], "y": place[1], "yaw": float(rng.uniform(0, 360))}
    colour = _colour(rng, judging=judging)
    if name == "people":
        return Person(
            **spot,
            colour=colour,
            trousers=_colour(rng, judging=judging) if rng.random() < 0.7 else (0.17, 0.20, 0.29),
            skin=_changed(rng, SKINS[rng.integers(len(SKINS))], 0.06),
            hair=_changed(
                rng, ((0.2, 0.15, 0.11), (0.75, 0.62, 0.35), (0.6, 0.6, 0.6))[rng.integers(3)], 0.1
            ),
            height=float(rng.uniform(1.5, 2.0)),
            posture=POSTURES[rng.choice(len(POSTURES), p=(0.36, 0.28, 0.12, 0.12, 0.12))],
        )
    if name == "cones":
        kinds = JUDGED_CONES if judging else CONES
        body, band = kinds[rng.integers(len(kinds)) if rng.random() < 0.6 else rng.integers(2)]
        spread = 0.02 if judging else 0.05
        return Cone(
            **spot,
            height=float(rng.uniform(0.45, 0.8)),
            colour=_changed(rng, body, spread),
            band=_changed(rng, band, spread),
        )
    if name == "cars":
        return Car(**spot, model=CAR_MODELS[rng.integers(len(CAR_MODELS))], colour=colour)
    if name == "barrels":
        return Barrel(**spot, height=float(rng.uniform(0.6, 1.1)), colour=colour)
    long, wide, high = (float(part) for part in rng.uniform(0.35, 1.0, 3))
    return Block(**spot, length=long, width=wide, height=high, colour=colour)
