"""Messages of the plain WebSocket: what they ask for, and what asks for STOP."""

from __future__ import annotations

from robotside.gateways.websocket.requests import any_id, bare_word, says_stop
from tests.looped import looped

NO_STOP = (
    b"stopped",
    b"stop it",
    b'{"call": "/stop/hold"}',
    b'{"subscribe": "/stop"}',
    b'{"call": "/places/set", "request": {"place": {"name": "stop"}}}',
    rb'{"call": "/places/set", "request": {"place": {"name": "\"call\": \"/stop\""}}}',
    b"",
)


@looped("raw", NO_STOP)
def test_what_only_looks_like_stop_is_none(raw: bytes) -> None:
    assert not says_stop(raw)


@looped(
    ("raw", "word"),
    (
        (b"home", "home"),
        (b"  second box\r\n", "second box"),
        (b"pick-up_2", "pick-up_2"),
        (b"7up", ""),
        (b'{"call": 1}', ""),
        ("größer".encode(), ""),
        (b"x" * 41, ""),
        (b"x" * 40, "x" * 40),
    ),
)
def test_a_bare_word_is_letters_digits_and_blanks_of_bounded_length(raw: bytes, word: str) -> None:
    assert bare_word(raw) == word


@looped(
    ("raw", "id"), ((b'{"id": 7, "x": 1}', 7), (b'{"id": "a"}', "a"), (b'{"id": [1]}', None), (b"{", None))
)
def test_the_id_of_a_wrong_message_is_found_where_there_is_one(raw: bytes, id: object) -> None:
    assert any_id(raw) == id
    assert any_id(b'{"id": "' + b"x" * 65 + b'"}') is None
