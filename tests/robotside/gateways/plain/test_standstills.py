"""Standstills of the loop: what came meanwhile is told from what came before and after."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import pytest

from robotside.gateways.plain.standstills import ROUNDS, STALL_PERIOD, STALL_TIMEOUT, Standstills

LONG = STALL_PERIOD + STALL_TIMEOUT + 0.01


class Clock:
    """Goes forward when the test says so."""

    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
async def watch(clock: Clock) -> AsyncIterator[Standstills]:
    made = Standstills(clock)
    made.start()
    yield made
    made.stop()


async def settle() -> None:
    for _ in range(ROUNDS + 1):
        await asyncio.sleep(0)


async def test_what_was_read_before_or_right_after_a_standstill_is_touched_by_it(
    watch: Standstills, clock: Clock
) -> None:
    before = clock.now
    clock.now += LONG
    assert watch.touches(before)
    assert watch.touches(clock.now)
    for _ in range(ROUNDS - 1):
        await asyncio.sleep(0)
        clock.now += 0.01
        assert watch.touches(clock.now)
    late = clock.now
    await settle()
    clock.now += 0.01
    assert not watch.touches(clock.now)
    assert watch.touches(late)
    assert watch.touches(before)


async def test_a_second_standstill_while_the_first_is_caught_up_with_lasts_as_long_again(
    watch: Standstills, clock: Clock
) -> None:
    clock.now += LONG
    assert watch.touches(clock.now)
    for _ in range(ROUNDS - 1):
        await asyncio.sleep(0)
    clock.now += LONG
    assert watch.touches(clock.now)
    for _ in range(ROUNDS - 1):
        await asyncio.sleep(0)
        assert watch.touches(clock.now)
    await settle()
    clock.now += 0.01
    assert not watch.touches(clock.now)


async def test_a_shorter_one_and_one_that_is_not_watched_touch_nothing(
    watch: Standstills, clock: Clock
) -> None:
    clock.now += STALL_TIMEOUT
    assert not watch.touches(clock.now)
    watch.stop()
    clock.now += LONG
    assert not watch.touches(clock.now)


async def test_the_loop_itself_is_watched_without_anybody_asking(
    clock: Clock, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.gateways.plain.standstills.STALL_PERIOD", 0.0)
    watch = Standstills(clock)
    watch.start()
    read = clock.now
    clock.now += LONG
    await asyncio.sleep(0.01)  # the timer looks, and later looks find nothing new
    clock.now += 0.01
    assert not watch.touches(clock.now)
    assert watch.touches(read)
    watch.stop()
