"""Whether Java has what the app asks it for: classes, their constants and methods where they are named at once, and interfaces in whole.

Android's own classes are looked up in stubs of its whole API, those of the app's own Java code in python-for-android's sources. What a
method is handed cannot be seen here; the tests of `app/device` call the same stubs.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from scripts.android.failure import Failed

__all__ = [
    "OPTIONAL",
    "Interface",
    "Use",
    "arity",
    "check_java_names",
    "interfaces",
    "java_class",
    "stubs_folder",
    "uses",
]

COVERED = ("android", "androidx", "dalvik", "java", "javax")
"""Packages that the stubs have."""
OURS = {
    "org.kivy.android": "src/main/java/org/kivy/android",
    "org.libsdl.app": "src/main/java/org/libsdl/app",
}
"""Packages of python-for-android's own, and where their sources are in its tree; SDL's come with SDL, which is not there."""
OF_SDL = frozenset({"org.libsdl.app.SDLActivity"})


class Use(NamedTuple):
    """A class that is asked for."""

    where: str
    name: str
    attribute: str
    """What is read of it at once; empty where the class is kept."""


class Interface(NamedTuple):
    """An interface of Java's that a class of the app stands in for."""

    where: str
    names: tuple[str, ...]
    methods: dict[str, int]
    """Name to how many arguments Java hands over, by the signature."""
    classes: tuple[str, ...]
    """Named in the signatures."""


def stubs_folder() -> Path:
    """Where the stubs are installed; Failed where they are not."""
    import sysconfig

    place = Path(sysconfig.get_path("purelib"))
    if not (place / "android-stubs").is_dir():
        raise Failed("the stubs of Android's API are not installed; run make setup-test.")
    return place


@cache
def _module(path: Path) -> ast.Module | None:
    return ast.parse(path.read_text()) if path.is_file() else None


def _members(body: Iterable[ast.stmt]) -> dict[str, ast.stmt]:
    found: dict[str, ast.stmt] = {}
    for node in body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            found[node.target.id] = node
    return found


def java_class(name: str, stubs: Path) -> ast.ClassDef | None:
    """The stub of `android.a.B$C`; None where Java has no such class."""
    *package, last = name.split(".")
    if not package:
        return None
    module = _module(stubs.joinpath(f"{package[0]}-stubs", *package[1:], "__init__.pyi"))
    body: list[ast.stmt] = module.body if module else []
    found: ast.stmt | None = None
    for part in last.split("$"):
        found = _members(body).get(part)
        if not isinstance(found, ast.ClassDef):
            return None
        body = found.body
    return found if isinstance(found, ast.ClassDef) else None


def _text(node: ast.expr) -> str:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def _called(node: ast.AST) -> str:
    if not isinstance(node, ast.Call):
        return ""
    return node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")


