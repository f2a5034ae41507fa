"""Heads of CBOR values (RFC 8949), checked before decoding: the number of values, and their tags."""

from __future__ import annotations

from bridge.core.errors import ProtocolError

__all__ = ["check_cbor"]

_BYTES, _TEXT, _TAG = 2, 3, 6
_FOLLOWING = {24: 1, 25: 2, 26: 4, 27: 8}
"""Number of bytes that follow the first byte of a value, by its low bits."""
_ARRAYS = range(64, 88)
"""Tags of number arrays (RFC 8746)."""


def check_cbor(raw: bytes, most: int) -> None:
    """ProtocolError when a CBOR text holds more than `most` values, a number array counted as one, or tags other than
    those of arrays.

    Other tags make dates, patterns, fractions and cycles of a few bytes, whose making can take any time. Whether the
    text is CBOR at all is left to the decoder.
    """
    place, left = 0, most
    while place < len(raw):
        left -= 1
        if left < 0:
            raise ProtocolError(f"A binary frame may hold at most {most} values outside number arrays.")
        first = raw[place]
        kind, number = first >> 5, first & 31
        place += 1
        if following := _FOLLOWING.get(number, 0):
            number = int.from_bytes(raw[place : place + following], "big")
            place += following
        elif number == 31:
            number = 0
        if kind in (_BYTES, _TEXT):
            place += number
        elif kind == _TAG and number not in _ARRAYS:
            raise ProtocolError(
                f"A binary frame may hold no CBOR tags but those of number arrays, not {number}."
            )
