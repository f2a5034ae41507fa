"""The machine's noise is told from a loop of fixed length."""

from __future__ import annotations

import pytest

from bench.support.noise import WANTED, Noise


class Machine:
    """One that does a million rounds a second, `slow` times slower, with `taken` of the core taken by others."""

    slow = 1.0
    taken = 0.0

    def __init__(self) -> None:
        self.wall = self.cpu = 0.0
        self.rounds: list[int] = []

    def work(self, rounds: int) -> None:
        self.rounds.append(rounds)
        spent = rounds / 1e6 * self.slow
        self.cpu += spent
        self.wall += spent / (1 - self.taken)


def noise_of(machine):
    return Noise(now=lambda: machine.wall, cpu=lambda: machine.cpu, work=machine.work)


def test_the_loop_is_made_as_long_as_wanted_and_stays_so():
    machine = Machine()
    noise = noise_of(machine)
    noise.sample()
    noise.sample()
    assert machine.rounds[-1] == machine.rounds[-2]
    assert machine.rounds[-1] / 1e6 == pytest.approx(WANTED)


def test_a_slower_machine_shows_as_slowness():
    machine = Machine()
    noise = noise_of(machine)
    noise.sample()
    machine.slow = 2.5
    noise.sample()
    assert noise.slowness == pytest.approx([1.0, 2.5])
    assert noise.waiting == pytest.approx([0.0, 0.0], abs=1e-9)


def test_a_faster_run_later_rescales_the_earlier_ones():
    machine = Machine()
    machine.slow = 2.0
    noise = noise_of(machine)
    noise.sample()
    machine.slow = 1.0
    noise.sample()
    assert noise.slowness == pytest.approx([2.0, 1.0])


def test_a_core_taken_by_others_shows_as_waiting():
    machine = Machine()
    noise = noise_of(machine)
    noise.sample()
    machine.taken = 0.75
    noise.sample()
    assert noise.waiting == pytest.approx([0.0, 0.75])
    assert noise.slowness == pytest.approx([1.0, 4.0])
