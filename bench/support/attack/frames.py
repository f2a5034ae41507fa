"""Hostile WebSocket frames of many kinds, each made anew from a random generator.

None asks for STOP or control: whoever asks for STOP gets it, by choice, and this measures what the others do.
"""

from __future__ import annotations

import base64
import json
import random
import struct
import zlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from websockets.frames import Frame, Opcode

__all__ = ["BREAKING", "KINDS", "chosen", "hostile"]

OPS = [
    "publish",
    "subscribe",
    "unsubscribe",
    "advertise",
    "unadvertise",
    "call_service",
    "service_response",
    "advertise_service",
    "unadvertise_service",
    "send_action_goal",
    "cancel_action_goal",
    "action_feedback",
    "action_result",
    "advertise_action",
    "status",
    "set_level",
    "auth",
    "fragment",
    "png",
]
FIELDS = [
    "id",
    "topic",
    "type",
    "msg",
    "service",
    "args",
    "values",
    "result",
    "compression",
    "throttle_rate",
    "queue_length",
    "fragment_size",
    "latch",
    "action",
    "goal",
    "feedback",
    "status",
    "level",
    "token",
    "data",
    "num",
    "total",
]
TOPICS = [
    "/cmd_vel",
    "/cmd_vel_stamped",
    "/cmd_manoeuvre",
    "/goal_pose",
    "/initialpose",
    "/pose",
    "/odom",
    "/scan",
    "/map",
    "/camera/image_raw/compressed",
    "/events",
    "/task/status",
    "/control/status",
    "/robot/info",
    "/tf",
    "/rosout",
]
SERVICES = [
    "/stop/release",
    "/stop/hold",
    "/mode/set",
    "/task/start",
    "/task/pause",
    "/task/cancel",
    "/task/queue/set",
    "/mission/set",
    "/mission/recall",
    "/places/set",
    "/places/delete",
    "/schedule/set",
    "/events/get",
    "/events/acknowledge",
    "/history/get",
    "/settings/set",
    "/arm/move",
    "/lights/set",
    "/people/me",
    "/people/list",
    "/people/remove",
    "/people/guest",
    "/people/invite",
    "/pair/scan",
    "/pair/begin",
    "/pair/finish",
    "/rosapi/topics",
    "/rosapi/message_details",
    "/rosapi/set_param",
    "/rosapi/delete_param",
    "/rosapi/get_time",
    "/rosapi/nodes",
]
WORDS = (
    "",
    "a",
    "x" * 5000,
    "\x00",
    "é",
    "🤖",
    "../../etc/passwd",
    "%s%n",
    "'; DROP TABLE",
    "NaN",
    "\\ud800",
)
NUMBERS = (
    "0",
    "-1",
    "1e308",
    "-1e308",
    "1e999",
    "1e-400",
    "9" * 400,
    "NaN",
    "Infinity",
    "-0.0",
    "4294967296",
    "0.1",
)
LARGE = 400_000
"""Bytes of the largest frames, about [byte]."""
MAX_NESTING = 20_000


def _value(rng: random.Random, depth: int = 3) -> str:
    """Any JSON value as text, some of it none at all."""
    kind = rng.randrange(7 if depth else 4)
    if kind == 0:
        return rng.choice(NUMBERS)
    if kind == 1:
        return json.dumps(rng.choice(WORDS)).replace("\\\\", "\\")
    if kind == 2:
        return rng.choice(("true", "false", "null"))
    if kind == 3:
        return json.dumps(rng.choice(TOPICS + SERVICES))
    if kind == 4:
        return "[" + ",".join(_value(rng, depth - 1) for _ in range(rng.randrange(5))) + "]"
    inner = (f'"{rng.choice(FIELDS)}":{_value(rng, depth - 1)}' for _ in range(rng.randrange(5)))
    return "{" + ",".join(inner) + "}"


def _operation(rng: random.Random, **fields: Any) -> bytes:
    return json.dumps({"id": f"i{rng.randrange(10**6)}", **fields}).encode()


