"""Pictures drawn and compressed in a process of its own, so that a loop that drives robots never waits for one.

The process draws by OpenGL, or where that is not to be had slowly and smaller by pybullet. Each camera has at most one view that is
being drawn and one that waits; a newer one takes its place. Where the process ends or hangs another takes its place.
"""

from __future__ import annotations

import logging
import math
import os
import pickle
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path

from sim.core.shapes import Shape
from sim.rendering.jpeg import jpeg
from sim.rendering.message_socket import MessageSocket, read_message, write_message
from sim.rendering.renderer import NoRendererError, Renderer, paint
from sim.rendering.view import View
from sim.world.world import World

__all__ = ["DrawingProcess", "main"]

NICENESS = 5
"""Pictures give way to driving where the computer is too slow for both."""

FIRST_PICTURE_TIMEOUT, PICTURE_TIMEOUT = 60.0, 10.0
"""A process that owes pictures and gave none for so long hangs; its first takes longer, for it has to get ready [s]."""
MAX_GAP = 1.0
"""Longer between two looks nobody looked, as in a robot side that was suspended: that does not count as silence of the process [s]."""
MIN_RESTART_PERIOD, MAX_RESTART_PERIOD = 5.0, 60.0
"""From start to start [s]; twice as long after each process that gave no picture."""
WARNING_PERIOD = 60.0
"""The log is told of an end at most so often [s]."""

_MAIN = "import sys; sys.path.insert(0, sys.argv[1]); from sim.rendering.drawing_process import main; main(int(sys.argv[2]))"
_ROOT = Path(__file__).parents[2]

_log = logging.getLogger(__name__)

_Wish = tuple[View, float, tuple[Shape, ...]]


class DrawingProcess:
    """Draws `world` for all its cameras, and never has its caller wait. Not thread-safe."""

    def __init__(self, world: World, clock: Callable[[], float] = time.monotonic) -> None:
        """Start the process, which gets ready; what is asked for before it can draw waits.

        `clock` tells the seconds by which a process hangs. Raises RuntimeError with one sentence when no process can be started.
        """
        self._world, self._clock = world, clock
        self._cameras: list[_BesideRenderer] = []
        self._closed = False
        self._warned, self._is_small = -math.inf, False
        self._period = MIN_RESTART_PERIOD
        try:
            self._start()
        except OSError as fault:
            raise RuntimeError(_cannot(fault)) from fault

    def _start(self) -> None:
        self._pipe: MessageSocket | None = None
        self._started = self._looked = self._clock()
        self._silence = 0.0
        self._under_way, self._has_drawn = 0, False
        ours, theirs = socket.socketpair()
        with theirs:
            try:
                self._process = subprocess.Popen(
                    [sys.executable, "-c", _MAIN, str(_ROOT), str(theirs.fileno())],
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,  # who started the robot side reads lines there
                    pass_fds=(theirs.fileno(),),
                )
            except OSError:
                ours.close()
                raise
        self._pipe = MessageSocket(ours)
        with suppress(OSError):  # one that has ended already is noticed by the next wish
            self._pipe.send(pickle.dumps(self._world))

    def for_camera(self) -> _BesideRenderer:
        """A renderer for one more camera."""
        camera = _BesideRenderer(self, len(self._cameras))
        self._cameras.append(camera)
        return camera

    def ask(self, number: int, wish: _Wish) -> bool:
        """Have something drawn for the camera of this `number`, which has nothing under way; False when that is not possible now."""
        pipe = self._running()
        if pipe is None:
            return False
        try:
            if not pipe.is_free():
                return False
            pipe.send(pickle.dumps((number, wish)))
        except OSError:
            self._lose("has ended")
            return False
        if not self._under_way:
            self._looked, self._silence = self._clock(), 0.0
        self._under_way += 1
        return True

    def take(self) -> None:
        """Hand what is ready to the cameras that it was drawn for."""
        if self._pipe is None:
            return
        try:
            self._pipe.is_free()  # a wish of which a part did not fit goes on
            while self._under_way and (message := self._pipe.receive()) is not None:
                self._silence = 0.0
                self._hear(message)
        except (EOFError, OSError):
            self._lose("has ended")
            return
        now = self._clock()
        self._silence += min(now - self._looked, MAX_GAP)
        self._looked = now
        if self._under_way and self._silence >= (
            PICTURE_TIMEOUT if self._has_drawn else FIRST_PICTURE_TIMEOUT
        ):
            self._lose("hangs")

    def _hear(self, message: bytes) -> None:
        number, stamp, picture = pickle.loads(message)  # noqa: S301 - what the process wrote that this one started
        if number < 0:
            if not self._is_small:
                _log.warning("%s The camera gives 320 x 240 pictures instead.", picture)
            self._is_small = True
            return
        self._under_way -= 1
        self._has_drawn, self._period = True, MIN_RESTART_PERIOD
        self._cameras[number].drawn(stamp, picture)

    def close(self) -> None:
        """End the process; closing twice does nothing."""
        if self._closed:
            return
        self._closed = True
        if self._pipe is not None:
            self._pipe.close()
            self._pipe = None
        self._process.kill()  # it keeps nothing that could be lost
        self._process.wait()

    def _running(self) -> MessageSocket | None:
        """The way to the process; a new one is started when it is time for that."""
        if self._pipe is not None or self._closed:
            return self._pipe
        early = self._clock() - self._started < self._period
        if early or self._process.poll() is None:  # one that hangs in the kernel is not waited for
            return None
        self._period = min(2 * self._period, MAX_RESTART_PERIOD)
        try:
            self._start()
        except OSError as fault:
            self._warn(_cannot(fault))
        return self._pipe

    def _lose(self, how: str) -> None:
        """The process gives nothing more; what the cameras asked of it waits for the next one."""
        self._warn(f"The process that draws the cameras' pictures {how}; another takes its place.")
        self._process.kill()
        if self._pipe is not None:
            self._pipe.close()
            self._pipe = None
        for camera in self._cameras:
            camera.lost()

    def _warn(self, words: str) -> None:
        now = self._clock()
        if now - self._warned >= WARNING_PERIOD:
            self._warned = now
            _log.warning(words)


