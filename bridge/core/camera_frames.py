"""Camera frames on a WebSocket of their own: a 24-byte header, then the JPEG file.

Header, big-endian: `PHF1`, sequence number (uint32), stamp (float64), width (uint32), height (uint32). The receiver
answers each with the text `ack SEQ`.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from bridge.core.errors import ProtocolError

__all__ = ["Frame", "pack", "sequence", "unpack"]

_HEADER = struct.Struct(">4sIdII")
_MAGIC = b"PHF1"


@dataclass(frozen=True, slots=True)
class Frame:
    """One picture of a camera."""

    seq: int
    """Sequence number, modulo 2**32; a gap means pictures that were left out."""
    stamp: float
    """Time of exposure [s], on the clock of `/rosapi/get_time`."""
    width: int
    """[pixel]"""
    height: int
    """[pixel]"""
    jpeg: bytes


def pack(seq: int, stamp: float, jpeg: bytes, width: int, height: int) -> bytes:
    """The bytes of a frame; `seq` is taken modulo 2**32."""
    return _HEADER.pack(_MAGIC, seq & 0xFFFFFFFF, stamp, width, height) + jpeg


def unpack(raw: bytes) -> Frame:
    """The frame in one binary message; ProtocolError for anything else."""
    _check(raw)
    _, seq, stamp, width, height = _HEADER.unpack_from(raw)
    return Frame(seq, stamp, width, height, raw[_HEADER.size :])


def sequence(raw: bytes) -> int:
    """The sequence number of a packed frame, without copying its picture."""
    _check(raw)
    return int(_HEADER.unpack_from(raw)[1])


def _check(raw: bytes) -> None:
    if len(raw) < _HEADER.size or raw[:4] != _MAGIC:
        raise ProtocolError(f"A camera frame must begin with {_MAGIC!r} and a header, not {raw[:8]!r}.")
