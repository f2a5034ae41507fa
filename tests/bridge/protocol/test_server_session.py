"""What a server remembers about one client."""

from __future__ import annotations

import msgspec
import pytest
from msgspec import UNSET, Raw

from bridge.core.compat import Compat
from bridge.core.errors import ProtocolError
from bridge.protocol import (
    ActionFeedback,
    ActionResult,
    Advertise,
    AdvertiseAction,
    AdvertiseService,
    CallService,
    CancelActionGoal,
    Publish,
    Reduction,
    SendActionGoal,
    ServerSession,
    ServiceResponse,
    SetLevel,
    Subscribe,
    Unadvertise,
    UnadvertiseAction,
    UnadvertiseService,
    Unsubscribe,
    encode,
    parse,
    split,
)
from bridge.protocol import server_session as module
from tests.bridge.protocol.spoken import FROM_CLIENTS

STRICT = Compat.strict()


def heard(session, text):
    """The one operation in a frame, taken in as a server takes it."""
    (op,) = session.receive(text, 0.0)
    if isinstance(op, ProtocolError):
        raise op
    return op


def test_two_subscriptions_of_one_client_are_one_delivery_at_the_faster_rate():
    session = ServerSession()
    assert session.subscribe(Subscribe(topic="/odom", id="a", throttle_rate=200)) == "/odom"
    assert session.subscribe(Subscribe(topic="odom", id="b", throttle_rate=50, compression="cbor")) == "/odom"
    wanted = session.subscriptions["/odom"]
    assert (wanted.name, wanted.period, wanted.compression) == ("/odom", 0.05, "cbor")
    session.unsubscribe(Unsubscribe(topic="/odom", id="b"))
    wanted = session.subscriptions["/odom"]
    assert (wanted.period, wanted.compression) == (0.2, "none")


def test_the_same_id_again_replaces_what_it_asked_for():
    session = ServerSession()
    session.subscribe(Subscribe(topic="/odom", id="a", throttle_rate=50))
    session.subscribe(Subscribe(topic="/odom", id="a", throttle_rate=200))
    assert session.subscriptions["/odom"].period == 0.2


@pytest.mark.parametrize("id", [UNSET, None])
def test_unsubscribing_without_an_id_ends_all_subscriptions_of_the_topic(id):
    session = ServerSession()
    session.subscribe(Subscribe(topic="/odom", id="a"))
    session.subscribe(Subscribe(topic="/odom", id="b"))
    session.subscribe(Subscribe(topic="/scan", id="b"))
    session.unsubscribe(Unsubscribe(topic="odom", id=id))
    assert list(session.subscriptions) == ["/scan"]


def test_unsubscribing_from_what_was_never_asked_for_is_no_error():
    session = ServerSession()
    session.subscribe(Subscribe(topic="/odom", id="a"))
    session.unsubscribe(Unsubscribe(topic="/odom", id="z"))
    session.unsubscribe(Unsubscribe(topic="/scan"))
    assert list(session.subscriptions) == ["/odom"]


def test_a_subscription_that_cannot_be_had_changes_nothing():
    session = ServerSession()
    session.subscribe(Subscribe(topic="/scan", id="a", throttle_rate=50))
    before = session.subscriptions["/scan"]
    with pytest.raises(ProtocolError):
        session.subscribe(Subscribe(topic="/scan", id="a", reduce=Reduction(beams=0)))
    with pytest.raises(ProtocolError):
        session.subscribe(Subscribe(topic="/new", id="a", reduce=Reduction(beams=0)))
    assert session.subscriptions == {"/scan": before}


def test_of_ten_thousand_subscriptions_a_thousand_are_taken():
    session, refused = ServerSession(), []
    for number in range(10_000):
        try:
            session.subscribe(Subscribe(topic=f"/t{number % 700}", id=number))
        except ProtocolError as error:
            refused.append(error)
    assert (len(refused), len(session.subscriptions)) == (9_000, 700)
    assert str(refused[0]) == "A client may have at most 1000 subscriptions."
    assert (refused[0].op, refused[0].id) == ("subscribe", 1000)


