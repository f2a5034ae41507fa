"""Decoders are made one at a time."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import Any

import msgspec

from bridge.codec.decoders import decoder_of

TOGETHER = threading.Barrier(2)
MOMENT = 0.2
"""For the second thread to come, which it must not [s]."""
met: list[bool] = []


class Meeting:
    """What an annotation evaluates; waits for another thread that evaluates it as well."""

    @property
    def kind(self) -> Any:
        met.append(False)
        with suppress(threading.BrokenBarrierError):
            TOGETHER.wait(MOMENT)
            met[-1] = True
        return float


meeting = Meeting()


class Slow(msgspec.Struct):
    x: meeting.kind  # type: ignore[name-defined]


def test_two_threads_do_not_read_one_class_at_the_same_time():
    with ThreadPoolExecutor(2) as threads:
        made = list(threads.map(decoder_of, [Slow, Slow]))
    assert [each.decode(b'{"x":1}').x for each in made] == [1.0, 1.0]
    assert met
    assert not any(met)
