"""Contents in blocks: bounded, in order, each block of the same content."""

from __future__ import annotations

from typing import Any

import pytest
from aiocoap import Message
from aiocoap.numbers.codes import Code

from robotside.gateways.coap import blocks
from robotside.gateways.coap.blocks import (
    BODY_TIMEOUT,
    MAX_BODIES,
    MAX_UPLOADS,
    UPLOAD_TIMEOUT,
    BlocksIn,
    BlocksOut,
)
from robotside.gateways.coap.requests import JSON, MAX_BLOCK, Body, Failure


def block1(payload: bytes, number: int, *, more: bool, exponent: int = 6) -> Any:
    return Message(code=Code.POST, payload=payload, block1=(number, more, exponent))


def block2(number: int, exponent: int = 6) -> Any:
    return Message(code=Code.GET, block2=(number, False, exponent))


def refused(taken: BlocksIn, message: Any, now: float = 0.0, key: object = "k") -> Code:
    with pytest.raises(Failure) as failure:
        taken.take(message, key, now)
    return failure.value.code


def test_a_content_comes_in_blocks_one_after_the_other() -> None:
    taken = BlocksIn()
    assert refused(taken, block1(b"a" * 1024, 0, more=True)) == Code.CONTINUE
    assert refused(taken, block1(b"b" * 1024, 1, more=True)) == Code.CONTINUE
    assert taken.take(block1(b"c", 2, more=False), "k", 0.0) == b"a" * 1024 + b"b" * 1024 + b"c"
    assert refused(taken, block1(b"c", 2, more=False)) == Code.REQUEST_ENTITY_INCOMPLETE
    assert taken.take(Message(code=Code.POST, payload=b"x" * MAX_BLOCK), "k", 0.0) == b"x" * MAX_BLOCK


def test_a_block_that_does_not_follow_is_refused() -> None:
    taken = BlocksIn()
    refused(taken, block1(b"a" * 1024, 0, more=True))
    assert refused(taken, block1(b"a" * 1024, 2, more=True)) == Code.REQUEST_ENTITY_INCOMPLETE
    refused(taken, block1(b"a" * 1024, 0, more=True))
    assert refused(taken, block1(b"a" * 1024, 1, more=True), key="other") == Code.REQUEST_ENTITY_INCOMPLETE
    late = UPLOAD_TIMEOUT + 1
    assert refused(taken, block1(b"a" * 1024, 1, more=True), late) == Code.REQUEST_ENTITY_INCOMPLETE


def test_a_block_of_another_size_than_it_says_is_refused() -> None:
    taken = BlocksIn()
    assert refused(taken, block1(b"a" * 1025, 0, more=False)) == Code.BAD_REQUEST
    assert refused(taken, block1(b"a" * 100, 0, more=True)) == Code.BAD_REQUEST


def test_what_is_sent_in_blocks_is_bounded() -> None:
    taken = BlocksIn()
    for number in range(64):
        assert refused(taken, block1(b"a" * 1024, number, more=True)) == Code.CONTINUE
    assert refused(taken, block1(b"a", 64, more=False)) == Code.REQUEST_ENTITY_TOO_LARGE
    for key in range(100):
        refused(taken, block1(b"a" * 1024, 0, more=True), key=key)
    assert len(taken._uploads) == MAX_UPLOADS


def test_all_blocks_are_of_the_content_that_was_begun_with() -> None:
    made, body = BlocksOut(), Body(bytes(range(256)) * 10, JSON)
    first = made.answer(block2(0), "k", body, 0.0)
    assert tuple(first.opt.block2) == (0, True, 6)
    parts = [first.payload]
    for number in (1, 2):
        kept = made.kept(block2(number), "k", 1.0)
        assert kept == body
        answer = made.answer(block2(number), "k", kept, 1.0)
        assert answer.opt.etag == first.opt.etag
        parts.append(answer.payload)
    assert b"".join(parts) == body.payload
    assert not answer.opt.block2.more
    assert made.kept(block2(1), "other", 1.0) is None
    assert made.kept(block2(0), "k", 1.0) is None
    assert made.kept(block2(1), "k", 2.0 + BODY_TIMEOUT) is None
    with pytest.raises(Failure, match="no block 3"):
        made.answer(block2(3), "k", body, 1.0)


def test_a_client_may_ask_for_small_blocks() -> None:
    made, body = BlocksOut(), Body(b"0123456789abcdef" * 3, JSON)
    answer = made.answer(block2(1, 0), "k", body, 0.0)
    assert (answer.payload, tuple(answer.opt.block2)) == (b"0123456789abcdef", (1, True, 0))
    whole = made.answer(Message(code=Code.GET), "k", body, 0.0)
    assert (whole.payload, whole.opt.block2) == (body.payload, None)


def test_what_is_kept_for_readers_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    made = BlocksOut()
    for key in range(100):
        made.answer(block2(0), key, Body(b"x" * 2000, JSON), 0.0)
    assert len(made._bodies) == MAX_BODIES
    monkeypatch.setattr(blocks, "MAX_BODY_BYTES", 5000)
    made.answer(block2(0), "k", Body(b"x" * 2000, JSON), 0.0)
    assert len(made._bodies) == 2
