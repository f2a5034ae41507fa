"""Fields of a message that its type does not have, by which a client finds its misspelt ones."""

from __future__ import annotations

from typing import Any

from bridge.codec.fields import HEADER, fields_of, is_time
from bridge.msgs import Msg

__all__ = ["MAX_NAMED", "unknown_fields"]

MAX_NAMED = 5
"""Most fields that are named."""
_TIME_NAMES = {"secs", "nsecs", "sec", "nanosec"}


def unknown_fields(obj: Any, cls: type[Msg]) -> list[str]:
    """Paths of the fields in a decoded message that a `cls` does not have, the first `MAX_NAMED`; of lists the first
    element stands for all."""
    found: list[str] = []
    _look(obj, cls, "", found)
    return found[:MAX_NAMED]


def _look(obj: Any, cls: type[Msg], place: str, found: list[str]) -> None:
    if not isinstance(obj, dict) or len(found) >= MAX_NAMED:
        return
    fields = {field.key: field for field in fields_of(cls)}
    known = _TIME_NAMES if is_time(cls) else {*fields, *(["seq"] if cls.MSGTYPE == HEADER else [])}
    found += [f"{place}{key[:60]}" for key in obj if key not in known][:MAX_NAMED]
    for key, field in fields.items():
        value = obj.get(key)
        if field.type is not None and value:
            inner = value[0] if isinstance(value, list) else value
            _look(inner, field.type, f"{place}{key}{'[]' if isinstance(value, list) else ''}.", found)
