"""The roll of a robot side: the HELLOs of all its robots in one document, for who cannot hear them on the network.

It is a list in JSON at `PATH` of the socket of every one of its robots.
"""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from bridge.core.errors import ProtocolError
from bridge.discovery.beacon import named
from bridge.discovery.hello import Hello, read_hello, write_hello

__all__ = ["MAX_ROBOTS", "MAX_ROLL", "PATH", "read_roll", "write_roll"]

PATH = "/robots"
MAX_ROBOTS = 32
"""So many robots of one robot side are taken in; those behind them are left out."""
MAX_ROLL = 65536
"""A longer document is no roll [byte]."""


def write_roll(hellos: Iterable[Hello]) -> bytes:
    """The roll of these robots."""
    return b"[" + b",".join(map(write_hello, hellos)) + b"]"


def read_roll(text: bytes, host: str) -> list[Hello]:
    """The robots on a roll that came from `host`, where all of them are reached whatever it says. ProtocolError for none."""
    if len(text) > MAX_ROLL:
        raise ProtocolError(f"A list of robots has at most {MAX_ROLL} bytes, not {len(text)}.")
    try:
        lines = msgspec.json.decode(text, type=list[msgspec.Raw])
    except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
        raise ProtocolError(f"This is no list of robots: {error}.") from error
    return [named(read_hello(bytes(line), "127.0.0.1"), host) for line in lines[:MAX_ROBOTS]]
