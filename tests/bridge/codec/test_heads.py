"""What CBOR is made of, before it is decoded."""

from __future__ import annotations

import contextlib

import cbor2
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.codec import check_cbor
from bridge.core.errors import ProtocolError

PLAIN = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers(-(2**63), 2**63 - 1) | st.text() | st.binary(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=20,
)


def values(obj):
    if isinstance(obj, list):
        return 1 + sum(map(values, obj))
    return 1 + sum(1 + values(each) for each in obj.values()) if isinstance(obj, dict) else 1


@given(obj=PLAIN)
def test_values_are_counted_as_they_are(obj):
    raw, count = cbor2.dumps(obj), values(obj)
    check_cbor(raw, count)
    with pytest.raises(ProtocolError, match=f"at most {count - 1} values"):
        check_cbor(raw, count - 1)


def test_a_number_array_is_two_values_however_long():
    raw = cbor2.dumps(cbor2.CBORTag(85, bytes(1_000_000)))
    check_cbor(raw, 2)
    with pytest.raises(ProtocolError, match="at most 1 values"):
        check_cbor(raw, 1)


def test_values_without_a_told_length_are_counted_too():
    check_cbor(b"\x9f\x01\x02\xff", 4)
    with pytest.raises(ProtocolError):
        check_cbor(b"\x9f\x01\x02\xff", 3)


@pytest.mark.parametrize("tag", [0, 1, 2, 3, 4, 5, 28, 29, 30, 35, 36, 37, 63, 88, 260, 2**40])
def test_other_tags_are_refused_by_their_number(tag):
    with pytest.raises(ProtocolError, match=f"but those of number arrays, not {tag}\\."):
        check_cbor(cbor2.dumps({"a": cbor2.CBORTag(tag, b"")}), 100)


@given(raw=st.binary(max_size=50))
def test_whatever_is_no_cbor_is_left_to_who_decodes_it(raw):
    with contextlib.suppress(ProtocolError):
        check_cbor(raw, 100)
