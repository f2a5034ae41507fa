from __future__ import annotations

import gc
import itertools
import re
from pathlib import Path

import pytest
from fontTools.ttLib import TTFont
from kivy.lang import Builder
from kivy.metrics import mm

from tests.looped import looped
from tests.thrown import automatic, throw_away
from widgets.core.base import text_texture
from widgets.core.icons import FILLED, ICONS, OUTLINED, icon
from widgets.core.language import LANGUAGES, PSEUDO, language
from widgets.core.theme import FACES, FONTS, PALETTES, Theme, contrast, theme

WIDGETS = Path(__file__).parents[3] / "widgets"
GROUNDS = ("bg", "surface", "raised")
WORDS = ("text", "muted", "accent", "plan", "ok", "warn", "danger")
INKS = {"ink_accent": "accent", "ink_plan": "plan", "ink_danger": "danger", "ink_stop": "stop"}
PAIRS = [*itertools.product(WORDS, GROUNDS), *INKS.items()]


@pytest.fixture(autouse=True)
def dark_afterwards():
    yield
    theme.name, theme.gloves = "dark", False
    language.name = "en"


def test_black_on_white_has_the_contrast_of_the_standard():
    assert contrast("000000", "FFFFFF") == pytest.approx(21.0)
    assert contrast("777777", "FFFFFF") == pytest.approx(4.48, abs=0.005)


@looped("name", PALETTES)
@looped(("ink", "ground"), PAIRS)
def test_text_can_be_read_on_its_ground(name, ink, ground):
    least = 7.0 if name == "sunlight" else 4.5
    assert contrast(PALETTES[name][ink], PALETTES[name][ground]) >= least


@pytest.mark.parametrize("name", PALETTES)
def test_every_theme_has_every_role(name):
    assert PALETTES[name].keys() == PALETTES["dark"].keys()
    assert all(hasattr(theme, role) for role in PALETTES[name])


def test_a_rule_follows_the_theme():
    label = Builder.load_string("Label:\n    color: theme.accent\n    text: icons['home']\n")
    theme.name = "sunlight"
    assert label.color[:3] == pytest.approx([0.0, 0x48 / 255, 0xA8 / 255])
    assert theme.roles["accent"] == pytest.approx(label.color)
    assert label.text == icon("home")


def test_a_new_theme_is_the_dark_one_in_every_role():
    fresh = Theme()
    fresh.name = "sunlight"
    fresh.name = "dark"
    assert all(
        list(getattr(fresh, role)) == pytest.approx(list(Theme().roles[role])) for role in PALETTES["dark"]
    )


def test_glass_is_the_surface_but_lets_something_through():
    theme.name = "sunlight"
    assert list(theme.glass)[:3] == [1.0, 1.0, 1.0]
    assert 0.8 < theme.glass[3] < 1.0


def test_targets_are_14_mm_and_20_mm_in_gloves():
    assert theme.target == mm(14)
    theme.gloves = True
    assert theme.target == mm(20)


def test_no_file_but_the_theme_names_a_colour():
    hexes = re.compile(r"""["'#][0-9A-Fa-f]{6}(?:[0-9A-Fa-f]{2})?["']""")
    numbers = re.compile(
        r"(?:rgba?:|Color\()\s*\(?\s*(?:\d*\.\d+|[01])\s*,\s*(?:\d*\.\d+|[01])\s*,\s*(\d*\.?\d+)"
    )
    guilty = []
    for path in sorted(WIDGETS.rglob("*.py")):
        if path.name == "theme.py":
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            painted = [
                found for found in numbers.finditer(line) if not re.search(r"0, 0, 0, 0|1, 1, 1, 1", line)
            ]
            if hexes.search(line) or painted:
                guilty.append(f"{path.name}:{number}: {line.strip()}")
    assert not guilty


