"""What a robot says, in the language of the glass."""

from __future__ import annotations

import re

import pytest

from app.core.robot_sentences import SENTENCES, sentence
from bridge.core.codes import Code
from bridge.core.units import UNITS, quantity_of
from bridge.msgs.diagnostic_msgs import KeyValue
from tests.looped import looped
from widgets.core.language import PSEUDO, language
from widgets.core.quantities import quantities


@pytest.fixture(autouse=True)
def english_and_metric_afterwards():
    yield
    language.name, quantities.system = "en", "metric"


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


@looped(
    ("system", "told"),
    [
        ("metric", "The robot's own words, in metres."),
        ("imperial", "The fence is 4.9\u00a0ft away: the robot goes no nearer."),
        ("nautical", "The fence is 1.50\u00a0m away: the robot goes no nearer."),
    ],
)
def test_an_operator_with_other_units_reads_the_robot_s_figures_in_them_in_english_too(system, told):
    quantities.system = system
    assert said(Code.FENCE_NEAR, "The robot's own words, in metres.", room="1.5") == told


def test_what_has_no_figure_in_a_unit_stays_in_the_robot_s_english_whatever_the_units():
    quantities.system = "imperial"
    assert said(Code.CONTROL_LAPSED, "own words", name="tablet-B", seconds="2") == "own words"


@looped(
    ("code", "parameters", "told"),
    [
        (Code.BATTERY_LOW, {"charge": "0.194"}, "Akku schwach: 19\u00a0%."),
        (Code.TASK_STARTED, {"task": "patrol"}, "Patrouille gestartet."),
        (Code.TASK_STARTED, {"task": "of_tomorrow"}, "of_tomorrow gestartet."),
        (Code.FENCE_NEAR, {"room": "near"}, "near"),
        (
            Code.DRIVE_EXCESSIVE,
            {"robot": "R", "asked": "1.2", "allowed": "0.8", "quantity": "speed"},
            "0,80\u00a0m/s",
        ),
        (Code.DRIVE_EXCESSIVE, {"robot": "R", "asked": "2", "allowed": "1", "quantity": "turn"}, "57°/s"),
        (Code.DRIVE_EXCESSIVE, {"robot": "R", "asked": "2", "allowed": "1.25"}, "1.25"),
        (Code.TASK_SLOW, {"seconds": "12.34"}, "12,3\u00a0s"),
    ],
)
def test_figures_and_known_words_are_those_of_the_chosen_language(code, parameters, told):
    language.name = "de"
    assert told in said(code, **parameters)


@looped("code", SENTENCES)
def test_each_quantity_of_a_sentence_has_a_unit(code):
    kinds = {quantity_of(code, key, {}) for key in Code(code).parameters}
    assert kinds <= {"", *UNITS}
