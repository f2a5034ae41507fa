"""The Python text of one class."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from bridge.generate.comments import unit_in
from bridge.generate.extras import BASES, DEFAULTS, ROS1_FIELDS
from bridge.generate.hints import NUMBERS, RANGES, Names, default_of, hint_of, literal, python_name
from bridge.generate.library import Library
from bridge.generate.model import Constant, Field, Kind, Part, TextError

__all__ = ["WIDTH", "class_text", "listed"]

WIDTH = 110
"""Longest line [characters]."""
_INDENT = "    "
_CONSTANTS = {"bool": "bool", "string": "str", "wstring": "str"}


def class_text(part: Part, library: Library, names: Names) -> str:
    """The Python text of the class of `part`; the names that it uses are noted in `names`."""
    part = replace(part, fields=(*part.fields, *ROS1_FIELDS.get(part.rosname, ())))
    parent = library.ancestor(part)
    fields = part.fields[len(parent.fields) if parent else 0 :]
    constants = () if parent else part.constants
    attributes = {each.name for each in part.fields}
    if clash := next((each.name for each in part.constants if each.name in attributes), None):
        raise TextError(f"{part.rosname} has a field and a constant called {clash}.")
    lines = [f"class {names.local[part.rosname]}({_base(part, parent, names)}, frozen=True, gc=False):"]
    if part.comment:
        lines += [*_docstring(part.comment), ""]
    lines.append(f'{_INDENT}MSGTYPE: ClassVar[str] = "{part.rosname}"')
    lines += listed(
        f"{_INDENT}ROSTYPES: ClassVar[tuple[str, ...]] = ",
        [f'"{each.kind.rostype}"' for each in part.fields],
        "()",
    )
    if constants:
        lines += _constant_types(constants)
    if units := _units(part, set(names.local.values())):
        items = [f'"{name}": "{unit}"' for name, unit in units.items()]
        lines += listed(f"{_INDENT}UNITS: ClassVar[dict[str, str]] = ", items, "{}")
    if constants:
        lines.append("")
    for constant in constants:
        lines += _constant(constant, part, names)
    if constants and fields:
        lines.append("")
    for each in fields:
        lines += _field(each, part, library, names)
    return "\n".join(lines) + "\n"


def listed(start: str, items: list[str], brackets: str = "[]") -> list[str]:
    """`start` and a list or tuple: on one line where it fits, else each item on a line of its own."""
    comma = "," if brackets == "()" and len(items) == 1 else ""
    line = f"{start}{brackets[0]}{', '.join(items)}{comma}{brackets[1]}"
    if len(line) <= WIDTH:
        return [line]
    indent = start[: len(start) - len(start.lstrip())]
    return [
        f"{start}{brackets[0]}",
        *(f"{indent}{_INDENT}{item}," for item in items),
        f"{indent}{brackets[1]}",
    ]


def _units(part: Part, classes: set[str]) -> dict[str, str]:
    """The unit of each field whose comment names one; of all numbers where only the comment on the whole does so."""
    if any(each.name == "UNITS" for each in part.constants):  # the text has that name for itself
        return {}
    numbers = [each.kind.base in NUMBERS for each in part.fields]
    found = {
        python_name(each.name, classes): unit
        for each, number in zip(part.fields, numbers, strict=True)
        if (number or "/" in each.kind.base) and (unit := unit_in(each.comment))
    }
    if not found and all(numbers) and (unit := unit_in(part.comment)):
        return {python_name(each.name, classes): unit for each in part.fields}
    return found


def _base(part: Part, parent: Part | None, names: Names) -> str:
    if parent is not None:
        names.messages.add(parent.rosname)
        return names.local[parent.rosname]
    if part.rosname in BASES:
        names.additions = True
        return f"additions.{BASES[part.rosname]}"
    names.base.add("Msg")
    return "Msg"


def _constant_types(constants: Sequence[Constant]) -> list[str]:
    start, kinds = f"{_INDENT}CONSTTYPES: ClassVar[tuple[str, ...]] = ", [each.base for each in constants]
    if len(kinds) > 1 and len(set(kinds)) == 1:
        return [f'{start}("{kinds[0]}",) * {len(kinds)}']
    return listed(start, [f'"{each}"' for each in kinds], "()")


def _constant(constant: Constant, part: Part, names: Names) -> Iterator[str]:
    value = literal(Kind(constant.base), constant.value, f"{part.rosname}.{constant.name}")
    names.math |= "math." in value
    hint = _CONSTANTS.get(constant.base, "int" if constant.base in RANGES else "float")
    yield from _assigned(f"{_INDENT}{constant.name}: ClassVar[{hint}] = ", value)
    yield from _docstring(constant.comment)


def _field(each: Field, part: Part, library: Library, names: Names) -> Iterator[str]:
    hint = hint_of(each.kind, names)
    name = python_name(each.name, set(names.local.values()) | set(names.aliases))
    default, made = default_of(each, part.rosname, names.local, library.holds_list)
    if own := DEFAULTS.get(part.rosname, {}).get(each.name):
        default, made = own, False
    names.math |= "math." in default
    arguments: Mapping[str, str] = {
        "default_factory" if made else "default": default,
        **({"name": f'"{each.name}"'} if name != each.name else {}),
    }
    start = f"{_INDENT}{name}: {hint} = "
    if not made and name == each.name:
        yield from _assigned(start, default)
    else:
        names.msgspec.add("field")
        yield from _called(f"{start}field", [f"{key}={value}" for key, value in arguments.items()])
    yield from _docstring(each.comment)


def _assigned(start: str, value: str) -> list[str]:
    line = f"{start}{value}"
    if len(line) <= WIDTH or len(value) + 2 * len(_INDENT) > WIDTH:
        return [line]
    return [f"{start}(", f"{_INDENT}{_INDENT}{value}", f"{_INDENT})"]


def _called(start: str, arguments: list[str]) -> list[str]:
    inside = ", ".join(arguments)
    if len(start) + len(inside) + 2 <= WIDTH:
        return [f"{start}({inside})"]
    if len(inside) + 2 * len(_INDENT) <= WIDTH:
        return [f"{start}(", f"{_INDENT}{_INDENT}{inside}", f"{_INDENT})"]
    return [f"{start}(", *(f"{_INDENT}{_INDENT}{each}," for each in arguments), f"{_INDENT})"]


def _docstring(comment: str) -> list[str]:
    """A comment as a docstring: its lines kept, overlong ones wrapped."""
    if not comment.strip():
        return []
    text = comment.strip().replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    if text.endswith('"') and not text.endswith('\\"'):
        text = f'{text[:-1]}\\"'
    lines: list[str] = []
    for line in text.splitlines():
        if len(line) <= WIDTH - len(_INDENT) - 6:
            lines.append(line.rstrip())
        else:
            lines += textwrap.wrap(
                line, WIDTH - len(_INDENT) - 6, break_long_words=False, break_on_hyphens=False
            )
    if len(lines) == 1:
        return [f'{_INDENT}"""{lines[0]}"""']
    first, *rest = lines
    return [
        f'{_INDENT}"""{first}',
        *(f"{_INDENT}{line}" if line else "" for line in rest),
        f'{_INDENT}"""',
    ]
