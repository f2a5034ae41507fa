"""A WebSocket of the server whose messages are heard at once, in the step of the loop in which they come.

Reading by tasks costs a switch of tasks a message. Here a complete message goes straight to whoever hears the
connection, and frames that are the same for many are written as they are. Closing, answers to pings, limits and broken
frames stay the library's own work.
"""

from __future__ import annotations

import asyncio
import logging
import math
import time
from collections import deque
from collections.abc import Callable
from typing import Any, Protocol

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode, Frame, Opcode
from websockets.protocol import Event, State

from bridge.server.flow.send_queue import Round
from bridge.server.flow.sockets import TURN

__all__ = ["Ears", "HeardConnection"]

log = logging.getLogger(__name__)

MOST = 128
"""Connections open at a time; for one more the oldest that has not shaken hands is closed, else that one."""
MOST_PIECES = 1000
"""Frames that one message may come in."""
PIECE = 32_768
"""So much of what came is looked at before the clock is [byte]."""
_DATA = (Opcode.TEXT, Opcode.BINARY, Opcode.CONT)


class Ears(Protocol):
    """Hears a connection."""

    def hear(self, message: str | bytes) -> bool:
        """A message came; bytes hold the UTF-8 of a text or a binary message. False when it asks for more than a turn."""

    def go_on(self) -> bool:
        """Do more of what was heard; False when there is still more."""

    def answered(self, content: bytes) -> None:
        """A pong came."""

    def pump(self) -> None:
        """Everything written so far left this process."""


