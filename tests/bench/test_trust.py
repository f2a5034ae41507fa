"""Servers with and without TLS answer the client that measures them."""

from __future__ import annotations

import asyncio

import pytest

from bench.bridge import made
from bench.support.traffic import ODOM
from bench.trust import answered, secured


@pytest.mark.parametrize("kind", ["ours", "bare"])
def test_both_ways_answer_with_every_message_and_not_to_who_pins_another_certificate(kind: str) -> None:
    with secured(kind) as servers:
        for server in servers.values():
            assert asyncio.run(answered(server.url)) > 0
            assert made(server, ODOM, 1, step=1) > 0
        with pytest.raises(RuntimeError, match="another certificate"):
            asyncio.run(answered(servers["tls"].url, pin="0" * 64))
