"""Results as a table, as plain values and as a page."""

from __future__ import annotations

import json
import math

import pytest

from bench.support.figures import Figure, Outcome, Samples, Stated
from bench.support.harness import Result
from bench.support.noise import Noise
from bench.support.report import as_json, document, number, table, write

COST = Figure("cost", "ms", "what it costs", target=2.0, against="the old way")
SPEED = Figure("speed", "×", "how fast", better="more")


def result():
    outcomes = [
        Outcome(COST, Samples((1.0, 1.5, 1.2)), Samples((6.0,))),
        Outcome(SPEED, Samples((12.345,))),
    ]
    noise = Noise(slowness=[1.0, 1.8], waiting=[0.0, 0.25], load=[3.0])
    return Result("part", "How it is done.", outcomes, noise)


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.012345, "0.0123"), (1.2345, "1.23"), (123.45, "123"), (12345.6, "12346"), (0, "0"), (math.nan, "–")],
)
def test_numbers_have_three_figures(value, text):
    assert number(value) == text


def test_the_table_has_a_line_a_figure_in_even_columns():
    name, head, cost, speed, noise = table(result()).rstrip("\n").split("\n")
    assert name == "part"
    assert cost.split() == [
        *(
            "cost",
            "1.20",
            "ms",
            "1.00…1.50",
            "≤",
            "2.00",
            "reached",
            "the",
            "old",
            "way",
            "6.00",
            "ms",
            "5.00×",
        )
    ]
    assert speed.split() == ["speed", "12.3", "×", "12.3…12.3", "–", "–", "–", "–"]
    assert head.index("target") == cost.index("≤")
    assert noise == (
        "noise: the fixed loop took 1…1.80 times its best, others had the core 25% of it at worst, load 3.00"
    )


def test_the_json_holds_every_sample_and_null_for_nan(tmp_path):
    write(tmp_path / "new" / "part.json", as_json(result()))
    read = json.loads((tmp_path / "new" / "part.json").read_text())
    cost, speed = read["figures"]
    assert cost["ours"] == {
        "median": 1.2,
        "low": 1.0,
        "high": 1.5,
        "spread": pytest.approx(0.5 / 1.2),
        "values": [1.0, 1.5, 1.2],
    }
    assert (cost["verdict"], cost["target"], cost["ratio"]) == ("reached", 2.0, 5.0)
    assert speed["peer"] == {"median": None, "low": None, "high": None, "spread": None, "values": []}
    assert (speed["verdict"], speed["target"], speed["ratio"]) == ("", None, None)
    assert read["noise"]["load"] == [3.0]


def test_the_page_shows_what_was_reached_and_under_which_conditions():
    page = document([json.loads(json.dumps(as_json(result())))], "a machine")
    assert "Measured on a machine." in page
    assert "## part\n\nHow it is done.\n" in page
    assert (
        "| what it costs | 1.20 ms (1.00…1.50) | ≤ 2.00 ms | reached | the old way: 6.00 ms | 5.00× |" in page
    )
    assert "| how fast | 12.3 × (12.3…12.3) | – |  | – | – |" in page
    assert "up to 1.80 times its best; load 3.00" in page


def test_the_page_says_which_share_of_the_peers_value_is_aimed_at():
    share = Figure("share", "ms", "at most so much", target=9.0, against="the old way", share=0.25)
    outcomes = [Outcome(share, Samples((1.0,)), Samples((5.0,)))]
    told = Result("part", "How.", outcomes, Noise(slowness=[1.0], waiting=[0.0], load=[3.0]))
    page = document([json.loads(json.dumps(as_json(told)))], "a machine")
    assert "| ≤ 9.00 ms, ≤ 0.250 of its value | reached | the old way: 5.00 ms | 5.00× |" in page
    assert "≤ 9.00, ≤ 0.250 of its value" in table(told)


def with_stated():
    relayed = Figure("relay", "µs", "relayed", target=20.0, stated=Stated("the real server", 310.0))
    outcomes = [Outcome(relayed, Samples((10.0,))), Outcome(SPEED, Samples((12.345,)))]
    return Result("part", "How.", outcomes, Noise(slowness=[1.0], waiting=[0.0], load=[3.0]))


def test_what_was_only_stated_stands_apart_from_what_was_measured():
    _, head, relay, speed, _ = table(with_stated()).rstrip("\n").split("\n")
    place = head.index("stated, not of this run")
    assert relay[place:] == "the real server: 310 µs  31.0×"
    assert relay[:place].split()[-3:] == ["–", "–", "–"]
    assert speed[place:].split() == ["–", "–"]
    assert "stated" not in table(result())


def test_the_page_has_a_column_for_what_was_stated_where_something_was():
    page = document([json.loads(json.dumps(as_json(with_stated())))], "a machine")
    assert "| better by | stated, not of this run | better by |" in page
    assert "| reached | – | – | the real server: 310 µs | 31.0× |" in page
    assert "| how fast | 12.3 × (12.3…12.3) | – |  | – | – | – | – |" in page


def test_the_page_can_be_written_from_results_of_before_there_was_anything_stated():
    old = json.loads(json.dumps(as_json(result())))
    for figure in old["figures"]:
        del figure["stated"]
    page = document([old], "a machine")
    assert "the old way: 6.00 ms | 5.00× |\n" in page
