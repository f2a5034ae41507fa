"""The count of messages in headers, `seq`: ROS 1 has it, ROS 2 has not."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from typing import Any

import msgspec

from bridge.codec.fields import HEADER, Field, fields_of
from bridge.msgs import Msg

__all__ = ["has_header", "with_count", "without_count"]

_COUNT = re.compile(rb',"seq":\d+(?=\})')
_BEGINNING = re.compile(rb'"header"\s*:\s*\{')


def without_count(text: bytes, cls: type[Msg]) -> bytes:
    """A `cls` as JSON text that the codec wrote, its headers without their count, as in ROS 2."""
    if not has_header(cls):
        return text
    if not _is_last(cls):
        obj = msgspec.json.decode(text)
        _forget(obj, cls)
        return msgspec.json.encode(obj)
    # A quote within a text is escaped, so that these bytes can be nothing but a key.
    return _COUNT.sub(b"", text, count=1 if _is_single(cls) else 0)


def with_count(text: bytes, cls: type[Msg]) -> bytes | None:
    """A `cls` as JSON text whose headers all lack their count, with the count of who does not count, 0, as in ROS 1.

    None where the headers cannot be told by their names.
    """
    if not has_header(cls):
        return text
    if not _is_named(cls):
        return None
    if not _is_single(cls):
        return _BEGINNING.sub(rb'\g<0>"seq":0,', text)
    found = _BEGINNING.search(text)
    return None if found is None else b"".join((text[: found.end()], b'"seq":0,', text[found.end() :]))


@functools.lru_cache(maxsize=1024)
def has_header(cls: type[Msg]) -> bool:
    """Whether a `cls` is or holds a header."""
    return any(each.MSGTYPE == HEADER for each, _ in _owners(cls))


@functools.lru_cache(maxsize=1024)
def _is_single(cls: type[Msg]) -> bool:
    """Whether every `cls` has one header and no more, so that the rest of its text need not be searched."""
    return sum(_count_of(field) for field in fields_of(cls)) == 1


def _count_of(field: Field) -> int:
    """Number of headers in a field, 2 for more."""
    if field.type is None:
        return 0
    inner = int(field.type.MSGTYPE == HEADER) or sum(_count_of(each) for each in fields_of(field.type))
    return 2 if field.array and inner else min(inner, 2)


@functools.lru_cache(maxsize=1024)
def _is_last(cls: type[Msg]) -> bool:
    """Whether the count stands behind something in each header of a `cls`, and nothing else has its name."""
    return all(
        owner.MSGTYPE == HEADER and fields_of(owner)[-1] is field and len(fields_of(owner)) > 1
        for owner, field in _owners(cls)
        if field.key == "seq"
    )


@functools.lru_cache(maxsize=1024)
def _is_named(cls: type[Msg]) -> bool:
    """Whether all headers of a `cls` are fields called `header`, and no other field is called so."""
    return cls.MSGTYPE != HEADER and all(
        (field.key == "header")
        == (field.type is not None and field.type.MSGTYPE == HEADER and not field.array)
        and not (field.array and field.type is not None and field.type.MSGTYPE == HEADER)
        for _, field in _owners(cls)
    )


def _owners(cls: type[Msg]) -> Iterator[tuple[type[Msg], Field]]:
    """All fields in a `cls`, however deep, each with the class that has it."""
    for field in fields_of(cls):
        yield cls, field
        if field.type is not None:
            yield from _owners(field.type)


def _forget(obj: Any, cls: type[Msg]) -> None:
    if cls.MSGTYPE == HEADER:
        obj.pop("seq", None)
    for field in fields_of(cls):
        if field.type is not None:
            for each in obj[field.key] if field.array else (obj[field.key],):
                _forget(each, field.type)
