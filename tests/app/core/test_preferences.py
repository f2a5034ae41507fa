"""What an operator chose for this handheld: checked when it is read, applied at once, remembered."""

from __future__ import annotations

import json

import pytest
from kivy.metrics import Metrics, sp

from app.core.preferences import Preferences
from app.core.settings_store import Settings
from widgets.core.language import language
from widgets.core.quantities import quantities
from widgets.core.theme import theme


@pytest.fixture
def settings(tmp_path):
    made = Settings(tmp_path)
    yield made
    made.close()


@pytest.fixture(autouse=True)
def as_before():
    yield
    quantities.system, language.name, theme.gloves, Metrics.fontscale = "metric", "en", False, 1.0


def kept(tmp_path, **values):
    (tmp_path / "settings.json").write_text(json.dumps(values))
    return Settings(tmp_path)


def test_nothing_kept_is_as_usual_and_no_mistake(settings):
    preferences = Preferences(settings)
    assert (quantities.system, language.name, theme.gloves) == ("metric", "en", False)
    assert (preferences.text, preferences.sentence) == (1.0, "")


def test_a_choice_is_on_the_glass_at_once_and_the_next_time(settings, tmp_path):
    first = Preferences(settings)
    for name, value in {
        "units": "nautical",
        "language": "de",
        "gloves": True,
        "text": 1.5,
    }.items():
        first.choose(name, value)
    assert (quantities.system, language.name, theme.gloves, sp(10)) == ("nautical", "de", True, 15.0)
    settings.close()
    first.close()
    quantities.system, language.name, theme.gloves = "metric", "en", False
    again = Settings(tmp_path)
    second = Preferences(again)
    again.close()
    assert (quantities.system, language.name, theme.gloves, second.text) == ("nautical", "de", True, 1.5)
    second.close()
    assert Metrics.fontscale == 1.0


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("units", "miles"),
        ("units", ["metric"]),
        ("language", 7),
        ("gloves", "yes"),
        ("text", 40),
        ("text", "large"),
    ],
)
def test_what_was_kept_and_is_no_good_says_so_and_the_default_holds(tmp_path, name, value):
    settings = kept(tmp_path, **{name: value})
    preferences = Preferences(settings)
    settings.close()
    assert preferences.sentence.startswith(f"In the settings of this handheld {name} is ")
    assert repr(value) in preferences.sentence
    assert preferences.sentence.endswith(": reset to default.")
    assert (quantities.system, language.name, theme.gloves) == ("metric", "en", False)
    assert preferences.text == 1.0


def test_what_is_no_good_is_said_in_the_kept_language(tmp_path):
    settings = kept(tmp_path, language="de", text=40)
    sentence = Preferences(settings).sentence
    settings.close()
    assert "dieses Handgerät" in sentence
    assert "handheld" not in sentence
    assert "not 40" not in sentence


@pytest.mark.parametrize("name", ["units", "language", "text"])
def test_words_figures_and_places_are_made_anew(settings, name):
    preferences, made = Preferences(settings), []
    preferences.on_anew = lambda: made.append(name)
    preferences.choose("gloves", True)
    assert not made
    preferences.choose(name, {"units": "imperial", "language": "fr", "text": 2.0}[name])
    assert made == [name]


@pytest.mark.parametrize(("name", "value"), [("text", 2.1), ("text", 0.5), ("units", "miles")])
def test_what_there_is_not_is_not_taken_and_not_remembered(settings, name, value):
    preferences = Preferences(settings)
    with pytest.raises(ValueError, match=str(value)):
        preferences.choose(name, value)
    assert settings.get(name) is None
