"""Figures for people in the unit that the operator chose, and back to SI what is typed."""

from __future__ import annotations

import math

import pytest

from widgets.core.language import language
from widgets.core.quantities import (
    DASH,
    KINDS,
    SYSTEMS,
    digits_for,
    from_shown,
    quantities,
    read,
    round_length,
    said,
    to_shown,
    unit_of,
)


@pytest.fixture(autouse=True)
def metric_afterwards():
    yield
    quantities.system, language.name = "metric", "en"


@pytest.mark.parametrize(
    ("system", "value", "kind", "words"),
    [
        ("metric", 0.624, "speed", "0.62 m/s"),
        ("imperial", 0.44704, "speed", "1.00 mph"),
        ("nautical", 0.5144444, "speed", "1.00 kn"),
        ("metric", 999.0, "distance", "999 m"),
        ("metric", 1850.0, "distance", "1.9 km"),
        ("imperial", 30.48, "distance", "100 ft"),
        ("imperial", 1609.344, "distance", "1.0 mi"),
        ("nautical", 300.0, "distance", "300 m"),
        ("nautical", 1852.0, "distance", "1.0 nmi"),
        ("metric", 0.42, "length", "42 cm"),
        ("metric", 4.2, "length", "4.20 m"),
        ("metric", 42.0, "length", "42.0 m"),
        ("imperial", 0.0254, "length", "1 in"),
        ("imperial", 0.6096, "length", "2.0 ft"),
        ("metric", -4.5, "height", "−4.5 m"),
        ("imperial", -3.048, "height", "−10 ft"),
        ("metric", 25000.0, "area", "2.5 ha"),
        ("imperial", 4046.8564224, "area", "1.0 acres"),
        ("metric", 21.5, "temperature", "21.5 °C"),
        ("imperial", -40.0, "temperature", "−40 °F"),
        ("imperial", 100.0, "temperature", "212 °F"),
        ("metric", 101325.0, "pressure", "1013 hPa"),
        ("imperial", 101325.0, "pressure", "29.92 inHg"),
        ("imperial", 0.45359237, "mass", "1.0 lb"),
        ("nautical", math.pi / 2, "angle", "90°"),
    ],
)
def test_a_value_is_said_in_the_chosen_unit(system, value, kind, words):
    quantities.system = system
    assert said(value, kind).words == words.replace(" ", "\u00a0")


@pytest.mark.parametrize("value", [None, math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("kind", KINDS)
def test_what_there_is_not_is_a_dash(value, kind):
    assert said(value, kind).text == DASH
    assert said(value, kind).words == DASH
    assert said(value, kind, 2).text == DASH


def test_nothing_is_no_negative_nothing():
    assert said(-0.0001, "speed").text == "0.00"
    assert said(0.0001, "speed", signed=True).text == "0.00"


def test_what_is_above_zero_has_its_sign_where_that_is_asked():
    assert (said(0.5, "speed", signed=True).text, said(-0.5, "speed", signed=True).text) == ("+0.50", "−0.50")


def test_decimals_are_as_the_language_writes_them():
    language.name = "de"
    assert said(0.62, "speed").text == "0,62"
    assert round_length(0.5 * 1852)[1] == "500\u00a0m"


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_typed_as_it_is_shown_is_the_same_in_si(system, kind):
    quantities.system = system
    for value in (0.0, 1.0, -7.25, 1234.5):
        assert from_shown(to_shown(value, kind), kind) == pytest.approx(value)
        typed = f"{to_shown(value, kind):.12f}"
        assert read(typed, kind) == pytest.approx(value, abs=1e-6)
        assert read(f"{typed.replace('.', ',')} {unit_of(kind)}", kind) == pytest.approx(value, abs=1e-6)


def test_a_unit_that_is_typed_counts_more_than_the_chosen_one():
    quantities.system = "imperial"
    assert read("2 m", "height") == pytest.approx(2.0)
    assert read("2", "height") == pytest.approx(0.6096)
    assert read("−2,5 m", "height") == pytest.approx(-2.5)


@pytest.mark.parametrize("text", ["", "fast", "1 m", "1.2.3", "--1", "nan", "inf", "1e3x"])
def test_what_is_no_number_of_that_kind_is_said(text):
    with pytest.raises(ValueError, match=r"^A number is needed, as in 1\.5.m/s, not '.*'\.$"):
        read(text, "speed")


def test_a_length_on_the_map_is_round_in_its_own_unit():
    assert round_length(0.34) == (pytest.approx(0.2), "20\u00a0cm")
    assert round_length(1.0) == (pytest.approx(1.0), "1\u00a0m")
    assert round_length(7900.0) == (pytest.approx(5000.0), "5\u00a0km")
    quantities.system = "imperial"
    assert round_length(7.0) == (pytest.approx(6.096), "20\u00a0ft")
    assert round_length(4000.0) == (pytest.approx(2 * 1609.344), "2\u00a0mi")
    quantities.system = "nautical"
    assert round_length(4000.0) == (pytest.approx(2 * 1852.0), "2\u00a0nmi")


def test_digits_tell_as_much_in_a_smaller_unit():
    assert digits_for("height", 2) == 2
    quantities.system = "imperial"
    assert (digits_for("height", 2), digits_for("height", 0), digits_for("speed", 2)) == (1, 0, 2)
    assert said(1.0, "height", 2).words == "3.3\u00a0ft"


def test_every_system_has_units_for_every_kind():
    assert all(set(systems) == set(SYSTEMS) for systems in KINDS.values())
