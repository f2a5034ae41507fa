"""Numbers in CBOR are typed arrays, for every type."""

from __future__ import annotations

import struct
from array import array
from typing import ClassVar

import cbor2
import msgspec
import pytest

from bridge.codec import from_builtins, from_cbor, to_cbor
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, Twist, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import CompressedImage, Imu, JointState, LaserScan, NavSatFix
from bridge.msgs.std_msgs import Empty, Int64, String


class Numbers(Msg, frozen=True, gc=False):
    """Every kind of numbers."""

    MSGTYPE: ClassVar[str] = "test_msgs/Numbers"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        *(f"{name}[2]" for name in ("int8", "uint16", "int16", "uint32", "int32", "uint64", "int64")),
        "float32[<=2]",
        "float64[]",
        "uint8[]",
        "string[]",
        "bool[]",
    )
    a: list[int]
    b: list[int]
    c: list[int]
    d: list[int]
    e: list[int]
    f: list[int]
    g: list[int]
    h: list[float]
    i: list[float]
    j: bytes
    k: list[str]
    m: list[bool]


PAIR = [1, 2]
NUMBERS = Numbers(*[PAIR] * 7, [1.0, 2.0], [1.0, 2.0], b"\1\2", ["1"], [True])


def test_each_kind_of_number_has_its_tag_and_its_width():
    found = cbor2.loads(to_cbor(NUMBERS))
    tags = {key: (value.tag, len(value.value)) for key, value in found.items() if key < "j"}
    assert tags == {
        "a": (72, 2),
        "b": (69, 4),
        "c": (77, 4),
        "d": (70, 8),
        "e": (78, 8),
        "f": (71, 16),
        "g": (79, 16),
        "h": (85, 8),
        "i": (86, 16),
    }
    assert (found["j"], found["k"], found["m"]) == (b"\1\2", ["1"], [True])
    assert from_builtins(from_cbor(to_cbor(NUMBERS)), Numbers) == NUMBERS


@pytest.mark.parametrize(
    ("msg", "path"),
    [
        (Odometry(), ("pose", "covariance")),
        (Odometry(), ("twist", "covariance")),
        (Imu(), ("orientation_covariance",)),
        (NavSatFix(), ("position_covariance",)),
        (PoseWithCovarianceStamped(), ("pose", "covariance")),
        (JointState(position=[1.0]), ("position",)),
    ],
)
def test_arrays_of_exact_length_are_typed_too(msg, path):
    found = cbor2.loads(to_cbor({"op": "publish", "topic": "/x", "msg": msg}))["msg"]
    for name in path:
        found = found[name]
    assert found.tag == 86


def test_a_number_that_does_not_fit_its_width_is_a_protocol_error():
    with pytest.raises(ProtocolError, match="cannot be sent as CBOR"):
        to_cbor(msgspec.structs.replace(NUMBERS, a=[300]))


def test_numbers_are_little_endian():
    assert cbor2.loads(to_cbor(msgspec.structs.replace(NUMBERS, b=[258, 1])))["b"].value == struct.pack(
        "<2H", 258, 1
    )


@pytest.mark.parametrize("number", [0, 23, 24, 255, 256, 65535, 65536, 2**32 - 1, 2**32, 2**63 - 1])
def test_whole_numbers_are_as_short_as_can_be(number):
    assert to_cbor(Int64(number)) == cbor2.dumps({"data": number})
    assert to_cbor(Int64(-1 - number)) == cbor2.dumps({"data": -1 - number})


@pytest.mark.parametrize("length", [0, 23, 24, 255, 256, 65535, 65536])
def test_texts_and_bytes_of_any_length_are_told_their_length(length):
    assert to_cbor(String("é" + "x" * length)) == cbor2.dumps({"data": "é" + "x" * length})
    assert cbor2.loads(to_cbor(CompressedImage(data=b"x" * length)))["data"] == b"x" * length


def test_a_message_of_nothing_is_an_empty_map():
    assert to_cbor(Empty()) == cbor2.dumps({})


def test_floats_keep_all_their_digits():
    assert cbor2.loads(to_cbor(Vector3(0.1, -1e-300, 1e300))) == {"x": 0.1, "y": -1e-300, "z": 1e300}


@pytest.mark.parametrize(
    "msg",
    [
        Int64(2**64),
        Int64("1"),
        String(5),
        String("\ud800"),
        Vector3("fast"),
        Vector3(10**400),
        Twist(linear=None),
        JointState(name=5),
        LaserScan(ranges=array("u", "x")),
        LaserScan(ranges=None),
        CompressedImage(data=5),
    ],
)
def test_a_value_that_is_none_of_its_field_is_a_protocol_error(msg):
    with pytest.raises(ProtocolError, match="cannot be sent as CBOR"):
        to_cbor(msg)
