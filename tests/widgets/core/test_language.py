"""Words, plurals and figures in the language of the glass."""

from __future__ import annotations

import math

import pytest

from tests.looped import looped
from widgets.core import language as module
from widgets.core.language import LANGUAGES, PSEUDO, brief_figure, figure, language, mark, tr, trn, within


@pytest.fixture(autouse=True)
def english_afterwards():
    yield
    language.name = "en"


@pytest.fixture
def german(tmp_path, monkeypatch):
    from babel.messages.catalog import Catalog
    from babel.messages.mofile import write_mo

    made = Catalog(locale="de")
    made.add("Start", "Los")
    made.add("Home", "Heim", context="verb")
    made.add(("{count} robot", "{count} robots"), ("{count} Roboter", "{count} Robotern"))
    with (tmp_path / "de.mo").open("wb") as file:
        write_mo(file, made)
    monkeypatch.setattr(module, "FOLDER", tmp_path)
    language.name = "de"


def test_english_is_what_stands_in_the_sources():
    assert tr("Start") == "Start"
    assert (trn("{count} robot", "{count} robots", 1), trn("{count} robot", "{count} robots", 2)) == (
        "1 robot",
        "2 robots",
    )


@pytest.mark.usefixtures("german")
def test_a_sentence_is_in_the_language_that_is_chosen():
    assert tr("Start") == "Los"
    language.name = "en"
    assert tr("Start") == "Start"


@pytest.mark.usefixtures("german")
def test_one_english_word_has_two_translations_by_its_context():
    assert (tr("Home", "verb"), tr("Home")) == ("Heim", "Home")


@pytest.mark.usefixtures("german")
def test_what_is_not_translated_stays_english():
    assert tr("Pause") == "Pause"


@pytest.mark.usefixtures("german")
def test_nothing_is_nothing_in_every_language():
    assert tr("") == ""


@pytest.mark.usefixtures("german")
def test_a_count_chooses_the_form_of_the_language():
    assert trn("{count} robot", "{count} robots", 1) == "1 Roboter"
    assert trn("{count} robot", "{count} robots", 3) == "3 Robotern"


def test_a_language_that_there_is_not_is_refused_and_the_old_one_stays():
    with pytest.raises(ValueError, match="A language is one of en, fr, .*, not 'xx'."):
        language.name = "xx"
    assert language.name == "en"


def test_a_constant_is_marked_and_unchanged():
    assert mark("Start") == "Start"


@pytest.mark.usefixtures("german")
def test_a_marked_word_of_two_meanings_brings_its_own_context_along():
    words = {"key": mark("Home", "verb"), "place": mark("Home")}
    assert words["key"] == words["place"] == "Home"
    assert (tr(words["key"]), tr(words["place"])) == ("Heim", "Home")
    assert tr(words["key"], "other") == "Home"
    language.name = "en"
    assert type(tr(words["key"])) is str  # what draws it makes copies by its type


@looped(
    ("name", "value", "text"),
    [("en", 0.25, "0.25"), ("de", 0.25, "0,25"), ("de", -5.0, "−5"), ("de", math.nan, "—")],
)
def test_a_brief_figure_has_the_decimals_that_it_needs(name, value, text):
    language.name = name
    assert brief_figure(value) == text


def test_the_pseudo_language_lengthens_what_is_said_and_keeps_places_and_marks():
    language.name = PSEUDO
    said = tr("[b]{name}[/b] has control")
    assert said.startswith("[[b]{name}[/b]")
    assert len(said) >= len("[b]{name}[/b] has control") + 0.4 * len(" has control")
    assert said != "[b]{name}[/b] has control"
    assert trn("{count} robot", "{count} robots", 2).startswith("[2 ")
    assert tr("{value}") == "{value}"


@looped(
    ("name", "text"),
    [("en", "−1234.50"), ("de", "−1234,50"), ("fr", "−1234,50"), ("es", "−1234,50"), ("zh_CN", "−1234.50")],
)
def test_a_figure_is_written_as_the_language_writes_it(name, text):
    language.name = name
    assert figure(-1234.5, 2) == text


def test_a_figure_that_there_is_not_is_a_dash_and_zero_has_no_sign():
    assert (figure(math.nan), figure(-math.inf, 2), figure(-0.001, 1)) == ("—", "—", "0.0")


def test_each_language_is_called_as_its_speakers_call_it():
    assert [LANGUAGES[name].own_name for name in ("de", "fr", "es", "zh_CN")] == [
        "Deutsch",
        "français",
        "español",
        "简体中文",
    ]


def test_english_words_begin_small_within_a_sentence_but_for_capitals():
    assert [within(words) for words in ("Patrol", "GPS", "I", "")] == ["patrol", "GPS", "i", ""]


def test_german_nouns_keep_their_capital_within_a_sentence(german):
    assert within("Patrouille") == "Patrouille"


@pytest.mark.parametrize(
    "damage", [b"", b"words", b"\xde\x12\x04\x95" + bytes(3), b"\xde\x12\x04\x95" + b"\xff" * 60]
)
def test_a_damaged_catalogue_leaves_english_and_no_app_that_cannot_begin(
    tmp_path, monkeypatch, caplog, damage
):
    monkeypatch.setattr(module, "FOLDER", tmp_path)
    (tmp_path / "fr.mo").write_bytes(damage)
    language.name = "fr"
    assert tr("Start") == "Start"
    assert "the catalogue of fr cannot be read" in caplog.text
