"""When a frame is drawn: never while the one before is still being drawn, and after what the fingers want was sent.

Kivy draws in the thread that reads the fingers. Where a processor fills the pixels that takes 20 to 60 ms a frame, and the
thread waits for it: a finger that is lifted meanwhile, or that presses STOP, is heard afterwards. So a frame is only begun
when the one before is through, which a fence tells without waiting; until then the loop goes on reading and sending.
Whoever writes into what is being drawn from would wait as well, and asks here first.
"""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable
from typing import Any, Protocol

from kivy.base import EventLoop
from kivy.clock import Clock

from app.core.waking import waking
from bridge.core.codes import Code

__all__ = ["Fences", "FramePacer", "is_touched"]

log = logging.getLogger(__name__)

FRAME_PERIOD = 1 / 60
"""Least time between the beginnings of two frames while a hand is at work [s]."""
CALM_PERIOD = 1 / 30
"""The same where none is: what comes from the robot is looked at no more often."""
CALM_DELAY = 1.0
"""After the last move of a finger or a mouse there is none at work [s]: lists have rolled to rest by then, dialogs are open."""
MAX_FRAME_PERIOD = 1 / 15
"""Greatest one that is kept for the fingers' sake, or because drawing is slow [s]."""
FINGER_SHARE = 0.5
"""Of the time, how much is spent on drawing at most while a finger is down or a control is pushed."""
FINGER_PERIOD = 1 / 125
"""Between two looks at the fingers while one is down [s]."""
SENDING_PAUSE = 0.001
"""Left to the network thread before a frame is begun, when a finger did something [s]; else it had to wait for Python until
the frame is through."""
JITTER = 0.002
"""So much earlier than its period a frame may begin [s]: a turn of the loop is never quite on time."""
LOST_TIMEOUT = 2.0
"""A frame whose fence does not pass for longer is taken to be through [s]: the picture must not stand still for good."""
MAX_LOST = 2
"""So many lost fences in a row, and this OpenGL's are not believed any more: each would hold the picture for LOST_TIMEOUT."""
SLOW_COST, FAST_COST = 1 / 20, 1 / 30
"""A frame takes longer where drawing is slow, and less where it is fast again [s]."""
JUDGED_FRAMES = 20
"""So many frames in a row must be slow, or fast, before that is believed."""


class Fences(Protocol):
    """Tell whether what was drawn is through."""

    def insert(self) -> int | None:
        """A fence behind everything that was drawn so far; None where there was no room for one."""

    def passed(self, fence: int) -> bool:
        """Everything before it is drawn. Waits for nothing."""

    def delete(self, fence: int) -> None:
        """It is not asked for any more."""


def is_touched() -> bool:
    """A finger is down; a mouse that only moves over the window is none."""
    return any(touch.is_touch for touch in EventLoop.touches)


class FramePacer:
    """Decides for each turn of the loop whether its frame is drawn. Everything here happens in the UI thread."""

    def __init__(
        self,
        window: Any,
        fences: Fences | None,
        *,
        pushed: Callable[[], bool] = lambda: False,
        now: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], object] = time.sleep,
    ) -> None:
        """`window` is Kivy's. Without `fences` a frame is through when it was drawn.

        `pushed` says whether a control is out of its middle, whatever pushes it: the hand on a gamepad is a hand at work.
        `now` is our clock [s], `sleep` lets other threads work for so long [s].
        """
        self._window, self._fences, self._pushed = window, fences, pushed
        self._now, self._sleep = now, sleep
        self._begun = -math.inf
        self._cost = 0.0
        self._fence: int | None = None
        self._lost = 0
        """So many fences in a row did not pass."""
        self._drawing = self._flipping = self._moved = False
        self._moved_at = -math.inf
        self._row = 0
        self.slow = False
        """Fewer than 20 frames a second can be drawn: at most 15 are."""
        self._held: Callable[[], object] | None = None
        self._bound: dict[str, Callable[..., object]] = {
            "on_draw": self._draw,
            "on_flip": self._flip,
            "on_motion": self._move,
        }
        self._turn = Clock.create_trigger(lambda _: self.step(), 0, interval=True)
        self._look = waking(lambda: None, FINGER_PERIOD, interval=True)

    def open(self) -> None:
        """Decide from now on; until then each frame is drawn that Kivy wants."""
        self._window.bind(**self._bound)
        self._turn()

    def close(self) -> None:
        """Leave the frames to Kivy again."""
        self._window.unbind(**self._bound)
        self._turn.cancel()
        self._look.cancel()
        self._drawing = False
        self._forget_fence()
        self._held = None

    @property
    def touched(self) -> bool:
        """A finger is down."""
        return is_touched()

    @property
    def busy(self) -> bool:
        """A frame is being drawn: whoever writes into a texture waits for it."""
        return self._drawing

    def when_free(self, act: Callable[[], object]) -> None:
        """Call `act` as soon as no frame is being drawn: now, or in its turn of the loop instead of what waits for that."""
        if self.busy:
            self._held = act
        else:
            act()

    def step(self) -> None:
        """Look whether the frame is through; to be called in each turn of the loop."""
        (self._look if self.touched else self._look.cancel)()
        if self._fence is None or not self._through(self._fence):
            return
        self._end()
        self._forget_fence()
        if self._lost >= MAX_LOST:
            self._fences = None
        self._flipping = True
        try:
            self._window.dispatch("on_flip")
        finally:
            self._flipping = False
        held, self._held = self._held, None
        if held is not None:
            held()

    def _through(self, fence: int) -> bool:
        if self._fences is None or self._fences.passed(fence):
            self._lost = 0
            return True
        late = self._now() - self._begun > LOST_TIMEOUT
        self._lost += late
        return late

    def _end(self) -> None:
        self._drawing, self._cost = False, self._now() - self._begun
        self._judge()

    def _forget_fence(self) -> None:
        if self._fences is not None and self._fence is not None:
            self._fences.delete(self._fence)
        self._fence = None

    def _judge(self) -> None:
        """Slow or fast again, when as many frames in a row were."""
        other = self._cost < FAST_COST if self.slow else self._cost > SLOW_COST
        self._row = self._row + 1 if other else 0
        if self._row >= JUDGED_FRAMES:
            self.slow, self._row = not self.slow, 0
            code = Code.DRAWING_SLOW if self.slow else Code.DRAWING_FAST
            log.warning("%s: %s A frame takes %.3f s.", code, code.meaning, self._cost)

    @property
    def _period(self) -> float:
        """Between the beginnings of the last frame and of the next [s]."""
        if self.slow:
            return MAX_FRAME_PERIOD
        if self.touched or self._pushed():
            return min(max(self._cost / FINGER_SHARE, FRAME_PERIOD), MAX_FRAME_PERIOD)
        return FRAME_PERIOD if self._now() - self._moved_at < CALM_DELAY else CALM_PERIOD

    # what the window tells; true keeps it from the window itself

    def _move(self, *_: object) -> None:
        self._moved, self._moved_at = True, self._now()

    def _draw(self, _: object) -> bool:
        if self._drawing or self._now() - self._begun < self._period - JITTER:
            return True
        if self._moved:
            self._moved = False
            self._sleep(SENDING_PAUSE)
        self._begun, self._drawing = self._now(), True
        return False

    def _flip(self, _: object) -> bool:
        if self._flipping:
            return False
        if not self._drawing or self._fence is not None:
            return True  # there is nothing new to be seen
        self._fence = self._fences.insert() if self._fences is not None else None
        if self._fence is None:
            self._end()
        return self._fence is not None
