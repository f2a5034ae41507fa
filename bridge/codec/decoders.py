"""Decoders of JSON for a type, one made at a time.

To make one msgspec reads the annotations of all classes in the type and keeps what it found at the classes. It runs Python
meanwhile, so that a second thread can come to the same class and take over what is half made, which ends the process.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import msgspec

__all__ = ["decoder_of"]

_making = threading.Lock()


def decoder_of(
    type: Any, dec_hook: Callable[[type[Any], object], object] | None = None
) -> msgspec.json.Decoder[Any]:
    """A decoder of `type`, and `dec_hook` for what msgspec has no form of. TypeError for a type that it cannot decode."""
    with _making:
        return msgspec.json.Decoder(type, dec_hook=dec_hook)
