"""Servers with and without TLS answer the client that measures them."""

from __future__ import annotations

import asyncio

import pytest

from bench.bridge import made
from bench.support.traffic import ODOM
from bench.trust import answered, secured


@pytest.mark.parametrize("kind", ["ours", "bare"])
def test_both_ways_are_answered_and_every_message_of_a_row_arrives(kind: str) -> None:
    with secured(kind) as servers:
        for server in servers.values():
            assert asyncio.run(answered(server.url)) > 0
            assert made(server, ODOM, 1, step=1) > 0


def test_another_certificate_than_the_pinned_one_is_no_measurement() -> None:
    with secured("bare") as servers, pytest.raises(RuntimeError, match="another certificate"):
        asyncio.run(answered(servers["tls"].url, pin="0" * 64))
