"""Every number in a message, with its way and its unit: what a plot or a readout can show. No Kivy.

for field in number_fields(Odometry()): print(field.path, field.unit)
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from bridge.msgs import Msg
from bridge.msgs.std_msgs import Time
from widgets.core.field_paths import written
from widgets.fields.message_fields import Path, spelled

__all__ = ["NumberField", "number_fields", "unit_at"]

MAX_PARTS = 12
"""Of a list so many parts are told one by one."""
MAX_FIELDS = 400
"""More are not listed: nobody looks through them."""


@dataclass(frozen=True, slots=True)
class NumberField:
    """One number of a message."""

    path: str
    """As in `twist.twist.linear.x` or `position[3]`."""
    unit: str
    """As people write it; empty where it is not known."""


def number_fields(message: Msg) -> list[NumberField]:
    """All that can be drawn over time, in the order of the message; of long lists the first."""
    found: list[NumberField] = []
    for field in _of_message(message, (), ""):
        found.append(field)
        if len(found) == MAX_FIELDS:
            break
    return found


def unit_at(message: Msg | type[Msg], path: str) -> str:
    """Unit of the field at `path`; empty where it is not known."""
    whole = message if isinstance(message, Msg) else message()
    return next((field.unit for field in number_fields(whole) if field.path == path), "")


def _of_message(message: Msg, way: Path, outer: str) -> Iterator[NumberField]:
    units = getattr(type(message), "UNITS", None)
    known = units if isinstance(units, dict) else {}
    for name in message.__struct_fields__:
        unit = known.get(name, "") or outer
        yield from _of_value(getattr(message, name), (*way, name), unit)


def _of_value(value: Any, way: Path, unit: str) -> Iterator[NumberField]:
    if isinstance(value, Msg):
        if not isinstance(value, Time) and value.MSGTYPE != "std_msgs/Header":
            yield from _of_message(value, way, unit)
    elif isinstance(value, int | float):
        yield NumberField(written(way), spelled(unit))
    elif not isinstance(value, str | bytes | bytearray | memoryview) and _counted(value):
        for index, part in enumerate(value[:MAX_PARTS]):
            yield from _of_value(part, (*way, index), unit)


def _counted(value: Any) -> bool:
    return isinstance(value, list | tuple | np.ndarray) or hasattr(value, "typecode")
