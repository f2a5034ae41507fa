"""Diagnostics as a tree: groups as bad as the worst in them, the worst first, silent parts stale, all of it bounded."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus, KeyValue
from widgets.status.diagnostics import (
    ERROR,
    MAX_PARTS,
    OK,
    STALE,
    STALE_TIMEOUT,
    WARN,
    DiagnosticsModel,
)


def part(name, level=0, message="", **values):
    return DiagnosticStatus(level, name, message, values=[KeyValue(*each) for each in values.items()])


def told(*parts, now=0.0) -> DiagnosticsModel:
    model = DiagnosticsModel()
    model.take(DiagnosticArray(status=list(parts)), now)
    return model


def lines(model, now=0.0):
    return [("  " * row.depth + row.name, row.level) for row in model.rows(now)]


def test_a_group_is_as_bad_as_the_worst_in_it_and_what_is_worse_comes_first():
    model = told(part("/a/well"), part("/b/bad", 2), part("/b/warm", 1), part("/a/warm", 1), part("/c", 0))
    assert lines(model) == [
        ("b", ERROR),
        ("  bad", ERROR),
        ("  warm", WARN),
        ("a", WARN),
        ("  warm", WARN),
        ("  well", OK),
        ("c", OK),
    ]


def test_what_is_well_is_closed_until_a_finger_opens_it():
    model = told(part("/a/one"), part("/a/two"))
    assert lines(model) == [("a", OK)]
    model.fold(("a",), 0.0)
    assert lines(model) == [("a", OK), ("  one", OK), ("  two", OK)]
    model.fold(("a",), 0.0)
    assert lines(model) == [("a", OK)]


def test_what_a_finger_closed_stays_closed_when_it_gets_worse():
    model = told(part("/a/one", 1))
    model.fold(("a",), 0.0)
    model.take(DiagnosticArray(status=[part("/a/one", 2)]), 1.0)
    assert lines(model, 1.0) == [("a", ERROR)]


def test_readings_of_a_part_are_shown_once_it_is_opened():
    model = told(part("/motor", 0, "runs", temperature="41", current="1.2"))
    assert [row.foldable for row in model.rows(0.0)] == [True]
    model.fold(("motor",), 0.0)
    assert [(row.name, row.text, row.value) for row in model.rows(0.0)[1:]] == [
        ("temperature", "41", True),
        ("current", "1.2", True),
    ]


def test_a_part_without_anything_in_it_cannot_be_opened():
    model = told(part("/battery"))
    model.fold(("battery",), 0.0)
    assert not model.rows(0.0)[0].open


def test_a_message_need_not_tell_of_every_part_and_a_silent_one_grows_stale():
    model = told(part("/one"), part("/two"))
    model.take(DiagnosticArray(status=[part("/two")]), 4.0)
    now = STALE_TIMEOUT + 1.0
    assert lines(model, now) == [("one", STALE), ("two", OK)]
    (one, two) = model.rows(now)
    assert one.age == pytest.approx(now)
    assert math.isnan(two.age)
    assert model.level(now) == STALE


def test_an_error_does_not_become_better_by_silence():
    assert lines(told(part("/one", 2)), 100.0) == [("one", ERROR)]


def test_a_part_that_says_that_it_is_stale_is():
    assert lines(told(part("/one", 3))) == [("one", STALE)]


def test_a_level_that_nobody_knows_is_an_error():
    assert lines(told(part("/one", 9))) == [("one", ERROR)]


def test_a_part_may_be_a_group_too():
    model = told(part("/arm", 0, "homed"), part("/arm/joint", 1))
    assert lines(model) == [("arm", WARN), ("  joint", WARN)]
    assert model.rows(0.0)[0].text == "homed"


@pytest.mark.parametrize(
    ("name", "names"),
    [("a", ["a"]), ("//a//b/", ["a", "  b"]), ("", ["?"]), ("/", ["?"]), ("left: motor", ["left: motor"])],
)
def test_names_are_cut_at_slashes(name, names):
    model = told(part(name, 1))
    assert [line for line, _ in lines(model)] == names


def test_a_name_of_very_many_parts_ends_somewhere():
    assert max(row.depth for row in told(part("/".join("x" * 90), 1)).rows(0.0)) < 10


def test_of_very_many_parts_those_that_were_silent_longest_go():
    model = told(*[part(f"/p{n}") for n in range(MAX_PARTS)])
    model.take(DiagnosticArray(status=[part("/new"), part("/p0")]), 1.0)
    names = {row.name for row in model.rows(1.0)}
    assert len(names) == MAX_PARTS
    assert {"new", "p0"} <= names
    assert "p1" not in names


def test_endless_texts_are_cut():
    row = told(part("/" + "n" * 9000, 1, "m" * 9000)).rows(0.0)[0]
    assert len(row.name) < 300
    assert len(row.text) < 500


def test_how_many_there_are_of_each():
    model = told(part("/a", 2), part("/b", 1), part("/c", 1), part("/d"))
    assert model.counts(0.0) == {ERROR: 1, WARN: 2, OK: 1, STALE: 0}


def test_of_another_robot_nothing_is_left():
    model = told(part("/a", 2))
    model.clear()
    assert model.rows(0.0) == []
    assert model.level(0.0) == OK
