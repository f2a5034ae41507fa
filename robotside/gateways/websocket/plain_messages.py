"""The robot's messages as plain JSON in WebSocket frames, made once for all clients; pictures as they are."""

from __future__ import annotations

import msgspec
from msgspec import Raw

from bridge.codec import to_json
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.server.flow.outgoing_messages import Form, OutgoingMessage, binary_frame, text_frame

__all__ = ["NewestMessages", "PlainMessage"]


class PlainMessage(OutgoingMessage):
    """One message of the robot: `{"topic": …, "message": …}`, or a head and the bytes of a picture; Raw is sent as it is."""

    __slots__ = ("_plain",)

    def __init__(self, topic: str, msg: Msg | Raw) -> None:
        super().__init__(topic, msg)
        self._plain = b""

    def frame(self, form: Form) -> bytes:
        """The frames, the same in every form."""
        if not self._plain:
            self._plain = _frames(self.topic, self.msg)
        return self._plain


def _frames(topic: str, msg: Msg | Raw) -> bytes:
    if isinstance(msg, Raw):
        return text_frame(bytes(msg))
    if isinstance(msg, CompressedImage):
        data = bytes(msg.data)
        head = {"topic": topic, "stamp": msg.header.stamp.seconds, "format": msg.format, "size": len(data)}
        return text_frame(msgspec.json.encode(head)) + binary_frame(data)
    return text_frame(
        b"".join((b'{"topic":', msgspec.json.encode(topic), b',"message":', to_json(msg), b"}"))
    )


class NewestMessages:
    """The newest message of each topic that clients have: each is encoded once."""

    def __init__(self) -> None:
        self._newest: dict[str, tuple[Msg, PlainMessage]] = {}

    def of(self, topic: str, msg: Msg) -> PlainMessage:
        """`msg` in frames, as other clients have it."""
        known = self._newest.get(topic)
        if known is None or known[0] is not msg:
            known = self._newest[topic] = msg, PlainMessage(topic, msg)
        return known[1]

    def clear(self) -> None:
        """Nobody has any."""
        self._newest.clear()
