from __future__ import annotations

import threading

import numpy as np
import pytest

from widgets.map import grid_worker
from widgets.map.grid_cells import layout
from widgets.map.grid_worker import GridWorker


@pytest.fixture
def worker():
    made = GridWorker()
    yield made
    made.close()
    assert not any(thread.name == "map grid" for thread in threading.enumerate())


def cells(value=0, size=(20, 2100)):
    return np.full(size, value, np.int8)


def taken(worker):
    return list(iter(worker.take, None))


def test_all_pieces_of_a_grid_are_made_in_order(worker):
    worker.want(cells(100))
    worker.wait()
    found = taken(worker)
    assert [(one.column, one.row) for one in found] == [(one.column, one.row) for one in layout(2100, 20)]
    assert all((one.pixels == 255).all() for one in found)
    assert not worker.busy


def test_what_is_drawn_already_is_not_made_again(worker):
    worker.want(cells(100))
    worker.wait()
    first = taken(worker)
    changed = cells(100)
    changed[5, 2090] = 0
    worker.want(changed, {one.digest for one in first})
    worker.wait()
    second = taken(worker)
    assert [one.pixels is None for one in second] == [True] * (len(second) - 1) + [False]
    assert [one.digest for one in second[:-1]] == [one.digest for one in first[:-1]]


def test_of_two_grids_only_the_newer_is_taken(worker, monkeypatch):
    """The first is still at work when the second comes: nothing of it is left to be taken."""
    begun, go_on, real = threading.Event(), threading.Event(), grid_worker.piece

    def held(these, place, drawn):
        begun.set()
        go_on.wait()
        return real(these, place, drawn)

    monkeypatch.setattr(grid_worker, "piece", held)
    worker.want(cells(0))
    begun.wait()
    worker.want(cells(100))
    go_on.set()
    worker.wait()
    found = taken(worker)
    assert len(found) == len(layout(2100, 20))
    assert all((one.pixels == 255).all() for one in found)


def test_closed_it_has_nothing_to_take_and_its_thread_is_gone(worker):
    worker.want(cells())
    worker.close()
    assert worker.take() is None
    assert not worker.busy


def test_it_works_again_after_it_was_closed(worker):
    worker.close()
    worker.want(cells(size=(2, 2)))
    worker.wait()
    assert len(taken(worker)) == 1
