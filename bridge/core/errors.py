"""What can go wrong on the socket. The text of each is one sentence that may be shown to the operator."""

from __future__ import annotations

__all__ = ["BridgeError", "NoReply", "NotConnected", "ProtocolError", "Refused"]


class BridgeError(Exception):
    """The base of everything that this package raises on purpose."""


class ProtocolError(BridgeError):
    """The other side sent something that is no message; says which part, its value and what is allowed."""

    def __init__(self, sentence: str, *, op: str | None = None, id: str | float | None = None) -> None:
        """`op` and `id` are those of the operation at fault; None where it has none or they cannot be read."""
        super().__init__(sentence)
        self.op = op
        self.id = id


class NotConnected(BridgeError):
    """There is no connection, or it was cut before the answer came."""


class Refused(BridgeError):
    """The other side said no; the text is its own sentence."""


class NoReply(BridgeError):
    """The other side did not answer in time; whether it did what was asked is not known."""
