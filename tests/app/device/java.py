"""Java as a phone has it, for tests: only classes, members and signatures of Android's own API, by its stubs.

A test says what objects do; what the app asks of them beyond that API fails with a sentence. `install` puts it in the place of `jnius`.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Callable, Iterator
from functools import cache
from types import ModuleType
from typing import Any

import pytest

from scripts.android.java_names import OPTIONAL, arity, java_class, stubs_folder

__all__ = ["Handle", "JavaException", "NotJava", "install", "java", "played"]

OURS = {"org.kivy.android.PythonActivity": "android.app.Activity"}
"""Classes of python-for-android's own, and what of Android's they are."""
FIELDS = {"org.kivy.android.PythonActivity": {"mActivity"}}
"""What those have beside it."""
PRIMITIVES: dict[str, tuple[type, ...]] = {
    "bool": (bool,), "int": (int,), "float": (float, int), "str": (str,)
}  # fmt: skip
"""What of Python pyjnius hands over as them."""
ANY = {"object", "java.lang.Object", "java.lang.CharSequence", "java.lang.Number", "typing.Any"}
"""What a plain value may be given as, too."""
TYPE = re.compile(r"\[*(?:[ZBCSIJFD]|L[\w/$]+;)")


class JavaException(Exception):
    """As jnius raises it for whatever Java throws."""


class Handle(str):
    """A text that stands for an object of Java's, as an address or a file: plain text is none."""

    __slots__ = ()


class NotJava(AssertionError):
    """The app asked for what Java does not have."""


@cache
def members(name: str) -> dict[str, tuple[ast.stmt, ...]]:
    """By name, every kind of a class's methods and its fields, with those that it inherits."""
    stub = java_class(OURS.get(name, name), stubs_folder())
    if stub is None:
        raise NotJava(f"Java has no class {name}.")
    found: dict[str, tuple[ast.stmt, ...]] = {}
    for base in stub.bases:
        text = ast.unparse(base).partition("[")[0]
        above = text if "." in text else f"{OURS.get(name, name).rpartition('.')[0]}.{text}"
        if java_class(above, stubs_folder()) is not None:
            found |= members(above)
    own: dict[str, tuple[ast.stmt, ...]] = {}
    for node in stub.body:
        key = getattr(node, "name", None) or getattr(getattr(node, "target", None), "id", "")
        own[key] = (*own.get(key, ()), node)
    return found | own


def _takes(kind: ast.FunctionDef, given: tuple[Any, ...]) -> bool:
    """A kind of a method takes these arguments, without the object itself."""
    fixed = kind.args.posonlyargs + kind.args.args
    if fixed and fixed[0].arg == "self":
        fixed = fixed[1:]
    if len(given) < len(fixed) or (len(given) > len(fixed) and kind.args.vararg is None):
        return False
    return all(_fits(one.annotation, value) for one, value in zip(fixed, given, strict=False))


def _fits(annotation: ast.expr | None, value: object) -> bool:
    """Only plain numbers, truths and texts are looked at: a test's own object stands for whatever it is given as."""
    if type(value) not in {bool, int, float, str}:
        return True
    text = ast.unparse(annotation) if annotation is not None else "object"
    wanted = {part.strip() for part in text.split("|")}
    if wanted & ANY:
        return True
    return any(type(value) in PRIMITIVES[one] for one in wanted if one in PRIMITIVES)


class _Checked:
    """An object or a class: what is asked of it exists, and is called as Java wants it."""

    def __init__(self, name: str, given: dict[str, Any]) -> None:
        members(name)
        self.__dict__.update(_name=name, _given=given)
        for known in given:
            if known != "new":
                self._kinds(known)

    def _kinds(self, attribute: str) -> tuple[ast.stmt, ...]:
        known = members(self._name)
        if attribute not in known and attribute not in FIELDS.get(self._name, ()):
            raise NotJava(f"{self._name} has no {attribute}.")
        return known.get(attribute, ())

    def __getattr__(self, attribute: str) -> Any:
        if attribute.startswith("__"):
            raise AttributeError(attribute)
        kinds = [one for one in self._kinds(attribute) if isinstance(one, ast.FunctionDef)]
        if not kinds:
            return self._given.get(attribute, f"{self._name}.{attribute}")
        if attribute not in self._given:
            raise NotJava(f"this test does not say what {self._name}.{attribute} does.")
        return lambda *given: self._call(attribute, kinds, given)

    def _call(self, method: str, kinds: list[ast.FunctionDef], given: tuple[Any, ...]) -> Any:
        if not any(_takes(kind, given) for kind in kinds):
            raise NotJava(f"{self._name}.{method} does not take {given!r}.")
        does = self._given[method]
        return does(*given) if callable(does) and not isinstance(does, _Checked) else does

    def __call__(self, *given: Any) -> Any:
        kinds = [one for one in members(self._name).get("__init__", ()) if isinstance(one, ast.FunctionDef)]
        if "new" not in self._given or not any(_takes(kind, given) for kind in kinds):
            raise NotJava(f"{self._name} is not made of {given!r}.")
        return self._given["new"](*given)


def java(name: str, **given: Any) -> Any:
    """An object of a class, or the class: what its methods do, or answer, and its fields hold; `new` is its maker."""
    return _Checked(name, given)


def played(name: str, by: Any) -> Any:
    """An object of a class whose methods are those of a test's own object."""
    methods = {one: getattr(by, one) for one in vars(type(by)) if not one.startswith("_")}
    return java(name, **methods)


def _signature(text: str) -> int:
    whole = re.fullmatch(rf"\(((?:{TYPE.pattern})*)\)(?:V|{TYPE.pattern})", text)
    if not whole:
        raise NotJava(f"{text!r} is no signature of Java's.")
    for name in re.findall(r"L([\w/$]+);", text):
        members(name.replace("/", "."))
    return len(TYPE.findall(whole[1]))


def _java_method(text: str) -> Callable[[Any], Any]:
    count = _signature(text)

    def mark(method: Any) -> Any:
        if method.__code__.co_argcount - 1 != count:
            raise NotJava(f"{method.__name__} is handed {count} arguments by Java.")
        method.java = count
        return method

    return mark


class PythonJavaClass:
    """Stands in for Java's interfaces, each of whose methods it must have."""

    __javainterfaces__: tuple[str, ...] = ()

    def __init_subclass__(cls) -> None:
        for name in cls.__javainterfaces__:
            for method, count in _abstract(name.replace("/", ".")):
                found = getattr(getattr(cls, method, None), "java", None)
                if found != count:
                    raise NotJava(f"{name} wants {method} with {count} arguments.")


def _abstract(name: str) -> Iterator[tuple[str, int]]:
    stub = java_class(name, stubs_folder())
    if stub is None:
        raise NotJava(f"Java has no class {name}.")
    for node in stub.body:
        if isinstance(node, ast.FunctionDef) and node.name not in OPTIONAL:
            yield node.name, arity(node)


def install(monkeypatch: pytest.MonkeyPatch, *classes: Any) -> None:
    """Have `jnius` know these classes, made by `java`; all others of Android's exist and do nothing that a test said."""
    known = {one._name: one for one in classes}

    def autoclass(name: str) -> Any:
        return known.get(name) or java(name)

    def cast(name: str, it: Any) -> Any:
        members(name)
        return it

    jnius = ModuleType("jnius")
    jnius.__dict__.update(
        autoclass=autoclass, cast=cast, JavaException=JavaException, PythonJavaClass=PythonJavaClass,
        java_method=_java_method,
    )  # fmt: skip
    monkeypatch.setitem(sys.modules, "jnius", jnius)
