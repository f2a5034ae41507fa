"""Which twist at the robot's port, and which picture on the glass, belongs to what was done before."""

from __future__ import annotations

import math

import pytest

from bench.latency import delays, followed
from bench.video import ages


def test_each_move_is_followed_to_the_command_and_to_the_port():
    moved = [(1.0, 10, 20), (2.0, 30, 40)]
    commands = [(1.005, 10.2, 20.3, 0.1, 0.2), (2.004, 30.1, 40.0, 0.3, 0.4)]
    port = [(1.006, 0.1, 0.2), (1.056, 0.1, 0.2), (2.007, 0.3, 0.4)]
    touch, whole = delays(moved, commands, port)
    assert touch == pytest.approx([0.005, 0.004])
    assert whole == pytest.approx([0.006, 0.007])


def test_a_move_that_a_newer_one_overtook_came_with_it():
    moved = [(1.0, 10, 20), (1.02, 30, 40)]
    commands = [(1.03, 30, 40, 0.3, 0.4)]
    touch, whole = delays(moved, commands, [(1.04, 0.3, 0.4)])
    assert touch == pytest.approx([0.03, 0.01])
    assert whole == pytest.approx([0.04, 0.02])


def test_a_twist_that_a_newer_one_overtook_in_the_app_came_with_it():
    moved = [(1.0, 10, 20), (1.1, 30, 40)]
    commands = [(1.01, 10, 20, 0.1, 0.2), (1.11, 30, 40, 0.3, 0.4)]
    _, whole = delays(moved, commands, [(1.12, 0.3, 0.4)])
    assert whole == pytest.approx([0.12, 0.02])


def test_what_never_came_is_infinitely_late():
    touch, whole = delays([(1.0, 10, 20)], [(1.01, 10, 20, 0.1, 0.2)], [(1.02, 0.5, 0.5)])
    assert touch == pytest.approx([0.01])
    assert whole == [math.inf]


def test_an_overtaken_cause_does_not_wait_for_the_same_numbers_much_later():
    causes = [(1.0, [7.0]), (1.1, [8.0]), (1.2, [9.0]), (5.0, [7.0])]
    effects = [(1.12, [8.0]), (1.21, [9.0]), (5.01, [7.0])]
    assert followed(causes, effects, 0.0) == [1.12, 1.12, 1.21, 5.01]


def test_an_effect_before_its_cause_is_not_its_own():
    assert followed([(1.0, [7])], [(0.9, [7]), (1.3, [7])], 0.0) == [1.3]


def test_a_picture_is_as_old_as_its_drawing_and_one_not_shown_is_lost():
    drawn = [(10.0, 5.0), (10.1, 5.1), (10.2, 5.2), (10.3, 5.3)]
    taken, missing = ages(drawn, [(10.05, 5.0), (10.24, 5.2)])
    assert taken == pytest.approx([0.05, 0.04])
    assert missing == pytest.approx(1 / 3)


def test_a_picture_that_nobody_drew_is_a_fault():
    with pytest.raises(RuntimeError, match="not those that were drawn"):
        ages([(10.0, 5.0)], [(10.1, 6.0)])