def _mixed(rng: random.Random) -> bytes:
    fields = ",".join(f'"{name}":{_value(rng)}' for name in rng.sample(FIELDS, rng.randrange(1, 6)))
    return f'{{"op":"{rng.choice(OPS)}",{fields}}}'.encode()


def _twisted(rng: random.Random) -> bytes:
    topic, number = rng.choice(TOPICS[:5]), rng.choice(NUMBERS)
    return f'{{"op":"publish","topic":"{topic}","msg":{{"linear":{{"x":{number}}},"angular":{_value(rng, 1)}}}}}'.encode()


def _called(rng: random.Random) -> bytes:
    service = rng.choice(SERVICES)
    return f'{{"op":"call_service","id":"c{rng.randrange(99)}","service":"{service}","args":{_value(rng)}}}'.encode()


def _asked(rng: random.Random) -> bytes:
    ops = ("subscribe", "advertise", "unsubscribe", "unadvertise", "advertise_service", "call_service")
    name = f"/flood/{rng.randrange(10**6)}"
    return _operation(rng, op=rng.choice(ops), topic=name, service=name, type="std_msgs/String")


def _watched(rng: random.Random) -> bytes:
    return _operation(
        rng,
        op=rng.choice(("subscribe", "unsubscribe")),
        topic=rng.choice(TOPICS),
        compression=rng.choice(("none", "png", "cbor", "cbor-raw", "zip")),
        throttle_rate=rng.choice((0, 1, -5, 10**12)),
        fragment_size=rng.choice((1, 100, -1, 10**12)),
    )


def _goal(rng: random.Random) -> bytes:
    op = rng.choice(("send_action_goal", "cancel_action_goal", "action_result", "advertise_action"))
    return _operation(rng, op=op, action=rng.choice(("/task/run", "/nothing")), args=rng.choice(WORDS))


def _knocked(rng: random.Random) -> bytes:
    return _operation(
        rng, op="auth", token=rng.choice((rng.randbytes(32).hex(), "p1." + "A" * 43, "", 7, None))
    )


def _garbage(rng: random.Random) -> bytes:
    return bytes(rng.choices(range(32, 127), k=rng.randrange(200)))


def _cut_short(rng: random.Random) -> bytes:
    whole = _mixed(rng)
    return whole[: rng.randrange(len(whole))]


def _deep(rng: random.Random) -> bytes:
    times = rng.randrange(10, MAX_NESTING)
    return rng.choice((b"[", b'{"op":', b'{"op":"publish","msg":[')) * times


def _piece(rng: random.Random) -> bytes:
    return _operation(
        rng,
        op="fragment",
        data=_garbage(rng).decode(),
        num=rng.randrange(-1, 5),
        total=rng.choice((0, 2, 10**9, "many")),
    )


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


PNG_BOMB = base64.b64encode(
    b"\x89PNG\r\n\x1a\n"
    + _chunk(b"IHDR", struct.pack(">IIBBBBB", 50_000, 50_000, 8, 2, 0, 0, 0))
    + _chunk(b"IDAT", zlib.compress(bytes(2_000_000)))
    + _chunk(b"IEND", b"")
).decode()
"""A picture of 50000 x 50000 pixels in a few kilobytes."""


def _bomb(rng: random.Random) -> bytes:
    if rng.random() < 0.5:
        return _operation(rng, op="png", data=PNG_BOMB)
    msg = {"format": "jpeg", "data": PNG_BOMB}
    return _operation(rng, op="publish", topic="/camera/image_raw/compressed", msg=msg)


