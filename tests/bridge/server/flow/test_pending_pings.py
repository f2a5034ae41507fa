"""Pings that wait for their answer."""

from __future__ import annotations

import pytest

from bridge.server.flow.pending_pings import MAX_PINGS, PendingPings


def test_a_pong_answers_its_ping_and_those_before():
    pings: PendingPings[str] = PendingPings()
    pings.send(1.0, "a")
    second = pings.send(2.0, "b")
    third = pings.send(3.0, "c")
    assert (len(pings), pings.oldest) == (3, 1.0)
    answered = pings.on_pong(second)
    assert answered is not None
    assert (answered.sent, answered.note) == (2.0, "b")
    assert (len(pings), pings.oldest) == (1, 3.0)
    assert pings.on_pong(second) is None
    assert pings.on_pong(third) is not None
    assert not pings


@pytest.mark.parametrize(
    "content", [b"", b"rtt", b"\0" * 8, b"\xff" * 11, b"rtt" + b"\xff" * 8, b"rt" + b"\0" * 9]
)
def test_a_pong_to_a_ping_of_another_purpose_answers_none(content):
    pings: PendingPings[None] = PendingPings(b"rtt")
    sent = pings.send(0.0, None)
    assert pings.on_pong(content) is None
    assert sent.startswith(b"rtt")
    assert pings.on_pong(sent) is not None


def test_there_is_an_end_to_unanswered_pings():
    pings: PendingPings[None] = PendingPings()
    contents = [pings.send(float(number), None) for number in range(MAX_PINGS)]
    assert pings.is_full
    pings.on_pong(contents[0])
    assert not pings.is_full
