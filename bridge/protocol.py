"""rosbridge v2 without I/O: text in, operations out, and what each side must remember about the other.

One extension: `publish` may carry `"stamp"`, the instant on the operators' clock [s] at which the sender meant it.
Foreign servers ignore it.
"""

from __future__ import annotations

import functools
import itertools
import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import msgspec
from msgspec import UNSET, Raw, UnsetType

from bridge.codec import from_builtins, from_cbor, from_json, shown
from bridge.errors import ProtocolError
from bridge.msgs import Msg

__all__ = [
    "Advertise",
    "BinaryPublish",
    "CallService",
    "ClientSession",
    "Id",
    "Op",
    "Publish",
    "ServerSession",
    "ServiceResponse",
    "SetLevel",
    "Status",
    "Subscribe",
    "Subscribed",
    "Subscription",
    "Unadvertise",
    "Unsubscribe",
    "absolute",
    "arguments",
    "dump",
    "encode",
    "parse",
    "parse_binary",
]

Id = str | int | float | UnsetType | None
"""Names an interaction; given back as it came. UNSET where the sender gave none."""

_NAMELESS = (None, UNSET)

LEVELS = ("info", "warning", "error", "none")
"""What a client may ask to be told, from everything to nothing."""


class Op(msgspec.Struct, frozen=True, tag_field="op", omit_defaults=True, kw_only=True):
    """One operation of the protocol; the field names are those on the wire."""

    id: Id = UNSET


class Advertise(Op, frozen=True, tag="advertise"):
    """The sender is going to publish on `topic`."""

    topic: str
    type: str | None = None


class Unadvertise(Op, frozen=True, tag="unadvertise"):
    """Takes an `Advertise` back; without `id` all of them for `topic`."""

    topic: str


class Publish(Op, frozen=True, tag="publish"):
    """A message."""

    topic: str
    msg: Raw = Raw(b"{}")
    """The message as JSON text."""
    stamp: float | None = None
    """When the sender meant it [s], operators' clock; None when it does not say."""


class Subscribe(Op, frozen=True, tag="subscribe"):
    """The sender wants what is published on `topic`."""

    topic: str
    type: str | None = None
    throttle_rate: int | float | None = 0
    """Shortest time between two messages [ms]."""
    queue_length: int | float | None = 0
    compression: str | None = "none"
    """`none` or `cbor`; anything else counts as `none`."""


class Unsubscribe(Op, frozen=True, tag="unsubscribe"):
    """Takes a `Subscribe` back; without `id` all of them for `topic`."""

    topic: str


class CallService(Op, frozen=True, tag="call_service"):
    """Asks for something to be done once and answered."""

    service: str
    args: Raw = Raw(b"{}")
    """An object, or a list of the fields in their order, as JSON text."""


class ServiceResponse(Op, frozen=True, tag="service_response", omit_defaults=False):
    """The answer to a `CallService` with the same `id`."""

    service: str = ""
    values: Raw = Raw(b"{}")
    """The response; the reason as a text when `result` is false."""
    result: bool = True


class Status(Op, frozen=True, tag="status", omit_defaults=False):
    """A remark of the server; sent only to those who asked by `SetLevel`."""

    level: str = "error"
    msg: str = ""


class SetLevel(Op, frozen=True, tag="set_level"):
    """Which remarks the sender wants: `info`, `warning`, `error` or `none`."""

    level: str = "error"


@dataclass(frozen=True, slots=True)
class BinaryPublish:
    """A `Publish` that came as CBOR."""

    topic: str
    msg: object
    """The message as decoded, for `codec.from_builtins`."""


_OPS: tuple[type[Op], ...] = (
    Advertise,
    Unadvertise,
    Publish,
    Subscribe,
    Unsubscribe,
    CallService,
    ServiceResponse,
    Status,
    SetLevel,
)
_NAMES = tuple(str(op.__struct_config__.tag) for op in _OPS)


@functools.cache
def _decoder() -> msgspec.json.Decoder[Op]:
    union = functools.reduce(lambda left, right: left | right, _OPS)  # type: ignore[arg-type,return-value]
    return msgspec.json.Decoder(union)


_ENCODER = msgspec.json.Encoder()
_BARE = re.compile(r"\b(NaN|Infinity)\b")


def parse(text: str | bytes) -> Op:
    """The operation in one frame of text; ProtocolError with the first 80 characters when it is none."""
    try:
        return _decode(text)
    except ProtocolError:
        repaired = _without_nan(text)
        if repaired is None:
            raise
    return _decode(repaired)


