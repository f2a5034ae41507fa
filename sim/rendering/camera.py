"""A camera on a vehicle, which gives JPEG pictures with the stamp of their moment."""

from __future__ import annotations

import io
import logging
import math
from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time
from sim.core.parameters import CameraParameters
from sim.core.sensor_schedule import Schedule
from sim.core.shapes import Shape, compose, from_yaw, place
from sim.physics.backend_bullet import State
from sim.rendering.renderer import NoRendererError, Renderer
from sim.rendering.tiny_renderer import TinyRenderer
from sim.rendering.view import View
from sim.world.world import World

__all__ = ["Camera", "SharedRenderer"]

QUALITY = 80
"""Of the JPEG."""

_log = logging.getLogger(__name__)

Picture = NDArray[np.uint8]
"""(height, width, 3) RGB, top row first; a fourth byte a pixel means nothing."""


class ViewRenderer(Protocol):
    """Something that draws views, at once or a little later."""

    def show(self, view: View, stamp: float, moving: Sequence[Shape] = ()) -> list[tuple[float, Picture]]:
        """Draw `view` as of `stamp`; gives the pictures that are ready, oldest first, each with its stamp.

        They are good until the next call.

        `moving` are the other robots, which one that draws slowly may leave out.
        """

    def ready(self) -> list[tuple[float, Picture]]:
        """Pictures that became ready since the last call, without waiting."""

    def close(self) -> None:
        """Free everything."""


class _ImmediateRenderer:
    """Draws by OpenGL, at once."""

    def __init__(self, renderer: Renderer) -> None:
        self._renderer = renderer

    def show(self, view: View, stamp: float, moving: Sequence[Shape] = ()) -> list[tuple[float, Picture]]:
        return [(stamp, self._renderer.draw(view, moving))]

    def ready(self) -> list[tuple[float, Picture]]:
        return []

    def close(self) -> None:
        pass  # it is the shared renderer's


class SharedRenderer:
    """The renderer that the cameras of one world share, made with the first of them because it takes 100 MB."""

    def __init__(self, world: World) -> None:
        """Of `world`; nothing is made yet."""
        self._world = world
        self._renderer: Renderer | None = None

    def for_camera(self) -> ViewRenderer:
        """Draws for one camera; where OpenGL cannot draw without a window slowly and smaller, and the log says so."""
        try:
            self._renderer = self._renderer or Renderer(self._world)
        except NoRendererError as fault:
            _log.warning("%s The camera gives 320 x 240 pictures instead.", fault)
            return TinyRenderer(self._world)
        return _ImmediateRenderer(self._renderer)

    def close(self) -> None:
        """Free everything; closing twice does nothing."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None


class Camera:
    """The view from its place on the vehicle."""

    def __init__(self, renderer: ViewRenderer, parameters: CameraParameters, *, first: int = 0) -> None:
        """A camera that draws with `renderer`, which it closes, from the `first` step on."""
        self._parameters = parameters
        self._renderer = renderer
        self._schedule, self._first = Schedule({"camera": parameters.rate}), first
        down = (0.0, math.sin(parameters.pitch / 2), 0.0, math.cos(parameters.pitch / 2))
        self._turned = compose(from_yaw(parameters.yaw), down)

    def is_due(self, step: int) -> bool:
        """It is time for a picture after physics step `step`; to be asked after every step."""
        return bool(self._schedule.due(step - self._first))

    def shoot(self, state: State, stamp: float, moving: Sequence[Shape] = ()) -> list[CompressedImage]:
        """Take a picture from a vehicle in `state` at `stamp` [s]; gives those that are ready, oldest first.

        `moving` are the visible shapes of other robots.
        """
        parameters = self._parameters
        eye = place(parameters.position, state.position, state.rotation)
        rotation = compose(state.rotation, self._turned)
        view = View(eye, rotation, (parameters.width, parameters.height), parameters.field_of_view)
        return [_message(picture, taken) for taken, picture in self._renderer.show(view, stamp, moving)]

    def collect(self) -> list[CompressedImage]:
        """Pictures taken earlier that have become ready."""
        return [_message(picture, taken) for taken, picture in self._renderer.ready()]

    def close(self) -> None:
        """Free everything; closing twice does nothing."""
        self._renderer.close()


def _message(picture: Picture, stamp: float) -> CompressedImage:
    return CompressedImage(Header(Time.at(stamp), "camera"), "jpeg", jpeg(picture))


def jpeg(picture: Picture) -> bytes:
    """The picture as a JPEG file."""
    file = io.BytesIO()
    height, width, depth = picture.shape
    if depth == 4:  # as Pillow keeps it, so that it is not copied
        image = Image.frombuffer("RGBX", (width, height), picture, "raw", "RGBX", 0, 1)
    else:
        image = Image.fromarray(picture)
    image.save(file, "JPEG", quality=QUALITY)
    return file.getvalue()
