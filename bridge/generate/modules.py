"""Modules of message classes as Python text, one for each ROS package."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from bridge.generate.classes import WIDTH, class_text, listed
from bridge.generate.extras import ALSO
from bridge.generate.hints import ARRAYS, RANGES, Names
from bridge.generate.library import Library
from bridge.generate.model import Part

__all__ = ["MARK", "package_module"]

MARK = "made by `python -m bridge.generate`"
"""Part of the first line of every file that the generator may overwrite."""
_TIMES = {"time": "Time", "duration": "Duration"}
_TAKEN = {
    "Annotated",
    "ClassVar",
    "Meta",
    "Msg",
    "TypeAlias",
    "additions",
    "field",
    "math",
    *ARRAYS.values(),
    *RANGES,
    *_TIMES.values(),
}
"""Names that a module's own classes must not hide."""


def package_module(package: str, library: Library, home: str) -> str:
    """The text of the module of `package`.

    `home` is the dotted name of the output folder, as in `bridge.msgs`; empty when it is none of ours, and then the modules
    refer to each other by relative imports.
    """
    parts = library.ordered(package)
    names = Names(local=_local_names(parts))
    own = {part.rosname for part in parts}
    texts = [class_text(part, library, names) for part in parts]
    names.messages |= {
        each for part in parts for each in ("time", "duration") if each in (f.kind.base for f in part.fields)
    }
    also = ALSO.get(package, {})
    imports = _imports(names, own, library, home)
    for source, extra in also.items():
        imports.setdefault(source, set()).update(extra)
    public = sorted([names.local[name] for name in own] + [name for extra in also.values() for name in extra])
    head = [f'"""{package}: {MARK}; change the ROS text, not this file."""', ""]
    head += ["from __future__ import annotations", "", *_import_lines(names, imports), ""]
    head += [*listed("__all__ = ", [f'"{name}"' for name in public])]
    if names.aliases:
        head += ["", *(f"{name}: TypeAlias = {hint}" for name, hint in sorted(names.aliases.items()))]
    return "\n\n\n".join(["\n".join(head), *(text.rstrip("\n") for text in texts)]) + "\n"


def _local_names(parts: list[Part]) -> dict[str, str]:
    """Names of types in a package's module: as in ROS, unless another type or Python has that name."""
    local = {"time": "Time", "duration": "Duration"}
    for part in parts:
        local[part.rosname] = f"{part.name}_" if part.name in _TAKEN else part.name
    for need in sorted({need for part in parts for need in part.needs}):
        if need in local:
            continue
        owner, name = need.split("/")
        if name in local.values() or name in _TAKEN:
            name = "".join(word.capitalize() for word in owner.split("_")) + name
        local[need] = name
    return local


def _imports(names: Names, own: set[str], library: Library, home: str) -> dict[str, set[str]]:
    """The imports of the module, by the module they come from."""
    imports: dict[str, set[str]] = {}

    def add(source: str, found: Iterable[str]) -> None:
        if found := set(found):
            imports.setdefault(source, set()).update(found)

    add("bridge.msgs", ["additions"] if names.additions else [])
    add("bridge.msgs.arrays", names.arrays)
    add("bridge.msgs.base", names.base)
    for rosname in names.messages - own:
        name = names.local[rosname]
        original = _TIMES.get(rosname) or rosname.split("/")[1]
        original = f"{original}_" if original in _TAKEN and rosname not in _TIMES else original
        source = _source(rosname, library, home)
        add(source, [name if name == original else f"{original} as {name}"])
    return imports


def _source(rosname: str, library: Library, home: str) -> str:
    if rosname in _TIMES:
        return "bridge.msgs.builtin_interfaces"
    package = rosname.partition("/")[0]
    if rosname in library.parts:
        return f"{home}.{package}" if home else f".{package}"
    return f"bridge.msgs.{package}"


def _import_lines(names: Names, imports: dict[str, set[str]]) -> Iterator[str]:
    if names.math:
        yield "import math"
    yield from _from("typing", names.typing)
    if names.msgspec:
        yield ""
        yield from _from("msgspec", names.msgspec)
    for relative in (False, True):
        sources = sorted((each for each in imports if each.startswith(".") is relative), key=_order)
        if sources:
            yield ""
        for source in sources:
            yield from _from(source, imports[source])


def _order(source: str) -> tuple[int, list[object]]:
    """ruff's order of modules: those further up first, numbers by their value."""
    return -len(source) + len(source.lstrip(".")), _natural(source)


def _from(source: str, names: Iterable[str]) -> list[str]:
    items = sorted(names, key=_name_order)
    if len(line := f"from {source} import {', '.join(items)}") <= WIDTH:
        return [line]
    return listed(f"from {source} import ", items, "()")


def _name_order(name: str) -> tuple[bool, bool, list[object], list[object]]:
    """ruff's order of the names in an import: constants, classes, the rest."""
    return not name.isupper(), not name[0].isupper(), _natural(name.lower()), _natural(name)


def _natural(text: str) -> list[object]:
    found: list[object] = []
    digits = ""
    for letter in f"{text}\0":
        if letter.isdigit():
            digits += letter
            continue
        if digits:
            found.append((1, int(digits), ""))
            digits = ""
        found.append((2, 0, letter) if letter != "\0" else (0, 0, ""))
    return found
