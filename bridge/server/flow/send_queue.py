"""The send queue of one client: straight to its connection while there is room, through priority lanes otherwise."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable
from typing import Protocol

from bridge.core.errors import ProtocolError
from bridge.server.flow.outgoing_messages import OutgoingMessage, ping_frame
from bridge.server.flow.priority_lanes import Lane, PriorityLanes, Stream
from bridge.server.flow.send_window import SendWindow
from bridge.server.reception.log_limit import STRANGERS

__all__ = ["TURN_TIME", "FrameWriter", "SendQueue", "WriteBatch"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

TURN_TIME = 0.005
"""Longest time for one client before the others have their turn [s]; one frame may hold a thousand operations."""
FULL_TURNS = 4
"""Clients that may each have the whole of `TURN_TIME` in one step of the loop; more of them share what these would have, so that
however many flood the robot, the others wait no longer."""
_MAX_REFUSED_TOPICS = 100
"""Most topics of one client for which a failure to send is logged."""


class FrameWriter(Protocol):
    """The connection that frames are written to."""

    paused: bool
    """Whether some of the data written so far is still in this process."""

    @property
    def is_open(self) -> bool:
        """Whether frames may still be written."""

    def write(self, frames: bytes) -> None:
        """Write whole WebSocket frames; returns at once."""

    def abort(self) -> None:
        """Cut the connection at once."""


class WriteBatch:
    """Gathers the frames of one step of the loop, for one write per client."""

    def __init__(self, call_soon: Callable[[Callable[[], None]], object]) -> None:
        """`call_soon` has a function called at the end of this step of the loop."""
        self.held = False
        """Whether the batch waits for an explicit `flush`."""
        self.crowd: set[object] = set()
        """Clients that said more than fits into a turn."""
        self._call_soon = call_soon
        self._waiting: list[SendQueue] = []
        self._frames: list[bytes] = []
        self._piece = b""

    @property
    def share(self) -> float:
        """Share of `TURN_TIME` that a client has in a step of the loop, above 0 to 1."""
        return FULL_TURNS / max(FULL_TURNS, len(self.crowd))

    def add(self, queue: SendQueue) -> None:
        """Flush a queue at the end of this step."""
        if not self._waiting and not self.held:
            self._call_soon(self.flush)
        self._waiting.append(queue)

    def flush(self) -> None:
        """Write everything that was gathered."""
        waiting, self._waiting = self._waiting, []
        for queue in waiting:
            queue.flush()
        self._frames, self._piece = [], b""

    def joined(self, frames: list[bytes]) -> bytes:
        """`frames` in one piece, made once for consecutive clients that get the same."""
        if len(frames) == 1:
            return frames[0]
        if frames != self._frames:
            self._frames, self._piece = frames, b"".join(frames)
        return self._piece


class SendQueue:
    """Sends the messages of one client. What cannot leave soon waits in lanes, bounded by a window of unanswered
    pings."""

    def __init__(
        self, writer: FrameWriter, batch: WriteBatch, name: str, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """`name` is the client's, for the log; `clock` [s] only goes forward."""
        self._writer = writer
        self._batch = batch
        self._name = name
        self._loop = asyncio.get_running_loop()
        self._clock = clock
        self._lanes = PriorityLanes()
        self._urgent: list[bytes] = []
        self._frames: list[bytes] = []
        self._timer: asyncio.TimerHandle | None = None
        self._closing = False
        self._refused: set[str] = set()
        self.window = SendWindow(self._clock())
        """The bytes under way."""

    def send(self, lane: Lane, frame: bytes) -> None:
        """Send a frame that must not be lost. A client with too many waiting frames is disconnected."""
        writer = self._writer
        if lane is Lane.CONTROL and not writer.paused:
            self._gather(self._urgent, frame)
        elif self._has_room() and not self._lanes.is_blocked(lane) and self.window.fits(len(frame)):
            self._gather(self._frames, frame)
        elif self._lanes.push(lane, frame):
            self.send_waiting()
        elif writer.is_open:
            log.warning("%s does not read what it asked for and is disconnected", self._name)
            writer.abort()

    def offer(self, stream: Stream, message: OutgoingMessage) -> None:
        """Send a message of a topic as soon as its interval and the link allow, unless a newer one comes before."""
        if stream.ordered:
            self._send_in_order(stream, message)
            return
        now, window, lanes = self._clock(), self.window, self._lanes
        room = window.limit - window.sent + window.acknowledged
        if (
            stream.waiting
            or self._writer.paused
            or room <= 0
            or now >= window.stalls_at
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
        frames = self._frames
        if not frames and not self._urgent:
            self._batch.add(self)
        frames.append(frame)
        window.sent += size

    def remove(self, stream: Stream) -> None:
        """Drop all messages of a topic that is no longer wanted."""
        self._lanes.remove(stream)

    def flush(self) -> None:
        """Write the gathered frames, with a ping behind them when one is due."""
        frames, self._frames = self._frames, []
        if self._urgent:
            frames = self._urgent + frames
            self._urgent.clear()
        if not self._writer.is_open:
            return
        data, now = self._batch.joined(frames), self._clock()
        if self.window.needs_ping(now, self._lanes.held):
            data += ping_frame(self.window.ping(now))
        if data:
            self._writer.write(data)

    def ping(self, content: bytes) -> None:
        """Send a ping at once, before all that waits; not while the connection is paused."""
        if self._writer.is_open and not self._writer.paused:
            self._writer.write(ping_frame(content))

    def on_pong(self, content: bytes) -> None:
        """Handle a pong."""
        if self.window.on_pong(content, self._clock()):
            self.send_waiting()
            if not self._frames and not self._urgent:
                self._batch.add(self)  # for a ping: the window may have fallen below what is under way

    def send_waiting(self) -> None:
        """Send waiting messages while there is room."""
        now = self._clock()
        while not self._writer.paused and self._lanes.is_blocked(Lane.CONTROL):
            self._gather(self._urgent, self._lanes.pop(now) or b"")
        while not self._writer.paused and self.window.has_room(now):
            try:
                frame = self._lanes.pop(now, self.window.fits)
            except ProtocolError as error:
                log.warning("A message is not sent: %s", error)
                continue
            if frame is None:
                break
            self._gather(self._frames, frame)
        if self._lanes.held and not self._frames and not self._urgent:
            self._batch.add(self)  # for a ping: what is under way must be known to have arrived
        self._arm(now)

    def check_alive(self) -> None:
        """Send a ping when one is due, and disconnect a client that answers none; to be called every second or so."""
        if not self._writer.is_open:
            if self._closing:
                self._writer.abort()
            self._closing = True
        elif self.window.is_dead(self._clock()):
            log.info("%s gave no sign of life and is disconnected", self._name)
            self._writer.abort()
        else:
            self.flush()

    def close(self) -> None:
        """Drop everything: references to this client must not keep its messages in memory."""
        self._lanes.clear()
        self._frames.clear()
        self._urgent.clear()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _wait(self, stream: Stream, message: OutgoingMessage) -> None:
        self._lanes.offer(stream, message)
        self.send_waiting()

    def _has_room(self) -> bool:
        return not self._writer.paused and self.window.has_room(self._clock())

    def _send_in_order(self, stream: Stream, message: OutgoingMessage) -> None:
        try:
            self.send(stream.lane, message.frame(stream.form))
        except ProtocolError as error:
            self._refuse(message.topic, error)

    def _refuse(self, topic: str, error: ProtocolError) -> None:
        """Log once per topic that it cannot be sent: the next message cannot either."""
        if topic not in self._refused and len(self._refused) < _MAX_REFUSED_TOPICS:
            self._refused.add(topic)
            log.warning("%s is not sent to %s: %s", topic, self._name, error)

    def _gather(self, frames: list[bytes], frame: bytes) -> None:
        if not self._urgent and not self._frames:
            self._batch.add(self)
        frames.append(frame)
        self.window.sent += len(frame)

    def _arm(self, now: float) -> None:
        """Set a timer for the next throttled message; messages that wait for room are sent when there is room."""
        if self._lanes.held or not self._has_room() or not self._writer.is_open:
            return
        delay = self._lanes.delay(now)
        if delay is None:
            return
        if self._timer is not None:
            if self._timer.when() <= now + delay:
                return
            self._timer.cancel()
        self._timer = self._loop.call_later(delay, self._on_timer)

    def _on_timer(self) -> None:
        self._timer = None
        self.send_waiting()
