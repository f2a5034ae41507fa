"""Camera frames on the wire."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.camera_frames import Frame, pack, sequence, unpack
from bridge.core.errors import ProtocolError

SIZE = st.integers(0, 2**32 - 1)


@given(seq=SIZE, stamp=st.floats(allow_nan=False), jpeg=st.binary(max_size=64), width=SIZE, height=SIZE)
def test_a_frame_comes_back_unchanged(seq, stamp, jpeg, width, height):
    raw = pack(seq, stamp, jpeg, width, height)
    assert unpack(raw) == Frame(seq, stamp, width, height, jpeg)
    assert sequence(raw) == seq


def test_the_sequence_number_begins_anew_after_its_largest():
    assert sequence(pack(2**32 + 3, 0.0, b"", 1, 1)) == 3


@given(raw=st.binary(max_size=40).filter(lambda raw: raw[:4] != b"PHF1"))
def test_what_is_no_frame_is_a_protocol_error(raw):
    with pytest.raises(ProtocolError, match="must begin with b'PHF1'"):
        unpack(raw)


def test_a_frame_cut_off_in_its_header_is_a_protocol_error():
    with pytest.raises(ProtocolError):
        sequence(pack(1, 0.0, b"", 640, 480)[:-1])
