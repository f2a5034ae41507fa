"""Errors of the bridge. The text of each is one sentence that may be shown to the operator."""

from __future__ import annotations

__all__ = ["BridgeError", "NoReply", "NotConnected", "ProtocolError", "Refused"]


class BridgeError(Exception):
    """The base of all errors that this package raises on purpose."""


class ProtocolError(BridgeError):
    """The other side sent something that is no valid message; the text names the part, its value and what is allowed."""

    def __init__(self, sentence: str, *, op: str | None = None, id: str | float | None = None) -> None:
        """`op` and `id` are those of the faulty operation; None where it has none or they cannot be read."""
        super().__init__(sentence)
        self.op = op
        self.id = id


class NotConnected(BridgeError):
    """There is no connection, or it was cut before the answer came."""


class Refused(BridgeError):
    """The other side refused; the text is its own sentence."""


class NoReply(BridgeError):
    """The other side did not answer in time; the outcome of the request is not known."""
