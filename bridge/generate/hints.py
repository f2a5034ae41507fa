"""Fields of ROS in Python: annotations, defaults and literals."""

from __future__ import annotations

import keyword
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from bridge.generate.model import Field, Kind, Many, TextError, Value

__all__ = ["ARRAYS", "NUMBERS", "RANGES", "Names", "default_of", "hint_of", "literal", "python_name"]

ARRAYS = {
    "float32": "Float32Array",
    "float64": "Float64Array",
    "int8": "Int8Array",
    "int16": "Int16Array",
    "int32": "Int32Array",
    "int64": "Int64Array",
    "uint16": "UInt16Array",
    "uint32": "UInt32Array",
    "uint64": "UInt64Array",
}
"""The class of a number array of any length."""
RANGES = {
    **{f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)},
    "char": (0, 255),
    "byte": (-128, 255),
}
"""Least and greatest value of each whole number."""
NUMBERS = {"float32", "float64", *RANGES}
_PLAIN = {"float32": "float", "float64": "float", "bool": "bool", "string": "str", "wstring": "str"}
_BYTES = ("uint8", "char", "byte")
_ZERO = {"bool": "False", "string": '""', "wstring": '""', "float32": "0.0", "float64": "0.0"}
_TAKEN = {
    *keyword.kwlist,
    *_PLAIN.values(),
    *RANGES,
    "bytes",
    "field",
    "list",
    "math",
    "CONSTTYPES",
    "MSGTYPE",
    "ROSTYPES",
    "UNITS",
}
"""Names that a field cannot have in a class, because the next annotation needs them."""


@dataclass
class Names:
    """The names that the classes of a module use, to be imported or defined above them."""

    base: set[str] = field(default_factory=set)
    arrays: set[str] = field(default_factory=set)
    msgspec: set[str] = field(default_factory=set)
    typing: set[str] = field(default_factory=lambda: {"ClassVar"})
    messages: set[str] = field(default_factory=set)
    """ROS names of the types that are used."""
    aliases: dict[str, str] = field(default_factory=dict)
    """Annotations with a size, by their name."""
    local: dict[str, str] = field(default_factory=dict)
    """Name of each type in this module, by its ROS name."""
    math: bool = False
    """Whether `math.nan` or `math.inf` is used."""
    additions: bool = False
    """Whether a base class of `bridge.msgs.additions` is used."""


def python_name(name: str, classes: set[str]) -> str:
    """The attribute for a ROS field: its name, with `_` behind it where Python or the class needs that name itself."""
    return f"{name}_" if name in _TAKEN or name in classes else name


def hint_of(kind: Kind, names: Names) -> str:
    """The annotation of a field of `kind`; the names that it uses are noted in `names`."""
    item = _item(kind, names)
    if kind.many is Many.ONE:
        return item
    if kind.base in _BYTES:
        return _sized("bytes", "Bytes", kind, names)
    if kind.many is Many.ANY and kind.base in ARRAYS:
        names.arrays.add(ARRAYS[kind.base])
        return ARRAYS[kind.base]
    return _sized(f"list[{item}]", item[1:] if kind.longest else _camel(kind.base), kind, names)


def _item(kind: Kind, names: Names) -> str:
    if kind.longest:
        names.msgspec.add("Meta")
        names.typing |= {"Annotated", "TypeAlias"}
        names.aliases[f"_Text{kind.longest}"] = f"Annotated[str, Meta(max_length={kind.longest})]"
        return f"_Text{kind.longest}"
    if kind.base in _PLAIN:
        return _PLAIN[kind.base]
    if kind.base in RANGES:
        listed = kind.base not in _BYTES and (kind.many is not Many.ANY or kind.base not in ARRAYS)
        if kind.many is Many.ONE or listed:
            names.base.add(kind.base)
        return kind.base
    names.messages.add(kind.base)
    return names.local[kind.base]


def _camel(base: str) -> str:
    """`uint16` as `UInt16`, `string` as `String`, `geometry_msgs/Point` as `Point`."""
    if base.startswith("uint"):
        return f"UI{base[2:]}"
    name = base.rpartition("/")[2]
    return name[0].upper() + name[1:]


def _sized(hint: str, name: str, kind: Kind, names: Names) -> str:
    if kind.many is Many.ANY:
        return hint
    exactly = kind.many is Many.EXACTLY
    alias = f"_{name}{'x' if exactly else 'to'}{kind.size}"
    least = f"min_length={kind.size}, " if exactly else ""
    if "/" in kind.base:
        hint = f'"{hint}"'  # the alias stands above the class
    names.aliases[alias] = f"Annotated[{hint}, Meta({least}max_length={kind.size})]"
    names.msgspec.add("Meta")
    names.typing |= {"Annotated", "TypeAlias"}
    return alias


