from __future__ import annotations

import threading

import pytest
from kivy.core.image import ImageData

from app.maps.network_tiles import NetworkTiles
from app.maps.tile_address import TileAddress
from app.maps.tile_queue import FIRST_PAUSE
from app.maps.tile_server import MAX_CONNECTIONS, NoAnswer, Tile
from app.maps.tile_store import Stored
from widgets.map.tiles.tile_reader import MAX_AHEAD

A, B = (3, 1, 2), (3, 2, 2)
PATIENCE = 60.0
"""A fault, not a delay, uses this up [s]."""
ADDRESS = TileAddress("https://a.org/{z}/{x}/{y}.png")


def pixels(data: object) -> ImageData:
    if data == b"damaged":
        raise ValueError("no picture")
    return ImageData(1, 1, "rgb", bytes(data))


class Server:
    """Answers what the test says, when it says."""

    def __init__(self) -> None:
        self.asked: list[tuple[tuple[int, int, int], Stored | None]] = []
        self.answers: dict[tuple[int, int, int], Tile | NoAnswer] = {}
        self.may = threading.Event()
        self.may.set()
        self.at_work = self.most_at_work = 0
        self._change = threading.Condition()

    def fetch(self, address, tile, kept=None):
        with self._change:
            self.asked.append((tile, kept))
            self.at_work += 1
            self.most_at_work = max(self.most_at_work, self.at_work)
            self._change.notify_all()
        self.may.wait()
        with self._change:
            self.at_work -= 1
        answer = self.answers.get(tile) or Tile(Stored(b"new", expires=2000.0), pixels(b"new"))
        if isinstance(answer, NoAnswer):
            raise answer
        return answer

    def until_at_work(self, count):
        """Wait until so many are asked for at once."""
        with self._change:
            assert self._change.wait_for(lambda: self.at_work >= count, PATIENCE)


class Kept(dict):
    def get(self, tile, now=0.0):
        return super().get(tile)

    def put(self, tile, stored, now):
        self[tile] = stored


class Clock:
    now = 1000.0

    def __call__(self):
        return self.now


@pytest.fixture
def parts():
    before = threading.active_count()
    server, kept, clock = Server(), Kept(), Clock()
    tiles = NetworkTiles(ADDRESS, server, kept, now=clock, clock=clock, decode=pixels)
    yield tiles, server, kept, clock
    server.may.set()
    tiles.close()
    tiles.wait()
    assert threading.active_count() == before


def taken(tiles: NetworkTiles) -> dict[tuple[int, int, int], bytes | None]:
    found = {}
    while made := tiles.take():
        found[made[0]] = made[1] and made[1].data
    return found


def looked(tiles: NetworkTiles, *keys) -> dict[tuple[int, int, int], bytes | None]:
    """What there is after two looks of the map: one that finds what is kept, one that has the rest asked for."""
    found = {}
    for _ in range(2):
        tiles.want([key for key in keys if key not in found])
        tiles.wait()
        found |= taken(tiles)
    return found


def test_what_is_not_kept_is_fetched_kept_and_handed_over(parts):
    tiles, server, kept, _ = parts
    assert looked(tiles, A) == {A: b"new"}
    assert kept[A].data == b"new"
    assert looked(tiles, A) == {A: b"new"}
    assert len(server.asked) == 1, "the second time it was kept"


def test_what_is_old_is_shown_at_once_and_asked_for_again(parts):
    tiles, server, kept, _ = parts
    kept[A] = Stored(b"old", '"tag"', expires=10.0)
    assert looked(tiles, A) == {A: b"old"}
    assert server.asked == [(A, Stored(b"old", '"tag"', expires=10.0))]
    assert looked(tiles, A) == {A: b"new"}


def test_what_is_old_is_shown_while_the_server_is_gone_and_asked_for_when_it_is_looked_at_again(parts):
    tiles, server, kept, clock = parts
    kept[A] = Stored(b"old", expires=10.0)
    server.answers[A] = NoAnswer("gone")
    assert looked(tiles, A) == {A: b"old"}
    clock.now += 10
    server.answers.clear()
    assert looked(tiles, A) == {A: b"old"}
    assert looked(tiles, A) == {A: b"new"}


