"""Turns: however many requests come, so many begin in a step of the loop, one source after another; virtual steps, no time."""

from __future__ import annotations

import asyncio

import pytest

from bridge.core.codes import Code
from bridge.core.errors import Refused
from robotside.core.notice import Notice
from robotside.gateways.plain.turns import EACH_STEP, MAX_WAITING, Turns


class _Steps:
    """Counts the steps of the loop, and in which of them each request begins."""

    def __init__(self, turns: Turns) -> None:
        self.turns, self.now = turns, 0
        self.begun: list[tuple[int, str]] = []
        self.tasks: list[asyncio.Task[None]] = []
        self._count()

    def _count(self) -> None:
        self.now += 1
        self._next = asyncio.get_running_loop().call_soon(self._count)

    def come(self, source: str, count: int = 1) -> None:
        """So many requests come at once."""
        self.tasks += [asyncio.create_task(self._ask(source)) for _ in range(count)]

    async def _ask(self, source: str) -> None:
        await self.turns.take(source)
        self.begun.append((self.now, source))

    async def until_all_began(self) -> None:
        await asyncio.gather(*self.tasks)
        self._next.cancel()

    def most(self) -> int:
        """Requests that began in one step, at most."""
        steps = [step for step, _ in self.begun]
        return max(map(steps.count, steps))


@pytest.fixture
async def steps() -> _Steps:
    return _Steps(Turns())


async def test_who_comes_alone_begins_at_once(steps: _Steps) -> None:
    for _ in range(3):
        work = steps.turns.take("a")
        with pytest.raises(StopIteration):
            work.send(None)  # it waits for nothing
        await asyncio.sleep(0)
        await asyncio.sleep(0)
    await steps.until_all_began()


async def test_of_many_that_come_at_once_few_begin_in_a_step(steps: _Steps) -> None:
    steps.come("a", 100)
    await steps.until_all_began()
    assert len(steps.begun) == 100
    assert steps.most() == EACH_STEP
    assert steps.begun[-1][0] - steps.begun[0][0] <= 100 / EACH_STEP + 2  # and none is kept waiting longer


async def test_of_many_that_keep_coming_few_begin_in_a_step(steps: _Steps) -> None:
    for number in range(60):
        steps.come("abc"[number % 3], number % 4)
        await asyncio.sleep(0)
    await steps.until_all_began()
    assert len(steps.begun) == sum(number % 4 for number in range(60))
    assert steps.most() == EACH_STEP


@pytest.mark.parametrize("order", [("flood", "other"), ("other", "flood")])
async def test_the_flood_of_one_source_does_not_hold_up_another(
    steps: _Steps, order: tuple[str, str]
) -> None:
    for source in order:
        steps.come(source, {"flood": 100, "other": 3}[source])
        await asyncio.sleep(0)
    await steps.until_all_began()
    places = [place for place, (_, source) in enumerate(steps.begun) if source == "other"]
    assert places[-1] < 10


async def test_those_of_one_source_begin_in_the_order_in_which_they_came(steps: _Steps) -> None:
    order: list[int] = []

    async def ask(number: int) -> None:
        await steps.turns.take("a")
        order.append(number)

    await asyncio.gather(*(ask(number) for number in range(20)))
    assert order == list(range(20))
    await steps.until_all_began()


async def test_more_than_may_wait_are_refused_at_once_with_a_code(steps: _Steps) -> None:
    steps.come("a", MAX_WAITING + EACH_STEP)
    await asyncio.sleep(0)
    with pytest.raises(Refused) as refused:
        await steps.turns.take("b")
    said = refused.value.args[0]
    assert isinstance(said, Notice)
    assert (said.code, said.parameters) == (Code.GATEWAY_BUSY, {"max": str(MAX_WAITING)})
    await steps.until_all_began()
    await steps.turns.take("b")  # there is room again


async def test_who_gives_up_is_waited_for_by_nobody(steps: _Steps) -> None:
    steps.come("a", 10)
    steps.come("gone", 200)
    steps.come("a", 10)
    await asyncio.sleep(0)
    gone = [task for number, task in enumerate(steps.tasks) if 10 <= number < 210]
    for task in gone:
        task.cancel()
    await asyncio.gather(*steps.tasks, return_exceptions=True)
    steps._next.cancel()
    assert [source for _, source in steps.begun] == ["a"] * 20
    assert steps.begun[-1][0] - steps.begun[0][0] <= 20 / EACH_STEP + 4
    assert steps.turns._waiting == 0
    assert not steps.turns._lines


async def test_when_nobody_waits_nothing_is_left_to_do(steps: _Steps) -> None:
    steps.come("a", 5)
    await steps.until_all_began()
    for _ in range(3):
        await asyncio.sleep(0)
    assert not steps.turns._steps
