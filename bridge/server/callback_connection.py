"""A WebSocket of the server that passes messages to a callback, in the step of the loop in which they arrive.

Reading by tasks costs a switch of tasks per message. Here a complete message goes straight to the connection's
`MessageHandler`, and frames that are the same for many clients are written as they are. Closing, pongs, limits and
broken frames remain the library's work. Its `process_event`, `send_data` and `protocol.reader`, which are used here,
are not documented: pyproject.toml caps its version.
"""

from __future__ import annotations

import asyncio
import logging
import math
import time
from collections import deque
from collections.abc import Callable
from typing import Any, Protocol, TypeVar

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode, Frame, Opcode
from websockets.protocol import Event, State

from bridge.server.flow.send_queue import TURN_TIME, WriteBatch
from bridge.server.reception.log_limit import STRANGERS
from bridge.server.reception.places import Place

__all__ = ["MessageHandler", "CallbackConnection"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)
T = TypeVar("T")

MAX_PIECES = 1000
"""Most frames of one message."""
PIECE_BYTES = 32_768
"""Bytes that are handled before the clock is read."""
_DATA = (Opcode.TEXT, Opcode.BINARY, Opcode.CONT)


class MessageHandler(Protocol):
    """The receiver of a connection's messages."""

    def on_message(self, message: str | bytes) -> bool:
        """Handle a message; bytes hold the UTF-8 of a text, or a binary message. False when it takes longer than a
        turn."""

    def resume(self) -> bool:
        """Handle more of what is left; False when there is still more."""

    def on_pong(self, content: bytes) -> None:
        """Handle a pong."""

    def on_drained(self) -> None:
        """Everything written so far has left this process."""


