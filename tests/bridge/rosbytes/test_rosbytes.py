"""Bytes of ROS, against the serialisers of rosbags."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable
from typing import Any, ClassVar

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from bridge.codec.fields import CODES, Field, bare, fields_of, is_time, ros_fields
from bridge.core.errors import ProtocolError
from bridge.msgs import TYPES, Msg
from bridge.msgs.arrays import Float32Array
from bridge.msgs.std_msgs import Duration, Empty, Header, Time
from bridge.rosbytes import deserialize, serialize
from tests.looped import looped


class Inner(Msg, frozen=True, gc=False):
    """Is nested with an odd number of bytes."""

    MSGTYPE: ClassVar[str] = "test_msgs/Inner"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8", "string", "float64[]")
    a: int
    b: str
    c: list[float]


class Everything(Msg, frozen=True, gc=False):
    """Every kind of field there is, each after one that leaves the next in an odd place."""

    MSGTYPE: ClassVar[str] = "test_msgs/Everything"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        *("std_msgs/Header", "bool", "float64", "int8", "uint64[3]", "string", "int16[]", "uint16", "int32"),
        *("test_msgs/Inner", "byte", "test_msgs/Inner[]", "char", "std_msgs/Empty", "uint8", "string[<=3]"),
        *("float32[<=4]", "uint8[]", "uint8[4]", "time", "uint32", "time[]", "duration", "int64", "float32"),
        *("test_msgs/Inner[2]", "string<=5", "bool[]", "std_msgs/Empty[2]"),
    )
    header: Header
    flag: bool
    real: float
    small: int
    three: list[int]
    text: str
    shorts: list[int]
    word: int
    whole: int
    inner: Inner
    level: int
    inners: list[Inner]
    letter: int
    nothing: Empty
    one: int
    texts: list[str]
    floats: Float32Array
    raw: bytes
    four: bytes
    stamp: Time
    number: int
    stamps: list[Time]
    length: Duration
    long: int
    ratio: float
    pair: list[Inner]
    brief: str
    flags: list[bool]
    empties: list[Empty]


CLASSES = {Everything.MSGTYPE: Everything} | {
    name: cls for name, cls in TYPES.items() if hasattr(cls, "ROSTYPES") and not is_time(cls)
}
DTYPES = {name: np.dtype(f"<{code}") if code != "?" else np.dtype(bool) for name, code in CODES.items()}
BITS = {code: np.dtype(code).itemsize * 8 for code in "bBhHiIqQ"}
ASCII = st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=5)


def number(base: str) -> st.SearchStrategy[Any]:
    code = CODES[base]
    if code == "?":
        return st.booleans()
    if code in "fd":
        return st.floats(width=32 if code == "f" else 64)
    if base == "byte":
        return st.integers(0, 127)  # above it ROS 1 and ROS 2 mean different numbers by the same bits
    top = 2 ** BITS[code]
    return st.integers(0, top - 1) if code.isupper() else st.integers(-top // 2, top // 2 - 1)


def one(field: Field) -> st.SearchStrategy[Any]:
    if field.type is not None:
        return messages(field.type)
    return ASCII if field.base == "string" else number(field.base)


def values(field: Field) -> st.SearchStrategy[Any]:
    if not field.array:
        return one(field)
    many = st.lists(
        one(field), min_size=field.length or 0, max_size=3 if field.length is None else field.length
    )
    kind = bare(field.hint)
    make: Callable[[Any], Any] = kind if isinstance(kind, type) else list
    return many.map(make)


def messages(cls: type[Msg]) -> st.SearchStrategy[Any]:
    if is_time(cls):
        return st.builds(cls, secs=st.integers(0, 2**31 - 1), nsecs=st.integers(0, 999_999_999))
    return st.builds(cls, **{field.name: values(field) for field in fields_of(cls)})


def ros_name(name: str) -> str:
    package, _, rest = name.partition("/")
    return {"time": "builtin_interfaces/msg/Time", "duration": "builtin_interfaces/msg/Duration"}.get(
        name, f"{package}/msg/{rest}"
    )


def text_of(cls: type[Msg], ros1: bool) -> str:
    return "\n".join(f"{field.rostype} {field.name}" for field in ros_fields(cls, not ros1))


@functools.cache
def store(ros1: bool) -> Any:
    made = get_typestore(Stores.EMPTY)
    known: dict[str, Any] = {}
    for name in ("Time", "Duration"):
        known |= get_types_from_msg("int32 sec\nuint32 nanosec", f"builtin_interfaces/msg/{name}")
    waiting: list[type[Msg]] = list(CLASSES.values())
    while waiting:
        cls = waiting.pop()
        name = ros_name(cls.MSGTYPE)
        if name not in known:
            known |= get_types_from_msg(text_of(cls, ros1), name)
            waiting += [field.type for field in fields_of(cls) if field.type and not is_time(field.type)]
    made.register(known)
    return made


def theirs(msg: Msg, types: Any) -> Any:
    """The same message as rosbags keeps it."""
    made = types.types[ros_name(type(msg).MSGTYPE)]
    if isinstance(msg, Time):
        return made(sec=msg.secs, nanosec=msg.nsecs)
    ros2 = isinstance(msg, Header) and "seq" not in made.__dataclass_fields__
    fields = ros_fields(type(msg), ros2)
    told = {field.name: their_value(getattr(msg, field.name), field, types) for field in fields}
    if not told and made.__dataclass_fields__:
        told["structure_needs_at_least_one_member"] = 0
    return made(**told)


def without_count(value: Any) -> Any:
    """The same message as ROS 2 has it: headers do not count."""
    if isinstance(value, list):
        return [without_count(each) for each in value]
    if not isinstance(value, Msg):
        return value
    kept = {name: without_count(getattr(value, name)) for name in value.__struct_fields__}
    return msgspec.structs.replace(value, **(kept | ({"seq": 0} if isinstance(value, Header) else {})))


def their_value(value: Any, field: Field, types: Any) -> Any:
    if field.type is not None:
        return [theirs(each, types) for each in value] if field.array else theirs(value, types)
    if field.array and field.base != "string":
        return np.array(list(value), dtype=DTYPES[field.base])
    return value


@looped("cls", CLASSES.values())
@settings(max_examples=5, deadline=None)
@given(data=st.data())
def test_every_type_has_the_bytes_that_rosbags_gives_it(cls, data):
    msg = data.draw(messages(cls))
    for cdr in (False, True):
        types = store(not cdr)
        write = types.serialize_cdr if cdr else types.serialize_ros1
        raw = bytes(write(theirs(msg, types), ros_name(cls.MSGTYPE)))
        assert serialize(msg, cdr) == raw
        assert serialize(deserialize(raw, cls, cdr), cdr) == raw
        assert repr(deserialize(raw, cls, cdr)) == repr(without_count(msg) if cdr else msg)


def test_a_time_alone_has_two_numbers():
    assert serialize(Time(1, 2)) == b"\1\0\0\0\2\0\0\0"
    assert serialize(Duration(-1, 2)) == b"\xff\xff\xff\xff\2\0\0\0"
    assert serialize(Time(1, 2), cdr=True) == b"\0\1\0\0\1\0\0\0\2\0\0\0"


class Vague(Msg, frozen=True, gc=False):
    """Does not say how wide its numbers are."""

    MSGTYPE: ClassVar[str] = "test_msgs/Vague"
    x: int = 0


class Pair(Msg, frozen=True, gc=False):
    """Two small numbers."""

    MSGTYPE: ClassVar[str] = "test_msgs/Pair"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8[2]", "wstring")
    values: list[int]
    name: str = ""


class Byte(Msg, frozen=True, gc=False):
    """A small number."""

    MSGTYPE: ClassVar[str] = "test_msgs/Byte"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8[2]",)
    data: list[int]


@pytest.mark.parametrize(
    ("msg", "sentence"),
    [
        (Vague(), "test_msgs/Vague does not give the widths of its numbers."),
        (Pair([1, 2]), "name is a wstring, which has no form in bytes of ROS here."),
        (Byte([1, 2, 3]), "data must hold 2, not 3."),
        (Byte([1, 300]), "test_msgs/Byte cannot be sent as bytes of ROS: "),
        (Time(-1, 0), "time cannot be sent as bytes of ROS: "),
    ],
)
def test_what_has_no_such_bytes_is_a_protocol_error(msg, sentence):
    with pytest.raises(ProtocolError) as caught:
        serialize(msg)
    assert str(caught.value).startswith(sentence)


@pytest.mark.parametrize("cdr", [False, True], ids=["ros1", "cdr"])
@settings(max_examples=80, deadline=None)
@given(data=st.data())
def test_nothing_but_a_protocol_error_leaves_the_reader(cdr, data):
    whole = serialize(data.draw(messages(Everything)), cdr)
    raw = data.draw(
        st.one_of(st.binary(max_size=80), st.integers(0, len(whole)).map(lambda end: whole[:end]))
    )
    with contextlib.suppress(ProtocolError):
        deserialize(raw, Everything, cdr)


@pytest.mark.parametrize(
    ("raw", "cdr", "sentence"),
    [
        (b"\1\2\3", False, "3 bytes that are no test_msgs/Byte: 2 would be enough."),
        (b"\1", False, "1 bytes that are no test_msgs/Byte: it ends after 1 bytes, where 2 are needed."),
        (
            b"\0\0\0\0\1\2",
            True,
            "test_msgs/Byte is not in little-endian CDR: it begins with b'\\x00\\x00\\x00\\x00'.",
        ),
    ],
)
def test_bytes_that_are_no_such_message_are_a_protocol_error(raw, cdr, sentence):
    with pytest.raises(ProtocolError) as caught:
        deserialize(raw, Byte, cdr)
    assert str(caught.value) == sentence


def test_a_count_that_no_message_can_hold_is_not_believed():
    with pytest.raises(ProtocolError, match="4294967295 elements cannot stand in 4 bytes"):
        deserialize(b"\xff\xff\xff\xff", Texts)


class Texts(Msg, frozen=True, gc=False):
    """Any number of texts."""

    MSGTYPE: ClassVar[str] = "test_msgs/Texts"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    data: list[str]
