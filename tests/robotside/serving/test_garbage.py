from __future__ import annotations

import contextlib
import gc
import subprocess
import sys
from collections.abc import Iterator

import pytest

from robotside.serving.garbage import loading, set_aside

SERVES = """
import gc, sys
from robotside.serving.fleet_server import FleetServer

async def run(self, ready):
    print(gc.get_freeze_count(), len(gc.get_objects()))

FleetServer.run = run
from robotside.__main__ import main
sys.exit(main(["serve", "--port", "0", "--http-port", "0", "--state", sys.argv[1]]))
"""


class Ring:
    """Something that only the collector frees."""

    def __init__(self):
        self.itself = self


def test_what_there_is_is_looked_through_no_more_and_what_comes_later_is():
    kept = Ring()
    try:
        set_aside()
        later = Ring()
        looked_at = {id(each) for each in gc.get_objects()}
    finally:
        gc.unfreeze()
    assert id(kept) not in looked_at
    assert id(later) in looked_at


def test_garbage_that_a_start_leaves_is_freed_before():
    freed = []

    class Leaving(Ring):
        def __del__(self):
            freed.append(True)

    Leaving()
    try:
        set_aside()
    finally:
        gc.unfreeze()
    assert freed == [True]


@pytest.fixture
def collecting() -> Iterator[None]:
    """The collector works, whatever it did before."""
    before = gc.isenabled()
    gc.enable()
    yield
    gc.unfreeze()
    (gc.enable if before else gc.disable)()


@pytest.mark.usefixtures("collecting")
def test_while_libraries_are_loaded_nothing_is_collected_and_afterwards_they_are_looked_through_no_more():
    set_aside()
    with loading():
        rests = not gc.isenabled()
        loaded = Ring()
    works = gc.isenabled()
    later = Ring()
    looked_at = {id(each) for each in gc.get_objects()}
    assert rests
    assert works
    assert id(loaded) not in looked_at
    assert id(later) in looked_at


@pytest.mark.usefixtures("collecting")
def test_the_collector_works_again_when_all_loads_are_over_in_whatever_order():
    first, second = loading(), loading()
    first.__enter__()
    second.__enter__()
    first.__exit__(None, None, None)
    assert not gc.isenabled()
    second.__exit__(None, None, None)
    assert gc.isenabled()


@pytest.mark.usefixtures("collecting")
def test_a_load_that_fails_leaves_the_collector_as_it_was():
    with contextlib.suppress(ImportError), loading():
        raise ImportError
    assert gc.isenabled()
    gc.disable()
    with loading():
        pass
    assert not gc.isenabled()


def test_a_robot_side_that_begins_to_serve_has_set_aside_what_it_is_made_of(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", SERVES, str(tmp_path)], capture_output=True, text=True, timeout=120, check=True
    )
    aside, looked_at = map(int, done.stdout.split())
    assert aside > 20 * looked_at
