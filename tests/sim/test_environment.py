"""A simulated robot as Gymnasium's environment: true goals, honest sensors, the same episode for the same seed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import sim
from sim.environment import BUMP_COST, REACHED_REWARD, STEP_COST, DriveToGoal

AHEAD = np.array([1.0, 0.0], dtype=np.float32)
REST = np.zeros(2, dtype=np.float32)


@pytest.fixture
def office() -> Iterator[DriveToGoal]:
    env = sim.make("scout", world="office", time_limit=2.0, noise=False)
    yield env
    env.close()


def at(office: DriveToGoal, start: tuple[float, float, float], goal: tuple[float, float]) -> dict[str, Any]:
    return office.reset(seed=1, options={"start": start, "goal": goal})[0]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # the checker advises on spaces that are not normalised
@pytest.mark.parametrize(
    ("robot", "axes", "sees"),
    [
        ("patrol", 2, 360),
        ("scout", 2, 16),
        ("commander", 2, 271),
        ("minnow", 2, 0),
        ("aqua", 3, 0),
        ("ardrone", 4, 0),
    ],
)
def test_every_robot_is_an_environment_by_gymnasiums_own_check(robot: str, axes: int, sees: int) -> None:
    env = sim.make(robot, render_mode="rgb_array")
    check_env(env)
    assert env.action_space.shape == (axes,)
    seen, _ = env.reset(seed=2)
    assert seen.get("ranges", np.zeros(0)).shape == (sees,)
    env.close()


def test_the_goal_is_seen_from_the_robot(office: DriveToGoal) -> None:
    x, y = office._places.draw(np.random.default_rng(4))
    seen = at(office, (x, y, math.pi / 2), (x, y))
    assert seen["goal"] == pytest.approx([0.0, 0.0, 0.0], abs=1e-3)
    there = office._places.draw_apart(np.random.default_rng(4), (x, y), 1.0, 3.0)
    seen = at(office, (x, y, math.pi / 2), there)
    # it faces north: what lies north is ahead of it, what lies west is to its left
    assert seen["goal"] == pytest.approx([there[1] - y, x - there[0], 0.0], abs=2e-3)


def test_the_same_seed_gives_the_same_episode_to_the_last_bit() -> None:
    def run() -> list[bytes]:
        env = sim.make("scout", world="office", time_limit=1.0)
        seen, _ = env.reset(seed=7)
        steps = [seen, *(env.step(AHEAD)[0] for _ in range(5))]
        env.close()
        return [each[key].tobytes() for each in steps for key in sorted(each)]

    assert run() == run()


def test_the_next_episode_without_a_seed_is_another_one(office: DriveToGoal) -> None:
    _, first = office.reset(seed=7)
    _, second = office.reset()
    assert first["goal"] != second["goal"]


def test_the_reward_is_how_much_nearer_it_came_less_a_little_for_the_time(office: DriveToGoal) -> None:
    env = office
    _, info = env.reset(seed=3)
    x, y, _, yaw = info["pose"]
    at(env, (x, y, yaw), info["goal"][:2])
    before = math.dist(info["pose"][:2], info["goal"][:2])
    total = 0.0
    for _ in range(5):
        _, reward, ended, late, info = env.step(np.array([0.3, 0.5], dtype=np.float32))
        assert not ended
        assert not late
        total += float(reward)
    nearer = before - math.dist(info["pose"][:2], info["goal"][:2])
    assert total == pytest.approx(nearer - 5 * STEP_COST, abs=1e-3)


def test_being_there_ends_it_with_a_reward(office: DriveToGoal) -> None:
    place = office._places.draw(np.random.default_rng(0))
    at(office, (*place, 0.0), place)
    _, reward, ended, late, info = office.step(REST)
    assert (ended, late, info["is_success"]) == (True, False, True)
    assert float(reward) == pytest.approx(REACHED_REWARD - STEP_COST, abs=1e-3)
    with pytest.raises(RuntimeError, match="No episode runs: call reset first"):
        office.step(REST)


def test_a_bump_ends_it_and_costs() -> None:
    env = sim.make("scout", world="office", time_limit=60.0, noise=False)
    env.reset(seed=5)
    ended = late = False
    reward: Any = 0.0
    while not (ended or late):
        _, reward, ended, late, info = env.step(AHEAD)
    assert (ended, info["bumped"], info["is_success"]) == (True, True, False)
    assert float(reward) < -BUMP_COST + 1.0
    env.close()


def test_time_that_is_up_cuts_it_off(office: DriveToGoal) -> None:
    office.reset(seed=3)
    late = [office.step(REST)[3] for _ in range(20)]
    assert late == [False] * 19 + [True]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"robot": "rover"}, "There is no simulated robot 'rover'"),
        ({"world": "moon"}, "moon"),
        ({"world": "lake"}, "needs dry land"),
        (
            {"distance": (3.0, 2.0)},
            "distance is the least and the most, above 0 and in this order, not (3.0, 2.0).",
        ),
        ({"time_limit": 0.0}, "time_limit is at least 0.1 s, not 0."),
        ({"render_mode": "human"}, "render_mode is None or rgb_array, not 'human'."),
    ],
)
def test_a_wrong_argument_is_one_sentence(arguments: dict[str, Any], said: str) -> None:
    with pytest.raises(ValueError, match=".") as fault:
        sim.make(**{"robot": "scout", "world": "office", **arguments})
    assert said in str(fault.value)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"place": (0, 0)}, "An episode has the options start and goal, not 'place'."),
        ({"start": (12.95, 0.0, 0.0)}, "The start has no room at (12.95, 0): something stands there."),
        ({"goal": (-12.95, 0.0)}, "The goal has no room at (-12.95, 0): something stands there."),
    ],
)
def test_a_wrong_option_is_one_sentence_and_the_last_episode_goes_on(
    office: DriveToGoal, options: dict[str, Any], said: str
) -> None:
    office.reset(seed=3)
    with pytest.raises(ValueError, match=".") as fault:
        office.reset(options=options)
    assert str(fault.value) == said
    office.step(REST)


@pytest.mark.parametrize("action", [[math.nan, 0.0], [1.0], [[0.0, 0.0]]])
def test_an_action_that_is_none_moves_nothing(office: DriveToGoal, action: Any) -> None:
    _, info = office.reset(seed=3)
    with pytest.raises(ValueError, match="An action has 2 finite numbers"):
        office.step(np.array(action))
    assert office._info()["pose"] == info["pose"]