class HeardConnection(ServerConnection):
    """One WebSocket; works as any other until it is heard."""

    clock = staticmethod(time.monotonic)
    round: Round | None = None
    """Where what is written in one step of the loop is gathered; set by the server."""
    crowd: dict[HeardConnection, None] | None = None
    """All of one server, the oldest first; set by the server."""
    _ears: Ears | None = None
    _direct = False
    _deaf = False
    _kind = Opcode.TEXT
    _pieces: list[bytes]
    _behind = False
    _waits = False

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self._rest = bytearray()
        self._unheard: deque[str | bytes] = deque()
        self._until = math.inf
        self._idle = asyncio.Event()
        self._idle.set()

    @property
    def open(self) -> bool:
        """Whether frames may still be written."""
        return not self._deaf and self.protocol.state is State.OPEN

    def write(self, frames: bytes) -> None:
        """Write whole frames of this side; returns at once."""
        self.transport.write(frames)

    def cut(self) -> None:
        """Break the connection at once; nothing that came is heard any more, but for what came before a goodbye."""
        self._deaf = self._deaf or self.protocol.state is State.OPEN
        self.transport.abort()

    async def heard_by(self, ears: Ears) -> None:
        """Have `ears` hear everything until the connection ends; ConnectionClosed when it ends badly."""
        self.transport.set_write_buffer_limits(high=0)
        self._ears = ears
        try:
            while not self._take_over():
                message = await self.recv()
                self._tell(ears, message)
                if self._behind and not self._waits:  # the next one may be long in coming
                    self._wait()
        except ConnectionClosed:
            pass  # what was heard before it is done all the same
        try:
            await self.wait_closed()
            await self._idle.wait()  # what came before a goodbye counts, a rest above all
        finally:
            self._forget()
        if self.close_code not in (CloseCode.NORMAL_CLOSURE, CloseCode.GOING_AWAY):
            raise self.close_exc

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Let it in if there is room or somebody has not shaken hands."""
        super().connection_made(transport)
        if self.crowd is None:
            return
        self.crowd[self] = None
        if len(self.crowd) > MOST:
            strangers = (other for other in self.crowd if other.protocol.state is State.CONNECTING)
            oldest = next(strangers, self)
            del self.crowd[oldest]
            oldest.transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        """It is gone."""
        if self.crowd is not None:
            self.crowd.pop(self, None)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Take what came from the network, in pieces with a turn for others between when it is much."""
        if self._waits:
            self._rest += data
        elif self._direct and len(data) > PIECE:
            self._rest += data
            self._go_on()
        else:
            self._until = self.clock() + TURN
            self._together(super().data_received, data)
            if self._behind:
                self._wait()

    def _go_on(self) -> None:
        """Have a turn: what was heard first, then what came after it."""
        take = super().data_received
        self._waits = False
        if self._deaf or self._ears is None:
            self._idle.set()
            return
        self._until = self.clock() + TURN
        if self._behind:
            self._together(self._catch_up, self._ears)
        if self.protocol.state is State.CLOSED:
            self._rest.clear()  # nothing is read of a connection that is lost
        while self._rest and not self._behind and not self._deaf:
            piece = self._rest[:PIECE]
            del self._rest[:PIECE]
            self._together(take, piece)
            if self.clock() >= self._until:
                break
        if self._rest or self._behind:
            self._wait()
        else:
            self._idle.set()
            self.transport.resume_reading()

    def _forget(self) -> None:
        """It is over: keep nothing of what came, for as long as anybody still holds this connection."""
        self._ears = None
        self._rest.clear()
        self._unheard.clear()
        self._pieces = []
        self.protocol.reader.buffer.clear()  # a frame of which only a part came; the library keeps it

    def _wait(self) -> None:
        self._waits = True
        self._idle.clear()
        self.transport.pause_reading()
        self.loop.call_soon(self._go_on)

    def _catch_up(self, ears: Ears) -> None:
        """What was heard and not done first, then what came in the same piece."""
        self._behind = False
        try:
            self._behind = not ears.go_on()
        except Exception:
            log.exception("A message was not understood")
        while self._unheard and not self._behind:
            self._tell(ears, self._unheard.popleft())
        self._behind = self._behind or bool(self._unheard)

    def _together(self, work: Callable[[Any], None], about: Any) -> None:
        """Let what `work` causes leave together."""
        round = self.round
        if round is None or round.held:
            work(about)
            return
        round.held = True
        try:
            work(about)
        finally:
            round.held = False
            round.flush()

    def resume_writing(self) -> None:
        """Everything written so far left this process."""
        super().resume_writing()
        if self._ears is not None:
            self._ears.pump()

    def process_event(self, event: Event) -> None:
        """Take one frame."""
        ears = self._ears
        if ears is None or not isinstance(event, Frame):
            super().process_event(event)
        elif event.opcode is Opcode.PONG:
            ears.answered(bytes(event.data))
        elif not self._direct or event.opcode not in _DATA:
            super().process_event(event)
        elif event.opcode is not Opcode.CONT and event.fin:
            self._complete(ears, event.opcode, bytes(event.data))
        else:
            self._piece(ears, event)

    def _take_over(self) -> bool:
        """Whether from now on messages are heard as they come: nothing waits in the library's queue."""
        # a message in several frames of which some went there ends there
        self._direct = not self.recv_messages.frames and self.protocol.current_size is None
        return self._direct

    def _piece(self, ears: Ears, frame: Frame) -> None:
        """One frame of a message in several; the library bounds them all together."""
        if frame.opcode is not Opcode.CONT:
            self._kind, self._pieces = frame.opcode, []
        self._pieces.append(bytes(frame.data))
        if len(self._pieces) > MOST_PIECES:
            self._give_up(CloseCode.POLICY_VIOLATION, f"a message in over {MOST_PIECES} frames")
        elif frame.fin:
            pieces, self._pieces = self._pieces, []
            self._complete(ears, self._kind, b"".join(pieces))

    def _complete(self, ears: Ears, kind: Opcode, data: bytes) -> None:
        if kind is Opcode.TEXT and not data.isascii():
            try:
                data.decode()
            except UnicodeDecodeError as error:
                self._give_up(CloseCode.INVALID_DATA, f"{error.reason} at position {error.start}")
                return
        self._tell(ears, data)

    def _tell(self, ears: Ears, message: str | bytes) -> None:
        # a goodbye that came in the same breath as this message has closed the protocol already; it was still sent before
        if self._deaf:
            return
        if self._behind:
            self._unheard.append(message)  # of one piece, so they are few or small
            return
        try:
            self._behind = not ears.hear(message) or self.clock() >= self._until
        except Exception:
            log.exception("A message of %d bytes was not understood", len(message))

    def _give_up(self, code: CloseCode, reason: str) -> None:
        self._deaf = True
        if self.protocol.state is State.OPEN:
            self.protocol.fail(code, reason)
            self.send_data()
