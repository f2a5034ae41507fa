"""Stamps beside a message: a time, or none; what is no time is refused."""

from __future__ import annotations

import pytest

from bridge.core.errors import ProtocolError
from robotside.gateways.plain.stamps import read_stamp


def test_a_stamp_is_a_time_or_none() -> None:
    assert read_stamp("12.5", "header stamp") == 12.5
    assert read_stamp(None, "header stamp") != read_stamp(None, "header stamp")
    for text in ("soon", "nan", "inf"):
        with pytest.raises(ProtocolError, match=f"The header stamp is a time in seconds, not '{text}'"):
            read_stamp(text, "header stamp")
