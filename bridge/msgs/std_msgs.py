"""std_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import (
    Float32Array,
    Float64Array,
    Int8Array,
    Int16Array,
    Int32Array,
    Int64Array,
    UInt16Array,
    UInt32Array,
    UInt64Array,
)
from bridge.msgs.base import Msg, byte, char, int8, int16, int32, int64, uint8, uint16, uint32, uint64
from bridge.msgs.builtin_interfaces import Duration, Time

__all__ = [
    "Bool",
    "Byte",
    "ByteMultiArray",
    "Char",
    "ColorRGBA",
    "Duration",
    "Empty",
    "Float32",
    "Float32MultiArray",
    "Float64",
    "Float64MultiArray",
    "Header",
    "Int16",
    "Int16MultiArray",
    "Int32",
    "Int32MultiArray",
    "Int64",
    "Int64MultiArray",
    "Int8",
    "Int8MultiArray",
    "MultiArrayDimension",
    "MultiArrayLayout",
    "String",
    "Time",
    "UInt16",
    "UInt16MultiArray",
    "UInt32",
    "UInt32MultiArray",
    "UInt64",
    "UInt64MultiArray",
    "UInt8",
    "UInt8MultiArray",
]


class Bool(Msg, frozen=True, gc=False):
    """A truth."""

    MSGTYPE: ClassVar[str] = "std_msgs/Bool"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool",)
    data: bool = False


class Byte(Msg, frozen=True, gc=False):
    """Eight bits."""

    MSGTYPE: ClassVar[str] = "std_msgs/Byte"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("byte",)
    data: byte = 0


class MultiArrayDimension(Msg, frozen=True, gc=False):
    """One dimension of a grid."""

    MSGTYPE: ClassVar[str] = "std_msgs/MultiArrayDimension"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "uint32", "uint32")
    label: str = ""
    """Name of the dimension, as in rows."""
    size: uint32 = 0
    """Number of elements along it."""
    stride: uint32 = 0
    """Number of elements that one step along the dimension before this one spans."""


class MultiArrayLayout(Msg, frozen=True, gc=False):
    """Layout of a grid in a plain list."""

    MSGTYPE: ClassVar[str] = "std_msgs/MultiArrayLayout"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayDimension[]", "uint32")
    dim: list[MultiArrayDimension] = []
    """The dimensions, the outermost first."""
    data_offset: uint32 = 0
    """Number of elements to skip at the front."""


class ByteMultiArray(Msg, frozen=True, gc=False):
    """Bytes in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/ByteMultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "byte[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: bytes = b""


class Char(Msg, frozen=True, gc=False):
    """A character by its number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Char"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("char",)
    data: char = 0


class ColorRGBA(Msg, frozen=True, gc=False):
    """A colour; each part from 0 to 1."""

    MSGTYPE: ClassVar[str] = "std_msgs/ColorRGBA"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float32", "float32", "float32", "float32")
    r: float = 0.0
    g: float = 0.0
    b: float = 0.0
    a: float = 0.0
    """0 is transparent, 1 opaque."""


class Empty(Msg, frozen=True, gc=False):
    """Nothing but the fact that it was sent."""

    MSGTYPE: ClassVar[str] = "std_msgs/Empty"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class Float32(Msg, frozen=True, gc=False):
    """A number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Float32"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float32",)
    data: float = 0.0


class Float32MultiArray(Msg, frozen=True, gc=False):
    """Numbers in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/Float32MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "float32[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: Float32Array = field(default_factory=Float32Array)


class Float64(Msg, frozen=True, gc=False):
    """A number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Float64"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float64",)
    data: float = 0.0


class Float64MultiArray(Msg, frozen=True, gc=False):
    """Numbers in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/Float64MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "float64[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: Float64Array = field(default_factory=Float64Array)


class Header(Msg, frozen=True, gc=False):
    """When and in which frame a message was measured."""

    MSGTYPE: ClassVar[str] = "std_msgs/Header"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "string", "uint32")
    stamp: Time = Time()
    """When it was measured, by the clock of who measured it."""
    frame_id: str = ""
    """Name of the coordinate frame (REP-105): map, odom, base_link, or a sensor's."""
    seq: uint32 = 0
    """Number of the message as its publisher counts. ROS 1 alone has it, as the first field; 0 where
    nobody counts.
    """


class Int16(Msg, frozen=True, gc=False):
    """A whole number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int16"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int16",)
    data: int16 = 0


class Int16MultiArray(Msg, frozen=True, gc=False):
    """Whole numbers in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int16MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "int16[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: Int16Array = field(default_factory=Int16Array)


class Int32(Msg, frozen=True, gc=False):
    """A whole number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int32"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32",)
    data: int32 = 0


class Int32MultiArray(Msg, frozen=True, gc=False):
    """Whole numbers in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int32MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "int32[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: Int32Array = field(default_factory=Int32Array)


class Int64(Msg, frozen=True, gc=False):
    """A whole number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int64"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int64",)
    data: int64 = 0


class Int64MultiArray(Msg, frozen=True, gc=False):
    """Whole numbers in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int64MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "int64[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: Int64Array = field(default_factory=Int64Array)


class Int8(Msg, frozen=True, gc=False):
    """A whole number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int8"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int8",)
    data: int8 = 0


class Int8MultiArray(Msg, frozen=True, gc=False):
    """Whole numbers in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int8MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "int8[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: Int8Array = field(default_factory=Int8Array)


class String(Msg, frozen=True, gc=False):
    """A text."""

    MSGTYPE: ClassVar[str] = "std_msgs/String"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    data: str = ""


class UInt16(Msg, frozen=True, gc=False):
    """A whole number from 0."""

    MSGTYPE: ClassVar[str] = "std_msgs/UInt16"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint16",)
    data: uint16 = 0


class UInt16MultiArray(Msg, frozen=True, gc=False):
    """Whole numbers from 0 in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/UInt16MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "uint16[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: UInt16Array = field(default_factory=UInt16Array)


class UInt32(Msg, frozen=True, gc=False):
    """A whole number from 0."""

    MSGTYPE: ClassVar[str] = "std_msgs/UInt32"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint32",)
    data: uint32 = 0


class UInt32MultiArray(Msg, frozen=True, gc=False):
    """Whole numbers from 0 in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/UInt32MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "uint32[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: UInt32Array = field(default_factory=UInt32Array)


class UInt64(Msg, frozen=True, gc=False):
    """A whole number from 0."""

    MSGTYPE: ClassVar[str] = "std_msgs/UInt64"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint64",)
    data: uint64 = 0


class UInt64MultiArray(Msg, frozen=True, gc=False):
    """Whole numbers from 0 in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/UInt64MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "uint64[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: UInt64Array = field(default_factory=UInt64Array)


class UInt8(Msg, frozen=True, gc=False):
    """A whole number from 0."""

    MSGTYPE: ClassVar[str] = "std_msgs/UInt8"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8",)
    data: uint8 = 0


class UInt8MultiArray(Msg, frozen=True, gc=False):
    """Bytes in a grid of any number of dimensions."""

    MSGTYPE: ClassVar[str] = "std_msgs/UInt8MultiArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/MultiArrayLayout", "uint8[]")
    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    """Layout of the grid in data."""
    data: bytes = b""