def test_room_comes_back_with_what_is_unsubscribed():
    session = ServerSession()
    for number in range(1000):
        session.subscribe(Subscribe(topic="/t", id=number))
    session.subscribe(Subscribe(topic="/t", id=7, throttle_rate=5))
    session.unsubscribe(Unsubscribe(topic="/t", id=7))
    session.subscribe(Subscribe(topic="/u", id=7))
    with pytest.raises(ProtocolError):
        session.subscribe(Subscribe(topic="/v", id=7))
    session.unsubscribe(Unsubscribe(topic="/t"))
    session.subscribe(Subscribe(topic="/v", id=7))


SIZED = '{"op":"subscribe","topic":"/map","id":"m","fragment_size":1000}'


def test_a_fragment_size_in_any_operation_holds_for_the_whole_connection():
    session = ServerSession()
    session.subscribe(heard(session, '{"op":"subscribe","topic":"/odom"}'))
    assert session.subscriptions["/odom"].fragment_size is None
    heard(session, '{"op":"publish","topic":"/a","fragment_size":500}')
    session.subscribe(heard(session, '{"op":"subscribe","topic":"/map"}'))
    assert [each.fragment_size for each in session.subscriptions.values()] == [500, 500]
    assert session.answer_size(CallService(service="/a")) == 500


def test_of_what_a_subscription_wants_and_what_holds_the_smaller_counts_and_null_ends_it():
    session = ServerSession()
    session.subscribe(heard(session, SIZED))
    heard(session, '{"op":"unsubscribe","topic":"/x","fragment_size":2000.0}')
    assert (session.fragment_size, session.subscriptions["/map"].fragment_size) == (2000, 1000)
    heard(session, '{"op":"unsubscribe","topic":"/x"}')
    assert session.fragment_size == 2000
    heard(session, '{"op":"unsubscribe","topic":"/x","fragment_size":null}')
    assert (session.fragment_size, session.subscriptions["/map"].fragment_size) == (None, None)
    heard(session, '{"op":"unsubscribe","topic":"/x","fragment_size":3000}')
    assert session.subscriptions["/map"].fragment_size == 1000


def test_to_the_letter_a_fragment_size_holds_for_what_it_came_with():
    session = ServerSession(STRICT)
    session.subscribe(heard(session, SIZED))
    session.subscribe(heard(session, '{"op":"subscribe","topic":"/odom"}'))
    assert [each.fragment_size for each in session.subscriptions.values()] == [1000, None]
    assert session.answer_size(CallService(service="/a", fragment_size=70)) == 70
    assert session.answer_size(CallService(service="/a")) is None
    assert session.fragment_size is None


def test_an_operation_with_a_fragment_size_that_cannot_be_is_refused():
    session = ServerSession()
    with pytest.raises(ProtocolError, match="fragment_size must be at least 1 or null, not 0") as caught:
        heard(session, '{"op":"publish","topic":"/a","id":5,"fragment_size":0}')
    assert (caught.value.op, caught.value.id) == ("publish", 5)


@pytest.mark.parametrize(
    "said",
    [
        Subscribe(topic="/a", type="std_msgs/msg/String"),
        Advertise(topic="/a", type="std_msgs/msg/String"),
        AdvertiseService(service="/a", type="std_srvs/srv/Trigger"),
        AdvertiseAction(action="/a", type="dock_msgs/action/Dock"),
        SendActionGoal(action="/a", action_type="dock_msgs/action/Dock"),
    ],
    ids=lambda op: type(op).__name__,
)
def test_who_has_spelled_a_type_as_in_ros_2_gets_the_times_of_ros_2_where_it_names_none(said):
    session = ServerSession()
    session.subscribe(Subscribe(topic="/before"))
    heard(session, encode(said))
    session.subscribe(Subscribe(topic="/after"))
    session.subscribe(Subscribe(topic="/named", type="nav_msgs/Odometry"))
    assert session.ros2
    assert [each.ros2 for each in session.subscriptions.values()] == [False, True, False]


@pytest.mark.parametrize("said", FROM_CLIENTS)
def test_every_frame_that_clients_write_is_taken(said):
    found = ServerSession().receive(FROM_CLIENTS[said], 0.0)
    assert not [each for each in found if isinstance(each, ProtocolError)]


