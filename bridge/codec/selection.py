"""Messages with only the fields that were asked for."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Sequence
from operator import attrgetter
from typing import Any

import msgspec

from bridge.codec.fields import Field, fields_of, is_time
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg

__all__ = ["check_paths", "select"]

Pick = Callable[[Any], Any]
"""Makes the smaller message of the whole one."""


def select(msg: Msg, paths: Sequence[str]) -> Msg:
    """`msg` with only the fields of `paths`, as in `pose.pose.position`; a message of a smaller class.

    A path through an array applies to each of its elements; one into a time gives the whole time. Where one path is
    the beginning of another, the shorter one counts. ProtocolError for a path that leads nowhere; it lists the fields
    there.
    """
    return _picker(type(msg), tuple(paths))(msg)  # type: ignore[no-any-return]


def check_paths(cls: type[Msg], paths: Sequence[str]) -> None:
    """ProtocolError when `select` would raise it for every message of class `cls`."""
    _picker(cls, tuple(paths))


@functools.lru_cache(maxsize=256)
def _picker(cls: type[Msg], paths: tuple[str, ...]) -> Pick:
    if not paths:
        raise ProtocolError("fields must name one field at least.")
    return _smaller(cls, [path.split(".") for path in paths], "")[1]


def _smaller(cls: type[Msg], paths: Iterable[list[str]], place: str) -> tuple[type[Msg], Pick]:
    """A class with those fields of `cls`, and the function that makes one; `place` is the path of `cls` in the
    message."""
    wanted: dict[str, list[list[str]]] = {}
    for first, *rest in paths:
        wanted.setdefault(first, []).append(rest)
    there = {field.key: field for field in fields_of(cls)}
    for name in wanted:
        if name not in there:
            kind = cls.MSGTYPE or cls.__name__
            whole = f"{place} is a {kind} and" if place else kind
            raise ProtocolError(f"{whole} has no field {name[:60]!r}, only {', '.join(there)}.")
    parts = [
        _part(field, wanted[key], f"{place}.{key}".strip("."))
        for key, field in there.items()
        if key in wanted
    ]
    made: Any = msgspec.defstruct(
        cls.__name__,
        [(field.name, hint, msgspec.field(name=field.key)) for field, hint, _ in parts],
        bases=(Msg,),
        namespace={"MSGTYPE": cls.MSGTYPE, "ROSTYPES": tuple(field.rostype for field, _, _ in parts)},
        frozen=True,
        gc=False,
    )
    picks = [pick for _, _, pick in parts]
    return made, lambda msg: made(*[pick(msg) for pick in picks])


def _part(field: Field, rests: list[list[str]], place: str) -> tuple[Field, Any, Pick]:
    """The smaller type of one field and the function that takes it from the message."""
    get = attrgetter(field.name)
    if [] in rests or is_time(field.type):
        return field, field.hint, get
    if field.type is None:
        raise ProtocolError(f"{place} is a {field.rostype} and has no field {'.'.join(rests[0])[:60]!r}.")
    kind, pick = _smaller(field.type, rests, place)
    if not field.array:
        return field, kind, lambda msg: pick(get(msg))
    return field, list[kind], lambda msg: [pick(each) for each in get(msg)]  # type: ignore[valid-type]
