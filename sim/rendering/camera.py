"""A camera on a vehicle, which gives JPEG pictures with the stamp of their moment."""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from typing import Protocol

from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time
from sim.core.parameters import CameraParameters
from sim.core.sensor_schedule import Schedule
from sim.core.shapes import Shape, compose, from_yaw, place
from sim.physics.backend_bullet import State
from sim.rendering.drawing_process import DrawingProcess
from sim.rendering.jpeg import jpeg
from sim.rendering.renderer import NoRendererError, Renderer, paint
from sim.rendering.tiny_renderer import TinyRenderer
from sim.rendering.view import View
from sim.world.world import World

__all__ = ["Camera", "SharedRenderer"]

SAME_DISTANCE, SAME_TURN = 5e-4, 5e-5
"""A camera that has moved less [m], and turned less [half rad], sees the same: a twentieth of a pixel at some metres, and wheels creep
so far in seconds."""

_log = logging.getLogger(__name__)


class ViewRenderer(Protocol):
    """Something that draws views as JPEG files for one camera, at once or a little later."""

    def show(self, view: View, stamp: float, moving: Sequence[Shape] = ()) -> list[tuple[float, bytes]]:
        """Draw `view` as of `stamp`; gives the pictures that are ready, oldest first, each with its stamp.

        `moving` are the other robots, which one that draws slowly may leave out.
        """

    def ready(self, *, wait: bool = False) -> list[tuple[float, bytes]]:
        """Pictures that became ready since the last call; `wait` for them where time is not real."""

    def close(self) -> None:
        """Free everything."""


class _ImmediateRenderer:
    """Draws by OpenGL, at once."""

    def __init__(self, renderer: Renderer) -> None:
        self._renderer = renderer

    def show(self, view: View, stamp: float, moving: Sequence[Shape] = ()) -> list[tuple[float, bytes]]:
        return [(stamp, jpeg(self._renderer.draw(view, moving)))]

    def ready(self, *, wait: bool = False) -> list[tuple[float, bytes]]:
        del wait
        return []

    def close(self) -> None:
        pass  # it is the shared renderer's


class _SmallRenderer:
    """Draws by pybullet in a process, a little later."""

    def __init__(self, renderer: TinyRenderer) -> None:
        self._renderer = renderer

    def show(self, view: View, stamp: float, moving: Sequence[Shape] = ()) -> list[tuple[float, bytes]]:
        return [(taken, jpeg(picture)) for taken, picture in self._renderer.show(view, stamp, moving)]

    def ready(self, *, wait: bool = False) -> list[tuple[float, bytes]]:
        return [(taken, jpeg(picture)) for taken, picture in self._renderer.ready(wait=wait)]

    def close(self) -> None:
        self._renderer.close()


class SharedRenderer:
    """The renderer that the cameras of one world share, made with the first of them because it takes 100 MB."""

    def __init__(self, world: World, *, beside: bool = False) -> None:
        """Of `world`; nothing is made yet.

        `beside` draws and compresses in a process of its own, so that the physics never waits for a picture: in real time.
        Else pictures are drawn in the step in which they are taken, the same in each run.
        """
        self._world, self._beside = world, beside
        self._renderer: Renderer | None = None
        self._process: DrawingProcess | None = None

    def prepare(self) -> None:
        """Do beforehand most of what the first picture takes."""
        if self._beside:
            self._started()
        else:
            paint(self._world)

    def for_camera(self) -> ViewRenderer:
        """Draws for one camera; where OpenGL cannot draw without a window slowly and smaller, and the log says so."""
        if self._beside:
            return self._started().for_camera()
        try:
            self._renderer = self._renderer or Renderer(self._world)
        except NoRendererError as fault:
            _log.warning("%s The camera gives 320 x 240 pictures instead.", fault)
            return _SmallRenderer(TinyRenderer(self._world))
        return _ImmediateRenderer(self._renderer)

    def _started(self) -> DrawingProcess:
        self._process = self._process or DrawingProcess(self._world)
        return self._process

    def close(self) -> None:
        """Free everything; closing twice does nothing."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None
        if self._process is not None:
            self._process.close()
            self._process = None


class Camera:
    """The view from its place on the vehicle."""

    def __init__(self, renderer: ViewRenderer, parameters: CameraParameters, *, first: int = 0) -> None:
        """A camera that draws with `renderer`, which it closes, from the `first` step on."""
        self._parameters = parameters
        self._renderer = renderer
        self._schedule, self._first = Schedule({"camera": parameters.rate}), first
        down = (0.0, math.sin(parameters.pitch / 2), 0.0, math.cos(parameters.pitch / 2))
        self._turned = compose(from_yaw(parameters.yaw), down)
        self._seen: tuple[View, tuple[Shape, ...]] | None = None
        """What is drawn, or was drawn last."""
        self._since = math.nan
        """When it first saw that [s]."""
        self._picture: bytes | None = None
        """The picture of it; None until it is drawn."""

    def is_due(self, step: int) -> bool:
        """It is time for a picture after physics step `step`; to be asked after every step."""
        return bool(self._schedule.due(step - self._first))

    def shoot(self, state: State, stamp: float, moving: Sequence[Shape] = ()) -> list[CompressedImage]:
        """Take a picture from a vehicle in `state` at `stamp` [s]; gives those that are ready, oldest first.

        `moving` are the visible shapes of other robots. While nothing that it sees moves nothing is drawn: the picture is the
        same, down to its `data` object.
        """
        parameters = self._parameters
        eye = place(parameters.position, state.position, state.rotation)
        rotation = compose(state.rotation, self._turned)
        # Only under water does anything move by itself.
        time = stamp if eye[2] < 0.0 else 0.0
        view = View(eye, rotation, (parameters.width, parameters.height), parameters.field_of_view, time=time)
        others = tuple(moving)
        if self._seen is not None and _is_same(view, self._seen[0]) and others == self._seen[1]:
            ready = [] if self._picture is not None else self._messages(self._renderer.ready(wait=True))
            return ready if self._picture is None else [*ready, _message(self._picture, stamp)]
        self._seen, self._since, self._picture = (view, others), stamp, None
        return self._messages(self._renderer.show(view, stamp, others))

    def collect(self) -> list[CompressedImage]:
        """Pictures taken earlier that have become ready."""
        return self._messages(self._renderer.ready())

    def _messages(self, pictures: Sequence[tuple[float, bytes]]) -> list[CompressedImage]:
        for taken, picture in pictures:
            if taken >= self._since:
                self._picture = picture
        return [_message(picture, taken) for taken, picture in pictures]

    def close(self) -> None:
        """Free everything; closing twice does nothing."""
        self._renderer.close()


def _message(picture: bytes, stamp: float) -> CompressedImage:
    return CompressedImage(Header(Time.at(stamp), "camera"), "jpeg", picture)


def _is_same(one: View, other: View) -> bool:
    turned = max(abs(a - b) for a, b in zip(one.rotation, other.rotation, strict=True))
    near = math.dist(one.eye, other.eye) <= SAME_DISTANCE and turned <= SAME_TURN
    return near and one.time == other.time
