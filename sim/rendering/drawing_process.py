"""Pictures drawn and compressed in a process of its own, so that a loop that drives robots never waits for one.

The process draws by OpenGL, or where that is not to be had slowly and smaller by pybullet. Each camera has at most one view that is
being drawn and one that waits; a newer one takes its place.
"""

from __future__ import annotations

import logging
import os
import pickle
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path

from sim.core.shapes import Shape
from sim.rendering.jpeg import jpeg
from sim.rendering.renderer import NoRendererError, Renderer, paint
from sim.rendering.view import View
from sim.world.world import World

__all__ = ["DrawingProcess", "main"]

NICENESS = 5
"""Pictures give way to driving where the computer is too slow for both."""

_MAIN = "import sys; sys.path.insert(0, sys.argv[1]); from sim.rendering.drawing_process import main; main(int(sys.argv[2]))"
_ROOT = Path(__file__).parents[2]

_log = logging.getLogger(__name__)

_Wish = tuple[View, float, tuple[Shape, ...]]


class DrawingProcess:
    """Draws `world` for all its cameras. Not thread-safe."""

    def __init__(self, world: World) -> None:
        """Start the process, which gets ready; what is asked for before it can draw waits."""
        ours, theirs = socket.socketpair()
        with theirs, tempfile.TemporaryFile() as file:
            pickle.dump(world, file)  # by a file, which does not have to be read before this goes on
            file.seek(0)
            self._process = subprocess.Popen(
                [sys.executable, "-c", _MAIN, str(_ROOT), str(theirs.fileno())],
                stdin=file,
                stdout=subprocess.DEVNULL,  # who started the robot side reads lines there
                pass_fds=(theirs.fileno(),),
            )
        self._pipe = Connection(ours.detach())
        self._cameras: list[_BesideRenderer] = []
        self._under_way = 0
        self._closed = False

    def for_camera(self) -> _BesideRenderer:
        """A renderer for one more camera."""
        camera = _BesideRenderer(self, len(self._cameras))
        self._cameras.append(camera)
        return camera

    def ask(self, number: int, wish: _Wish) -> bool:
        """Have something drawn for the camera of this `number`, which has nothing under way; False when that is not possible."""
        if self._closed:
            return False
        try:
            self._pipe.send((number, wish))
        except OSError:
            self._give_up()
            return False
        self._under_way += 1
        return True

    def take(self) -> None:
        """Hand what is ready to the cameras that it was drawn for."""
        try:
            while self._under_way and not self._closed and self._pipe.poll(0):
                number, stamp, picture = self._pipe.recv()
                if number < 0:
                    _log.warning("%s The camera gives 320 x 240 pictures instead.", picture)
                    continue
                self._under_way -= 1
                self._cameras[number].drawn(stamp, picture)
        except (EOFError, OSError):
            self._give_up()

    def close(self) -> None:
        """End the process; closing twice does nothing."""
        if self._closed:
            return
        self._closed = True
        self._pipe.close()
        self._process.kill()  # it keeps nothing that could be lost
        self._process.wait()

    def _give_up(self) -> None:
        _log.warning("The process that draws the camera's pictures has ended; there are no more.")
        self.close()


class _BesideRenderer:
    """Of one camera."""

    def __init__(self, process: DrawingProcess, number: int) -> None:
        self._process, self._number = process, number
        self._busy = False
        self._waiting: _Wish | None = None
        self._ready: list[tuple[float, bytes]] = []

    def show(self, view: View, stamp: float, moving: Sequence[Shape] = ()) -> list[tuple[float, bytes]]:
        """Have `view` as of `stamp` [s] drawn with what is `moving`; gives what is ready by now, oldest first."""
        self._waiting = (view, stamp, tuple(moving))
        return self.ready()

    def ready(self, *, wait: bool = False) -> list[tuple[float, bytes]]:
        """Pictures that became ready since the last call; it never waits."""
        del wait
        if self._busy:
            self._process.take()
        if not self._busy and self._waiting is not None:
            self._busy, self._waiting = self._process.ask(self._number, self._waiting), None
        ready, self._ready = self._ready, []
        return ready

    def drawn(self, stamp: float, picture: bytes) -> None:
        """The picture of `stamp` [s] is ready."""
        self._busy = False
        self._ready = [(stamp, picture)]

    def close(self) -> None:
        """Ask for nothing more; the process is that of all cameras."""
        self._waiting = None


def main(number: int) -> None:
    """The process: draw every view that comes through the socket of this file `number` until that closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who started it ends it
    os.nice(NICENESS)
    with Connection(number) as pipe, suppress(EOFError, OSError):
        world = pickle.load(sys.stdin.buffer)  # noqa: S301 - what the process that started this one wrote
        paint(world)
        draw: Callable[[View, Sequence[Shape]], bytes] | None = None
        while True:
            camera, (view, stamp, moving) = pipe.recv()
            draw = draw or _pen(world, pipe)  # only now, for OpenGL takes 90 MB
            pipe.send((camera, stamp, draw(view, moving)))


def _pen(world: World, pipe: Connection) -> Callable[[View, Sequence[Shape]], bytes]:
    try:
        renderer = Renderer(world)
    except NoRendererError as fault:
        from sim.rendering.tiny_renderer import SmallPictures  # a physics engine, which is seldom needed here

        pipe.send((-1, 0.0, str(fault)))
        small = SmallPictures(world)
        return lambda view, _: jpeg(small.draw(view))
    return lambda view, moving: jpeg(renderer.draw(view, moving))