def test_fragments_are_put_together_before_they_count():
    session = ServerSession()
    *first, last = split(SIZED.encode(), 20, "f")
    assert [session.receive(each, 0.0) for each in first] == [[]] * len(first)
    assert session.receive(last, 0.0) == [parse(SIZED)]
    assert session.fragment_size == 1000


def test_what_is_wrong_stands_among_what_is_right():
    session = ServerSession()
    found = session.receive('{"op":"publish","topic":"/a"} {"op":"dance"}', 0.0)
    assert [type(each) for each in found] == [Publish, ProtocolError]


def test_advertisements_are_kept_by_id():
    session = ServerSession()
    assert session.advertise(Advertise(topic="cmd_vel", id="a")) == "/cmd_vel"
    session.advertise(Advertise(topic="/cmd_vel", id="b", latch=True))
    assert session.latches("/cmd_vel")
    assert session.unadvertise(Unadvertise(topic="cmd_vel", id="b")) == "/cmd_vel"
    assert list(session.advertised["/cmd_vel"]) == ["a"]
    assert not session.latches("/cmd_vel")
    assert not session.latches("/never")


@pytest.mark.parametrize("id", [UNSET, None])
def test_unadvertising_without_an_id_ends_all_advertisements_of_the_topic(id):
    session = ServerSession()
    for name in "ab":
        session.advertise(Advertise(topic="/cmd_vel", id=name))
    session.unadvertise(Unadvertise(topic="/cmd_vel", id="z"))
    assert set(session.advertised["/cmd_vel"]) == {"a", "b"}
    session.unadvertise(Unadvertise(topic="/cmd_vel", id=id))
    session.unadvertise(Unadvertise(topic="/never"))
    assert session.advertised == {}


def test_topics_services_and_actions_that_a_client_advertises_are_bounded_together():
    session = ServerSession()
    for number in range(998):
        session.advertise(Advertise(topic="/t", id=number))
    session.advertise_service(AdvertiseService(service="/s"))
    session.advertise_action(AdvertiseAction(action="/a"))
    again = (
        (session.advertise, Advertise(topic="/t", id=5)),
        (session.advertise_service, AdvertiseService(service="s", type="std_srvs/Empty")),
        (session.advertise_action, AdvertiseAction(action="a")),
    )
    for advertise, op in again:
        advertise(op)
    more = (
        (session.advertise, Advertise(topic="/t", id="new")),
        (session.advertise_service, AdvertiseService(service="/new")),
        (session.advertise_action, AdvertiseAction(action="/new")),
    )
    for advertise, op in more:
        with pytest.raises(
            ProtocolError, match="A client may advertise at most 1000 topics, services and actions"
        ):
            advertise(op)
    session.unadvertise(Unadvertise(topic="/t", id=5))
    more[1][0](more[1][1])


def with_service(compat=None):
    session, answers = ServerSession(compat), []
    session.advertise_service(AdvertiseService(service="lamp", type="std_srvs/SetBool"))
    op = session.ask(
        CallService(service="/lamp", args=Raw(b'{"data":true}'), id="callers", compression="cbor"),
        answers.append,
    )
    return session, op, answers


def test_a_client_is_asked_under_an_id_of_the_servers_own():
    session, op, _ = with_service()
    assert op == CallService(service="/lamp", args=op.args, id="service_request:/lamp:1")
    assert bytes(op.args) == b'{"data":true}'
    assert session.services["/lamp"].type == "std_srvs/SetBool"


def test_its_answer_reaches_who_asked_once():
    session, op, answers = with_service()
    answer = ServiceResponse(service="/lamp", id=op.id, values=Raw(b'{"success":true}'))
    assert session.on_response(answer)
    assert not session.on_response(answer)
    assert answers == [answer]


REFUSAL = '{"op":"service_response","service":"/lamp","id":"service_request:/lamp:1","result":false,"values":{"success":false}}'
SILENT_REFUSAL = REFUSAL.replace(',"values":{"success":false}', "")
SAID_WHY = REFUSAL.replace('{"success":false}', '"no key"')
SILENCE = '{"op":"service_response","service":"/lamp","id":"service_request:/lamp:1","result":true}'


