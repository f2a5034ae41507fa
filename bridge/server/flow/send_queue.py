"""The way out to one client: straight to its connection while there is room, by lanes while there is none."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable
from typing import Protocol

from bridge.core.errors import ProtocolError
from bridge.server.flow.outgoing_messages import Outgoing, ping_frame
from bridge.server.flow.priority_lanes import Lane, Lanes, Stream
from bridge.server.flow.send_window import Window

__all__ = ["Line", "Outlet", "Round"]

log = logging.getLogger(__name__)

_MOST_REFUSED = 100
"""So many topics are logged of one client that cannot be sent."""


class Line(Protocol):
    """What frames are written to."""

    paused: bool
    """Not everything written so far has left this process."""

    @property
    def open(self) -> bool:
        """Whether frames may still be written."""

    def write(self, frames: bytes) -> None:
        """Write whole WebSocket frames; returns at once."""

    def cut(self) -> None:
        """Break the connection at once."""


class Round:
    """Gathers what clients get in one step of the loop, so that it leaves in one write for each."""

    def __init__(self, call_soon: Callable[[Callable[[], None]], object]) -> None:
        """`call_soon` has a function called at the end of this step of the loop."""
        self.held = False
        """Whoever set it calls `flush` itself."""
        self._call_soon = call_soon
        self._waiting: list[Outlet] = []
        self._frames: list[bytes] = []
        self._piece = b""

    def add(self, outlet: Outlet) -> None:
        """Have an outlet flushed at the end of this step."""
        if not self._waiting and not self.held:
            self._call_soon(self.flush)
        self._waiting.append(outlet)

    def flush(self) -> None:
        """Have everything leave that was gathered."""
        waiting, self._waiting = self._waiting, []
        for outlet in waiting:
            outlet.flush()
        self._frames, self._piece = [], b""

    def joined(self, frames: list[bytes]) -> bytes:
        """`frames` in one piece, made once for clients that get the same one after the other."""
        if len(frames) == 1:
            return frames[0]
        if frames != self._frames:
            self._frames, self._piece = frames, b"".join(frames)
        return self._piece


class Outlet:
    """The way out to one client. What cannot leave soon waits in lanes, bounded by a window of unanswered pings."""

    def __init__(
        self, line: Line, round: Round, name: str, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """`name` is the client's, for the log; `clock` [s] only goes forward."""
        self._line = line
        self._round = round
        self._name = name
        self._loop = asyncio.get_running_loop()
        self._clock = clock
        self._lanes = Lanes()
        self._urgent: list[bytes] = []
        self._batch: list[bytes] = []
        self._timer: asyncio.TimerHandle | None = None
        self._closing = False
        self._refused: set[str] = set()
        self.window = Window(self._clock())
        """What is under way."""

    def send(self, lane: Lane, frame: bytes) -> None:
        """Send what must not be lost. A client for whom too much waits is cut off."""
        line = self._line
        if lane is Lane.CONTROL and not line.paused:
            self._gather(self._urgent, frame)
        elif self._room() and not self._lanes.blocked(lane) and self.window.fits(len(frame)):
            self._gather(self._batch, frame)
        elif self._lanes.put(lane, frame):
            self.pump()
        elif line.open:
            log.warning("%s does not read what it asked for and is disconnected", self._name)
            line.cut()

    def offer(self, stream: Stream, message: Outgoing) -> None:
        """Send a message of a topic as soon as its interval and the link allow, unless a newer one comes before."""
        if stream.ordered:
            self._send_in_order(stream, message)
            return
        now, window, lanes = self._clock(), self.window, self._lanes
        room = window.limit - window.sent + window.acknowledged
        if (
            stream.waiting
            or self._line.paused
            or room <= 0
            or now >= window.late
            or (lanes.held and stream.lane >= lanes.holding)
        ):
            lanes.offer(stream, message)  # what those before it wait for lets it go as well
            return
        if now < stream.due or lanes.held:
            self._wait(stream, message)
            return
        try:
            frame = message.frame(stream.form)
        except ProtocolError as error:
            self._refuse(message.topic, error)
            return
        size = len(frame)
        if size > room and not window.fits(size):
            self._wait(stream, message)
            return
        if stream.period:
            stream.due = now + stream.period
        batch = self._batch
        if not batch and not self._urgent:
            self._round.add(self)
        batch.append(frame)
        window.sent += size

    def forget(self, stream: Stream) -> None:
        """Nothing of this topic is wanted any more."""
        self._lanes.forget(stream)

    def flush(self) -> None:
        """Write what was gathered, with a ping behind it when one is due."""
        frames, self._batch = self._batch, []
        if self._urgent:
            frames = self._urgent + frames
            self._urgent.clear()
        if not self._line.open:
            return
        data, now = self._round.joined(frames), self._clock()
        if self.window.ping_due(now, self._lanes.held):
            data += ping_frame(self.window.ping(now))
        if data:
            self._line.write(data)

    def ping(self, content: bytes) -> None:
        """Send a ping at once, before all that waits; not while the connection takes nothing."""
        if self._line.open and not self._line.paused:
            self._line.write(ping_frame(content))

    def answered(self, content: bytes) -> None:
        """A pong came."""
        if self.window.pong(content, self._clock()):
            self.pump()
            if not self._batch and not self._urgent:
                self._round.add(self)  # for a ping: the window may have fallen below what is under way

    def pump(self) -> None:
        """Send of what waits as much as there is room for."""
        now = self._clock()
        while not self._line.paused and self._lanes.blocked(Lane.CONTROL):
            self._gather(self._urgent, self._lanes.take(now) or b"")
        while not self._line.paused and self.window.room(now):
            try:
                frame = self._lanes.take(now, self.window.fits)
            except ProtocolError as error:
                log.warning("A message is not sent: %s", error)
                continue
            if frame is None:
                break
            self._gather(self._batch, frame)
        if self._lanes.held and not self._batch and not self._urgent:
            self._round.add(self)  # for a ping: what is under way must be known to have arrived
        self._arm(now)

    def beat(self) -> None:
        """Ask for a sign of life when it is time, and cut off who gives none; to be called every second or so."""
        if not self._line.open:
            if self._closing:
                self._line.cut()
            self._closing = True
        elif self.window.dead(self._clock()):
            log.info("%s gave no sign of life and is disconnected", self._name)
            self._line.cut()
        else:
            self.flush()

    def close(self) -> None:
        """Send nothing more, and keep nothing: what others still hold of this client must not hold what waited for it."""
        self._lanes.clear()
        self._batch.clear()
        self._urgent.clear()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _wait(self, stream: Stream, message: Outgoing) -> None:
        self._lanes.offer(stream, message)
        self.pump()

    def _room(self) -> bool:
        return not self._line.paused and self.window.room(self._clock())

    def _send_in_order(self, stream: Stream, message: Outgoing) -> None:
        try:
            self.send(stream.lane, message.frame(stream.form))
        except ProtocolError as error:
            self._refuse(message.topic, error)

    def _refuse(self, topic: str, error: ProtocolError) -> None:
        """Log once of each topic that it cannot be sent: the next message cannot either."""
        if topic not in self._refused and len(self._refused) < _MOST_REFUSED:
            self._refused.add(topic)
            log.warning("%s is not sent to %s: %s", topic, self._name, error)

    def _gather(self, frames: list[bytes], frame: bytes) -> None:
        if not self._urgent and not self._batch:
            self._round.add(self)
        frames.append(frame)
        self.window.sent += len(frame)

    def _arm(self, now: float) -> None:
        """Come back when a throttled message is due; whatever waits for room comes with the room."""
        if self._lanes.held or not self._room() or not self._line.open:
            return
        delay = self._lanes.delay(now)
        if delay is None:
            return
        if self._timer is not None:
            if self._timer.when() <= now + delay:
                return
            self._timer.cancel()
        self._timer = self._loop.call_later(delay, self._wake)

    def _wake(self) -> None:
        self._timer = None
        self.pump()
