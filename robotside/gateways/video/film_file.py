"""Files of film that do not end: MP4 in fragments and WebM in clusters, of one picture each, so that none is held back.

The film is encoded once for all; each viewer gets a file of its own, whose time begins at zero with its first picture. A
library's writer holds a picture back until it knows the next one's time, and cannot begin a shared film anew for each viewer.
"""

from __future__ import annotations

import struct
from typing import Protocol

from robotside.gateways.video.video_encoder import TIME_SCALE, Encoded

__all__ = ["FilmFile", "Mp4File", "WebmFile"]


class FilmFile(Protocol):
    """The file of one viewer."""

    def add(self, picture: Encoded) -> bytes:
        """The next piece, with that picture; the first one must be complete."""


_FRAGMENT = struct.Struct(
    ">I4s"  # moof
    "I4sII"  # mfhd: flags, number
    "I4s"  # traf
    "I4sII"  # tfhd: flags, track
    "I4sIQ"  # tfdt: version, time
    "I4sIIiIII"  # trun: flags, count, where the data begin; duration, size, flags of the one picture
    "I4s"  # mdat
)
_TRUN, _TFDT, _TFHD, _MFHD = 32, 20, 16, 16
_TRAF = 8 + _TFHD + _TFDT + _TRUN
_MOOF = 8 + _MFHD + _TRAF
_KEY, _OTHER = 0x0200_0000, 0x0101_0000
_NOMINAL = TIME_SCALE // 30
"""How long a picture is said to last before the next one is known; its own time counts."""


class Mp4File:
    """ISO/IEC 14496-12, a movie fragment for each picture."""

    def __init__(self) -> None:
        self._begun: int | None = None
        self._number = 0

    def add(self, picture: Encoded) -> bytes:
        """The next fragment."""
        if self._begun is None:
            self._begun = picture.at
        self._number += 1
        size = len(picture.data)
        head = _FRAGMENT.pack(
            *(_MOOF, b"moof"),
            *(_MFHD, b"mfhd", 0, self._number),
            *(_TRAF, b"traf"),
            *(_TFHD, b"tfhd", 0x02_0000, 1),
            *(_TFDT, b"tfdt", 0x0100_0000, picture.at - self._begun),
            *(_TRUN, b"trun", 0x701, 1, _MOOF + 8, _NOMINAL, size, _KEY if picture.key else _OTHER),
            *(8 + size, b"mdat"),
        )
        return head + picture.data


_CLUSTER, _TIME, _BLOCK = b"\x1f\x43\xb6\x75", b"\xe7\x88", b"\xa3"
_TRACK = b"\x81"


class WebmFile:
    """Matroska as browsers take it, a cluster for each picture."""

    def __init__(self) -> None:
        self._begun: int | None = None

    def add(self, picture: Encoded) -> bytes:
        """The next cluster."""
        if self._begun is None:
            self._begun = picture.at
        time = (picture.at - self._begun) * 1000 // TIME_SCALE
        flags = b"\x80" if picture.key else b"\0"
        block = _BLOCK + _size(4 + len(picture.data)) + _TRACK + b"\0\0" + flags
        clock = _TIME + time.to_bytes(8, "big")
        return b"".join(
            (_CLUSTER, _size(len(clock) + len(block) + len(picture.data)), clock, block, picture.data)
        )


def _size(length: int) -> bytes:
    """The length of an element, in eight bytes."""
    return (1 << 56 | length).to_bytes(8, "big")
