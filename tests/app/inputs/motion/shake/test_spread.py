"""How velocity is spread, and whether a movement goes round."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.inputs.motion.shake.spread import Spread, Turning

LEAK = 0.25


def spread(wide: float, pace: float = 2.0 * math.pi, overtone: float = 1.0) -> Spread:
    """Of an ellipse so many times as wide as long, whose width is gone through `overtone` times as often as its length."""
    dt = 0.005
    at = np.arange(0.0, 6.0, dt)
    motion = np.stack([np.cos(pace * at), wide * np.sin(overtone * pace * at), np.zeros(len(at))], axis=1)
    velocity, sums, turned, power = np.zeros(3), np.zeros(6), np.zeros(3), 0.0
    for sample in motion:
        velocity = velocity * (1.0 - dt / LEAK) + sample * dt
        x, y, z = velocity
        sums += np.array([x * x, y * y, z * z, x * y, x * z, y * z]) * dt
        turned += np.cross(velocity, sample) * dt
        power += float(sample @ sample) * dt
    return Spread(sums.tolist(), 6.0, Turning((turned[0], turned[1], turned[2]), power, LEAK))


@pytest.mark.parametrize("pace", [4.0, 8.0, 15.0])
@pytest.mark.parametrize("wide", [0.0, 0.2, 0.5, 1.0])
def test_an_ellipse_is_as_round_as_it_is_wide_at_any_pace(wide: float, pace: float) -> None:
    found = spread(wide, pace)
    assert found.round == pytest.approx(2.0 * wide / (1.0 + wide**2), abs=0.06)
    assert found.pace == pytest.approx(pace, rel=0.06)


def test_an_arc_gone_to_and_fro_is_not_round_however_deep() -> None:
    found = spread(1.0, overtone=2.0)
    assert found.straight < 0.9
    assert found.round < 0.06


def test_what_is_left_of_a_movement_that_hardly_differs_from_its_background_is_not_rounder_than_round() -> (
    None
):
    """Less is left of its power than forgetting takes off: so slow it seems that whatever turns in it would be a circle many times over."""
    found = Spread([1.0, 0.1, 0.0, 0.0, 0.0, 0.0], 1.0, Turning((0.0, 0.0, 0.5), 15.0, LEAK))
    assert found.round < 0.5
    assert found.pace > 1.0


def test_where_nothing_moved_nothing_goes_round() -> None:
    still = Spread([0.0] * 6, 1.0, Turning((0.0, 0.0, 0.0), 0.0, LEAK))
    assert (still.round, still.straight, still.along((1.0, 0.0, 0.0))) == (0.0, 0.0, 0.0)
