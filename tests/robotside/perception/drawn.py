"""Pictures of things in a small world, as the simulator's camera sees them."""

from __future__ import annotations

import io
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from sim.core.shapes import from_yaw
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.world.tables import Cone, Datum, Ground, Person, Start, Wall
from sim.world.world import World

__all__ = ["FOV", "cone_ahead", "jpeg", "seen", "world"]

FOV = 1.2
"""Of the camera, across [rad]."""
EYE = 0.36
"""Height of the camera [m]."""


def world(**things: Any) -> World:
    """Asphalt of 18 x 12 m with a low wall round it, and these things on it."""
    return World("yard", "", Datum(45.0, 0.0), Ground(18.0, 12.0), Start(0.0, 0.0), Wall(0.5, 0.2), **things)


def seen(
    place: World, *, x: float = 0.0, y: float = 0.0, yaw: float = 0.0, dusk: bool = False, fov: float = FOV
) -> bytes:
    """What a robot at (x, y) sees that looks towards `yaw` [rad], a JPEG file."""
    renderer = Renderer(place)
    picture = renderer.render(View((x, y, EYE), from_yaw(yaw), (640, 480), fov))
    renderer.close()
    return jpeg((picture * np.array((0.40, 0.38, 0.36))).astype(np.uint8) if dusk else picture)


def jpeg(picture: NDArray[np.uint8] | Image.Image, quality: int = 80) -> bytes:
    """A picture as a file."""
    out = io.BytesIO()
    image = picture if isinstance(picture, Image.Image) else Image.fromarray(picture)
    image.save(out, "JPEG", quality=quality)
    return out.getvalue()


@lru_cache(maxsize=4)
def cone_ahead(away: float = 3.0, side: float = 0.0) -> bytes:
    """A cone `away` ahead of the camera and `side` to its left [m]."""
    return seen(world(cones=(Cone(x=away, y=side),)))


@lru_cache(maxsize=4)
def person_ahead(away: float = 3.0, side: float = 0.0) -> bytes:
    """A person `away` ahead of the camera and `side` to its left [m]."""
    return seen(world(people=(Person(x=away, y=side, yaw=160.0),)))