def _huge(rng: random.Random) -> bytes:
    inside = rng.choice(("0,", '"a",', "[],", "1e308,")) * (LARGE // 4)
    return f'{{"op":"publish","topic":"/scan","msg":{{"ranges":[{inside}0]}}}}'.encode()


def _binary(rng: random.Random) -> bytes:
    claims = (
        b"\x9b\xff\xff\xff\xff\xff\xff\xff\xff",  # an array of 2^64 items
        b"\xbb\x00\x00\x00\xff\xff\xff\xff\xff",  # a map of 2^40
        b"\x5b\x7f\xff\xff\xff\xff\xff\xff\xff",  # a string of bytes as long
        b"\x81" * 5000,
        b"\xc1" * 5000,
        b"\xf9\x7e\x00",
        b"",
    )
    return rng.choice(claims) + rng.randbytes(rng.randrange(40))


def _text(make: Callable[[random.Random], bytes]) -> Callable[[random.Random], list[Frame]]:
    return lambda rng: [Frame(Opcode.TEXT, make(rng))]


def _in_shreds(rng: random.Random) -> list[Frame]:
    whole = _mixed(rng)[:40]
    frames = [Frame(Opcode.CONT, whole[at : at + 1], fin=False) for at in range(1, len(whole))]
    return [Frame(Opcode.TEXT, whole[:1], fin=False), *frames, Frame(Opcode.CONT, b"", fin=True)]


def _controls(rng: random.Random) -> list[Frame]:
    return [
        Frame(rng.choice((Opcode.PING, Opcode.PONG)), rng.randbytes(rng.randrange(125))) for _ in range(5)
    ]


KINDS: Mapping[str, tuple[int, Callable[[random.Random], list[Frame]]]] = {
    "mixed types": (3000, _text(_mixed)),
    "twists of no number": (1500, _text(_twisted)),
    "calls with wrong arguments": (1500, _text(_called)),
    "floods of names": (1500, _text(_asked)),
    "subscriptions": (300, _text(_watched)),
    "goals": (400, _text(_goal)),
    "wrong tokens": (100, _text(_knocked)),
    "garbage": (800, _text(_garbage)),
    "half JSON": (800, _text(_cut_short)),
    "fragments of the protocol": (400, _text(_piece)),
    "frames of one byte": (15, _in_shreds),
    "pings and pongs": (40, _controls),
    "bytes that claim to be CBOR": (300, lambda rng: [Frame(Opcode.BINARY, _binary(rng))]),
    "deep JSON": (20, _text(_deep)),
    "pictures that grow": (5, _text(_bomb)),
    "huge arrays": (2, _text(_huge)),
}
"""By name, how often out of all together, and what makes one."""

BREAKING: Mapping[str, Callable[[random.Random], bytes]] = {
    "text that is no UTF-8": lambda rng: Frame(Opcode.TEXT, b"\xff\xfe" + rng.randbytes(20)).serialize(
        mask=True
    ),
    "an unknown opcode": lambda rng: bytes((0x83 + rng.randrange(4), 0x80)) + rng.randbytes(4),
    "a reserved bit": lambda rng: b"\xf1\x85" + rng.randbytes(9),
    "no mask": lambda _: Frame(Opcode.TEXT, b'{"op":"publish"}').serialize(mask=False),
    "a length of 2^62": lambda rng: b"\x81\xff" + struct.pack(">Q", 1 << 62) + rng.randbytes(60),
    "a close of one byte": lambda rng: b"\x88\x81" + rng.randbytes(5),
    "a continuation of nothing": lambda _: Frame(Opcode.CONT, b"x").serialize(mask=True),
    "half a frame": lambda rng: b"\x81\xfe\xff\xff" + rng.randbytes(rng.randrange(1, 900)),
    "a long ping": lambda rng: b"\x89\xfe\x00\xff" + rng.randbytes(259),
}
"""By name, bytes after which a server has to end the connection, or waits in vain."""

_MAKERS: Sequence[Callable[[random.Random], list[Frame]]] = [make for _, make in KINDS.values()]
_WEIGHTS = [weight for weight, _ in KINDS.values()]


def chosen(rng: random.Random, count: int) -> list[Frame]:
    """About `count` frames of any kind but the breaking ones."""
    return [frame for make in rng.choices(_MAKERS, _WEIGHTS, k=count) for frame in make(rng)]


def hostile(rng: random.Random, count: int) -> tuple[bytes, int]:
    """The same as they go over the wire, and their number."""
    frames = chosen(rng, count)
    return b"".join(frame.serialize(mask=True) for frame in frames), len(frames)
