"""What is kept of somebody's switches, how a pace is found for a hand, and what is learned from what is done."""

from __future__ import annotations

import json
import math
import random
import wave
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.inputs.switch_access.scan.reaction import Reaction
from app.inputs.switch_access.scan.settings import DEFAULTS, Key, read
from app.inputs.switch_access.tones import TONES, write
from app.inputs.switch_access.usage import Usage


def test_what_was_chosen_comes_back_from_the_file() -> None:
    mine = replace(DEFAULTS, one=True, interval=2.2, a=(), b=(Key("pad", "dpup", "Box"), Key("key", "f13")))
    assert read(json.loads(json.dumps(mine.save()))) == (mine, "")


@pytest.mark.parametrize(
    ("kept", "said"),
    [
        ({"interval": 99}, "interval 99 (0.5 to 6)"),
        ({"loops": True}, "loops True (1 to 9)"),
        ({"acceptance": math.nan}, "acceptance nan (0 to 1)"),
        ({"tones": "yes"}, "tones 'yes' (true or false)"),
        ({"b": [{"source": "key"}]}, "at most 6 keys"),
        ({"b": [{"source": "key", "name": "tab"}]}, "one key for both switches"),
    ],
)
def test_what_cannot_be_is_put_to_the_default_and_said(kept: dict[str, Any], said: str) -> None:
    options, fault = read({**kept, "first": 1.0})
    assert options == replace(DEFAULTS, first=1.0)
    assert said in fault


def test_what_is_no_table_at_all_is_said() -> None:
    assert read([1, 2])[0] == DEFAULTS
    assert "no table" in read([1, 2])[1]


def test_a_key_of_one_gamepad_is_not_that_of_another() -> None:
    key = Key("pad", "a", "Box")
    assert key.fits("pad", "a", "Box")
    assert not key.fits("pad", "a", "Other")
    assert not key.fits("key", "a", "Box")


def react(test: Reaction, after: float, now: float) -> float:
    """Wait for the sign, press so long after it, and wait until that is told."""
    while test.phase != "go":
        now += 0.01
        test.update(now)
    now += after
    test.press(now)
    return now


def test_the_interval_is_the_mean_by_the_rule_and_practice_does_not_count() -> None:
    test, now = Reaction(random.Random(1)), 0.0
    test.start(now)
    for after in (2.0, 1.5, 0.5, 0.6, 0.7, 0.5, 0.6, 0.7):
        now = react(test, after, now)
    assert test.phase == "done"
    assert test.mean == pytest.approx(0.6)
    assert test.interval == 1.0  # 0.6 / 0.65 = 0.92


def test_who_presses_before_the_sign_or_never_does_it_once_more() -> None:
    test, now = Reaction(random.Random(1)), 0.0
    test.start(now)
    test.press(0.2)
    assert (test.phase, test.done) == ("early", 0)
    now = react(test, 0.05, 0.2)
    assert (test.phase, test.done) == ("early", 0)
    now = react(test, 0.4, now)
    assert test.done == 1
    while test.phase != "missed":
        now += 0.1
        test.update(now)
    assert test.done == 1


def test_a_very_slow_hand_gets_the_longest_that_may_be_set() -> None:
    test, now = Reaction(random.Random(1)), 0.0
    test.start(now)
    for _ in range(8):
        now = react(test, 3.95, now)
    assert test.interval == 6.0


def test_nothing_learned_counts_before_the_next_start() -> None:
    usage = Usage(None)
    for _ in range(5):
        usage.used("drive", "pause")
    assert usage.frozen == {}
    assert Usage(json.loads(json.dumps(usage.save()))).frozen == {"drive": {"pause": 4.5}}


def test_what_is_used_no_more_is_forgotten() -> None:
    kept: Any = {"drive": {"pause": 5.0, "once": 1.0}}
    for _ in range(30):
        usage = Usage(kept)
        usage.used("drive", "pause")
        kept = usage.save()
    assert list(kept["drive"]) == ["pause"]


def test_what_is_kept_is_bounded_and_no_count_is_left_out() -> None:
    usage = Usage({"drive": {"a": "x", "b": math.inf, "c": 3}, "other": 5})
    assert usage.frozen == {"drive": {"c": pytest.approx(2.7)}}
    for place in range(100):
        for name in range(100):
            usage.used(f"p{place}", f"n{name}")
    usage.used("", "pause")
    kept = usage.save()
    assert len(kept) <= 40
    assert all(len(names) <= 80 for names in kept.values())
    assert kept[""] == {"pause": 1}


@pytest.mark.parametrize("name", list(TONES))
def test_a_tone_lasts_as_long_as_it_should_and_begins_and_ends_in_silence(tmp_path: Path, name: str) -> None:
    write(tmp_path / "tone.wav", *TONES[name])
    with wave.open(str(tmp_path / "tone.wav")) as file:
        frames = file.readframes(file.getnframes())
        assert file.getnframes() / file.getframerate() == pytest.approx(TONES[name][1], abs=1e-3)
    values = [int.from_bytes(frames[at : at + 2], "little", signed=True) for at in range(0, len(frames), 2)]
    assert max(abs(values[0]), abs(values[-1])) < 0.1 * max(values)
    assert max(values) > 8000
