"""JSON schemas of messages, made from their classes, as they are read and written."""

from __future__ import annotations

import typing
from typing import Any

import msgspec

from bridge.codec.fields import CODES, Field, fields_of
from bridge.codec.reader import WIDTHS, least_and_most
from bridge.msgs import Msg

__all__ = ["Schemas"]

_NUMBER = {"type": ["number", "null"]}
_SIMPLE: dict[str, dict[str, Any]] = {
    "string": {"type": "string"},
    "bool": {"type": "boolean"},
    "float64": _NUMBER,
    "float32": _NUMBER,
}
_BYTES = {"type": "string", "contentEncoding": "base64"}


class Schemas:
    """Schemas of message classes that refer to each other by name."""

    def __init__(self) -> None:
        self.components: dict[str, Any] = {}
        """By the name of each, as in `sensor_msgs.Imu`."""

    def of(self, cls: type[Msg]) -> dict[str, Any]:
        """A reference to the schema of a class."""
        name = (cls.MSGTYPE or cls.__name__).replace("/", ".")
        if name not in self.components:
            self.components[name] = {}  # of one that has itself as a part
            units = getattr(cls, "UNITS", {})
            parts = {field.key: self._field(field, units.get(field.key, "")) for field in fields_of(cls)}
            self.components[name] = {
                "type": "object",
                "properties": parts | self._read_only(cls, parts),
                "additionalProperties": False,
            }
        return {"$ref": f"#/components/schemas/{name}"}

    def _read_only(self, cls: type[Msg], parts: dict[str, Any]) -> dict[str, Any]:
        """Fields that are understood and never sent: ROS 2's names of the parts of a time."""
        names = [each.encode_name for each in msgspec.structs.fields(cls)]
        known: dict[str, Any] = next(iter(parts.values()), {})
        return {name: known for name in names if name not in parts}

    def _field(self, field: Field, unit: str) -> dict[str, Any]:
        one = self._one(field)
        if field.array and field.base in ("uint8", "char", "byte") and field.hint is bytes:
            one = dict(_BYTES)
        elif field.array:
            one = {"type": "array", "items": one}
            if field.length is not None and typing.get_origin(field.hint) is typing.Annotated:
                one |= {"minItems": field.length, "maxItems": field.length}
        return one | {"description": f"[{unit}]"} if unit and "$ref" not in one else one

    def _one(self, field: Field) -> dict[str, Any]:
        if field.type is not None:
            return self.of(field.type)
        if field.base in _SIMPLE:
            return dict(_SIMPLE[field.base])
        code = CODES.get(field.base, "")
        if code not in WIDTHS:
            return {"type": "string"}
        least, most = _told_range(field) or least_and_most(code)
        return {"type": "integer", "minimum": least, "maximum": most}


def _told_range(field: Field) -> tuple[int, int] | None:
    """What the reader allows of a single whole number, where that is not what its width alone says."""
    for each in typing.get_args(field.hint)[1:]:
        if isinstance(each, msgspec.Meta) and each.ge is not None and each.le is not None:
            least, most = int(each.ge), int(each.le)
            return least, 2**64 - 1 if (least, most) == (0, 2**63 - 1) else most
    return None