class CallbackConnection(ServerConnection):
    """One WebSocket; an ordinary connection of the library until `serve` is called."""

    clock = staticmethod(time.monotonic)
    batch: WriteBatch | None = None
    """Gathers the frames written in one step of the loop; set by the server."""
    place: Place | None = None
    """Its place on the server's socket; set by the reception."""
    below: asyncio.Transport | None = None
    """The socket's own transport under an encrypted one; set by the reception."""
    on_lost: Callable[[], None] | None = None
    """Called once when the connection is gone; set by the server."""
    _handler: MessageHandler | None = None
    _direct = False
    """Messages go to the handler as they arrive: none waits in the library."""
    _queued = 0
    """Messages that the library has and `recv` has not returned yet."""
    _incomplete = False
    """The library has some frames of a message, but not the last one."""
    _closed = False
    _kind = Opcode.TEXT
    _pieces: list[bytes]
    _behind = False
    _waits = False

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self._unread = bytearray()
        self._undelivered: deque[str | bytes] = deque()
        self._until = math.inf
        self._idle = asyncio.Event()
        self._idle.set()

    @property
    def is_open(self) -> bool:
        """Whether frames may still be written."""
        return not self._closed and self.protocol.state is State.OPEN

    def write(self, frames: bytes) -> None:
        """Write whole frames; returns at once."""
        self.transport.write(frames)

    def abort(self) -> None:
        """Cut the connection at once; of the data received only what came before a close frame is handled."""
        self._closed = self._closed or self.protocol.state is State.OPEN
        self.transport.abort()

    async def serve(self, handler: MessageHandler) -> None:
        """Pass everything to `handler` until the connection ends; ConnectionClosed when it ends badly."""
        if self.below is None:  # under TLS the reception has seen to it
            self.transport.set_write_buffer_limits(high=0)
        self._handler = handler
        try:
            while self._queued or self._incomplete:
                message = await self.recv()
                self._queued -= 1
                self._deliver(handler, message)
                if self._behind and not self._waits:  # the next one may be long in coming
                    self._wait()
            self._direct = True
        except ConnectionClosed:
            pass  # what was heard before it is done all the same
        try:
            await self.wait_closed()
            await self._idle.wait()  # what came before a goodbye counts, a rest above all
        finally:
            self._release()
        if self.close_code not in (CloseCode.NORMAL_CLOSURE, CloseCode.GOING_AWAY):
            raise self.close_exc

    def connection_lost(self, exc: Exception | None) -> None:
        """Leave its place."""
        if self.place is not None:
            self.place.leave()
        super().connection_lost(exc)
        if self.on_lost is not None:
            self.on_lost()

    def data_received(self, data: bytes) -> None:
        """Handle data from the network; much of it in pieces, with a turn for others between them."""
        if self.place is not None:
            self.place.hear()
        if self._waits:
            self._unread += data
        elif self._direct and len(data) > PIECE_BYTES:
            self._unread += data
            self._take_turn()
        else:
            self._until = self.clock() + self._turn
            self._batched(super().data_received, data)
            if self._behind:
                self._wait()

    @property
    def _turn(self) -> float:
        """As long this client may keep the others waiting [s]."""
        return TURN_TIME * (1.0 if self.batch is None else self.batch.share)

    def _take_turn(self) -> None:
        """Handle what was left first, then the data that came after it."""
        take = super().data_received
        self._waits = False
        if self._closed or self._handler is None:
            self._leave_crowd()
            self._idle.set()
            return
        self._until = self.clock() + self._turn
        if self._behind:
            self._batched(self._catch_up, self._handler)
        if self.protocol.state is State.CLOSED:
            self._unread.clear()  # nothing is read of a connection that is lost
        while self._unread and not self._behind and not self._closed:
            piece = bytes(self._unread[:PIECE_BYTES])
            del self._unread[:PIECE_BYTES]
            self._batched(take, piece)
            if self.clock() >= self._until:
                break
        if self._unread or self._behind:
            self._wait()
        else:
            self._leave_crowd()
            self._idle.set()
            self.transport.resume_reading()

    def _release(self) -> None:
        """Drop all data of a connection that has ended, for as long as something still refers to it."""
        self._handler = None
        self._leave_crowd()
        self._unread.clear()
        self._undelivered.clear()
        self._pieces = []
        self.protocol.reader.buffer.clear()  # a frame of which only a part came; the library keeps it

    def _leave_crowd(self) -> None:
        if self.batch is not None:
            self.batch.crowd.discard(self)

    def _wait(self) -> None:
        self._waits = True
        if self.batch is not None:
            self.batch.crowd.add(self)
        self._idle.clear()
        self.transport.pause_reading()
        self.loop.call_soon(self._take_turn)

    def _catch_up(self, handler: MessageHandler) -> None:
        """Handle what was left first, then the messages of the same piece of data."""
        self._behind = False
        try:
            self._behind = not handler.resume()
        except Exception:
            log.exception("A message was not understood")
        while self._undelivered and not self._behind:
            self._deliver(handler, self._undelivered.popleft())
        self._behind = self._behind or bool(self._undelivered)

    def _batched(self, work: Callable[[T], None], about: T) -> None:
        """Call `work`, and send what it causes together."""
        batch = self.batch
        if batch is None or batch.held:
            work(about)
            return
        batch.held = True
        try:
            work(about)
        finally:
            batch.held = False
            batch.flush()

    def resume_writing(self) -> None:
        """Inform the handler that everything written so far has left this process."""
        super().resume_writing()
        if self._handler is not None:
            self._handler.on_drained()

    def process_event(self, event: Event) -> None:
        """Handle one frame."""
        handler = self._handler
        if not isinstance(event, Frame):
            super().process_event(event)
        elif handler is None:
            self._to_library(event)
        elif event.opcode is Opcode.PONG:
            handler.on_pong(bytes(event.data))
        elif not self._direct or event.opcode not in _DATA:
            self._to_library(event)
        elif event.opcode is not Opcode.CONT and event.fin:
            self._complete(handler, event.opcode, bytes(event.data))
        else:
            self._piece(handler, event)

    def _to_library(self, frame: Frame) -> None:
        """Leave a frame to the library; `recv` returns the messages that it makes of data."""
        if frame.opcode in _DATA:
            self._incomplete = not frame.fin
            self._queued += frame.fin
        super().process_event(frame)

    def _piece(self, handler: MessageHandler, frame: Frame) -> None:
        """Handle one frame of a message in several; the library limits the size of all of them together."""
        if frame.opcode is not Opcode.CONT:
            self._kind, self._pieces = frame.opcode, []
        self._pieces.append(bytes(frame.data))
        if len(self._pieces) > MAX_PIECES:
            self._fail(CloseCode.POLICY_VIOLATION, f"a message in over {MAX_PIECES} frames")
        elif frame.fin:
            pieces, self._pieces = self._pieces, []
            self._complete(handler, self._kind, b"".join(pieces))

    def _complete(self, handler: MessageHandler, kind: Opcode, data: bytes) -> None:
        if kind is Opcode.TEXT and not data.isascii():
            try:
                data.decode()
            except UnicodeDecodeError as error:
                self._fail(CloseCode.INVALID_DATA, f"{error.reason} at position {error.start}")
                return
        self._deliver(handler, data)

    def _deliver(self, handler: MessageHandler, message: str | bytes) -> None:
        # a goodbye that came in the same breath as this message has closed the protocol already; it was still sent before
        if self._closed:
            return
        if self.place is not None:
            self.place.asked = True
        if self._behind:
            self._undelivered.append(message)  # of one piece, so they are few or small
            return
        try:
            self._behind = not handler.on_message(message) or self.clock() >= self._until
        except Exception:
            log.exception("A message of %d bytes was not understood", len(message))

    def _fail(self, code: CloseCode, reason: str) -> None:
        self._closed = True
        if self.protocol.state is State.OPEN:
            self.protocol.fail(code, reason)
            self.send_data()
