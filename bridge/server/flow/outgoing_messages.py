"""Outgoing messages, encoded and framed once for all clients that want them in the same form."""

from __future__ import annotations

import functools
import itertools
import struct
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

import msgspec
from msgspec import Raw

from bridge.codec import Unread, select, to_cbor, to_json, weight
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.std_msgs import Time
from bridge.protocol import Op, Reduction, Subscribed, encode, split, to_png
from bridge.rosbytes import serialize

__all__ = ["Form", "OutgoingMessage", "Reduce", "binary_frame", "op_frames", "ping_frame", "text_frame"]

K = TypeVar("K")
V = TypeVar("V")
Reduce = Callable[[Msg, Reduction], Msg]
"""Makes less of a message, or returns it unchanged. `Reduction.fields` is not its business."""

MAX_FORMS = 16
"""Most forms in which a message is kept; a latched one lives long, and a client may ask for any number one after the
other."""
MAX_LARGE_FORMS = 2
"""As `MAX_FORMS`, for forms of over `LARGE_BYTES`."""
LARGE_BYTES = 1_048_576
"""Size of a large form [byte]."""
MIN_SLICE = 30
"""A slice may be so long, however short a client wants them [characters]; one character each would make a hundred bytes of every
byte, and cost the robot as much time."""
_TEXT, _BINARY, _PING = 0x81, 0x82, 0x89
_HEAD_16, _HEAD_64 = struct.Struct(">BBH").pack, struct.Struct(">BBQ").pack
"""The head of a longer frame: its kind, what says how its length is told, and its length."""
_numbers = itertools.count(1)
_made = itertools.count(1)


class Form(NamedTuple):
    """The form of a message for one client: everything that decides its bytes."""

    name: str
    """The topic as the client wrote it."""
    compression: str = "none"
    """One of `bridge.protocol.COMPRESSIONS`."""
    fragment_size: int | None = None
    """Longest text frame [characters], `MIN_SLICE` at least; None for no limit."""
    reduction: Reduction | None = None
    """The part of it that is sent; None for all."""
    ros2: bool = False
    """Times are named as in ROS 2."""

    @classmethod
    def of(cls, wanted: Subscribed) -> Form:
        """The form that a client asked for."""
        return cls(wanted.name, wanted.compression, wanted.fragment_size, wanted.reduction, wanted.ros2)


def text_frame(text: bytes) -> bytes:
    """`text` as one text frame of a server."""
    return _head(_TEXT, len(text)) + text


def binary_frame(data: bytes) -> bytes:
    """`data` as one binary frame of a server."""
    return _head(_BINARY, len(data)) + data


def ping_frame(content: bytes) -> bytes:
    """A server's ping frame with up to 125 bytes."""
    return _head(_PING, len(content)) + content


def op_frames(op: Op, size: int | None = None) -> bytes:
    """An operation as text frames of at most `size` characters; ProtocolError when it cannot be encoded."""
    return _cut(encode(op), size)


