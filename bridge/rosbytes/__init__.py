"""Messages in ROS's own binary formats, for the compression `cbor-raw`.

ROS 1: little-endian, nothing between the fields, texts and arrays of any length with their length before them [1].
ROS 2: CDR as in OMG's DDSI-RTPS [2], little-endian, after a header of four bytes; each number is aligned to a
multiple of its size, and a text ends in a zero that its length counts.

[1] ROS wiki, "Connection header" and roscpp's serialization traits. [2] DDS-XTYPES 1.3, 7.4.1 (plain CDR version 1).
"""

from __future__ import annotations

from bridge.rosbytes.reading import deserialize
from bridge.rosbytes.writing import serialize

__all__ = ["deserialize", "serialize"]
