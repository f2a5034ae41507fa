"""Long operations in slices and back."""

from __future__ import annotations

import contextlib
import json
import re

import msgspec
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from msgspec import UNSET

from bridge.core.errors import ProtocolError
from bridge.protocol import Fragment, Fragments, split
from bridge.protocol.fragments import MAX_SLICES, SLICE_COST

LIMIT = 1_000_000
TEXT = b'{"op":"publish","topic":"/a","msg":{"data":"hello"}}'


def slices(text, size, id="f"):
    return [msgspec.json.decode(each, type=Fragment) for each in split(text, size, id)]


def a_slice(num=0, total=2, data="x", id="f"):
    return Fragment(id=id, data=data, num=num, total=total)


def test_a_long_text_is_cut_into_slices_with_text_ids_and_whole_totals():
    first, second = (json.loads(each) for each in split(b'{"op":"x"}', 6, "map:1"))
    assert first == {"op": "fragment", "id": "map:1", "data": '{"op":', "num": 0, "total": 2}
    assert second == {"op": "fragment", "id": "map:1", "data": '"x"}', "num": 1, "total": 2}


def test_a_text_that_fits_is_sent_as_it_is():
    assert split(TEXT, len(TEXT), "f") == [TEXT]
    assert split("äöü".encode(), 3, "f") == ["äöü".encode()]


@pytest.mark.parametrize("size", [0, -1])
def test_nothing_can_be_cut_into_nothing(size):
    with pytest.raises(ProtocolError, match=f"fragment_size must be at least 1, not {size}"):
        split(TEXT, size, "f")


def test_what_is_no_text_is_not_cut():
    with pytest.raises(ProtocolError, match="3 bytes that are not UTF-8"):
        split(b"\xff\xff\xff", 1, "f")


def test_a_size_that_makes_too_many_slices_is_not_kept():
    text = b"x" * (MAX_SLICES * 3 + 1)
    assert {len(each.data) for each in slices(text, 1)[:-1]} == {4}


ESCAPES = re.compile(r"\\u[dD][89abAB]..\\u[dD][c-fC-F]..|\\u....|\\.", re.DOTALL)
SPICY = st.text(st.sampled_from('a\\"\n\x01é€😀/'), max_size=40)


def cuts(parts):
    places, at = set(), 0
    for part in parts[:-1]:
        at += len(part.data)
        places.add(at)
    return places


@settings(max_examples=300, deadline=None)
@given(told=SPICY, ascii=st.booleans(), size=st.integers(1, 30), order=st.randoms(use_true_random=False))
@example(told="😀", ascii=True, size=20, order=None)
@example(told="\\\\\\\\", ascii=True, size=15, order=None)
def test_slices_give_the_text_again_in_any_order_and_never_cut_an_escape(told, ascii, size, order):
    text = json.dumps({"op": "x", "s": told}, ensure_ascii=ascii)
    parts = slices(text.encode(), size) if len(text) > size else []
    assert all(len(part.data) <= max(size, 12) for part in parts)
    places = cuts(parts)
    assert not [m for m in ESCAPES.finditer(text) if any(m.start() < place < m.end() for place in places)]
    if order is not None:
        order.shuffle(parts)
    together = Fragments(LIMIT)
    found = [together.add(part, 0.0) for part in parts]
    assert [each for each in found if each is not None] == ([text] if parts else [])
    assert (len(together), together.held) == (0, 0)


def test_what_only_looks_like_half_of_a_pair_is_not_taken_for_one():
    text = rb'{"s":"\\ud83d\ude00"}'
    assert [each.data for each in slices(text, 16)] == [r'{"s":"\\ud83d', r'\ude00"}']


@settings(max_examples=200, deadline=None)
@given(text=st.text(st.characters(exclude_categories=["Cs"]), min_size=1), size=st.integers(1, 9))
def test_any_text_comes_back(text, size):
    sent = split(text.encode(), size, "f")
    if len(sent) == 1:
        assert sent == [text.encode()]
        return
    together = Fragments(LIMIT)
    assert [together.add(msgspec.json.decode(each, type=Fragment), 0.0) for each in sent][-1] == text


@pytest.mark.parametrize("id", ["a", 0, 7, 1.5])
def test_slices_are_known_by_a_text_or_a_number(id):
    together = Fragments(LIMIT)
    assert together.add(a_slice(0, 2, "a", id), 0.0) is None
    assert together.add(a_slice(1, 2, "b", id), 0.0) == "ab"


def test_a_number_and_a_text_are_different_ids():
    together = Fragments(LIMIT)
    together.add(a_slice(0, 2, "a", 1), 0.0)
    assert together.add(a_slice(1, 2, "b", "1"), 0.0) is None


def test_the_total_of_a_ros_1_server_counts_by_its_whole_part():
    together = Fragments(LIMIT)
    assert [
        together.add(a_slice(num, 3.7, data), 0.0) for num, data in ((0.0, "a"), (2, "c"), (1.0, "b"))
    ] == [
        None,
        None,
        "abc",
    ]


def test_one_slice_may_be_all():
    assert Fragments(LIMIT).add(a_slice(0, 1, "all"), 0.0) == "all"


def test_the_same_slice_twice_is_one():
    together = Fragments(LIMIT)
    together.add(a_slice(0), 0.0)
    assert together.add(a_slice(0), 0.0) is None
    assert together.held == 1 + SLICE_COST
    assert together.add(a_slice(1), 0.0) == "xx"


def test_texts_may_come_mixed():
    together = Fragments(LIMIT)
    parts = [a_slice(num, 2, f"{id}{num}", id) for num in (0, 1) for id in "abcd"]
    assert [together.add(part, 0.0) for part in parts][4:] == ["a0a1", "b0b1", "c0c1", "d0d1"]


