"""A test that loops over its cases fails like all of them together."""

from __future__ import annotations

import inspect

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.looped import looped


def failure(test, **fixtures) -> str:
    with pytest.raises(pytest.fail.Exception) as caught:
        test(**fixtures)
    return str(caught.value)


def test_every_case_that_fails_is_named_with_its_fault():
    seen = []

    @looped("number", [1, 2, 3, 4])
    def even(number):
        seen.append(number)
        assert number % 2 == 0, f"{number} is odd"

    said = failure(even)
    assert seen == [1, 2, 3, 4]
    assert "2 of 4 cases failed" in said
    assert "number=1" in said
    assert "AssertionError: 1 is odd" in said
    assert "3 is odd" in said
    assert "number=2" not in said


def test_whatever_a_case_raises_is_a_failure_of_it():
    @looped("text", ["1", "x"])
    def is_a_number(text):
        int(text)

    @looped("text", ["1", "x"])
    def is_none(text):
        with pytest.raises(ValueError, match="invalid"):
            int(text)

    assert "text='x'" in failure(is_a_number)
    assert "text='1'" in failure(is_none)


def test_loops_within_loops_take_every_pair():
    seen = []

    @looped("a", "xy")
    @looped(("b", "c"), [(1, 2), (3, 4)])
    def pair(a, b, c):
        seen.append((a, b, c))
        assert c != 4

    said = failure(pair)
    assert seen == [("x", 1, 2), ("x", 3, 4), ("y", 1, 2), ("y", 3, 4)]
    assert "a='y'" in said
    assert "b=3, c=4" in said


def test_what_is_looped_over_is_no_fixture_and_the_rest_is(tmp_path):
    @looped("name", ["a", "b"])
    def leaves_files(tmp_path, name):
        (tmp_path / name).touch()

    assert list(inspect.signature(leaves_files).parameters) == ["tmp_path"]
    leaves_files(tmp_path=tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]


def test_a_property_tells_the_example_that_breaks_it():
    @looped("least", [0, 5])
    @given(number=st.integers(0, 9))
    def at_least(least, number):
        assert number >= least

    said = failure(at_least)
    assert "1 of 2 cases failed" in said
    assert "number=0" in said


def test_a_case_that_is_skipped_hides_no_other():
    @looped("x", [1, 2, 3])
    def odd(x):
        if x == 2:
            pytest.skip("This machine lacks even numbers")
        assert x < top

    top = 3
    assert "1 of 3 cases failed" in failure(odd)
    top = 9
    with pytest.raises(pytest.skip.Exception, match="even numbers"):
        odd()


def test_a_list_without_cases_proves_nothing():
    @looped("x", [])
    def nothing(x):
        pass

    with pytest.raises(AssertionError, match="There is no case"):
        nothing()


def test_a_coroutine_is_refused():
    async def later(x):
        pass

    with pytest.raises(TypeError, match="later is a coroutine"):
        looped("x", [1])(later)


@looped("x", [1, 2])
def test_pytest_collects_it(x, request):
    assert request.node.name == "test_pytest_collects_it"
