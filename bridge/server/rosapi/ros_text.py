"""Message types as ROS 1 text with all their parts, for `topics_and_raw_types`."""

from __future__ import annotations

import functools
from collections.abc import Iterator

from bridge.codec.fields import Field, ros_fields
from bridge.msgs import Msg
from bridge.server.rosapi.type_descriptions import constant_types, constants, parts

__all__ = ["full_text"]

_RULE = "=" * 80


@functools.lru_cache(maxsize=256)
def full_text(type: str) -> str:
    """The text of `type`, then each part's under a rule and its name; empty when it is not known.

    A reader of `cbor-raw` makes of it what is in the bytes: the fields in their order, and constants as well. Bounds and
    defaults, which ROS 1 does not know, are left out.
    """
    found = parts(type)
    texts = [_text(each) for each in found[:1]]
    texts += [f"{_RULE}\nMSG: {each.MSGTYPE}\n{_text(each)}" for each in found[1:]]
    return "\n".join(texts)


def _text(cls: type[Msg]) -> str:
    return "".join(f"{line}\n" for line in (*_constants(cls), *map(_field, ros_fields(cls, False))))


def _constants(cls: type[Msg]) -> Iterator[str]:
    """The constants whose type is known; one that was made up for programs has none."""
    values = constants(cls)
    for name, rostype in constant_types(cls).items():
        yield f"{rostype} {name}={values[name]}"


def _field(field: Field) -> str:
    array = f"[{field.length or ''}]" if field.array else ""
    return f"{field.base}{array} {field.key}"
