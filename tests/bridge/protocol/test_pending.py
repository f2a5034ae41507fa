"""Calls and goals until the other side has answered."""

from __future__ import annotations

import pytest
from msgspec import UNSET, Raw

from bridge.core.errors import ProtocolError
from bridge.protocol import (
    ActionFeedback,
    ActionResult,
    Calls,
    CallService,
    CancelActionGoal,
    Goals,
    SendActionGoal,
    ServiceResponse,
)


def calls(most=10):
    return Calls("call", most)


def goals(most=10):
    return Goals("goal", most)


def test_a_call_is_named_by_its_service_and_a_number():
    asked = calls()
    sent = [asked.ask(CallService(service="/add", args=Raw(b"[1]"), id="mine"), print) for _ in range(2)]
    assert [op.id for op in sent] == ["call:/add:1", "call:/add:2"]
    assert bytes(sent[0].args) == b"[1]"


def test_an_answer_reaches_who_asked_once():
    asked, heard = calls(), []
    first = asked.ask(CallService(service="/add"), lambda op: heard.append(("first", op)))
    asked.ask(CallService(service="/add"), lambda op: heard.append(("second", op)))
    answer = ServiceResponse(id=first.id, service="/add")
    assert asked.on_response(answer)
    assert not asked.on_response(answer)
    assert heard == [("first", answer)]
    assert len(asked) == 1


@pytest.mark.parametrize("id", ["nobody", 1, None, UNSET, "call:/add:2"])
def test_an_answer_that_nobody_waits_for_is_told_so(id):
    asked = calls()
    asked.ask(CallService(service="/add"), print)
    assert not asked.on_response(ServiceResponse(id=id))


def test_who_waits_no_longer_is_not_called():
    asked, heard = calls(), []
    op = asked.ask(CallService(service="/add"), heard.append)
    assert asked.forget(op.id)
    assert not asked.forget(op.id)
    asked.fail_all()
    assert heard == []


def test_when_a_service_is_gone_its_callers_are_told():
    asked, heard = calls(), []
    for service in ("add", "/add", "/stop"):
        asked.ask(CallService(service=service), lambda op, service=service: heard.append((service, op)))
    asked.fail_all("/add")
    assert heard == [("add", None), ("/add", None)]
    asked.fail_all()
    assert heard[2:] == [("/stop", None)]
    assert len(asked) == 0


def test_there_is_an_end_to_what_may_wait():
    asked = calls(most=2)
    first = asked.ask(CallService(service="/add"), print)
    asked.ask(CallService(service="/add"), print)
    with pytest.raises(ProtocolError, match="/add cannot be called: 2 calls wait for their answer already"):
        asked.ask(CallService(service="/add"), print)
    asked.forget(first.id)
    asked.ask(CallService(service="/add"), print)


def failing(_):
    raise ZeroDivisionError


def test_all_are_told_even_if_one_fails_at_it():
    asked, heard = calls(), []
    asked.ask(CallService(service="/a"), failing)
    asked.ask(CallService(service="/b"), heard.append)
    with pytest.raises(ZeroDivisionError):
        asked.fail_all()
    assert heard == [None]
    assert len(asked) == 0


def test_a_goal_is_named_by_its_action_and_a_number_and_asks_for_feedback_only_if_wanted():
    under_way = goals()
    first = under_way.send(SendActionGoal(action="/dock", id="mine"), print, print)
    second = under_way.send(SendActionGoal(action="/dock", feedback=True), None, print)
    assert [(op.id, op.feedback) for op in (first, second)] == [
        ("goal:/dock:1", True),
        ("goal:/dock:2", False),
    ]
    assert list(under_way) == [first, second]


def test_feedback_reaches_who_wants_it_until_the_goal_is_over():
    under_way, fed, ended = goals(), [], []
    op = under_way.send(SendActionGoal(action="/dock"), fed.append, ended.append)
    quiet = under_way.send(SendActionGoal(action="/dock"), None, ended.append)
    feedback, result = (
        ActionFeedback(id=op.id, action="/dock"),
        ActionResult(id=op.id, action="/dock", status=4),
    )
    assert under_way.on_feedback(feedback)
    assert not under_way.on_feedback(ActionFeedback(id=quiet.id, action="/dock"))
    assert under_way.on_result(result)
    assert not under_way.on_result(result)
    assert not under_way.on_feedback(feedback)
    assert (fed, ended) == ([feedback], [result])


def test_a_goal_that_is_taken_back_still_has_a_result():
    under_way, ended = goals(), []
    op = under_way.send(SendActionGoal(action="/dock"), None, ended.append)
    assert under_way.cancel(op.id) == CancelActionGoal(id=op.id, action="/dock")
    assert under_way.on_result(ActionResult(id=op.id, action="/dock", status=5))
    assert [each.status for each in ended] == [5]
    assert under_way.cancel(op.id) is None


def test_when_an_action_is_gone_whose_goals_it_had_are_told():
    under_way, ended = goals(), []
    for action in ("dock", "/fly"):
        under_way.send(
            SendActionGoal(action=action), None, lambda op, action=action: ended.append((action, op))
        )
    under_way.fail_all("/dock")
    assert ended == [("dock", None)]
    under_way.fail_all()
    assert ended == [("dock", None), ("/fly", None)]


def test_a_goal_may_be_forgotten():
    under_way, ended = goals(), []
    op = under_way.send(SendActionGoal(action="/dock"), None, ended.append)
    assert under_way.forget(op.id)
    assert not under_way.forget(op.id)
    under_way.fail_all()
    assert ended == []


def test_there_is_an_end_to_goals_under_way():
    under_way = goals(most=1)
    under_way.send(SendActionGoal(action="/dock"), None, print)
    with pytest.raises(ProtocolError, match="/dock takes no goal: 1 are under way already"):
        under_way.send(SendActionGoal(action="/dock"), None, print)
