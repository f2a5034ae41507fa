"""Kivy without what the app does not use: an expression of a rule is compiled when it is first asked for, and means the same."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path
from types import CodeType, ModuleType, SimpleNamespace
from typing import Any

import pytest
from kivy.lang import parser as real

from app.lean_kivy import be_lean, compile_when_used

ROOT = Path(__file__).parents[2]

RULES = """
<Lamp>:
    shade: 'red'
    nothing: None
    width: root.height * 2 + self.x
    on_touch_down: print('!')
    Bulb:
        power: root.mains.power if root.mains else 0
    canvas:
        Color:
            rgba: self.tint
"""


def another_parser() -> Any:
    """Kivy's parser once more, which nothing uses."""
    spec = importlib.util.spec_from_file_location("another_parser", real.__file__)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def lean() -> Any:
    module = another_parser()
    compile_when_used(module)
    return module


def expressions(parser: Any, rules: str = RULES) -> dict[str, Any]:
    """Every expression of the rules by its name."""
    found: dict[str, Any] = {}
    waiting = [rule for _, rule in parser.Parser(content=rules).rules]
    while waiting:
        rule = waiting.pop()
        found |= rule.properties | {one.name: one for one in rule.handlers}
        waiting += [*rule.children, *filter(None, (rule.canvas_before, rule.canvas_root, rule.canvas_after))]
    return found


def test_every_expression_means_what_it_means_to_kivy(lean: Any) -> None:
    ours, kivys = expressions(lean), expressions(real)
    assert set(ours) == {"shade", "nothing", "width", "on_touch_down", "power", "rgba"}
    for name, one in ours.items():
        assert one.co_value == kivys[name].co_value, name
        watched = [sorted(map(tuple, each.watched_keys or ())) for each in (one, kivys[name])]
        assert watched[0] == watched[1], name
        assert (one.mode, one.line) == (kivys[name].mode, kivys[name].line)


def test_it_is_compiled_once_and_not_before_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    module = another_parser()
    compiled: list[str] = []
    kept = module.ParserRuleProperty.precompile
    monkeypatch.setattr(
        module.ParserRuleProperty, "precompile", lambda one: (compiled.append(one.name), kept(one))
    )
    compile_when_used(module)
    found = expressions(module)
    assert compiled == []
    assert isinstance(found["width"].co_value, CodeType)
    assert found["width"].co_value is found["width"].co_value
    assert [found["shade"].co_value for _ in range(2)] == ["red", "red"]
    assert compiled == ["width", "shade"]


def test_a_mistake_is_said_with_its_line_each_time_it_is_asked_for(lean: Any) -> None:
    wrong = expressions(lean, "<Lamp>:\n    width: 1\n    height: 2 +\n")["height"]
    for _ in range(2):
        with pytest.raises(SyntaxError) as said:
            _ = wrong.co_value
        assert said.value.lineno == 3


@pytest.mark.parametrize(
    "other",
    [SimpleNamespace(), SimpleNamespace(ParserRuleProperty=type("Rule", (), {"precompile": lambda _: None}))],
)
def test_a_parser_that_is_built_otherwise_stays_as_it_is(other: Any) -> None:
    before = dict(vars(getattr(other, "ParserRuleProperty", object)))
    compile_when_used(other)
    assert dict(vars(getattr(other, "ParserRuleProperty", object))) == before


def test_nothing_is_changed_once_kivy_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    import kivy

    monkeypatch.setattr(kivy, "kivy_options", dict(kivy.kivy_options))
    finders = list(sys.meta_path)
    be_lean()
    assert sys.meta_path == finders


STARTED = """
import os, sys
from app.__main__ import prepare
os.environ["KIVY_NO_CONSOLELOG"] = "1"
finders = list(sys.meta_path)
prepare()
from kivy.lang import Builder, parser
slot = parser.ParserRuleProperty.__dict__["co_value"]
print(isinstance(slot, property), sys.meta_path == finders, type(parser.__loader__).__name__, parser.__spec__.loader is parser.__loader__)
import kivy.core.image
print(sorted(loader.__name__ for loader in kivy.core.image.ImageLoader.loaders), "PIL" in sys.modules)
"""


def test_the_program_starts_with_it() -> None:
    told = subprocess.run(
        [sys.executable, "-c", STARTED], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    assert told[0] == "True True SourceFileLoader True"
    assert told[1] == "['ImageLoaderSDL2'] False"


def test_whoever_names_other_readers_of_pictures_gets_them(monkeypatch: pytest.MonkeyPatch) -> None:
    import kivy

    monkeypatch.setenv("KIVY_IMAGE", "pil,sdl2")
    monkeypatch.setattr(kivy, "kivy_options", {"image": ["pil", "sdl2"]})
    be_lean()
    assert kivy.kivy_options["image"] == ["pil", "sdl2"]
    monkeypatch.delenv("KIVY_IMAGE")
    be_lean()
    assert kivy.kivy_options["image"] == ("sdl2",)


def test_a_build_without_that_reader_keeps_kivys_own_choice(monkeypatch: pytest.MonkeyPatch) -> None:
    import kivy

    setup = ModuleType("kivy.setupconfig")
    setup.USE_SDL2 = 0  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "kivy.setupconfig", setup)
    monkeypatch.setattr(kivy, "setupconfig", setup, raising=False)
    monkeypatch.setattr(kivy, "kivy_options", {"image": ["pil"]})
    monkeypatch.delenv("KIVY_IMAGE", raising=False)
    be_lean()
    assert kivy.kivy_options["image"] == ["pil"]
