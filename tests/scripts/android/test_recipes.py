"""Requirements that a real build would stop at, or that would not load on a phone."""

from __future__ import annotations

import pytest

from scripts.android.failure import Failed
from scripts.android.recipes import Module, Recipe, Resolved, check_recipes

KIVY = Recipe("kivy", "2.3.1", "2.3.1", 3)
PLYER = Module("plyer", "2.1.0", "plyer-2.1.0-py2.py3-none-any.whl", "plyer-2.1.0-py2.py3-none-any.whl", "")


def judged(recipe: Recipe = KIVY, module: Module = PLYER) -> str:
    return check_recipes(Resolved("sdl2", "3.14.2", (recipe,), (module,)))


def test_what_holds_is_said_in_words():
    assert judged() == "recipes: 1 of Python 3.14.2 (sdl2), 1 modules, each with a file that a phone can load"


def test_a_pin_that_is_not_the_recipes_own_breaks_its_patches():
    assert judged(Recipe("numpy", "2.2.0", "2.3.0", 0)), "nothing is patched there"
    with pytest.raises(Failed, match=r"ruamel\.yaml==0\.19\.1: its recipe's patches are for 0\.15\.77"):
        judged(Recipe("ruamel.yaml", "0.19.1", "0.15.77", 1))


def test_pure_source_is_built_where_there_is_no_wheel():
    assert judged(module=Module("hkdf", "0.0.3", "", "", "hkdf-0.0.3.tar.gz"))


@pytest.mark.parametrize(
    ("module", "why"),
    [
        (Module("charset-normalizer", "3.4.2", "a-any.whl", "a-any.whl", ""), "write an underscore"),
        (Module("nowhere", "9", "", "", ""), "no such release"),
        (Module("numbers", "1", "", "numbers-1-cp314-manylinux_2_28_x86_64.whl", ""), "there is none for a phone"),
        (Module("words", "3", "words-3-cp314-android_24_arm64_v8a.whl", "", ""), "Pin a release that is pure"),
    ],
)  # fmt: skip
def test_a_module_that_no_phone_can_load_is_told(module, why):
    with pytest.raises(Failed, match=why):
        judged(module=module)
