"""Kivy without what the app does not use: of its rules those of widgets that are made, and one reader of pictures.

Kivy compiles every expression of every rule when it reads it, its own style included, which has the rules of 60 widgets of
which the app makes ten: a tenth of the time until the first frame. Here an expression is compiled when a widget is first
made by it. A mistake in a rule is therefore said, with its line, when the rule is first used.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from types import ModuleType
from typing import Any

__all__ = ["be_lean", "compile_when_used"]

PARSER = "kivy.lang.parser"
READER = "sdl2"
"""The reader of pictures that comes with Kivy's window; what the camera sends is decoded elsewhere."""


def be_lean() -> None:
    """To be called before any of Kivy is imported; what is imported already stays as it is."""
    if PARSER not in sys.modules:
        sys.meta_path.insert(0, _ParserFinder())
    import kivy
    from kivy.setupconfig import USE_SDL2

    if (
        USE_SDL2 and "KIVY_IMAGE" not in os.environ
    ):  # else Kivy loads the whole of Pillow, though its own is asked first
        kivy.kivy_options["image"] = (READER,)


class _ParserFinder(MetaPathFinder):
    """Finds Kivy's parser once, as those behind it do, to change it as soon as it is loaded: the next line of Kivy uses it."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if fullname != PARSER:
            return None
        sys.meta_path.remove(self)
        spec = find_spec(fullname)
        if spec is not None and spec.loader is not None:
            spec.loader = _ParserLoader(spec.loader)
        return spec


class _ParserLoader(Loader):
    def __init__(self, loader: Loader) -> None:
        self._loader = loader

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        if module.__spec__ is not None:
            module.__spec__.loader = module.__loader__ = self._loader
        self._loader.exec_module(module)
        compile_when_used(module)


def compile_when_used(parser: ModuleType) -> None:
    """Have the expressions that `parser`, Kivy's, reads from now on compiled when one first asks for them.

    A parser that is built otherwise than that of Kivy 2.3 is left as it is.
    """
    expression: Any = getattr(parser, "ParserRuleProperty", object)
    kept: Any = vars(expression).get("co_value")
    compile_now: Any = vars(expression).get("precompile")
    if not hasattr(kept, "__set__") or compile_now is None:
        return
    waiting = object()

    def compiled(one: Any) -> Any:
        value = kept.__get__(one)
        if value is waiting:
            compile_now(one)
            value = kept.__get__(one)
        return value

    expression.co_value = property(compiled, kept.__set__)
    expression.precompile = lambda one: kept.__set__(one, waiting)
