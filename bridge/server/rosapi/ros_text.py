"""Message types as ROS text with all their parts, for `topics_and_raw_types`."""

from __future__ import annotations

import functools
from typing import Any

from bridge.server.rosapi.type_descriptions import typedefs

__all__ = ["full_text"]

_RULE = "=" * 80


@functools.lru_cache(maxsize=256)
def full_text(type: str) -> str:
    """The fields of `type`, then each part's under a rule and its name; empty when it is not known."""
    found = typedefs(type)
    parts = [_fields(each) for each in found[:1]]
    parts += [f"{_RULE}\nMSG: {each['type']}\n{_fields(each)}" for each in found[1:]]
    return "\n".join(parts)


def _fields(definition: dict[str, Any]) -> str:
    lines = [
        f"{kind}{'' if length < 0 else f'[{length or str()}]'} {name}"
        for kind, length, name in zip(
            definition["fieldtypes"], definition["fieldarraylen"], definition["fieldnames"], strict=True
        )
    ]
    return "".join(f"{line}\n" for line in lines)
