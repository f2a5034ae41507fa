"""Scenes for a detector, drawn with their truth: made-up worlds and the simulator's own ones, with people, cones, cars and boxes in them.

A thing's truth is the box round all of it that lies in the picture, hidden or not, and how much of it can be seen: each thing is drawn
once alone, which gives its outline, and once in its colour among all others, which gives the pixels that nothing hides.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from bench.support.made_worlds import free, made_world, peopled
from sim.core.shapes import Shape, from_yaw
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.world.props import Prop
from sim.world.tables import Datum, Ground, Start
from sim.world.world import World
from sim.world.world_files import load

__all__ = ["KINDS", "OWN_WORLDS", "Scene", "Truth", "scenes", "taken"]

KINDS = {"cone": "cone", "person": "person", "car": "car", "block": "box", "barrel": "box"}
"""The class of each kind of thing."""
OWN_WORLDS = ("parking_lot", "office", "orchard")
SIZE = (640, 480)
"""Of a picture [px]."""
NEAREST, FARTHEST = 1.5, 10.0
"""From the camera to the thing that it looks for [m]."""
MAX_BOX = 1.3
"""A block that is larger than this [m] is a wall or a pillar."""
Picture = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Truth:
    """One thing in a picture."""

    kind: str
    box: tuple[float, float, float, float]
    """Left, top, right and bottom of all of it that lies in the picture [parts of the picture]."""
    pixels: float
    """That can be seen, of a picture of 640 x 480."""
    seen: float
    """Part of its outline that nothing hides and the picture's edge does not cut off."""
    distance: float
    """From the camera to its middle [m]."""


@dataclass(frozen=True, slots=True)
class Scene:
    """A picture and what is in it."""

    world: str
    dusk: bool
    picture: Picture
    truths: list[Truth]


class _Set:
    """A world with its things, ready to be looked at."""

    def __init__(self, name: str, world: World, bare: World, empty: Renderer, *, judging: bool) -> None:
        self._judging = judging
        self.name, self.world, self._empty = name, world, empty
        self.things = [prop for prop in world.props if _kind(prop)]
        self._drawn, self._bare = Renderer(world), Renderer(bare)

    def close(self) -> None:
        self._drawn.close()
        self._bare.close()

    def scene(self, rng: np.random.Generator, *, dusk: bool, label_size: tuple[int, int]) -> Scene | None:
        view = self._view(rng)
        if view is None:
            return None
        picture = taken(self._drawn.render(view), rng, dusk=dusk)
        return Scene(self.name, dusk, picture, self._truths(replace(view, size=label_size)))

    def _view(self, rng: np.random.Generator) -> View | None:
        half = self.world.ground.length / 2, self.world.ground.width / 2
        for _ in range(60):
            thing = self.things[rng.integers(len(self.things))]
            away = NEAREST * (FARTHEST / NEAREST) ** rng.random() + (2.0 if thing.kind == "car" else 0.0)
            turn = rng.uniform(-math.pi, math.pi)
            x, y = (
                part + away * way
                for part, way in zip(thing.position[:2], (math.cos(turn), math.sin(turn)), strict=True)
            )
            if max(abs(x) - half[0], abs(y) - half[1]) > -0.4 or not free(self.world, x, y, 0.35):
                continue
            yaw = turn + math.pi + rng.uniform(-0.42, 0.42)
            tilt = float(rng.normal(0.0, 0.008))
            rotation = from_yaw(yaw)
            turned = (
                rotation[0] - rotation[2] * tilt / 2,
                rotation[1] + rotation[3] * tilt / 2,
                rotation[2],
                rotation[3],
            )
            return View((x, y, self._eye(rng)), turned, SIZE, float(rng.choice((1.1, 1.2))))
        return None

    def _eye(self, rng: np.random.Generator) -> float:
        """Height of the camera [m]: that of our robots, or to learn from also others."""
        ours = self._judging or rng.random() < 0.7
        return float(rng.choice((0.36, 0.42)) if ours else rng.uniform(0.25, 1.3))

    def _truths(self, view: View) -> list[Truth]:
        near = [prop for prop in self.things if math.dist(prop.position[:2], view.eye[:2]) < FARTHEST + 4.0]
        coloured = [shape for n, prop in enumerate(near) for shape in _in_colour(prop, n + 1)]
        black = [shape for prop in near for shape in _in_colour(prop, 0)]
        ids = self._bare.render(view, coloured).astype(np.int16)
        changed = (ids != self._bare.render(view, black)).any(axis=2)
        number = np.where(changed, np.rint(ids[..., 0] / 6).astype(int), 0)
        nothing = self._empty.render(view)
        scale = SIZE[0] * SIZE[1] / number.size
        found = []
        visible = np.bincount(number.ravel(), minlength=len(near) + 1)
        for n, prop in enumerate(near):
            if not visible[n + 1]:
                continue
            whole = (self._empty.render(view, _in_colour(prop, 42)) != nothing).any(axis=2)
            truth = _truth(prop, whole, float(visible[n + 1]), scale, view)
            if truth is not None:
                found.append(truth)
        return found


