"""What a robot says, in the language of the glass."""

from __future__ import annotations

import re

import pytest

from app.core.robot_sentences import SENTENCES, sentence
from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from tests.looped import looped
from widgets.core.language import PSEUDO, language


@pytest.fixture(autouse=True)
def english_afterwards():
    yield
    language.name = "en"


def said(code: str, own_words: str = "own words", **parameters: str) -> str:
    return sentence(code, [KeyValue(key, value) for key, value in parameters.items()], own_words)


def test_in_english_a_robot_speaks_for_itself():
    assert (
        said(Code.STOP_PRESSED, "STOP pressed by tablet-B.", name="tablet-B") == "STOP pressed by tablet-B."
    )


def test_in_another_language_its_sentence_is_made_anew_with_its_values():
    language.name = PSEUDO
    told = said(Code.STOP_PRESSED, name="tablet-B")
    assert "tablet-B" in told
    assert told.startswith("[")


@looped(
    ("code", "parameters"),
    [("", {}), ("of_tomorrow", {}), (Code.STOP_PRESSED, {}), (Code.STOP_PRESSED, {"x": "1"})],
)
def test_what_cannot_be_made_anew_stays_in_its_own_words(code, parameters):
    language.name = PSEUDO
    assert said(code, **parameters) == "own words"


@looped("code", SENTENCES)
def test_a_sentence_names_only_what_its_code_carries(code):
    assert set(re.findall(r"\{(\w+)\}", SENTENCES[code])) <= set(Code(code).parameters)


def test_a_value_with_braces_is_no_place_for_another():
    language.name = PSEUDO
    assert "{name}" in said(Code.WAYPOINT_REACHED, place="{name}")