NO_SLICES = {
    "it needs an id": [a_slice(id=UNSET), a_slice(id=None)],
    "total must be a whole number from 1, not": [a_slice(total=0), a_slice(total=-5), a_slice(total=0.9)],
    "num must be a whole number from 0 to 1, not": [a_slice(num=2), a_slice(num=-1), a_slice(num=0.5)],
    "total must be at most 15625, not": [a_slice(total=15626), a_slice(total=10**400), a_slice(total=1e300)],
}


@pytest.mark.parametrize(("reason", "op"), [(why, op) for why, ops in NO_SLICES.items() for op in ops])
def test_a_slice_that_can_belong_to_no_text_is_refused(reason, op):
    with pytest.raises(ProtocolError, match=f"A fragment cannot be used: {reason}") as caught:
        Fragments(LIMIT).add(op, 0.0)
    assert caught.value.op == "fragment"


def test_an_id_too_long_to_be_kept_is_refused():
    with pytest.raises(ProtocolError, match="id must have at most 1024 characters, not 2000"):
        Fragments(LIMIT).add(a_slice(id="x" * 2000), 0.0)


def told():
    lost = []
    return lost, lambda error: lost.append((error.id, str(error)))


def test_a_text_that_is_begun_anew_forgets_what_came_before():
    lost, given_up = told()
    together = Fragments(LIMIT, given_up=given_up)
    together.add(a_slice(0, 3, "old"), 0.0)
    together.add(a_slice(0, 3, "new"), 0.0)
    together.add(a_slice(0, 2, "newest"), 0.0)
    assert together.add(a_slice(1, 2, "."), 0.0) == "newest."
    assert lost == [("f", "1 of 3 fragments are dropped: begun anew.")] * 2


def test_a_text_that_never_ends_is_given_up():
    lost, given_up = told()
    together = Fragments(LIMIT, lifetime=10.0, given_up=given_up)
    together.add(a_slice(0, 3), 0.0)
    together.add(a_slice(1, 3), 9.0)
    together.expire(18.9)
    assert len(together) == 1
    together.expire(19.0)
    assert (len(together), together.held) == (0, 0)
    assert lost == [("f", "2 of 3 fragments are dropped: nothing more came within 10 s.")]


def test_saying_the_same_again_keeps_nothing_alive():
    together = Fragments(LIMIT, lifetime=10.0)
    together.add(a_slice(0, 3), 0.0)
    together.add(a_slice(0, 3), 9.0)
    together.expire(10.0)
    assert len(together) == 0


def test_the_next_slice_finds_out_too_that_a_text_was_given_up():
    lost, given_up = told()
    together = Fragments(LIMIT, given_up=given_up)
    together.add(a_slice(0, 2, id="old"), 0.0)
    assert together.add(a_slice(0, 1, "new", id="new"), 60.0) == "new"
    assert [id for id, _ in lost] == ["old"]


def test_of_too_many_texts_the_one_that_waited_longest_is_given_up():
    lost, given_up = told()
    together = Fragments(LIMIT, most=2, given_up=given_up)
    for now, id in enumerate("abc"):
        together.add(a_slice(0, 2, id=id), float(now))
    assert len(together) == 2
    assert lost == [("a", "1 of 2 fragments are dropped: only 2 texts may be unfinished at a time.")]
    assert together.add(a_slice(1, 2, id="b"), 3.0) == "xx"


def test_what_waits_is_bounded_in_bytes():
    together = Fragments(1000)
    together.add(a_slice(0, 3, "x" * 500, id="a"), 0.0)
    with pytest.raises(ProtocolError, match="must stay under 1000 bytes") as caught:
        together.add(a_slice(0, 3, "x" * 500, id="b"), 0.0)
    assert (caught.value.op, caught.value.id) == ("fragment", "b")
    with pytest.raises(ProtocolError, match="must stay under 1000 bytes"):
        together.add(a_slice(1, 3, "x" * 500, id="a"), 0.0)
    assert (len(together), together.held) == (0, 0)


def test_what_just_fits_is_kept():
    together = Fragments(2 * (500 + SLICE_COST))
    together.add(a_slice(0, 2, "x" * 500), 0.0)
    assert together.add(a_slice(1, 2, "x" * 500), 0.0) == "x" * 1000
    assert Fragments(2 * SLICE_COST).add(a_slice(0, 2, ""), 0.0) is None


def test_empty_slices_cost_something_too():
    together = Fragments(64 * 20)
    with contextlib.suppress(ProtocolError):
        for num in range(20):
            together.add(a_slice(num, 20, "", id=str(num)), 0.0)
    assert together.held <= 64 * 20


ODD = st.one_of(st.integers(-2, 5), st.floats(), st.just(10**400))
ID = st.one_of(st.sampled_from(["a", "b", "c", 1, 1.5, None, UNSET]))
ODD_SLICE = st.builds(Fragment, id=ID, data=st.text(max_size=30), num=ODD, total=ODD)


@settings(max_examples=300, deadline=None)
@given(ops=st.lists(st.tuples(ODD_SLICE, st.floats(0, 20)), max_size=30))
def test_whatever_comes_stays_bounded_and_raises_nothing_else(ops):
    together, now = Fragments(500, most=2), 0.0
    for op, later in ops:
        now += later
        with contextlib.suppress(ProtocolError):
            together.add(op, now)
        assert 0 <= together.held <= 500
        assert len(together) <= 2
        assert bool(together.held) == bool(len(together))
