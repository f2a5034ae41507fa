"""Events that wake the loop, or are taken in its turn where it cannot be woken."""

from __future__ import annotations

from app.core.waking import wake_trigger, waking
from tests.headless import Stage


def test_what_was_triggered_is_called_once(stage: Stage) -> None:
    called: list[int] = []
    trigger = wake_trigger(lambda: called.append(1))
    stage.frames(3)
    assert called == []
    trigger()
    trigger()
    stage.frames(3)
    assert called == [1]


def test_an_interval_goes_on_until_it_is_cancelled(stage: Stage) -> None:
    called: list[int] = []
    event = waking(lambda: called.append(1), 1 / 32, interval=True)
    event()
    stage.frames(9)
    assert 3 <= len(called) <= 5
    event.cancel()
    before = len(called)
    stage.frames(9)
    assert len(called) == before