@pytest.mark.parametrize(
    ("compat", "answer", "result", "values"),
    [
        (None, REFUSAL, True, {"success": False}),
        (STRICT, REFUSAL, False, {"success": False}),
        (None, SAID_WHY, False, "no key"),
        (None, SILENCE, True, {}),
        (STRICT, SILENCE, False, "/lamp answered without saying more."),
        (None, SILENT_REFUSAL, False, "/lamp refused without saying more."),
        (STRICT, SILENT_REFUSAL, False, "/lamp refused without saying more."),
        (STRICT, SILENCE.replace("}", ',"values":{}}'), True, {}),
        (None, SILENCE.replace("true", "null").replace("}", ',"values":{"a":1}}'), True, {"a": 1}),
    ],
)
def test_a_refusal_and_an_answer_without_values_reach_the_caller_as_compat_has_it(
    compat, answer, result, values
):
    session, _, answers = with_service(compat)
    session.on_response(parse(answer))
    assert [(each.result, msgspec.json.decode(each.values)) for each in answers] == [(result, values)]


def test_who_waits_for_a_service_that_is_gone_is_told():
    session, _, answers = with_service()
    assert session.unadvertise_service(UnadvertiseService(service="lamp")) == "/lamp"
    assert (answers, session.services) == ([None], {})
    session.unadvertise_service(UnadvertiseService(service="/never"))


def test_who_waits_no_longer_is_not_called():
    session, op, answers = with_service()
    assert session.forget_call(op.id)
    assert not session.on_response(ServiceResponse(id=op.id))
    assert answers == []


def test_a_client_is_not_asked_without_end(monkeypatch):
    session, _, _ = with_service()
    for _ in range(module.MAX_CALLS - 1):
        session.ask(CallService(service="/lamp"), print)
    with pytest.raises(ProtocolError, match="/lamp cannot be called: 1000 calls wait"):
        session.ask(CallService(service="/lamp"), print)


def with_action():
    session, fed, ended = ServerSession(), [], []
    session.advertise_action(AdvertiseAction(action="dock", type="dock_msgs/Dock"))
    goal = SendActionGoal(action="/dock", action_type="dock_msgs/Dock", args=Raw(b"[1]"), id="callers")
    return session, session.hand_goal(goal, fed.append, ended.append), fed, ended


def test_a_goal_is_handed_to_a_client_under_an_id_of_the_servers_own():
    session, op, fed, ended = with_action()
    assert (op.id, op.action_type, bytes(op.args), op.feedback) == (
        "action_goal:/dock:1",
        "dock_msgs/Dock",
        b"[1]",
        True,
    )
    assert session.on_feedback(ActionFeedback(id=op.id, action="/dock"))
    assert session.cancel_handed(op.id) == CancelActionGoal(id=op.id, action="/dock")
    assert session.on_result(ActionResult(id=op.id, action="/dock", status=5))
    assert session.cancel_handed(op.id) is None
    assert (len(fed), [each.status for each in ended]) == (1, [5])


def test_whose_goal_is_with_an_action_that_is_gone_is_told():
    session, op, _, ended = with_action()
    assert session.unadvertise_action(UnadvertiseAction(action="dock")) == "/dock"
    assert (ended, session.actions) == ([None], {})
    assert not session.on_result(ActionResult(id=op.id, action="/dock"))
    session.unadvertise_action(UnadvertiseAction(action="/never"))


def test_a_clients_own_goals_are_known_by_its_ids_until_they_are_over():
    session = ServerSession()
    goal = SendActionGoal(action="dock", id=7)
    session.begin_goal(msgspec.structs.replace(goal, args=Raw(b'{"of a frame":"that is kept otherwise"}')))
    assert session.goal_to_cancel(CancelActionGoal(action="/dock", id=7)) == goal
    assert session.end_goal(7) == goal
    assert session.end_goal(7) is None
    session.begin_goal(goal)


