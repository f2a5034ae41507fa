"""The check at the goal: no robot is there that is not sure of its place."""

from __future__ import annotations

from bridge.core.codes import Code
from robotside.navigation.arrival_check import SURE_TIMEOUT, ArrivalCheck


def test_it_stands_and_waits_before_it_says_that_it_is_not_there() -> None:
    check = ArrivalCheck()
    assert not check.waits
    assert check.refusal("Lab", 10.0) is None
    assert check.waits
    assert check.refusal("Lab", 10.0 + SURE_TIMEOUT - 0.1) is None
    refusal = check.refusal("Lab", 10.0 + SURE_TIMEOUT)
    assert refusal is not None
    assert (refusal.code, refusal.parameters) == (Code.TASK_PLACE_UNSURE, {"place": "Lab"})


def test_one_that_was_moved_meanwhile_waits_anew() -> None:
    check = ArrivalCheck()
    check.refusal("Lab", 0.0)
    check.forget()
    assert not check.waits
    assert check.refusal("Lab", SURE_TIMEOUT + 1.0) is None
