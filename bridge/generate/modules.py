"""The Python text of a package: one module, or several where one would be too long."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from bridge.generate.classes import WIDTH, class_text, listed
from bridge.generate.extras import ALSO
from bridge.generate.hints import ARRAYS, RANGES, Names
from bridge.generate.library import Library
from bridge.generate.model import Part

__all__ = ["MARK", "package_files"]

MARK = "made by `python -m bridge.generate`"
"""Stands in the first line of every file that the generator may write over."""
_MOST_LINES = 430
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
"""What a module's own classes must not hide."""


@dataclass(frozen=True)
class _Module:
    """One file of a package."""

    path: str
    """Below the output folder."""
    parts: tuple[Part, ...]


def package_files(package: str, library: Library, home: str) -> dict[str, str]:
    """The files of `package` by their path below the output folder.

    `home` is the dotted name of that folder, as in `bridge.msgs`; empty when it is none of ours, and then the files refer
    to each other by relative imports.
    """
    parts = library.ordered(package)
    local = _local_names(parts)
    chunks = _chunks(parts, library, local)
    if len(chunks) == 1:
        return {f"{package}.py": _module(_Module(f"{package}.py", tuple(parts)), {}, library, local, home)}
    modules = [
        _Module(f"{package}/part{number}.py", tuple(chunk)) for number, chunk in enumerate(chunks, start=1)
    ]
    place = {part.rosname: module.path for module in modules for part in module.parts}
    files = {module.path: _module(module, place, library, local, home) for module in modules}
    files[f"{package}/__init__.py"] = _front(package, modules, local, home)
    return files


def _local_names(parts: list[Part]) -> dict[str, str]:
    """What types are called in a package's modules: as in ROS, unless another one or Python has that name."""
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


def _chunks(parts: list[Part], library: Library, local: dict[str, str]) -> list[list[Part]]:
    chunks: list[list[Part]] = [[]]
    lines = 0
    for part in parts:
        length = class_text(part, library, Names(local=local)).count("\n") + 3
        if chunks[-1] and lines + length > _MOST_LINES:
            chunks.append([])
            lines = 0
        chunks[-1].append(part)
        lines += length
    return chunks


def _module(
    module: _Module, place: dict[str, str], library: Library, local: dict[str, str], home: str
) -> str:
    package = module.parts[0].package
    names = Names(local=local)
    own = {part.rosname for part in module.parts}
    texts = [class_text(part, library, names) for part in module.parts]
    names.messages |= {
        each
        for part in module.parts
        for each in ("time", "duration")
        if each in (f.kind.base for f in part.fields)
    }
    also = _also("" if place else package)
    imports = _imports(names, own, place, library, home)
    for source, extra in also.items():
        imports.setdefault(source, set()).update(extra)
    public = sorted([local[name] for name in own] + [name for extra in also.values() for name in extra])
    head = [f'"""{package}: {MARK}; change the ROS text, not this file."""', ""]
    head += ["from __future__ import annotations", "", *_import_lines(names, imports), ""]
    head += [*listed("__all__ = ", [f'"{name}"' for name in public])]
    if names.aliases:
        head += ["", *(f"{name}: TypeAlias = {hint}" for name, hint in sorted(names.aliases.items()))]
    return "\n\n\n".join(["\n".join(head), *(text.rstrip("\n") for text in texts)]) + "\n"


def _imports(
    names: Names, own: set[str], place: dict[str, str], library: Library, home: str
) -> dict[str, set[str]]:
    """What is imported from which of our modules."""
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
        source = _source(rosname, place, library, home)
        add(source, [name if name == original else f"{original} as {name}"])
    return imports


def _source(rosname: str, place: dict[str, str], library: Library, home: str) -> str:
    if rosname in _TIMES:
        return "bridge.msgs.builtin_interfaces"
    package = rosname.partition("/")[0]
    if rosname in place:
        module = place[rosname].removesuffix(".py")
        return f"{home}.{module.replace('/', '.')}" if home else f".{module.split('/')[1]}"
    if rosname in library.parts:
        return f"{home}.{package}" if home else f"{'..' if place else '.'}{package}"
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
    """As ruff orders modules: those further up first, numbers by their value."""
    return -len(source) + len(source.lstrip(".")), _natural(source)


def _from(source: str, names: Iterable[str]) -> list[str]:
    items = sorted(names, key=_name_order)
    if len(line := f"from {source} import {', '.join(items)}") <= WIDTH:
        return [line]
    return listed(f"from {source} import ", items, "()")


def _name_order(name: str) -> tuple[bool, bool, list[object], list[object]]:
    """As ruff orders what is imported from a module: constants, classes, the rest."""
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


def _also(package: str) -> dict[str, tuple[str, ...]]:
    return ALSO.get(package, {})


def _front(package: str, modules: list[_Module], local: dict[str, str], home: str) -> str:
    also = _also(package)
    imports = {source: set(extra) for source, extra in also.items()}
    for module in modules:
        dotted = module.path.removesuffix(".py").replace("/", ".")
        source = f"{home}.{dotted}" if home else f".{dotted.split('.')[1]}"
        imports[source] = {local[part.rosname] for part in module.parts}
    public = sorted({name for found in imports.values() for name in found})
    lines = [f'"""{package}: {MARK}; change the ROS text, not this file."""', ""]
    lines += ["from __future__ import annotations", ""]
    for source in sorted(imports, key=_order):
        lines += _from(source, imports[source])
    return "\n".join([*lines, "", *listed("__all__ = ", [f'"{name}"' for name in public])]) + "\n"
