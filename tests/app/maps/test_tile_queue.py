from __future__ import annotations

import itertools

from app.maps.tile_queue import FIRST_PAUSE, GREATEST_PAUSE, TileQueue

A, B, C = (1, 0, 0), (1, 0, 1), (1, 1, 0)


def test_tiles_are_asked_for_in_order_and_once():
    queue = TileQueue()
    queue.want([A, B])
    assert [queue.next(0.0), queue.next(0.0), queue.next(0.0)] == [A, B, None]
    queue.want([A, B])
    assert queue.next(0.0) is None, "both are being asked for"


def test_one_bad_tile_lets_the_others_go_on_and_is_asked_for_again_later():
    queue = TileQueue()
    queue.want([A, B])
    assert queue.next(0.0) == A
    queue.failed(A, 0.0)
    queue.want([A, B])
    assert queue.next(0.0) == B
    queue.answered(B)
    queue.want([A])
    assert queue.next(FIRST_PAUSE - 0.1) is None
    assert queue.next(FIRST_PAUSE) == A
    assert not queue.troubled


def test_a_server_that_fails_again_rests_twice_as_long_each_time_and_not_for_ever():
    queue, now, rests = TileQueue(), 0.0, []
    for _ in range(12):
        queue.want([A, B, C])
        while (tile := queue.next(now)) is None:
            now += 0.5
        queue.failed(tile, now)
        rests.append(now)
    pauses = [later - earlier for earlier, later in itertools.pairwise(rests)]
    assert pauses[:4] == [0.0, 2.0, 4.0, 8.0]
    assert max(pauses) == GREATEST_PAUSE
    assert queue.troubled


def test_a_server_in_trouble_is_tried_by_one_tile_at_a_time():
    queue = TileQueue()
    queue.want([A, B, C])
    queue.next(0.0)
    queue.failed(A, 0.0)
    assert queue.next(0.0) == B
    assert queue.next(0.0) is None
    queue.answered(B)
    assert queue.next(0.0) == C


def test_a_server_that_asks_for_a_pause_has_it():
    queue = TileQueue()
    queue.want([A, B])
    queue.next(0.0)
    queue.failed(A, 0.0, pause=77.0)
    assert queue.next(76.9) is None
    assert queue.next(77.0) == B


def test_what_is_old_is_asked_for_once_and_after_what_is_missing():
    queue = TileQueue()
    queue.refresh(A)
    queue.refresh(A)
    queue.want([B])
    assert [queue.next(0.0), queue.next(0.0), queue.next(0.0)] == [B, A, None]


def test_another_try_is_made_at_once_when_one_asks_for_it():
    queue = TileQueue()
    queue.want([A, B])
    queue.next(0.0)
    queue.failed(A, 0.0, pause=500.0)
    queue.retry()
    queue.want([A])
    assert queue.next(1.0) == A
