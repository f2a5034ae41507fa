"""The judge of pictures on links of all kinds, in virtual time."""

from __future__ import annotations

import heapq
from itertools import pairwise
from statistics import quantiles

import pytest

from bridge.server.flow.picture_quality import COARSEST, MAX_PAUSE, PictureQuality

SIZES = (25_000, 13_500, 6_200, 2_600)
FRAME_PERIOD = 1 / 15


class Link:
    """A link of `rate` [byte/s] and `way` [s] there and back, fed by a camera through the judge or without one."""

    def __init__(self, rate: float, way: float = 0.02, judge: PictureQuality | None = None) -> None:
        self.rate, self.way, self.judge = rate, way, judge or PictureQuality()
        self.now = 0.0
        self.stalled_until = 0.0
        self.busy = 0.0
        """For so long out of each second the watcher does something else and acknowledges nothing [s]."""
        self.free = 0.0
        self.ages: list[tuple[float, float]] = []
        self.levels: list[int] = []
        self._acks: list[tuple[float, int, float]] = []
        self._newest: tuple[int, float] | None = None
        self._seq = 0

    def run(self, seconds: float) -> Link:
        end = self.now + seconds
        while self.now < end:
            self._seq += 1
            self._newest = self._seq, self.now
            self._until(self.now + FRAME_PERIOD)
        return self

    def _until(self, end: float) -> None:
        while True:
            self._send()
            delay = self.judge.delay(self.now) if self._newest else None
            due = [end] if delay is None else [end, self.now + max(delay, 1e-6)]
            if self._acks:
                due.append(self._acks[0][0])
            self.now = min(due)
            while self._acks and self._acks[0][0] <= self.now:
                _, seq, taken = heapq.heappop(self._acks)
                self.ages.append((self.now, self.now - taken - self.way / 2))
                assert self.judge.on_ack(seq, self.now)
            if self.now >= end:
                return

    def _send(self) -> None:
        if self._newest is None or self.judge.delay(self.now) != 0.0:
            return
        (seq, taken), self._newest = self._newest, None
        level = self.judge.level
        self.levels.append(level)
        self.judge.on_sent(seq, SIZES[level], level, self.now)
        self.free = max(self.now, self.free, self.stalled_until) + SIZES[level] / self.rate
        heard = self.free + self.way
        distracted = max(0.0, self.busy - heard % 1.0)
        heapq.heappush(self._acks, (heard + distracted, seq, taken))

    def late(self, seconds: float) -> list[float]:
        """How old the pictures of the last `seconds` were when they came [s]."""
        return [age for at, age in self.ages if at > self.now - seconds]

    def p95(self, seconds: float) -> float:
        return quantiles(self.late(seconds), n=20)[-1]


def test_ten_megabits_carry_every_picture_as_it_was_taken():
    link = Link(10e6 / 8).run(10)
    assert set(link.levels) == {0}
    assert len(link.late(5)) == pytest.approx(75, abs=1)
    assert link.p95(5) < 0.05


def test_one_megabit_carries_smaller_pictures_at_the_cameras_rate_and_young():
    link = Link(1e6 / 8).run(60)
    assert set(link.levels[150:]) <= {1, 2, 3}
    assert len(link.late(20)) > 20 * 9
    assert link.p95(20) < 0.2


def test_a_watcher_who_is_busy_now_and_then_keeps_the_best_pictures():
    link = Link(10e6 / 8)
    link.busy = 0.2
    link.run(30)
    assert set(link.levels) == {0}


def test_a_watcher_who_is_busy_now_and_then_gets_the_best_pictures_back():
    link = Link(0.5e6 / 8).run(10)
    assert link.levels[-1] >= 2
    link.rate, link.busy = 10e6 / 8, 0.2
    link.run(70)
    assert link.levels[-1] == 0


def test_one_picture_that_takes_far_too_long_is_enough():
    link = Link(10e6 / 8).run(10)
    link.rate = 0.3e6 / 8
    link.run(1.0)
    assert link.levels[-1] >= 1


def test_without_a_judge_the_same_link_shows_old_pictures():
    class Blind(PictureQuality):
        def _judge(self, *_):
            pass

    assert Link(1e6 / 8, judge=Blind()).run(60).p95(20) > 0.35


def test_the_level_does_not_swing_on_a_link_that_does_not_change():
    link = Link(1e6 / 8).run(300)
    late = link.levels[-600:]
    assert sum(a != b for a, b in pairwise(late)) <= 4


def test_a_link_too_slow_for_anything_shows_the_coarsest_pictures_seldom_and_none_wait():
    link = Link(64e3 / 8).run(120)
    assert set(link.levels[60:]) <= {COARSEST - 1, COARSEST}
    assert link.p95(60) < 1.5
    assert link.judge.pause <= MAX_PAUSE


def test_a_long_way_is_no_slow_link():
    link = Link(20e6 / 8, way=0.6).run(60)
    assert set(link.levels[-100:]) == {0}
    assert len(link.late(5)) > 5 * 10
    assert link.p95(5) < 0.45


def test_while_nothing_is_acknowledged_two_pictures_are_under_way_and_then_none():
    judge = PictureQuality()
    judge.on_sent(1, 25_000, 0, 0.0)
    assert judge.delay(0.0) == 0.0
    judge.on_sent(2, 25_000, 0, 0.0)
    assert judge.delay(1000.0) is None
    assert judge.on_ack(2, 1000.0)
    assert judge.delay(1000.0) == 0.0
    judge.on_sent(3, 25_000, 1, 1000.0)
    assert judge.delay(1000.0) == MAX_PAUSE


def test_after_a_stall_the_newest_picture_comes_first_and_soon_all_is_as_before():
    link = Link(10e6 / 8).run(10)
    link.stalled_until = link.now + 5.0
    link.run(5.0)
    link.ages.clear()
    link.run(1.0)
    assert sum(age > 0.2 for _, age in link.ages) <= 2
    link.run(20.0)
    assert link.levels[-1] == 0
    assert len(link.late(5)) == pytest.approx(75, abs=1)


def test_a_link_that_gets_worse_and_better_again_is_followed_both_ways():
    link = Link(10e6 / 8).run(10)
    link.rate = 0.5e6 / 8
    link.run(20)
    assert link.levels[-1] >= 2
    assert link.p95(10) < 0.35
    link.rate = 10e6 / 8
    link.run(70)
    assert link.levels[-1] == 0


def test_each_failure_of_a_finer_level_doubles_the_patience_before_the_next():
    link = Link(1e6 / 8).run(300)
    climbs = [n for n, (a, b) in enumerate(pairwise(link.levels)) if b < a]
    assert len(climbs) < 14


@pytest.mark.parametrize("seq", [7, -1])
def test_what_is_not_under_way_is_not_acknowledged(seq):
    judge = PictureQuality()
    judge.on_sent(1, 10, 0, 0.0)
    assert not judge.on_ack(seq, 9.0)
    assert (judge.level, judge.delay(0.0)) == (0, 0.0)
