"""The network thread: what runs in it ends with it, and after its end nothing is begun."""

from __future__ import annotations

import asyncio
import concurrent.futures
from typing import Any

import pytest

from bridge.core.errors import NotConnected
from bridge.core.network_thread import NetworkThread


async def tell(value: Any) -> Any:
    return value


def test_a_coroutine_runs_in_the_thread_and_gives_its_result() -> None:
    thread = NetworkThread()

    async def where() -> bool:
        return thread.inside

    assert thread.start(where()).result(5) is True
    assert not thread.inside
    thread.close()


def test_what_runs_is_cancelled_at_the_end() -> None:
    thread = NetworkThread()
    running = thread.start(asyncio.Event().wait())
    thread.close()
    assert not thread._thread.is_alive()
    with pytest.raises(concurrent.futures.CancelledError):
        running.result(5)


def test_after_its_end_nothing_is_begun_and_ending_again_does_nothing() -> None:
    thread = NetworkThread()
    thread.close()
    thread.close()
    thread.call(pytest.fail, "called after the end")
    with pytest.raises(NotConnected, match="closed"):
        thread.start(tell(1))
