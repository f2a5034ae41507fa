"""Number arrays of ROS messages as compact, typed Python arrays.

ROS `float32[]` and `int8[]` fields hold hundreds of numbers; a list of Python floats costs ten times
the memory and loses the width. In JSON they travel as plain lists in which `null` stands for a number
that JSON cannot say (NaN, infinity); in CBOR as RFC 8746 little-endian typed arrays. `uint8[]` is `bytes`.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable
from typing import Any, Self

__all__ = [
    "ARRAYS",
    "Float32Array",
    "Float64Array",
    "Int8Array",
    "Int16Array",
    "Int32Array",
    "Int64Array",
    "UInt16Array",
    "UInt32Array",
    "UInt64Array",
]

_NAN = float("nan")


class _Typed(array):  # type: ignore[type-arg]
    """An `array.array` whose element type belongs to the class."""

    code: str
    """Type code of `array.array`."""

    def __new__(cls, values: Iterable[Any] | bytes = ()) -> Self:
        """Make one from numbers (None becomes NaN) or from little-endian bytes."""
        try:
            return super().__new__(cls, cls.code, values)
        except TypeError:  # looking for None first would cost as much as the rest
            if not isinstance(values, list) or None not in values:
                raise
        return super().__new__(cls, cls.code, [_NAN if value is None else value for value in values])

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.tobytes(),)


class Float32Array(_Typed):
    """ROS `float32[]`."""

    code = "f"


class Float64Array(_Typed):
    """ROS `float64[]`."""

    code = "d"


class Int8Array(_Typed):
    """ROS `int8[]`."""

    code = "b"


class Int16Array(_Typed):
    """ROS `int16[]`."""

    code = "h"


class Int32Array(_Typed):
    """ROS `int32[]`."""

    code = "i"


class Int64Array(_Typed):
    """ROS `int64[]`."""

    code = "q"


class UInt16Array(_Typed):
    """ROS `uint16[]`."""

    code = "H"


class UInt32Array(_Typed):
    """ROS `uint32[]`."""

    code = "I"


class UInt64Array(_Typed):
    """ROS `uint64[]`."""

    code = "Q"


ARRAYS: dict[int, type[_Typed]] = {
    69: UInt16Array,
    70: UInt32Array,
    71: UInt64Array,
    72: Int8Array,
    77: Int16Array,
    78: Int32Array,
    79: Int64Array,
    85: Float32Array,
    86: Float64Array,
}
"""RFC 8746 tag of the little-endian typed array for each class."""
