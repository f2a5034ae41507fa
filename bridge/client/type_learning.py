"""Message classes made at run time from the answer of `/rosapi/message_details`, for types without a generated class."""

from __future__ import annotations

import builtins
import functools
import re
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from bridge.codec.fields import fields_of, ros_fields
from bridge.core.errors import ProtocolError
from bridge.msgs import TYPES, Msg
from bridge.msgs.making import BUILT_IN, SCALARS, make_class, rostype

__all__ = ["learn"]

MAX_TYPES = 500
"""Most definitions in one answer."""
MAX_FIELDS = 1000
"""Most fields of one type."""
MAX_DEPTH = 50
"""Deepest nesting of types."""
MAX_ELEMENTS = 1_000_000
"""Most values in the fixed arrays of an empty message."""

_OTHER_NAMES = {
    "boolean": "bool",
    "octet": "byte",
    "float": "float32",
    "double": "float64",
    "builtins/str": "string",
    "builtin_interfaces/Time": "time",
    "builtin_interfaces/Duration": "duration",
    "Header": "std_msgs/Header",
}
"""Other names of types in rosapi's answers: those of IDL, and the class of a bounded text."""
_NAME = re.compile(r"[A-Za-z]\w{0,199}", re.ASCII)
_TYPE = re.compile(r"[A-Za-z]\w{0,99}(?:/[A-Za-z]\w{0,99}){1,2}", re.ASCII)
_BOUND = re.compile(
    r"(?P<base>[\w/]+)(?:<=?\d+>?)?(?:, ?\d+)?(?:\[(?P<bound><=)?(?P<length>\d*)\])?", re.ASCII
)
_SEQUENCE = re.compile(r"sequence<(?P<inner>.+)>")
_PART = re.compile(r"_(Request|Response|Goal|Result|Feedback)$")
_CONSTANT = re.compile(r"(?!SLOT_TYPES$|MSGTYPE$|ROSTYPES$|CONSTTYPES$)[A-Z][A-Z0-9_]*")


class _Typedef(msgspec.Struct, frozen=True):
    """One entry of the answer, as rosapi_msgs/TypeDef says."""

    type: str
    fieldnames: list[str] = []
    fieldtypes: list[str] = []
    fieldarraylen: list[int] = []
    constnames: list[str] = []
    constvalues: list[str] = []


def learn(typedefs: Sequence[Mapping[str, Any]]) -> type[Msg]:
    """The class of the first type in an answer of `/rosapi/message_details`; the others are its parts.

    Names of ROS 1 and ROS 2 are understood. A type that is described as `bridge.msgs` has it is that class. The same
    answer gives the same class. ProtocolError names the fault of an answer.
    """
    try:
        return _learned(msgspec.json.encode(typedefs))
    except (TypeError, ValueError, OverflowError, RecursionError) as error:
        raise ProtocolError(f"This is no description of a message type: {error}.") from error


@functools.lru_cache(maxsize=256)
def _learned(answer: bytes) -> type[Msg]:
    try:
        definitions = msgspec.json.decode(answer, type=list[_Typedef])
    except msgspec.MsgspecError as error:
        raise ProtocolError(f"This is no description of a message type: {error}.") from error
    if not definitions:
        raise ProtocolError("The robot does not describe this type.")
    if len(definitions) > MAX_TYPES:
        raise ProtocolError(
            f"{definitions[0].type} is made of {len(definitions)} types; at most {MAX_TYPES} are taken."
        )
    known = {_named(each.type): each for each in definitions}
    return _made(_named(definitions[0].type), known, dict(BUILT_IN), ())


def _made(
    name: str, definitions: Mapping[str, _Typedef], made: dict[str, type[Msg]], way: tuple[str, ...]
) -> type[Msg]:
    """The class of `name`; `made` are those made for this answer, `way` the types that need it."""
    if name in made:
        return made[name]
    if name in way or len(way) > MAX_DEPTH:
        raise ProtocolError(f"{way[0]} holds {name}, which holds itself or lies too deep.")
    definition = definitions.get(name)
    if definition is None:
        if name not in TYPES:
            raise ProtocolError(f"{(*way, name)[0]} needs {name}, which is not described.")
        return TYPES[name]
    kinds = _kinds(name, definition)
    fields = tuple(
        (field, kind, None if kind[0] in SCALARS else _made(kind[0], definitions, made, (*way, name)))
        for field, kind in kinds.items()
    )
    made[name] = _class(name, fields, _constants(definition, kinds))
    return made[name]


