"""The learner of the example: it turns to the goal and away from what is near, and its score tells better from worse."""

from __future__ import annotations

import numpy as np
import pytest

import sim
from examples import learn_to_drive
from examples.learn_to_drive import act, score

TURNS_TO_GOAL = np.array([0.0, 0.5, -0.5, 2.0, 0.0])


def seen(goal: tuple[float, float], near: int | None = None) -> dict[str, np.ndarray]:
    ranges = np.full(16, 5.0, dtype=np.float32)
    if near is not None:
        ranges[near] = 0.3
    return {"goal": np.array([*goal, 0.0], dtype=np.float32), "ranges": ranges}


def test_a_goal_to_the_left_is_turned_to():
    assert act(TURNS_TO_GOAL, seen((1.0, 1.0)))[1] > 0.5
    assert act(TURNS_TO_GOAL, seen((1.0, -1.0)))[1] < -0.5


def test_what_is_near_ahead_slows_and_what_is_near_to_the_left_turns_it_right():
    assert act(TURNS_TO_GOAL, seen((1.0, 0.0), near=0))[0] < act(TURNS_TO_GOAL, seen((1.0, 0.0)))[0]
    assert act(np.array([0.0, 0.0, 0.0, 0.0, 1.0]), seen((1.0, 0.0), near=3))[1] < -0.5


@pytest.mark.slow
def test_a_policy_that_turns_to_the_goal_scores_better_than_one_that_stands(monkeypatch):
    monkeypatch.setattr(learn_to_drive, "EPISODES", 2)
    env = sim.make("scout", world="office", time_limit=10.0, distance=(1.0, 2.0))
    assert score(env, TURNS_TO_GOAL, 3) > score(env, np.zeros(5), 3) + 1.0
    env.close()