def parse_binary(raw: bytes) -> BinaryPublish:
    """The publish operation in one binary frame; ProtocolError when it is none."""
    obj = from_cbor(raw)
    if not isinstance(obj, dict) or obj.get("op") != "publish" or not isinstance(obj.get("topic"), str):
        raise ProtocolError(f"A binary frame must hold a publish operation, not {shown(obj)}.")
    return BinaryPublish(obj["topic"], obj.get("msg", {}))


def encode(op: Op) -> bytes:
    """`op` as JSON text in UTF-8."""
    return _ENCODER.encode(op)


def dump(op: Op) -> str:
    """`op` as JSON text."""
    return encode(op).decode()


def absolute(name: str) -> str:
    """A topic's or service's name with its leading slash, as ROS resolves a relative one."""
    return name if name.startswith("/") else f"/{name}"


def arguments(raw: Raw, type: type[Msg]) -> Msg:
    """A service's request in `CallService.args`: an object, a list of fields in their order, or null."""
    text = bytes(raw).lstrip()
    if text.startswith(b"{"):
        return from_json(raw, type)
    values = msgspec.json.decode(text)
    if values is None:
        return type()
    if not isinstance(values, list):
        raise ProtocolError(f"args must be an object or a list, not {shown(values)}.")
    return from_builtins(dict(zip(type.__struct_fields__, values, strict=False)), type)


def _decode(text: str | bytes) -> Op:
    try:
        return _decoder().decode(text)
    except (msgspec.MsgspecError, UnicodeError, RecursionError, OverflowError) as error:
        raise ProtocolError(_explain(error, text)) from error


def _without_nan(text: str | bytes) -> bytes | None:
    """The same JSON with `null` where Python's own encoder writes NaN or Infinity; None when neither is there."""
    try:
        decoded = text if isinstance(text, str) else text.decode()
        if not _BARE.search(decoded):
            return None
        repaired = msgspec.json.encode(json.loads(decoded))
    except (ValueError, RecursionError, OverflowError, TypeError):
        return None
    return repaired


_PLACE = re.compile(r"Expected `(?P<wanted>.+?)`, got `(?P<found>.+?)`(?: - at `\$\.?(?P<path>.*)`)?$")
_MISSING = re.compile(r"Object missing required field `(?P<field>.+?)`")


def _explain(error: Exception, text: str | bytes) -> str:
    start = text[:80] if isinstance(text, str) else text[:80].decode(errors="replace")
    try:
        obj = msgspec.json.decode(text)
    except (msgspec.MsgspecError, UnicodeError, RecursionError, OverflowError):
        return f"This is not JSON: {start!r}."
    if not isinstance(obj, dict):
        return f"An operation must be an object, not {start!r}."
    if obj.get("op") not in _NAMES:
        return f"op must be one of {', '.join(_NAMES)}, not {shown(obj.get('op'))}."
    if found := _PLACE.search(str(error)):
        allowed = found["wanted"].replace(" | ", " or ")
        return f"{obj['op']}: {found['path']} must be {allowed}, not {found['found']}: {start!r}."
    if found := _MISSING.search(str(error)):
        return f"{obj['op']} needs the field {found['field']}: {start!r}."
    return f"{obj['op']}: {error}: {start!r}."


@dataclass(frozen=True, slots=True)
class Subscribed:
    """What one client wants of one topic, all its subscriptions taken together."""

    name: str
    """The topic as the client wrote it."""
    period: float = 0.0
    """Shortest time between two messages [s]."""
    binary: bool = False
    """It wants CBOR."""


