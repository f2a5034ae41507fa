"""Messages as ROS 2 has them: times are `sec` and `nanosec` instead of `secs` and `nsecs`, headers without a count."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import msgspec

from bridge.codec.fields import Field, fields_of, is_time
from bridge.codec.headers import without_count
from bridge.msgs import Msg

__all__ = ["ROS2_NAMES", "named_for_ros2"]

ROS2_NAMES = {"secs": "sec", "nsecs": "nanosec"}
"""ROS 2's names of the two numbers of a time, by their names in ROS 1."""
Renamer = Callable[[dict[str, Any]], None]
"""Changes the names in a message's dict, in place."""


def named_for_ros2(text: bytes, cls: type[Msg]) -> bytes:
    """A `cls` as JSON text that the codec wrote, with times and headers as in ROS 2."""
    text = without_count(text, cls)
    rename = _renamer(cls)
    if rename is None:
        return text
    if not _ambiguous(cls):
        # A quote within a text is escaped, so that these bytes can be nothing but a key.
        return text.replace(b'"secs":', b'"sec":').replace(b'"nsecs":', b'"nanosec":')
    obj = msgspec.json.decode(text)
    rename(obj)
    return msgspec.json.encode(obj)


@functools.lru_cache(maxsize=1024)
def _renamer(cls: type[Msg]) -> Renamer | None:
    """The function that renames the times in a `cls` as a dict; None when it holds none."""
    if is_time(cls):
        return _rename_time
    works = [
        (field.key, field.array, found)
        for field in fields_of(cls)
        if field.type and (found := _renamer(field.type))
    ]
    return functools.partial(_rename_fields, works) if works else None


def _rename_time(obj: dict[str, Any]) -> None:
    for old, new in ROS2_NAMES.items():
        obj[new] = obj.pop(old)


def _rename_fields(works: list[tuple[str, bool, Renamer]], obj: dict[str, Any]) -> None:
    for key, array, rename in works:
        for each in obj[key] if array else (obj[key],):
            rename(each)


@functools.lru_cache(maxsize=1024)
def _ambiguous(cls: type[Msg]) -> bool:
    """Whether a `cls` has a field of such a name that belongs to no time."""
    if is_time(cls):
        return False
    return any(_clashes(field) for field in fields_of(cls))


def _clashes(field: Field) -> bool:
    return field.key in ("secs", "nsecs") or (field.type is not None and _ambiguous(field.type))
