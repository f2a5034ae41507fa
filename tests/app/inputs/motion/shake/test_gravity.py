"""Where up and right are, however the phone is held."""

from __future__ import annotations

import math

import pytest

from app.inputs.motion.shake.gravity import GRAVITY, GravityFilter

UPRIGHT, ASIDE = (0.0, 1.0), (1.0, 0.0)
"""How much of up are the device's x and y."""


def right(*held: tuple[float, float]) -> float:
    """How far a gentle swing along the device's own y goes to the right, when it was held so in turn and is so swung at last: 0 or less
    where it is taken to be upright."""
    ground, dt = GravityFilter(0.9), 1 / 60
    for x, y in held:
        z = math.sqrt(max(0.0, 1.0 - x * x - y * y))
        for _ in range(600):
            ground.motion(dt, x * GRAVITY, y * GRAVITY, z * GRAVITY)
    swing = [math.sin(math.tau * 2.0 * index * dt) for index in range(60)]
    found = [ground.motion(dt, x * GRAVITY, y * GRAVITY + value, z * GRAVITY)[0] for value in swing]
    return sum(one * value for one, value in zip(found, swing, strict=True)) / 30.0


def test_held_upright_its_own_y_goes_up_and_held_sideways_to_the_right() -> None:
    assert right((0.1, 0.7)) < 0.1
    assert right((0.9, 0.1)) > 0.6


@pytest.mark.parametrize("between", [(0.52, 0.0), (0.7, 0.5)], ids=["x hardly up", "x hardly more than y"])
def test_between_the_two_it_stays_as_it_was(between: tuple[float, float]) -> None:
    """It is carried near the limit, and one shake is never told half as the one and half as the other."""
    assert right(UPRIGHT, between) < 0.1
    assert right(ASIDE, between) > 0.6


def test_a_corner_that_is_up_is_not_sideways() -> None:
    assert right(UPRIGHT, (0.7, 0.7)) < 0.1
    assert right(ASIDE, (0.7, 0.7)) < 0.1