def _cannot(fault: OSError) -> str:
    return f"The process that draws the cameras' pictures cannot be started: {fault.strerror or fault}."


class _BesideRenderer:
    """Of one camera."""

    def __init__(self, process: DrawingProcess, number: int) -> None:
        self._process, self._number = process, number
        self._asked: _Wish | None = None
        self._waiting: _Wish | None = None
        self._ready: list[tuple[float, bytes]] = []

    def show(self, view: View, stamp: float, moving: Sequence[Shape] = ()) -> list[tuple[float, bytes]]:
        """Have `view` as of `stamp` [s] drawn with what is `moving`; gives what is ready by now, oldest first."""
        self._waiting = (view, stamp, tuple(moving))
        return self.ready()

    def ready(self, *, wait: bool = False) -> list[tuple[float, bytes]]:
        """Pictures that became ready since the last call; it never waits."""
        del wait
        if self._asked is not None:
            self._process.take()
        wish = self._waiting
        if self._asked is None and wish is not None and self._process.ask(self._number, wish):
            self._asked, self._waiting = wish, None
        ready, self._ready = self._ready, []
        return ready

    def drawn(self, stamp: float, picture: bytes) -> None:
        """The picture of `stamp` [s] is ready."""
        self._asked = None
        self._ready = [(stamp, picture)]

    def lost(self) -> None:
        """What was asked for will not come; it is asked for again, unless something newer waits."""
        self._waiting, self._asked = self._waiting or self._asked, None

    def close(self) -> None:
        """Ask for nothing more; the process is that of all cameras."""
        self._waiting = None


def main(number: int) -> None:
    """The process: draw every view that comes through the socket of this file `number` until that closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who started it ends it
    os.nice(NICENESS)
    with socket.socket(fileno=number) as end, suppress(EOFError, OSError), end.makefile("rb") as stream:
        world = pickle.loads(read_message(stream))  # noqa: S301 - what the process that started this one wrote
        paint(world)
        draw: Callable[[View, Sequence[Shape]], bytes] | None = None
        while True:
            camera, (view, stamp, moving) = pickle.loads(read_message(stream))  # noqa: S301 - so is this
            draw = draw or _pen(world, end)  # only now, for OpenGL takes 90 MB
            write_message(end, pickle.dumps((camera, stamp, draw(view, moving))))


def _pen(world: World, end: socket.socket) -> Callable[[View, Sequence[Shape]], bytes]:
    try:
        renderer = Renderer(world)
    except NoRendererError as fault:
        from sim.rendering.tiny_renderer import SmallPictures  # a physics engine, which is seldom needed here

        write_message(end, pickle.dumps((-1, 0.0, str(fault))))
        small = SmallPictures(world)
        return lambda view, _: jpeg(small.draw(view))
    return lambda view, moving: jpeg(renderer.draw(view, moving))
