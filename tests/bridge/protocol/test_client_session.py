"""What a client remembers about its server."""

from __future__ import annotations

import cbor2
import pytest
from msgspec import UNSET, Raw

from bridge.core.errors import ProtocolError
from bridge.msgs.geometry_msgs import Twist
from bridge.protocol import (
    ActionFeedback,
    ActionResult,
    Advertise,
    AdvertiseAction,
    AdvertiseService,
    CallService,
    CancelActionGoal,
    ClientSession,
    SendActionGoal,
    ServiceResponse,
    SetLevel,
    Subscribe,
    Unadvertise,
    UnadvertiseAction,
    UnadvertiseService,
    encode,
    split,
    to_png,
)
from bridge.protocol import client_session as module
from tests.bridge.protocol.spoken import FROM_SERVERS


def full():
    """A session with one of everything that is remembered over reconnects."""
    session = ClientSession()
    session.subscribe(Subscribe(topic="/odom", type="nav_msgs/Odometry"), Twist, print)
    session.advertise("/cmd_vel", Twist, latch=True)
    session.serve("lamp", "std_srvs/SetBool", print)
    session.provide("/dock", "dock_msgs/Dock", print, print)
    return session


def test_a_client_says_again_everything_it_said_when_it_connects_again():
    session = full()
    opening = list(session.opening())
    assert [type(op) for op in opening] == [Advertise, AdvertiseService, AdvertiseAction, Subscribe]
    assert opening == list(session.opening())
    assert opening[0] == Advertise(
        topic="/cmd_vel", type="geometry_msgs/Twist", latch=True, id="advertise:/cmd_vel"
    )


def test_what_it_took_back_it_does_not_say_again():
    session = full()
    _, ended = session.subscribe(Subscribe(topic="/scan"), Twist, print)
    (kept,) = session.subscribers("/odom")
    assert session.unsubscribe(ended)
    assert not session.unsubscribe(ended)
    assert session.unadvertise("/cmd_vel") == Unadvertise(topic="/cmd_vel", id="advertise:/cmd_vel")
    assert session.unadvertise("/cmd_vel") is None
    assert session.stop_serving("/lamp") == UnadvertiseService(service="lamp")
    assert session.stop_serving("/lamp") is None
    assert session.stop_providing("dock") == UnadvertiseAction(action="/dock")
    assert session.stop_providing("dock") is None
    assert list(session.opening()) == [kept.op]
    assert list(session.subscriptions) == ["/odom"]


def test_it_asks_for_remarks_first_if_it_wants_them():
    session = full()
    session.level = "warning"
    assert next(session.opening()) == SetLevel(level="warning")


def test_types_are_spelled_as_the_server_spells_them():
    session = full()
    session.ros2 = True
    assert [op.type for op in session.opening()] == [
        "geometry_msgs/msg/Twist",
        "std_srvs/srv/SetBool",
        "dock_msgs/action/Dock",
        "nav_msgs/msg/Odometry",
    ]
    assert session.goal("/dock", "dock_msgs/Dock", b"{}", None, print).action_type == "dock_msgs/action/Dock"
    first, _ = session.subscribe(Subscribe(topic="/any"), Twist, print)
    assert first.type is None
    session.ros2 = False
    assert next(session.opening()).type == "geometry_msgs/Twist"


def test_every_id_is_a_text_that_is_not_empty_and_no_other_has():
    session = ClientSession()
    ids = [session.call("/stop", b"{}", print).id for _ in range(50)]
    ids += [session.subscribe(Subscribe(topic="/odom"), Twist, print)[0].id for _ in range(50)]
    ids += [session.goal("/dock", "", b"{}", None, print).id for _ in range(50)]
    ids.append(session.advertise("/cmd_vel", Twist).id)
    assert len(set(ids)) == 151
    assert all(isinstance(id, str) and id for id in ids)


def test_subscribers_of_a_topic_are_told_apart_by_their_ids():
    session = ClientSession()
    for callback in (print, repr):
        session.subscribe(Subscribe(topic="/odom"), Twist, callback)
    assert [each.callback for each in session.subscribers("/odom")] == [print, repr]
    assert session.subscribers("/scan") == []


def test_an_answer_reaches_the_call_that_it_belongs_to_once():
    session, answers = ClientSession(), []
    first = session.call("/stop", b"[]", lambda op: answers.append(("first", op.result)), timeout=3.0)
    session.call("/stop", b"{}", lambda op: answers.append(("second", op)))
    assert (first.timeout, bytes(first.args)) == (3.0, b"[]")
    answer = ServiceResponse(id=first.id, values=Raw(b"{}"), result=True)
    assert session.on_response(answer)
    assert not session.on_response(answer)
    session.on_lost()
    assert answers == [("first", True), ("second", None)]


def test_a_call_of_the_server_reaches_who_answers_it():
    session, calls = full(), []
    session.serve("lamp", "std_srvs/SetBool", calls.append)
    op = CallService(service="/lamp", id="service_request:/lamp:1")
    session.called(op)
    assert calls == [op]
    with pytest.raises(ProtocolError, match='This client has no service "/fan"') as caught:
        session.called(CallService(service="/fan", id=3))
    assert (caught.value.op, caught.value.id) == ("call_service", 3)