def test_that_a_server_has_no_such_tile_is_handed_over_and_kept(parts):
    tiles, server, _, _ = parts
    server.answers[A] = Tile(Stored(None, expires=2000.0), None)
    assert looked(tiles, A) == {A: None}
    assert looked(tiles, A) == {A: None}
    assert len(server.asked) == 1


def test_what_is_kept_damaged_is_fetched_anew_and_not_only_if_it_is_newer(parts):
    tiles, server, kept, _ = parts
    kept[A] = Stored(b"damaged", '"tag"', expires=2000.0)
    assert looked(tiles, A) == {A: b"new"}
    assert server.asked == [(A, None)]
    assert tiles.refused == 1


def test_a_tile_that_failed_comes_when_the_server_does_and_the_trouble_is_over_then(parts):
    tiles, server, _, clock = parts
    server.answers |= {A: NoAnswer("It does not answer."), B: NoAnswer("It does not answer.")}
    assert looked(tiles, A, B) == {}
    assert tiles.trouble == "It does not answer."
    server.answers.clear()
    assert looked(tiles, A, B) == {}, "the server rests"
    clock.now += 2 * FIRST_PAUSE
    assert looked(tiles, A, B) == {A: b"new", B: b"new"}
    assert tiles.trouble == ""


def test_one_bad_tile_among_good_ones_is_no_trouble(parts):
    tiles, server, _, _ = parts
    server.answers[A] = NoAnswer("It sends what is no picture.")
    assert looked(tiles, A, B) == {B: b"new"}
    assert tiles.trouble == ""


def test_a_server_that_asks_to_be_left_alone_is_trouble_at_once(parts):
    tiles, server, _, clock = parts
    server.answers[A] = NoAnswer("Leave me alone.", 77.0)
    looked(tiles, A)
    assert tiles.trouble == "Leave me alone."
    clock.now += 76
    looked(tiles, A, B)
    assert len(server.asked) == 1


def test_no_more_connections_than_are_polite(parts):
    tiles, server, _, _ = parts
    keys = [(5, column, 0) for column in range(12)]
    tiles.want(keys)
    tiles.wait()
    server.may.clear()
    tiles.want(keys)
    server.until_at_work(MAX_CONNECTIONS)
    tiles.want(keys)
    server.may.set()
    tiles.wait()
    assert server.most_at_work == MAX_CONNECTIONS


def test_no_more_tiles_are_decoded_ahead_than_memory_is_meant_for(parts):
    tiles, _server, kept, _ = parts
    keys = [(5, column, 0) for column in range(40)]
    looked(tiles, *keys[:1])
    kept.update({key: Stored(b"kept", expires=2000.0) for key in keys})
    tiles.want(keys)
    tiles.wait()
    assert len(taken(tiles)) == MAX_AHEAD


def test_tiles_that_go_out_of_sight_are_not_asked_for(parts):
    tiles, server, _, _ = parts
    keys = [(5, column, 0) for column in range(12)]
    tiles.want(keys)
    tiles.wait()
    server.may.clear()
    tiles.want(keys)
    server.until_at_work(MAX_CONNECTIONS)
    tiles.want([])
    server.may.set()
    tiles.wait()
    assert len(server.asked) == MAX_CONNECTIONS


def test_what_comes_after_the_end_is_not_handed_over(parts, monkeypatch):
    tiles, server, _, _ = parts
    tiles.want([A])
    tiles.wait()
    server.may.clear()
    tiles.want([A])
    server.until_at_work(1)
    dropped, drop = threading.Event(), tiles._queue.want
    monkeypatch.setattr(tiles._queue, "want", lambda keys: (drop(keys), dropped.set()))
    closing = threading.Thread(target=tiles.close)
    closing.start()
    assert dropped.wait(PATIENCE)
    server.may.set()
    closing.join()
    assert tiles.take() is None
    tiles.want([B])
    assert len(server.asked) == 1


def test_to_close_waits_for_no_server(parts):
    tiles, server, _, _ = parts
    tiles.want([A])
    tiles.wait()
    server.may.clear()
    tiles.want([A])
    server.until_at_work(1)
    tiles.close()
    assert server.at_work == 1, "it was waited for, and no finger was taken meanwhile"