def test_no_widget_clears_its_canvas():
    assert not [
        path.name for path in WIDGETS.rglob("*.py") if "canvas.clear" in path.read_text(encoding="utf-8")
    ]


def test_no_size_in_a_rule_is_a_bare_number_of_pixels():
    bare = re.compile(
        r"^\s+(?:font_size|spacing|padding|width|height|size):\s*(?:[2-9]|\d\d+)(?:\.\d+)?\s*(?:,.*)?$",
        re.MULTILINE,
    )
    guilty = {path.name: bare.findall(path.read_text(encoding="utf-8")) for path in WIDGETS.rglob("*.py")}
    assert not {name: found for name, found in guilty.items() if found}


def test_every_icon_is_one_character_of_its_own():
    assert all(len(character) == 1 for character in ICONS.values())
    assert len(set(ICONS.values())) == len(ICONS) == len(OUTLINED) + len(FILLED)
    with pytest.raises(KeyError):
        icon("no such icon")


def test_the_fonts_have_every_icon_and_every_sign():
    from fontTools.ttLib import TTFont

    with TTFont(FONTS / "Icons.ttf") as font:
        assert {ord(character) for character in ICONS.values()} <= font.getBestCmap().keys()
    for face in ("B612-Regular", "B612-Bold"):
        with TTFont(FONTS / f"{face}.ttf") as font:
            known = font.getBestCmap()
            assert set(map(ord, "Aa0°−·–—…×²→≥≤±µéöß\u200a")) <= known.keys()
            assert len({font["hmtx"][known[ord(digit)]][0] for digit in "0123456789"}) == 1


def test_no_font_is_shipped_that_no_widget_uses():
    sources = "".join(p.read_text(encoding="utf-8") for p in WIDGETS.rglob("*.py") if p.name != "theme.py")
    families = {"B612": "theme.font", "Icons": "theme.icons"}
    assert {path.stem.split("-")[0] for path in FONTS.glob("*.ttf")} == set(families)
    assert all(use in sources for use in families.values())


def test_the_fonts_licences_are_beside_them():
    assert "SIL OPEN FONT LICENSE" in (FONTS / "B612-LICENSE.txt").read_text(encoding="utf-8")
    assert "Apache License" in (FONTS / "Icons-LICENSE.txt").read_text(encoding="utf-8")


def test_a_widget_that_was_thrown_away_does_not_vanish_while_it_follows_the_theme():
    with automatic():
        thrown = throw_away(theme)
        theme.name = "night"
        assert thrown().followed[0] == "night"
        assert gc.isenabled()


def test_a_name_that_is_none_leaves_the_collector_as_it_was():
    with automatic():
        with pytest.raises(ValueError, match="dusk"):
            theme.name = "dusk"
        assert gc.isenabled()
        gc.disable()
        theme.name = "night"
        assert not gc.isenabled()


def codes(path: Path) -> set[int]:
    return set(TTFont(path).getBestCmap())


@looped("weight", ["Regular", "Bold"])
@looped("name", LANGUAGES)
def test_the_typeface_of_a_language_has_its_letters(name, weight):
    own = LANGUAGES[name].own_name
    letters = {
        "fr": "àâçéèêëîïôœùûüÿ«»",
        "de": "äöüßÄÖÜ„“",
        "es": "áéíóúñü¿¡",
        "zh_CN": "停止机器人控制权限，。",
    }
    wanted = (
        set(map(ord, own + letters.get(name, ""))) if name != PSEUDO else set(map(ord, "ÅåÇçÈèÍíÑñÖöŠšÛûÝý"))
    )
    assert wanted <= codes(FONTS / FACES[LANGUAGES[name].font].format(weight))


def test_the_typeface_follows_the_language():
    wide = text_texture("停止", 20).size
    language.name = "zh_CN"
    assert theme.font == "Noto Sans SC"
    assert text_texture("停止", 20).size != wide
    language.name = "de"
    assert theme.font == "B612"