def _kinds(name: str, definition: _Typedef) -> dict[str, tuple[str, int]]:
    """The type of one element and the array length of each field."""
    if not len(definition.fieldnames) == len(definition.fieldtypes) == len(definition.fieldarraylen):
        raise ProtocolError(
            f"{name} is described with {len(definition.fieldnames)} fields, {len(definition.fieldtypes)} types and "
            f"{len(definition.fieldarraylen)} lengths; they must be as many."
        )
    if len(definition.fieldnames) > MAX_FIELDS:
        raise ProtocolError(
            f"{name} has {len(definition.fieldnames)} fields; at most {MAX_FIELDS} are taken."
        )
    kinds: dict[str, tuple[str, int]] = {}
    for field, kind, length in zip(
        definition.fieldnames, definition.fieldtypes, definition.fieldarraylen, strict=True
    ):
        if not _NAME.fullmatch(field) or field in kinds:
            raise ProtocolError(
                f"{name} has a field called {field!r:.60}, which cannot be or is there twice."
            )
        kinds[field] = _kind(kind, length, f"{name}.{field}")
    return kinds


def _kind(spelling: str, length: int, where: str) -> tuple[str, int]:
    """The type of one element and the array length; `spelling` may hold the array as well, as in `sequence<double, 8>` or
    `double[3]`."""
    sequence = _SEQUENCE.fullmatch(spelling)
    if sequence:
        spelling, length = sequence["inner"], 0
    found = _BOUND.fullmatch(spelling)
    if found is None or not -1 <= length <= MAX_ELEMENTS:
        raise ProtocolError(
            f"{where} is described as {spelling!r:.60} with array length {length}, which is no type."
        )
    if found["length"] is not None and length < 0:
        length = int(found["length"]) if found["length"] and not found["bound"] else 0
    return _named(found["base"]), length


def _named(spelling: str) -> str:
    """The ROS 1 name of a type: `std_srvs/srv/SetBool_Request` is `std_srvs/SetBoolRequest`."""
    if spelling in SCALARS or spelling in BUILT_IN:
        return spelling
    if spelling in _OTHER_NAMES:
        return _OTHER_NAMES[spelling]
    if not _TYPE.fullmatch(spelling):
        raise ProtocolError(f"{spelling!r:.60} is no type; one is called as in sensor_msgs/Imu.")
    package, *_, name = spelling.split("/")
    plain = f"{package}/{_PART.sub(lambda found: found[1], name)}"
    return _OTHER_NAMES.get(plain, plain)


def _constants(definition: _Typedef, kinds: Mapping[str, Any]) -> tuple[tuple[str, Any], ...]:
    """The constants of a type; rosapi of ROS 2 lists defaults and Python's own attributes among them."""
    return tuple(
        (name, _value(value))
        for name, value in zip(definition.constnames, definition.constvalues, strict=False)
        if _CONSTANT.fullmatch(name) and name not in kinds
    )


def _value(text: str) -> bool | int | float | str:
    if text in ("True", "False"):
        return text == "True"
    for read in (int, float):
        try:
            return read(text)
        except ValueError:
            pass
    return text


@functools.lru_cache(maxsize=1024)
def _class(
    name: str,
    fields: tuple[tuple[str, tuple[str, int], type[Msg] | None], ...],
    constants: tuple[tuple[str, Any], ...],
) -> type[Msg]:
    rostypes = tuple(rostype(*kind) for _, kind, _ in fields)
    known = TYPES.get(name)
    if known is not None and _same(known, fields, rostypes):
        return known
    if sum(_elements(length, inner) for _, (_, length), inner in fields) > MAX_ELEMENTS:
        raise ProtocolError(f"{name} holds more than {MAX_ELEMENTS} values when it is empty.")
    return make_class(name, fields, constants, source="as the robot described it.")


def _same(
    known: type[Msg], fields: Sequence[tuple[str, Any, type[Msg] | None]], rostypes: tuple[str, ...]
) -> bool:
    """Whether `known` has these fields, of classes that are known themselves; bounds are not described and do not
    count."""
    told = tuple((name, rostype) for (name, _, _), rostype in zip(fields, rostypes, strict=True))
    ours = [
        tuple((field.key, re.sub(r"<=\d+", "", field.rostype)) for field in ros_fields(known, ros2))
        for ros2 in (False, True)
    ]
    inside = all(inner is None or TYPES.get(inner.MSGTYPE) is inner for _, _, inner in fields)
    return inside and told in ours


def _elements(length: int, inner: type[Msg] | None) -> int:
    """Number of values in an empty field; a field of any length holds none."""
    return (1 if length < 0 else length) * (_held(inner) if inner else 1)


@functools.lru_cache(maxsize=1024)
def _held(type: builtins.type[Msg]) -> int:
    lengths = [((field.length or 0) if field.array else -1, field.type) for field in fields_of(type)]
    return max(sum(_elements(length, inner) for length, inner in lengths), 1)
