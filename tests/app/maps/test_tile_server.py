from __future__ import annotations

import logging
import threading
import traceback
from datetime import UTC, datetime

import pytest

from app.maps.tile_address import TileAddress
from app.maps.tile_server import LEAST_LIFE, MAX_TILE_BYTES, USUAL_LIFE, NoAnswer, TileServer
from tests.app.maps.faulty import FaultyServer, key

SECRET = "geheim"
NOW = datetime(2026, 11, 23, 12, tzinfo=UTC).timestamp()


@pytest.fixture
def town():
    with FaultyServer() as server:
        yield server
        server.may.set()


@pytest.fixture
def server():
    made = TileServer(now=lambda: NOW)
    yield made
    made.close()


def test_a_tile_comes_with_its_pixels_and_what_is_to_be_kept(town, server):
    tile = server.fetch(TileAddress(town.url), key())
    assert (tile.picture.width, tile.picture.height) == (256, 256)
    assert tile.stored.data.startswith(b"\x89PNG")
    assert tile.stored.etag
    assert tile.stored.expires == NOW + USUAL_LIFE
    assert "Pilothouse" in town.headers[0]["User-Agent"]


def test_what_is_kept_is_asked_for_only_if_it_is_newer(town, server):
    first = server.fetch(TileAddress(town.url), key()).stored
    town.extra = {"Cache_Control": "public, max-age=86400"}
    again = server.fetch(TileAddress(town.url), key(), first)
    assert again.unchanged
    assert (again.stored.data, again.stored.expires) == (first.data, NOW + 86400)
    assert town.headers[1]["If-None-Match"] == first.etag


@pytest.mark.parametrize(
    ("header", "life"),
    [
        ({"Cache_Control": "max-age=1"}, LEAST_LIFE),
        ({"Cache_Control": "no-cache"}, LEAST_LIFE),
        ({"Cache_Control": "max-age=many"}, USUAL_LIFE),
        ({"Expires": "Tue, 24 Nov 2026 12:00:00 GMT"}, 86400.0),
        ({"Expires": "soon"}, USUAL_LIFE),
        ({"Cache_Control": "max-age=99999999999"}, 90 * 86400.0),
    ],
)
def test_a_tile_is_good_for_as_long_as_the_server_says_within_reason(town, server, header, life):
    town.extra = header
    assert server.fetch(TileAddress(town.url), key()).stored.expires == NOW + life


def test_that_there_is_no_such_tile_is_an_answer(town, server):
    town.fault = "none"
    tile = server.fetch(TileAddress(town.url), key())
    assert (tile.picture, tile.stored.data, tile.stored.expires) == (None, None, NOW + USUAL_LIFE)


@pytest.mark.parametrize(
    ("fault", "sentence", "pause"),
    [
        ("html", r"127\.0\.0\.1 sends what is no picture \(text/html\)", 0),
        ("cut", r"sends what is no picture \(image/png\)", 0),
        ("short", "breaks off in the middle", 0),
        ("huge", f"sends tiles of more than {MAX_TILE_BYTES // 10**6} MB", 0),
        ("loop", "sends one from address to address without end", 0),
        ("busy", r"asks to be left alone for a while \(429\)", 77),
        ("refuses", r"refuses \(403\): its key or its terms", 300),
        ("broken", r"has a fault \(500\)", 0),
    ],
)
def test_what_is_no_tile_is_one_sentence_without_the_key(town, server, fault, sentence, pause, caplog):
    town.fault = fault
    caplog.set_level(logging.DEBUG)
    with pytest.raises(NoAnswer, match=sentence) as none:
        server.fetch(TileAddress(town.url + "?key={key}", key=SECRET), key())
    assert none.value.pause == pause
    assert SECRET not in str(none.value) + caplog.text
    told = traceback.format_exception(none.value)
    assert not any(SECRET in line for line in told), "what lies behind it holds the address"


def test_a_server_that_is_gone_is_one_sentence_without_the_key(server, caplog):
    with FaultyServer() as town:
        address = TileAddress(town.url + "?key={key}", key=SECRET)
    caplog.set_level(logging.DEBUG)
    with pytest.raises(NoAnswer, match="does not answer"):
        server.fetch(address, key())
    assert SECRET not in caplog.text


def test_a_server_that_sends_a_byte_at_a_time_is_too_slow():
    ticks = iter(range(0, 10_000, 5))
    server = TileServer(clock=lambda: float(next(ticks)))
    with FaultyServer() as town:
        town.fault = "drips"
        with pytest.raises(NoAnswer, match="is too slow"):
            server.fetch(TileAddress(town.url), key())
        town.may.set()
    server.close()


def test_closing_ends_a_connection_that_waits_for_an_answer(town, server):
    town.fault = "hangs"
    said = []

    def ask() -> None:
        try:
            server.fetch(TileAddress(town.url), key())
        except NoAnswer as none:
            said.append(str(none))

    thread = threading.Thread(target=ask)
    thread.start()
    assert town.begun.wait(60)
    server.close()
    thread.join()
    assert len(said) == 1
    with pytest.raises(NoAnswer, match="closed"):
        server.fetch(TileAddress(town.url), key())
