"""Numbers in CBOR are typed arrays, for every type."""

from __future__ import annotations

import struct
from typing import ClassVar

import cbor2
import msgspec
import pytest

from bridge.codec import from_builtins, from_cbor, to_cbor
from bridge.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu, JointState, NavSatFix


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
