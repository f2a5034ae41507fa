"""A scout learns to drive to places in the office, by the cross-entropy method: `python -m examples.learn_to_drive`."""

from __future__ import annotations

import sys

import numpy as np
from numpy.typing import NDArray

import sim
from sim.environment import DriveToGoal

EPISODES, POPULATION, ELITE = 4, 16, 4


def act(policy: NDArray[np.float64], seen: dict[str, NDArray[np.float32]]) -> NDArray[np.float32]:
    """Speed and turn by where the goal is and how much room is to the left, ahead and to the right [m]."""
    bearing = np.arctan2(seen["goal"][1], seen["goal"][0])
    ring = np.minimum(seen["ranges"], 2.0)  # sixteen sonars, anticlockwise from ahead
    left, ahead, right = ring[2:5].min(), ring[[15, 0, 1]].min(), ring[12:15].min()
    speed = policy[0] + policy[1] * ahead + policy[2] * abs(bearing)
    turn = policy[3] * bearing + policy[4] * (left - right)
    return np.tanh([speed, turn]).astype(np.float32)


def score(env: DriveToGoal, policy: NDArray[np.float64], first: int) -> float:
    """Mean return over the episodes from the seed `first` on."""
    total = 0.0
    for seed in range(first, first + EPISODES):
        seen, _ = env.reset(seed=seed)
        ended = late = False
        while not (ended or late):
            seen, reward, ended, late, _ = env.step(act(policy, seen))
            total += float(reward)
    return total / EPISODES


def main(generations: int = 10) -> float:
    """Learn for so many generations; the mean return of the policy on episodes that it has not seen."""
    env, random = (
        sim.make("scout", world="office", time_limit=20.0, distance=(2.0, 5.0)),
        np.random.default_rng(0),
    )
    mean, spread = np.zeros(5), np.ones(5)
    for number in range(generations):
        tried = mean + spread * random.standard_normal((POPULATION, 5))
        scores = [score(env, policy, 0) for policy in tried]
        best = tried[np.argsort(scores)[-ELITE:]]
        mean, spread = best.mean(axis=0), best.std(axis=0) + 0.05
        print(f"generation {number + 1}: best {max(scores):.1f}, mean {np.mean(scores):.1f}", flush=True)
    learned = score(env, mean, 10_000)
    env.close()
    return learned


if __name__ == "__main__":
    print(f"return on new episodes: {main(*map(int, sys.argv[1:])):.1f}")