def default_of(
    each: Field, where: str, local: Mapping[str, str], holds_list: Callable[[str], bool]
) -> tuple[str, bool]:
    """The default of a field as Python, and whether it is a factory.

    `local` gives the name of a type here, `holds_list` whether its values can be changed and must not be shared.
    TextError for a default that the type cannot hold.
    """
    kind = each.kind
    if each.default is not None:
        return _given(kind, each.default, f"{where}.{each.name}")
    if kind.many is Many.ONE:
        zero = _zero(kind, local)
        return (zero[:-2], True) if zero.endswith("()") and holds_list(kind.base) else (zero, False)
    count = kind.size if kind.many is Many.EXACTLY else 0
    if kind.base in _BYTES:
        return (f"bytes({count})" if count else 'b""'), False
    if kind.many is Many.ANY and kind.base in ARRAYS:
        return ARRAYS[kind.base], True
    if not count:
        return "[]", False
    zero = _zero(kind, local)
    if zero.endswith("()"):
        return f"lambda: [{zero} for _ in range({count})]", True
    return f"lambda: [{zero}] * {count}", True


def _zero(kind: Kind, local: Mapping[str, str]) -> str:
    if kind.base in _ZERO:
        return _ZERO[kind.base]
    return "0" if kind.base in RANGES else f"{local[kind.base]}()"


def _given(kind: Kind, value: Value, where: str) -> tuple[str, bool]:
    if "/" in kind.base or kind.base in ("time", "duration"):
        raise TextError(f"{where}: a {kind.base} can have no default.")
    if kind.many is Many.ONE:
        if isinstance(value, list):
            raise TextError(f"{where}: {value} is a list, and {kind.rostype} holds one value.")
        return literal(kind, value, where), False
    if not isinstance(value, list):
        raise TextError(f"{where}: {value!r} is no list, and {kind.rostype} is one.")
    if (kind.many is Many.EXACTLY and len(value) != kind.size) or (
        kind.many is Many.AT_MOST and len(value) > kind.size
    ):
        raise TextError(f"{where}: {kind.rostype} cannot hold {len(value)} values.")
    items = [literal(kind, item, where) for item in value]
    if kind.base in _BYTES:
        return literal_bytes(bytes(int(item) & 0xFF for item in items)), False
    if kind.many is Many.ANY and kind.base in ARRAYS:
        return f"lambda: {ARRAYS[kind.base]}([{', '.join(items)}])", True
    return f"lambda: [{', '.join(items)}]", True


def literal(kind: Kind, value: Value, where: str) -> str:
    """One value of `kind` as Python; TextError when it is none."""
    if kind.base in ("string", "wstring"):
        text = value if isinstance(value, str) else str(value)
        if kind.longest and len(text) > kind.longest:
            raise TextError(f"{where}: {text!r} is longer than {kind.longest} characters.")
        return _quoted(text)
    try:
        return _number(kind.base, value)
    except (TypeError, ValueError) as error:
        least, most = RANGES.get(kind.base, (None, None))
        allowed = "true or false" if kind.base == "bool" else "a number"
        if least is not None:
            allowed = f"a whole number from {least} to {most}"
        raise TextError(f"{where}: a {kind.base} must be {allowed}, not {value!r}.") from error


def _number(base: str, value: Value) -> str:
    if isinstance(value, list):
        raise TypeError("a list")
    if base == "bool":
        if value not in (True, False):
            raise ValueError("no truth")
        return str(bool(value))
    if base in RANGES:
        least, most = RANGES[base]
        if not isinstance(value, int) or not least <= value <= most:
            raise ValueError("out of range")
        return str(int(value))
    number = float(value)
    if math.isfinite(number):
        return repr(number)
    return "math.nan" if math.isnan(number) else "math.inf" if number > 0 else "-math.inf"


def _quoted(text: str) -> str:
    shown = repr(text)
    if shown.startswith('"') or '"' in text:
        return shown
    return '"' + shown[1:-1].replace("\\'", "'") + '"'


def literal_bytes(value: bytes) -> str:
    """A byte string as Python, in double quotes where that needs no more escapes."""
    shown = repr(value)
    return shown if '"' in shown else f'b"{shown[2:-1]}"'
