"""Measured figures and their table."""

from __future__ import annotations

import json
import math

from bench.__main__ import main
from bench.figures import Figure, machine, percentile, table, timed


def test_a_percentile_is_one_of_the_samples():
    samples = [4.0, 1.0, 3.0, 2.0]
    assert percentile(samples, 50) == 2.0
    assert percentile(samples, 99) == 4.0
    assert math.isnan(percentile([], 50))


def test_the_value_is_the_median_unless_another_percentile_is_asked():
    assert Figure("a", "s", (1.0, 2.0, 9.0)).value == 2.0
    assert Figure("a", "s", (1.0, 2.0, 9.0), percent=95).value == 9.0


def test_a_figure_keeps_its_limit_from_either_side():
    assert Figure("a", "s", (1.0,), limit=1.0).ok is True
    assert Figure("a", "s", (1.1,), limit=1.0).ok is False
    assert Figure("a", "x", (25.0,), limit=20.0, at_least=True).ok is True
    assert Figure("a", "x", (15.0,), limit=20.0, at_least=True).ok is False
    assert Figure("a", "s", (1.0,)).ok is None


def test_a_figure_without_samples_is_over_its_limit():
    assert Figure("a", "s", (), limit=1.0).ok is False


def test_the_table_marks_what_is_over_its_limit():
    text = table([Figure("slow", "s", (3.0,), limit=1.0), Figure("fast", "s", (0.5,), limit=1.0)])
    assert [("OVER" in line) for line in text.splitlines()] == [False, True, False]


def test_the_record_is_json_even_without_samples():
    record = json.loads(json.dumps(Figure("a", "s", ()).record(), allow_nan=False))
    assert record["value"] is None


def test_timed_gives_one_sample_a_repetition():
    samples = timed(lambda: None, repeat=3, least=1e-4)
    assert len(samples) == 3
    assert all(sample > 0 for sample in samples)


def test_the_machine_measures_its_own_noise():
    figure = machine()
    assert figure.spread >= 0
    assert "load" in figure.against


def test_an_unknown_name_is_the_users_mistake_in_one_sentence(capsys):
    assert main(["nonsense"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("bench: there is no nonsense; there are codec,")
    assert said.count("\n") == 1
