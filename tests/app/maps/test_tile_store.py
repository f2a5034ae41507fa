from __future__ import annotations

import sqlite3

import pytest

from app.maps import tile_store
from app.maps.tile_store import LOOKED_PERIOD, Stored, TileStore

KB = bytes(1000)


@pytest.fixture
def store(tmp_path):
    made = TileStore(tmp_path / "maps" / "tiles.sqlite3", 10_000)
    yield made
    made.close()


def test_what_is_kept_is_found_again_after_a_restart(store):
    kept = Stored(b"picture", '"tag"', "Mon, 23 Nov 2026 10:00:00 GMT", 500.0)
    store.put("a", (3, 1, 2), kept, 100.0)
    store.close()
    again = TileStore(store.path, 10_000)
    assert again.get("a", (3, 1, 2), 100.0) == kept
    assert again.get("b", (3, 1, 2), 100.0) is None, "another source has tiles of its own"
    assert again.size == 7
    again.close()


def test_that_a_server_has_no_such_tile_is_kept_too(store):
    store.put("a", (3, 1, 2), Stored(None, expires=9.0), 1.0)
    assert store.get("a", (3, 1, 2), 1.0) == Stored(None, expires=9.0)


def test_what_was_not_looked_at_for_longest_makes_room(store):
    for column in range(10):
        store.put("a", (5, column, 0), Stored(KB), float(column))
    store.get("a", (5, 0, 0), 2 * LOOKED_PERIOD)
    store.put("a", (5, 10, 0), Stored(KB), 2 * LOOKED_PERIOD)
    left = {column for column in range(11) if store.get("a", (5, column, 0), 2 * LOOKED_PERIOD)}
    assert left == {0, 3, 4, 5, 6, 7, 8, 9, 10}
    assert store.size == 9000


def test_a_smaller_limit_holds_at_once(store):
    for column in range(10):
        store.put("a", (5, column, 0), Stored(KB), float(column))
    store.set_limit(5000)
    assert store.size <= 5000
    store.put("a", (6, 0, 0), Stored(bytes(6000)), 99.0)
    assert store.get("a", (6, 0, 0), 99.0) is None, "one that is larger than all of it"


def test_a_newer_tile_takes_the_place_of_the_older_one(store):
    store.put("a", (5, 0, 0), Stored(KB), 1.0)
    store.put("a", (5, 0, 0), Stored(b"new"), 2.0)
    assert (store.get("a", (5, 0, 0), 2.0).data, store.size) == (b"new", 3)


def test_the_tiles_of_one_source_or_of_all_are_forgotten(store):
    for source in ("a", "b"):
        store.put(source, (5, 0, 0), Stored(KB), 1.0)
    store.clear("a")
    assert (store.get("a", (5, 0, 0), 1.0), store.size) == (None, 1000)
    store.clear()
    assert (store.get("b", (5, 0, 0), 1.0), store.size) == (None, 0)


def test_a_damaged_file_is_begun_anew(store, caplog):
    store.put("a", (5, 0, 0), Stored(KB), 1.0)
    store.close()
    store.path.write_bytes(b"no database at all" * 100)
    again = TileStore(store.path, 10_000)
    assert again.get("a", (5, 0, 0), 1.0) is None
    again.put("a", (5, 0, 0), Stored(KB), 1.0)
    assert again.get("a", (5, 0, 0), 1.0).data == KB
    assert again.problem == ""
    again.close()


def test_where_nothing_can_be_kept_it_is_said_and_nothing_fails(tmp_path, caplog):
    (tmp_path / "maps").write_text("a file where the folder should be")
    store = TileStore(tmp_path / "maps" / "tiles.sqlite3", 10_000)
    store.put("a", (5, 0, 0), Stored(KB), 1.0)
    assert store.get("a", (5, 0, 0), 1.0) is None
    assert "Tiles of maps cannot be kept" in store.problem
    store.close()


def test_what_comes_after_the_end_is_neither_kept_nor_found(store):
    store.put("a", (5, 0, 0), Stored(KB), 1.0)
    store.close()
    store.put("a", (5, 1, 0), Stored(KB), 1.0)
    assert store.get("a", (5, 0, 0), 1.0) is None


def test_a_file_that_another_program_holds_keeps_what_it_has(tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(tile_store, "BUSY_TIMEOUT", 0.0)
    store = TileStore(tmp_path / "tiles.sqlite3", 10_000)
    store.put("a", (5, 0, 0), Stored(KB), 1.0)
    other = sqlite3.connect(store.path, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    store.put("a", (6, 0, 0), Stored(KB), 1.0)
    assert "locked" in caplog.text
    other.execute("COMMIT")
    other.close()
    assert store.get("a", (5, 0, 0), 1.0).data == KB
    store.close()