class OutgoingMessage:
    """One published message; encoded when first needed and once per form, for any number of clients."""

    __slots__ = ("_bodies", "_frames", "_msg", "_now", "_reduce", "_reduced", "_weight", "number", "topic")

    def __init__(
        self,
        topic: str,
        msg: Msg | Raw | Unread,
        reduce: Reduce | None = None,
        now: Callable[[], float] = float,
    ) -> None:
        """`msg` as Raw is JSON text of an unknown type; it can be passed on, but not as `cbor-raw`. Unread is passed
        on as it is to all who want it unchanged.

        `now` is the operators' clock [s].
        """
        self.topic = topic
        self.number = next(_made)
        """Serial number; the older one of two messages has the smaller."""
        self._weight = -1
        self._msg = msg
        self._reduce = reduce
        self._now = now
        self._frames: dict[Form, bytes] = {}
        self._bodies: dict[tuple[Reduction | None, bool], bytes] = {}
        if type(msg) is Unread:
            self._bodies[None, False] = msg.text
        self._reduced: dict[Reduction, Msg | Raw] = {}

    def frame(self, form: Form) -> bytes:
        """The message in WebSocket frames; ProtocolError when it cannot be encoded."""
        frame = self._frames.get(form)
        if frame is None:
            frame = self._encode(form)
            _keep(self._frames, form, frame, len(frame))
        return frame

    @property
    def size(self) -> int:
        """Approximate memory [byte], without the encoded forms."""
        if self._weight < 0:
            msg = self._msg.text if isinstance(self._msg, Unread) else self._msg
            self._weight = weight(msg) if isinstance(msg, Msg) else len(msg)
        return self._weight

    @property
    def msg(self) -> Msg | Raw:
        """The whole message."""
        if isinstance(self._msg, Unread):
            self._msg = self._msg.read()
        return self._msg

    def reduced(self, reduction: Reduction | None) -> Msg | Raw:
        """The part of the message that `reduction` leaves; ProtocolError when it lacks the fields."""
        msg = self.msg
        if reduction is None or isinstance(msg, Raw):
            return msg
        found = self._reduced.get(reduction)
        if found is None:
            found = msg if self._reduce is None else self._reduce(msg, reduction)
            if reduction.fields is not None:
                found = select(found, reduction.fields)
            _keep(self._reduced, reduction, found, 0)
        return found

    def _encode(self, form: Form) -> bytes:
        name, compression, size, reduction, ros2 = form
        if compression == "cbor":
            return self._cbor(form, _plain(self.reduced(reduction)))
        if compression == "cbor-raw":
            return self._cbor(form, self._bytes_of_ros(form))
        beginning, body = _beginning(name), self._body(reduction, ros2)
        if compression == "none" and size is None:
            return b"".join((_head(_TEXT, len(beginning) + len(body) + 1), beginning, body, b"}"))
        text = b"".join((beginning, body, b"}"))
        return _cut(encode(to_png(text)) if compression == "png" else text, size)

    def _body(self, reduction: Reduction | None, ros2: bool) -> bytes:
        body = self._bodies.get((reduction, ros2))
        if body is None:
            msg = self.msg if reduction is None else self.reduced(reduction)
            body = bytes(msg) if isinstance(msg, Raw) else to_json(msg, ros2)
            _keep(self._bodies, (reduction, ros2), body, len(body))
        return body

    def _cbor(self, form: Form, msg: object) -> bytes:
        beginning, body = _binary_beginning(form.name), to_cbor(msg, form.ros2)
        return b"".join((_head(_BINARY, len(beginning) + len(body)), beginning, body))

    def _bytes_of_ros(self, form: Form) -> dict[str, Any]:
        msg = self.reduced(form.reduction)
        if isinstance(msg, Raw):
            raise ProtocolError(
                f"The type of {form.name} is not known here, so it cannot be sent as cbor-raw."
            )
        now = Time.at(self._now())
        return {"secs": now.secs, "nsecs": now.nsecs, "bytes": serialize(msg, cdr=form.ros2)}


def _keep(forms: dict[K, V], key: K, form: V, size: int) -> None:
    """Keep a form of `size` [byte], in the place of the oldest when there are many."""
    most = MAX_LARGE_FORMS if size > LARGE_BYTES else MAX_FORMS
    while len(forms) >= most:
        forms.pop(next(iter(list(forms))), None)  # a copy: a worker thread may be at it as well
    forms[key] = form


def _plain(msg: Msg | Raw) -> object:
    return msgspec.json.decode(msg) if isinstance(msg, Raw) else msg


@functools.lru_cache(maxsize=1024)
def _beginning(name: str) -> bytes:
    return b'{"op":"publish","topic":' + msgspec.json.encode(name) + b',"msg":'


@functools.lru_cache(maxsize=1024)
def _binary_beginning(name: str) -> bytes:
    two = to_cbor({"op": "publish", "topic": name})
    return bytes((two[0] + 1,)) + two[1:] + to_cbor("msg")  # a third pair follows, of which this is the key


def _cut(text: bytes, size: int | None) -> bytes:
    if size is None:
        return text_frame(text)
    return b"".join(
        text_frame(each) for each in split(text, max(size, MIN_SLICE), f"fragment:{next(_numbers)}")
    )


def _head(kind: int, length: int) -> bytes:
    """The head of an unmasked frame (RFC 6455, 5.2)."""
    if length < 126:
        return bytes((kind, length))
    if length < 65536:
        return _HEAD_16(kind, 126, length)
    return _HEAD_64(kind, 127, length)
