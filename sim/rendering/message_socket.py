"""Whole messages over a socket, of which one side never waits: neither for the rest of a message nor for room for one."""

from __future__ import annotations

import socket
from struct import Struct
from typing import IO

__all__ = ["MAX_MESSAGE", "MessageSocket", "read_message", "write_message"]

MAX_MESSAGE = 1 << 24
"""Longer than any picture [B]."""

_HEADER = Struct("!I")
"""The length of the message that follows [B]."""


class MessageSocket:
    """The side that never waits. It holds at most one message each way. Not thread-safe."""

    def __init__(self, end: socket.socket) -> None:
        """Over this `end`, which it owns from here on."""
        end.setblocking(False)
        self._end = end
        self._unsent = b""
        self._begun = bytearray()

    def fileno(self) -> int:
        """For `select`: readable as soon as some of a message is there, or the other side has ended."""
        return self._end.fileno()

    def is_free(self) -> bool:
        """Hand on what is left of the last message; True when nothing of it is. OSError when the other side has ended."""
        while self._unsent:
            try:
                self._unsent = self._unsent[self._end.send(self._unsent) :]
            except BlockingIOError:
                return False
        return True

    def send(self, message: bytes) -> None:
        """Hand on what fits and keep the rest for `is_free`, which must have been True. OSError when the other side has ended."""
        if self._unsent:
            raise RuntimeError("The message before is still on its way.")
        self._unsent = _framed(message)
        self.is_free()

    def receive(self) -> bytes | None:
        """A message, when the whole of it is there. EOFError or OSError when the other side has ended."""
        size = _HEADER.size
        if not self._reach(size):
            return None
        (length,) = _HEADER.unpack_from(self._begun)
        if length > MAX_MESSAGE:
            raise OSError(f"A message of {length} bytes is announced, and {MAX_MESSAGE} is the most.")
        if not self._reach(size + length):
            return None
        message = bytes(self._begun[size:])
        self._begun.clear()
        return message

    def _reach(self, length: int) -> bool:
        while len(self._begun) < length:
            try:
                piece = self._end.recv(length - len(self._begun))
            except BlockingIOError:
                return False
            if not piece:
                raise EOFError
            self._begun += piece
        return True

    def close(self) -> None:
        """Drop what is under way; closing twice does nothing."""
        self._end.close()


def read_message(stream: IO[bytes]) -> bytes:
    """The next message, waited for. EOFError when the other side has ended."""
    (length,) = _HEADER.unpack(_exactly(stream, _HEADER.size))
    return _exactly(stream, length)


def _exactly(stream: IO[bytes], length: int) -> bytes:
    got = stream.read(length)
    if len(got) < length:
        raise EOFError
    return got


def write_message(end: socket.socket, message: bytes) -> None:
    """Send a message and wait until it is through. OSError when the other side has ended."""
    end.sendall(_framed(message))


def _framed(message: bytes) -> bytes:
    if len(message) > MAX_MESSAGE:
        raise ValueError(f"A message has {len(message)} bytes, and {MAX_MESSAGE} is the most.")
    return _HEADER.pack(len(message)) + message