@pytest.mark.parametrize(
    "cancel", [CancelActionGoal(action="/dock", id=8), CancelActionGoal(action="/fly", id=7)]
)
def test_only_a_goal_that_is_under_way_can_be_taken_back(cancel):
    session = ServerSession()
    session.begin_goal(SendActionGoal(action="/dock", id=7))
    with pytest.raises(ProtocolError, match=f'No goal of "{cancel.action}" with this id is under way'):
        session.goal_to_cancel(cancel)


def test_two_goals_of_one_id_and_too_many_are_refused():
    session = ServerSession()
    session.begin_goal(SendActionGoal(action="/dock", id="g"))
    session.begin_goal(SendActionGoal(action="/dock"))
    for op, id in ((SendActionGoal(action="/fly", id="g"), '"g"'), (SendActionGoal(action="/fly"), "null")):
        with pytest.raises(ProtocolError, match=f"A goal with the id {id} is under way already"):
            session.begin_goal(op)
    for number in range(module.MAX_GOALS - 2):
        session.begin_goal(SendActionGoal(action="/dock", id=number))
    with pytest.raises(ProtocolError, match="A client may have at most 100 goals under way"):
        session.begin_goal(SendActionGoal(action="/dock", id="more"))


@pytest.mark.parametrize(
    ("method", "op"),
    [
        ("subscribe", Subscribe(topic="")),
        ("subscribe", Subscribe(topic="/a", id="x" * 2000)),
        ("advertise", Advertise(topic="x" * 300)),
        ("advertise", Advertise(topic="/a", id="x" * 2000)),
        ("advertise_service", AdvertiseService(service="")),
        ("advertise_action", AdvertiseAction(action="x" * 300)),
        ("begin_goal", SendActionGoal(action="", id=1)),
        ("begin_goal", SendActionGoal(action="/a", id="x" * 2000)),
    ],
)
def test_a_name_or_id_that_cannot_be_kept_is_refused(method, op):
    with pytest.raises(ProtocolError, match="characters, not") as caught:
        getattr(ServerSession(), method)(op)
    assert caught.value.op == op.__struct_config__.tag


def test_remarks_are_sent_only_to_who_asked_for_them():
    session = ServerSession()
    assert not session.wants("error")
    session.set_level(SetLevel(level="warning"))
    assert [session.wants(level) for level in ("info", "warning", "error")] == [False, True, True]
    session.set_level(SetLevel(level="none"))
    assert not session.wants("error")
    with pytest.raises(ProtocolError, match='level must be one of info, warning, error, none, not "loud"'):
        session.set_level(SetLevel(level="loud"))
    assert session.level == "none"


def test_a_vanished_client_leaves_nothing_but_its_goals():
    session, _, answers = with_service()
    ended = []
    session.subscribe(Subscribe(topic="/odom"))
    session.advertise(Advertise(topic="/a"))
    session.advertise_action(AdvertiseAction(action="/dock"))
    session.hand_goal(SendActionGoal(action="/dock"), None, ended.append)
    mine = SendActionGoal(action="/fly", id=1)
    session.begin_goal(mine)
    assert session.on_lost() == [mine]
    assert (answers, ended) == ([None], [None])
    kept = (session.subscriptions, session.advertised, session.services, session.actions, session.goals)
    assert kept == ({},) * 5
    assert session.on_lost() == []


def test_a_client_has_a_hundred_goals_under_way_at_most_and_each_id_once():
    session = ServerSession()
    for number in range(module.MAX_GOALS):
        session.begin_goal(SendActionGoal(action="/dock", id=number))
    with pytest.raises(ProtocolError, match="A goal with the id 7 is under way already"):
        session.begin_goal(SendActionGoal(action="/fly", id=7))
    with pytest.raises(ProtocolError, match="at most 100 goals under way"):
        session.begin_goal(SendActionGoal(action="/dock", id="one too many"))
    session.end_goal(7)
    session.begin_goal(SendActionGoal(action="/dock", id="one too many"))


def test_who_is_gone_leaves_no_unfinished_texts():
    session = ServerSession()
    session.receive('{"op": "fragment", "id": "f", "data": "x", "num": 0, "total": 2}', 0.0)
    session.on_lost()
    assert session.expire(100.0) == []
