from __future__ import annotations

import math
import sqlite3
from contextlib import closing

import pytest

from app.maps import tile_store
from app.maps.tile_store import GAP_BYTES, LOOKED_PERIOD, RETRY_PERIOD, Stored, TileStore

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
    assert again.size == 7, "counted when it was opened"
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
    store.wait()
    assert store.size <= 5000
    store.put("a", (6, 0, 0), Stored(bytes(6000)), 99.0)
    assert store.get("a", (6, 0, 0), 99.0) is None, "one that is larger than all of it"


def test_tiles_that_a_server_does_not_have_take_room_and_make_room_too(store):
    for column in range(200):
        store.put("a", (9, column, 0), Stored(None, expires=9.0), float(column))
    with closing(sqlite3.connect(store.path)) as file:
        (rows,) = file.execute("SELECT COUNT(*) FROM tiles").fetchone()
    assert store.size == rows * GAP_BYTES
    assert rows <= 10_000 / GAP_BYTES
    assert store.get("a", (9, 199, 0), 199.0) is not None, "the newest are here"


def test_gaps_that_an_earlier_version_did_not_count_are_counted(store):
    store.put("a", (9, 0, 0), Stored(None), 1.0)
    store.close()
    with closing(sqlite3.connect(store.path)) as file, file:
        file.execute("UPDATE tiles SET size=0")
    again = TileStore(store.path, 10_000)
    assert math.isnan(again.size), "it is counted in a thread"
    again.wait()
    assert again.size == GAP_BYTES
    again.close()


def test_nobody_who_serves_fingers_waits_for_a_file_that_another_holds(store):
    """Each of these would wait for the lock for ever: that it comes back is the proof."""
    store.put("a", (5, 0, 0), Stored(KB), 1.0)
    with store._lock:
        store.set_limit(500)
        store.clear()
        assert store.size == 1000
    store.wait()
    assert store.size == 0


def test_a_newer_tile_takes_the_place_of_the_older_one(store):
    store.put("a", (5, 0, 0), Stored(KB), 1.0)
    store.put("a", (5, 0, 0), Stored(b"new"), 2.0)
    assert (store.get("a", (5, 0, 0), 2.0).data, store.size) == (b"new", 3)


def test_the_tiles_of_one_source_or_of_all_are_forgotten(store):
    for source in ("a", "b"):
        store.put(source, (5, 0, 0), Stored(KB), 1.0)
    store.clear("a")
    store.wait()
    assert (store.get("a", (5, 0, 0), 1.0), store.size) == (None, 1000)
    store.clear()
    store.wait()
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
    with closing(sqlite3.connect(store.path, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        for column in range(20):
            store.put("a", (6, column, 0), Stored(KB), 1.0)
        assert store.problem == "Tiles of maps cannot be kept: database is locked."
        assert caplog.text.count("locked") == 1, "said once"
        assert store.size == 1000, "what was not kept is not counted"
        other.execute("COMMIT")
    store.put("a", (6, 0, 0), Stored(KB), 1.0)
    assert store.problem == ""
    assert store.get("a", (5, 0, 0), 1.0).data == KB
    store.close()


def test_a_file_that_is_held_while_it_is_opened_is_not_deleted_and_is_tried_again(
    tmp_path, monkeypatch, caplog
):
    monkeypatch.setattr(tile_store, "BUSY_TIMEOUT", 0.0)
    now = [0.0]
    first = TileStore(tmp_path / "tiles.sqlite3", 10_000)
    first.put("a", (5, 0, 0), Stored(KB), 1.0)
    first.close()
    again = TileStore(first.path, 10_000, clock=lambda: now[0])
    with closing(sqlite3.connect(first.path, isolation_level=None)) as other:
        other.execute("PRAGMA locking_mode=EXCLUSIVE")
        other.execute("BEGIN EXCLUSIVE")
        assert again.get("a", (5, 0, 0), 1.0) is None
        assert "locked" in again.problem
        other.execute("COMMIT")
    assert again.get("a", (5, 0, 0), 1.0) is None, "not asked with each tile"
    now[0] = RETRY_PERIOD
    assert again.get("a", (5, 0, 0), 1.0).data == KB
    assert again.problem == ""
    again.close()


def test_a_disk_that_is_full_costs_nothing_of_what_is_kept(tmp_path, caplog):
    store = TileStore(tmp_path / "tiles.sqlite3", 10_000_000)
    store.put("a", (5, 0, 0), Stored(KB), 1.0)
    (pages,) = store._file.execute("PRAGMA page_count").fetchone()
    store._file.execute(f"PRAGMA max_page_count={pages + 2}")  # SQLite's own SQLITE_FULL
    for column in range(20):
        store.put("a", (6, column, 0), Stored(4 * KB), 1.0)
    assert store.problem == "Tiles of maps cannot be kept: database or disk is full."
    assert store.get("a", (5, 0, 0), 1.0).data == KB
    store.close()
