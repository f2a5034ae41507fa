"""Any message of a class, within what its types allow."""

from __future__ import annotations

import functools
import types
import typing
from typing import Any

import msgspec
from hypothesis import strategies as st

from bridge.msgs import Msg
from bridge.msgs.arrays import ARRAYS

SCALARS: dict[Any, st.SearchStrategy] = {
    float: st.floats(),
    bool: st.booleans(),
    str: st.text(max_size=8),
    bytes: st.binary(max_size=8),
}


@functools.cache  # else each example makes them anew, and looks up all their types
def messages(cls: type[Msg]) -> st.SearchStrategy[Msg]:
    rostypes = (*getattr(cls, "ROSTYPES", ()), "", "")
    fields = zip(msgspec.structs.fields(cls), rostypes, strict=False)
    return st.builds(cls, **{field.name: values(field.type, rostype) for field, rostype in fields})


def values(hint: Any, rostype: str = "") -> st.SearchStrategy:
    if typing.get_origin(hint) is typing.Annotated:
        hint, meta = typing.get_args(hint)
        return bounded(hint, meta, rostype)
    if hint is float and rostype.startswith("float32"):
        return st.floats(width=32)
    if hint in SCALARS:
        return SCALARS[hint]
    if hint in ARRAYS.values():
        return numbers(hint)
    if typing.get_origin(hint) is list:
        return st.lists(values(typing.get_args(hint)[0], rostype), max_size=3)
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return st.just(msgspec.UNSET)
    return messages(hint)


def bounded(hint: Any, meta: msgspec.Meta, rostype: str) -> st.SearchStrategy:
    if hint is int:
        return st.integers(meta.ge, 2**64 - 1 if (meta.ge, meta.le) == (0, 2**63 - 1) else meta.le)
    sizes = {"min_size": meta.min_length or 0, "max_size": meta.max_length}
    if hint is str:
        return st.text(**sizes)
    if hint is bytes:
        return st.binary(**sizes)
    return st.lists(values(typing.get_args(hint)[0], rostype), **sizes)


def numbers(cls: Any) -> st.SearchStrategy:
    if cls.code in "fd":
        return st.lists(st.floats(width=32 if cls.code == "f" else 64), max_size=4).map(cls)
    bits = 8 * cls().itemsize
    least, most = (0, 2**bits - 1) if cls.code.isupper() else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    return st.lists(st.integers(least, most), max_size=4).map(cls)