def uses(tree: ast.AST, where: str) -> Iterator[Use]:
    """Each `autoclass` and `cast` to a class that is named."""
    read = {id(node.value): node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    for node in ast.walk(tree):
        if _called(node) in {"autoclass", "cast"} and isinstance(node, ast.Call) and node.args:
            name = _text(node.args[0]).replace("/", ".")
            if "." in name:  # else it is a word of ours: typing has a cast, too
                attribute = read.get(id(node), "") if _called(node) == "autoclass" else ""
                yield Use(f"{where}:{node.lineno}", name, attribute)


def interfaces(tree: ast.AST, where: str) -> Iterator[Interface]:
    """Each class with `__javainterfaces__`, and the methods that it and what stands before it in the same file have for Java."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.ClassDef):
            continue
        names = [
            _text(item)
            for statement in node.body
            if isinstance(statement, ast.Assign)
            and any(isinstance(one, ast.Name) and one.id == "__javainterfaces__" for one in statement.targets)
            and isinstance(statement.value, ast.List | ast.Tuple)
            for item in statement.value.elts
        ]
        if names:
            bases = [node, *_bases(node, tree)]
            signed = {name: sign for one in bases for name, sign in _signed(one)}
            counts = {name: len(_arguments(sign, where)) for name, sign in signed.items()}
            classes = tuple(re.findall(r"L([\w/$]+);", " ".join(signed.values())))
            yield Interface(
                f"{where}:{node.lineno}", tuple(name.replace("/", ".") for name in names), counts,
                tuple(name.replace("/", ".") for name in classes),
            )  # fmt: skip


def _bases(node: ast.ClassDef, tree: ast.AST) -> Iterator[ast.ClassDef]:
    """Classes that a function of the same file makes for it to stand on: `class Listener(_made())`."""
    makers = {_called(base) for base in node.bases}
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef) and function.name in makers:
            yield from (one for one in function.body if isinstance(one, ast.ClassDef))


def _signed(node: ast.ClassDef) -> Iterator[tuple[str, str]]:
    for method in node.body:
        if isinstance(method, ast.FunctionDef):
            for mark in method.decorator_list:
                if _called(mark) == "java_method" and isinstance(mark, ast.Call):
                    yield method.name, _text(mark.args[0])


def _arguments(signature: str, where: str) -> list[str]:
    """The types in `(ILandroid/os/Bundle;)V`; Failed where Java could not read it."""
    whole = re.fullmatch(
        r"\(((?:\[*(?:[ZBCSIJFD]|L[\w/$]+;))*)\)(?:V|\[*(?:[ZBCSIJFD]|L[\w/$]+;))", signature
    )
    if not whole:
        raise Failed(f"{where}: {signature!r} is no signature of Java's.")
    return re.findall(r"\[*(?:[ZBCSIJFD]|L[\w/$]+;)", whole[1])


def _known(name: str, stubs: Path, sources: Path | None) -> bool:
    package = name.rpartition(".")[0]
    if name.partition(".")[0] in COVERED:
        return java_class(name, stubs) is not None
    if name in OF_SDL or (package in OURS and sources is None):
        return True
    path = OURS.get(package)
    return (
        path is not None
        and sources is not None
        and (sources / path / f"{name.rpartition('.')[2]}.java").is_file()
    )


def _check_use(use: Use, stubs: Path, sources: Path | None) -> None:
    if not _known(use.name, stubs, sources):
        raise Failed(f"{use.where}: there is no Java class {use.name}.")
    stub = java_class(use.name, stubs)
    if stub is not None and use.attribute and use.attribute not in _inherited(stub, use.name, stubs):
        raise Failed(f"{use.where}: {use.name} has no {use.attribute}.")


def _inherited(stub: ast.ClassDef, name: str, stubs: Path) -> set[str]:
    """Members of a class and of those that it stands on; `getClass` and the like, which Java's Object has, too."""
    found = set(_members(stub.body))
    for base in stub.bases:
        text = ast.unparse(base)
        outer = text if "." in text else f"{name.rpartition('.')[0]}.{text}"
        above = java_class(outer, stubs)
        if above is not None and above is not stub:
            found |= _inherited(above, outer, stubs)
    return found


def _check_interface(one: Interface, stubs: Path) -> None:
    for name in (*one.names, *one.classes):
        if name.partition(".")[0] in COVERED and java_class(name, stubs) is None:
            raise Failed(f"{one.where}: there is no Java class {name}.")
    for name in one.names:
        stub = java_class(name, stubs)
        wanted = {
            method.name: arity(method)
            for method in (stub.body if stub else ())
            if isinstance(method, ast.FunctionDef)
        }
        for method, count in wanted.items():
            if one.methods.get(method, -1) not in _counts(stub, method, count):
                raise Failed(f"{one.where}: {name} wants {method} with {count} arguments.")
        if odd := set(one.methods) - set(wanted):
            raise Failed(f"{one.where}: {name} has no {', '.join(sorted(odd))}.")


def _counts(stub: ast.ClassDef | None, name: str, count: int) -> set[int]:
    """How many arguments any of an overloaded method's kinds takes; what is optional in an interface may be absent, as -1."""
    kinds = [
        one for one in (stub.body if stub else ()) if isinstance(one, ast.FunctionDef) and one.name == name
    ]
    return {count} | {arity(one) for one in kinds} | ({-1} if name in OPTIONAL else set())


OPTIONAL = frozenset({"onSegmentResults", "onEndOfSegmentedSession", "onLanguageDetection"})
"""Methods that an interface got later, with a body of its own; older phones do not have them."""


def arity(method: ast.FunctionDef) -> int:
    """How many arguments Java hands over."""
    arguments = method.args
    return len(arguments.posonlyargs) + len(arguments.args) - 1  # without self


def check_java_names(files: Iterable[Path], root: Path, stubs: Path, sources: Path | None) -> str:
    """Failed for the first name that Java does not have; `sources` is a rendered tree with python-for-android's own Java, if any."""
    asked, stood_for = 0, 0
    for path in files:
        if path.suffix != ".py":
            continue
        tree = ast.parse((root / path).read_text())
        for use in uses(tree, str(path)):
            _check_use(use, stubs, sources)
            asked += 1
        for one in interfaces(tree, str(path)):
            _check_interface(one, stubs)
            stood_for += 1
    return f"Java: {asked} classes asked for and {stood_for} interfaces stood in for, all of Android's API"
