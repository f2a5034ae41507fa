"""Messages to JSON and CBOR and back.

JSON has no NaN and no infinity: both travel as `null`, which comes back as NaN. `uint8[]` travels as base64.
In CBOR numbers keep their value, `uint8[]` is a byte string and number arrays are RFC 8746 typed arrays.

Both shapes of ROS's times are understood. What is sent has those of ROS 1 (`secs`, `nsecs`), which servers of either
kind take, and those of ROS 2 (`sec`, `nanosec`) where the receiver is known to want them.
"""

from __future__ import annotations

from bridge.codec.binary import from_cbor, to_cbor
from bridge.codec.heads import check_cbor
from bridge.codec.misspelt import unknown_fields
from bridge.codec.now import from_json_now
from bridge.codec.reader import from_builtins, shown, to_builtins
from bridge.codec.selection import check_paths, select
from bridge.codec.text import from_json, to_json, to_server_json
from bridge.codec.unread import Unread, unread
from bridge.codec.weight import weight

__all__ = [
    "Unread",
    "check_cbor",
    "check_paths",
    "from_builtins",
    "from_cbor",
    "from_json",
    "from_json_now",
    "select",
    "shown",
    "to_builtins",
    "to_cbor",
    "to_json",
    "to_server_json",
    "unknown_fields",
    "unread",
    "weight",
]
