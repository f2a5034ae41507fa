"""Pictures where OpenGL without a window is missing: drawn by pybullet's own renderer in a process of its own.

It is slow and would hold up the physics, so it draws small pictures, one at a time, next to it.
"""

from __future__ import annotations

import logging
import multiprocessing
from collections.abc import Iterator, Sequence
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

import numpy as np
from numpy.typing import NDArray

from sim.core.shapes import Shape, from_yaw, rotate
from sim.physics.backend_bullet import Bullet
from sim.rendering.view import View
from sim.world.world import World

__all__ = ["SIZE", "SmallPictures", "TinyRenderer"]

SIZE = (320, 240)
"""Of its pictures [px]."""
PICTURE_TIMEOUT = 5.0
"""Time to wait for one picture before giving up on the process [s]."""

START_TIMEOUT = 30.0
"""Longest time that the process may take to start [s]."""

_MIN_RADIUS = 0.11
"""Smallest radius of a thing that is drawn [m]."""

_SEA, _SAND = (0.10, 0.38, 0.43), (0.63, 0.60, 0.47)
_GROUNDS = {
    "asphalt": (0.44, 0.45, 0.47),
    "water": _SEA,
    "floor": (0.68, 0.66, 0.62),
    "grass": (0.37, 0.46, 0.24),
}

_log = logging.getLogger(__name__)

Picture = NDArray[np.uint8]


class TinyRenderer:
    """Draws `world`; a picture is ready a little after it was requested."""

    def __init__(self, world: World) -> None:
        """Start the process and wait until it can draw."""
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process: BaseProcess | None = context.Process(target=_draw, args=(world, theirs), daemon=True)
        self._process.start()
        theirs.close()
        self._stamp: float | None = None
        self._receive(START_TIMEOUT)

    def show(self, view: View, stamp: float, moving: Sequence[Shape] = ()) -> list[tuple[float, Picture]]:
        """Ask for `view` as of `stamp`; gives the picture asked for before, waiting for it if need be.

        The `moving` shapes are left out.
        """
        pictures = self._take(PICTURE_TIMEOUT)
        if self._process is not None:
            self._stamp = stamp
            self._send(view)
        return pictures

    def ready(self, *, wait: bool = False) -> list[tuple[float, Picture]]:
        """The picture asked for last, if it is ready by now; or, with `wait`, when it is."""
        return self._take(PICTURE_TIMEOUT if wait else 0.0)

    def close(self) -> None:
        """End the process; closing twice does nothing."""
        if self._process is not None:
            process, self._process = self._process, None
            self._pipe.close()
            process.join(PICTURE_TIMEOUT)
            if process.is_alive():
                process.kill()
                process.join()
            process.close()

    def _take(self, wait: float) -> list[tuple[float, Picture]]:
        if self._stamp is None or self._process is None:
            return []
        picture = self._receive(wait)
        if picture is None:
            return []
        stamp, self._stamp = self._stamp, None
        return [(stamp, picture)]

    def _receive(self, wait: float) -> Picture | None:
        """The next message of the process within `wait` [s]; None when there is none, which ends it unless `wait` is 0."""
        try:
            if self._pipe.poll(wait):
                picture: Picture = self._pipe.recv()
                return picture
        except (EOFError, OSError):
            self._give_up()
        else:
            if wait:
                self._give_up()
        return None

    def _send(self, view: View) -> None:
        try:
            self._pipe.send(view)
        except OSError:
            self._give_up()

    def _give_up(self) -> None:
        _log.warning("The process that draws the camera's pictures has ended; there are no more.")
        self.close()


def _draw(world: World, pipe: Connection) -> None:
    """The process: draw every view that comes through `pipe` until it closes."""
    pictures = SmallPictures(world)
    try:
        pipe.send(None)
        while True:
            pipe.send(pictures.draw(pipe.recv()))
    except (EOFError, OSError, KeyboardInterrupt):
        pictures.close()


class SmallPictures:
    """Draws `world` slowly, at once."""

    def __init__(self, world: World) -> None:
        """Prepare to draw `world`."""
        self._backend = Bullet()
        for shape in scene(world):
            self._backend.add_looks(shape)

    def draw(self, view: View) -> Picture:
        """The picture of `view`, of `SIZE`."""
        ahead, up = rotate(view.rotation, (1.0, 0.0, 0.0)), rotate(view.rotation, (0.0, 0.0, 1.0))
        x, y, z = view.eye
        target = (x + ahead[0], y + ahead[1], z + ahead[2])
        return self._backend.picture(view.eye, target, up, 2 * float(np.arctan(view.half_extent[1])), SIZE)

    def close(self) -> None:
        """Free everything."""
        self._backend.close()


def scene(world: World) -> Iterator[Shape]:
    """The shapes to draw: ground, paint, ceiling, and the things without their details; trees are smooth balls."""
    length, width = world.ground.length, world.ground.width
    around = _SEA if world.water else (0.40, 0.50, 0.27)
    yield Shape("box", (200.0, 200.0, 0.02), (0.0, 0.0, -0.05), colour=around)
    if world.water:
        yield Shape("box", (200.0, 200.0, 0.02), (0.0, 0.0, world.bottom - 0.015), colour=_SAND)
    yield Shape("box", (length, width, 0.02), (0.0, 0.0, -0.015), colour=_GROUNDS[world.ground.look])
    if world.ceiling:
        middle = (0.0, 0.0, world.ceiling.height + 0.02)
        yield Shape("box", (length, width, 0.02), middle, colour=(0.80, 0.78, 0.73))
        yield from world.overhead
    for row in world.bays:
        for number in range(row.count + 1):
            middle = (row.x + number * row.width, row.y + row.depth / 2, 0.0)
            yield Shape("box", (0.12, row.depth, 0.01), middle, colour=(0.92, 0.92, 0.92))
    for line in world.lines:
        (ax, ay), (bx, by) = line.start, line.end
        size = (float(np.hypot(bx - ax, by - ay)), line.width, 0.01)
        turn = from_yaw(float(np.arctan2(by - ay, bx - ax)))
        yield Shape("box", size, ((ax + bx) / 2, (ay + by) / 2, 0.0), turn, colour=(0.92, 0.92, 0.92))
    for prop in world.props:
        for shape in prop.outlines:
            if prop.kind == "cone" or np.linalg.norm(shape.size) / 2 > _MIN_RADIUS:
                yield shape