def _truth(prop: Prop, whole: NDArray[np.bool_], visible: float, scale: float, view: View) -> Truth | None:
    area = float(whole.sum())
    if area == 0.0:
        return None
    rows, columns = np.flatnonzero(whole.any(axis=1)), np.flatnonzero(whole.any(axis=0))
    height, width = whole.shape
    box = (columns[0] / width, rows[0] / height, (columns[-1] + 1) / width, (rows[-1] + 1) / height)
    inside = _inside(prop, view)
    distance = math.dist(prop.position[:2], view.eye[:2])
    return Truth(_kind(prop), box, visible * scale, min(1.0, visible / area) * inside, distance)


def _inside(prop: Prop, view: View) -> float:
    """Part of its breadth that lies between the picture's sides."""
    points = np.array([corner for shape in prop.visuals for corner in shape.corners(8)]) - view.eye
    seen = points @ view.axes
    ahead = np.maximum(-seen[:, 2], 0.05)
    across = seen[:, 0] / ahead / view.half_extent[0]
    left, right = float(across.min()), float(across.max())
    return max(0.0, min(right, 1.0) - max(left, -1.0)) / (right - left)


def _kind(prop: Prop) -> str:
    """Its class; empty where it is none to look for."""
    if prop.kind == "block" and max(prop.solids[0].size) > MAX_BOX:
        return ""
    return KINDS.get(prop.kind, "")


def _in_colour(prop: Prop, number: int) -> list[Shape]:
    colour = (number * 6 / 255, 0.0, 1.0 if number else 0.0)
    return [replace(shape, colour=colour, glow=1.0, gloss=0.0) for shape in prop.visuals]


def taken(picture: Picture, rng: np.random.Generator, *, dusk: bool) -> Picture:
    """What a camera makes of it: by day a little brighter or darker; at dusk a quarter to half of the light, warm or blue, and noise."""
    light = rng.uniform(0.25, 0.5) if dusk else rng.uniform(0.8, 1.15)
    warm = rng.uniform(-0.18, 0.18) if dusk else rng.uniform(-0.05, 0.05)
    noise = rng.uniform(3.0, 6.0) if dusk else rng.uniform(0.5, 2.5)
    tint = light * np.array([1 + warm, 1.0, 1 - warm], dtype=np.float32)
    grain = rng.standard_normal(picture.shape, dtype=np.float32) * noise
    return np.clip(picture * tint + grain, 0, 255).astype(np.uint8)


def scenes(
    seed: int, count: int, *, judging: bool, each: int = 20, dusk: float = 0.4, labels: tuple[int, int] = SIZE
) -> Iterator[Scene]:
    """So many scenes, `each` of one furnishing of a world; the same ones for a seed.

    To learn from, all worlds are made up; to judge by, they are the simulator's own ones and others that are made up. A part `dusk`
    of them is at dusk. No colour of what is judged is learnt from, see `made_worlds`.
    """
    empty = Renderer(World("empty", "", Datum(45.0, 0.0), Ground(4.0, 4.0), Start(0.0, 0.0)))
    number = made = 0
    try:
        while made < count:
            rng = np.random.default_rng((seed, int(judging), number))
            name, bare = _bare(rng, number, judging=judging)
            number += 1
            one = _Set(name, peopled(bare, rng, judging=judging), bare, empty, judging=judging)
            try:
                for scene in _looks(one, rng, min(each, count - made), dusk, labels):
                    made += 1
                    yield scene
            finally:
                one.close()
    finally:
        empty.close()


def _looks(
    one: _Set, rng: np.random.Generator, count: int, dusk: float, labels: tuple[int, int]
) -> Iterator[Scene]:
    for _ in range(count):
        scene = one.scene(rng, dusk=bool(rng.random() < dusk), label_size=labels)
        if scene is not None:
            yield scene


def _bare(rng: np.random.Generator, number: int, *, judging: bool) -> tuple[str, World]:
    """A world without the things that are looked for."""
    own: Sequence[str] = OWN_WORLDS if judging else ()
    choice = number % (len(own) + 2)
    if choice < len(own):
        world = load(own[choice])
        less: dict[str, Any] = dict.fromkeys(("cars", "cones", "people", "barrels"), ())
        return own[choice], msgspec.structs.replace(world, **less)
    indoor = choice == len(own)
    return ("made up, indoors" if indoor else "made up, outdoors"), made_world(rng, indoor=indoor)