class ServerSession:
    """What a server remembers about one client."""

    def __init__(self) -> None:
        self.subscriptions: dict[str, Subscribed] = {}
        """By the topic's absolute name."""
        self.advertised: dict[str, set[Id]] = {}
        """Ids of the advertisements, by the topic's absolute name."""
        self.level = "none"
        """The least remark that the client wants: one of `LEVELS`."""
        self._asked: dict[str, dict[Id, Subscribe]] = {}

    def subscribe(self, op: Subscribe) -> str:
        """Take a subscription in; gives the topic's absolute name. The same id again replaces the first."""
        topic = absolute(op.topic)
        self._asked.setdefault(topic, {})[op.id] = op
        self._merge(topic)
        return topic

    def unsubscribe(self, op: Unsubscribe) -> str:
        """Take a subscription out; gives the topic's absolute name. An unknown one is no error."""
        topic = absolute(op.topic)
        asked = self._asked.get(topic, {})
        if op.id in _NAMELESS:
            asked.clear()
        asked.pop(op.id, None)
        self._merge(topic)
        return topic

    def advertise(self, op: Advertise) -> None:
        """The client is going to publish."""
        self.advertised.setdefault(absolute(op.topic), set()).add(op.id)

    def unadvertise(self, op: Unadvertise) -> None:
        """The client no longer publishes."""
        ids = self.advertised.get(absolute(op.topic), set())
        ids.discard(op.id)
        if op.id in _NAMELESS or not ids:
            self.advertised.pop(absolute(op.topic), None)

    def set_level(self, op: SetLevel) -> None:
        """The client wants remarks from this level on; ProtocolError when there is no such level."""
        if op.level not in LEVELS:
            raise ProtocolError(f"level must be one of {', '.join(LEVELS)}, not {shown(op.level)}.")
        self.level = op.level

    def wants(self, level: str) -> bool:
        """Whether a remark of this level is to be sent."""
        return self.level != "none" and LEVELS.index(level) >= LEVELS.index(self.level)

    def _merge(self, topic: str) -> None:
        asked = list(self._asked.get(topic, {}).values())
        if not asked:
            self._asked.pop(topic, None)
            self.subscriptions.pop(topic, None)
            return
        self.subscriptions[topic] = Subscribed(
            name=asked[0].topic,
            period=max(0.0, min(op.throttle_rate or 0 for op in asked) / 1000),
            binary=any(op.compression == "cbor" for op in asked),
        )


@dataclass(frozen=True, slots=True)
class Subscription:
    """One subscription of a client, remembered over reconnects."""

    op: Subscribe
    type: type[Msg]
    callback: Callable[[Any, float], object]
    """Takes the message and when it was received [s], the client's clock."""


@dataclass(slots=True)
class ClientSession:
    """What a client remembers: its subscriptions and advertisements for ever, its calls until answered."""

    subscriptions: dict[str, dict[Id, Subscription]] = field(default_factory=dict)
    """By topic and id."""
    advertised: dict[str, Advertise] = field(default_factory=dict)
    """By topic."""
    calls: dict[Id, Callable[[ServiceResponse | None], None]] = field(default_factory=dict)
    """What to do with each answer that is still to come, by id."""
    _numbers: Iterator[int] = field(default_factory=lambda: itertools.count(1))

    def subscribe(
        self, op: Subscribe, type: type[Msg], callback: Callable[[Any, float], object]
    ) -> tuple[Subscribe, Unsubscribe]:
        """Remember a subscription; gives what to send now and what to send at its end."""
        named = msgspec.structs.replace(op, id=f"subscribe:{op.topic}:{next(self._numbers)}")
        self.subscriptions.setdefault(op.topic, {})[named.id] = Subscription(named, type, callback)
        return named, Unsubscribe(topic=op.topic, id=named.id)

    def unsubscribe(self, op: Unsubscribe) -> bool:
        """Forget a subscription; False when it was forgotten before."""
        of_topic = self.subscriptions.get(op.topic, {})
        known = of_topic.pop(op.id, None) is not None
        if not of_topic:
            self.subscriptions.pop(op.topic, None)
        return known

    def advertise(self, topic: str, type: type[Msg]) -> Advertise:
        """Remember that this client publishes on `topic`; gives what to send now."""
        op = Advertise(topic=topic, type=type.MSGTYPE, id=f"advertise:{topic}")
        self.advertised[topic] = op
        return op

    def call(
        self, service: str, args: bytes, answer: Callable[[ServiceResponse | None], None]
    ) -> CallService:
        """Remember a call; gives what to send now.

        `answer` is called once at most, with None when the connection is lost first.
        """
        op = CallService(service=service, args=Raw(args), id=f"call:{service}:{next(self._numbers)}")
        self.calls[op.id] = answer
        return op

    def answered(self, op: ServiceResponse) -> bool:
        """Pass an answer to whoever waits for it; False when nobody does."""
        answer = self.calls.pop(op.id, None)
        if answer is not None:
            answer(op)
        return answer is not None

    def lose(self) -> None:
        """The connection is gone, and with it all answers."""
        calls, self.calls = self.calls, {}
        for answer in calls.values():
            answer(None)

    def opening(self) -> Iterator[Op]:
        """Everything to say on a new connection."""
        yield from self.advertised.values()
        for of_topic in self.subscriptions.values():
            for subscription in of_topic.values():
                yield subscription.op

    def subscribers(self, topic: str) -> list[Subscription]:
        """Who wants a message on `topic`."""
        return list(self.subscriptions.get(topic, {}).values())