def test_a_goal_is_followed_until_the_server_says_what_became_of_it():
    session, fed, ended = ClientSession(), [], []
    op = session.goal("/dock", "dock_msgs/Dock", b'{"x":1}', fed.append, ended.append)
    assert (op.feedback, bytes(op.args)) == (True, b'{"x":1}')
    assert session.on_feedback(ActionFeedback(id=op.id, action="/dock"))
    assert session.cancel(op.id) == CancelActionGoal(id=op.id, action="/dock")
    assert session.on_result(ActionResult(id=op.id, action="/dock", status=5))
    assert not session.on_result(ActionResult(id=op.id, action="/dock"))
    assert session.cancel(op.id) is None
    assert (len(fed), len(ended)) == (1, 1)


def with_action():
    session, started, cancelled = ClientSession(), [], []
    session.provide("dock", "dock_msgs/Dock", started.append, cancelled.append)
    return session, started, cancelled


GOAL = SendActionGoal(action="/dock", id="action_goal:/dock:1")


def test_a_goal_of_the_server_reaches_who_carries_it_out():
    session, started, cancelled = with_action()
    session.goal_given(GOAL)
    assert started == [GOAL]
    assert session.goal_cancelled(CancelActionGoal(action="/dock", id=GOAL.id))
    assert cancelled == [GOAL.id]
    assert session.goal_ended(GOAL.id)
    assert not session.goal_ended(GOAL.id)
    assert not session.goal_cancelled(CancelActionGoal(action="/dock", id=GOAL.id))
    assert cancelled == [GOAL.id]


def test_a_goal_that_cannot_be_taken_is_refused(monkeypatch):
    monkeypatch.setattr(module, "MAX_GOALS", 2)
    session, started, _ = with_action()
    session.goal_given(GOAL)
    with pytest.raises(ProtocolError, match="A goal with the id .*dock:1.* is under way already"):
        session.goal_given(GOAL)
    with pytest.raises(ProtocolError, match='This client has no action "/fly"'):
        session.goal_given(SendActionGoal(action="/fly", id=1))
    with pytest.raises(ProtocolError, match="id must have at most"):
        session.goal_given(SendActionGoal(action="/dock", id="x" * 2000))
    session.goal_given(SendActionGoal(action="dock", id=UNSET))
    with pytest.raises(ProtocolError, match="At most 2 goals may be under way"):
        session.goal_given(SendActionGoal(action="/dock", id=3))
    assert len(started) == 2


def test_with_the_connection_everything_unanswered_is_lost_and_goals_of_the_server_are_cancelled():
    session, _, cancelled = with_action()
    session.goal_given(GOAL)
    lost = []
    session.call("/stop", b"{}", lambda op: lost.append(("call", op)))
    session.goal("/fly", "", b"{}", None, lambda op: lost.append(("goal", op)))
    session.receive(split(b'{"op":"publish","topic":"/a"}', 10, "f")[0], 0.0)
    session.on_lost()
    assert sorted(lost) == [("call", None), ("goal", None)]
    assert (cancelled, session.given) == ([GOAL.id], {})
    assert session.receive(split(b'{"op":"publish","topic":"/a"}', 10, "f")[1], 0.0) == []
    assert [type(op) for op in session.opening()] == [AdvertiseAction]


def test_a_goal_that_is_under_way_outlives_its_advertisement():
    session, _, cancelled = with_action()
    session.goal_given(GOAL)
    session.stop_providing("/dock")
    assert session.goal_cancelled(CancelActionGoal(action="/dock", id=GOAL.id))
    assert cancelled == [GOAL.id]


@pytest.mark.parametrize("said", FROM_SERVERS)
def test_every_frame_that_servers_write_is_taken(said):
    found = ClientSession().receive(FROM_SERVERS[said], 0.0)
    assert not [each for each in found if isinstance(each, ProtocolError)]


def test_pictures_are_unpacked():
    op = Unadvertise(topic="/a")
    assert ClientSession().receive(encode(to_png(encode(op))), 0.0) == [op]


@pytest.mark.parametrize("lost", [False, True])
def test_what_is_costly_to_read_in_cbor_is_not_taken_from_a_server_either(lost):
    session = ClientSession()
    if lost:
        session.on_lost()
    publish = {"op": "publish", "topic": "/n", "msg": {"data": cbor2.CBORTag(4, [1, 10**30])}}
    (told,) = session.receive(cbor2.dumps(publish), 0.0)
    assert str(told) == "A binary frame may hold no CBOR tags but those of number arrays, not 4."
    many = cbor2.dumps({"op": "publish", "topic": "/n", "msg": {"data": [[]] * 250_000}})
    (told,) = session.receive(many, 0.0)
    assert str(told) == "A binary frame may hold at most 250000 values outside number arrays."
    (told,) = session.receive(cbor2.dumps(publish | {"msg": {"data": [0.5] * 100_000}}), 0.0)
    assert told.topic == "/n"
