"""Real frames, damaged in every way that a program or a line can think of: nothing but ProtocolError comes of them.

The damage is drawn with a fixed seed, so that what fails here fails again.
"""

from __future__ import annotations

import json
import random

import cbor2
import pytest

from bridge.core.errors import ProtocolError
from bridge.msgs.pilothouse_msgs import CommandRequest
from bridge.protocol import (
    ActionFeedback,
    ActionResult,
    Advertise,
    AdvertiseAction,
    AdvertiseService,
    BinaryPublish,
    CallService,
    CancelActionGoal,
    ClientSession,
    Op,
    SendActionGoal,
    ServerSession,
    ServiceResponse,
    SetLevel,
    Subscribe,
    Unadvertise,
    UnadvertiseAction,
    UnadvertiseService,
    Unsubscribe,
    arguments,
    client_session,
    client_subscriptions,
    complaint,
    encode,
    goal_status,
    server_session,
    service_and_id,
    split,
    to_png,
    too_deep,
)
from tests.bridge.protocol.spoken import EVERY_OP, FROM_CLIENTS, FROM_SERVERS

LIMIT = 50_000
FRAMES = 3_000
LONG = encode(EVERY_OP[3]) + encode(EVERY_OP[12])
WHOLE = [
    *(text.encode() for text in (FROM_CLIENTS | FROM_SERVERS).values()),
    *(encode(op) for op in EVERY_OP),
    *split(LONG, 40, "long"),
    encode(to_png(LONG)),
    *split(encode(to_png(LONG)), 100, "picture"),
    cbor2.dumps({"op": "publish", "topic": "/a", "msg": {"data": [1.5, b"x", {"a": None}]}}),
    cbor2.dumps({"op": "publish", "topic": "/a", "msg": cbor2.CBORTag(85, bytes(16))}),
]
ODD = [
    b"null", b"true", b"-1", b"0", b"1e999", b"-0.0", b"NaN", b"-Infinity", b"9" * 400, b"1.5", b'""', b"[]", b"{}", b"[[",
    b"{", b"}", b'"', b"\\", b",", b":", b"\\ud800", b"\xff\xfe", b"\0", b'"op":"png",', b'"id":[1],', b'"total":0,',
    b'"fragment_size":-1,', b"{}" * 5, b"[" * 3000, '"é😀"'.encode(), b"\xd8\x1c\x81\xd8\x1d\x00", b"\x9f\x9f", b"\xbf",
]  # fmt: skip


def damaged(frame, rng):
    """The frame after one to four accidents."""
    for _ in range(rng.randint(1, 4)):
        place, end = sorted(rng.randrange(len(frame) + 1) for _ in range(2))
        odd, other = rng.choice(ODD), rng.choice(WHOLE)
        accidents = [
            frame[:place],
            frame[:place] + frame[end:],
            frame[:place] + odd + frame[place:],
            frame[:place] + odd + frame[end:],
            frame[:place] + rng.randbytes(rng.randint(1, 3)) + frame[place + 1 :],
            frame[:end] + frame[place:],
            frame + other,
            swapped(frame, rng),
            swapped(frame, rng),
        ]
        frame = rng.choice(accidents)
    return frame[: 2 * LIMIT]


def swapped(frame, rng):
    """The same object with one value in another's place, or with a value of another kind."""
    try:
        obj = json.loads(frame)
        fields = list(obj)
    except (ValueError, TypeError, RecursionError):
        return frame
    if not isinstance(obj, dict) or not fields:
        return frame
    odd = [None, True, 0, -1, 1.5, 10**30, "", "x" * 2000, [], [1], {}, {"a": [None]}, *obj.values()]
    obj[rng.choice(fields)] = rng.choice(odd)
    return json.dumps(obj).encode()


def use_at_server(session, op):
    """Do with an operation what a server does with it."""
    if isinstance(op, CallService):
        service_and_id(op)
        session.answer_size(op)
        arguments(op.args, CommandRequest)
        session.ask(op, lambda _: None)
    elif isinstance(op, SendActionGoal):
        session.begin_goal(op)
        session.hand_goal(op, None, lambda _: None)
    elif isinstance(op, CancelActionGoal):
        session.goal_to_cancel(op)
        session.cancel_handed(op.id)
    elif isinstance(op, ActionResult):
        goal_status(op)
        session.end_goal(op.id)
        session.on_result(op)
    else:
        hear = {
            Subscribe: session.subscribe,
            Unsubscribe: session.unsubscribe,
            Advertise: session.advertise,
            Unadvertise: session.unadvertise,
            AdvertiseService: session.advertise_service,
            UnadvertiseService: session.unadvertise_service,
            AdvertiseAction: session.advertise_action,
            UnadvertiseAction: session.unadvertise_action,
            ServiceResponse: session.on_response,
            ActionFeedback: session.on_feedback,
            SetLevel: session.set_level,
        }.get(type(op), lambda _: None)
        hear(op)


def use_at_client(session, op):
    """Do with an operation what a client does with it."""
    if isinstance(op, ActionResult):
        goal_status(op)
    hear = {
        CallService: session.called,
        SendActionGoal: session.goal_given,
        CancelActionGoal: session.goal_cancelled,
        ServiceResponse: session.on_response,
        ActionFeedback: session.on_feedback,
        ActionResult: session.on_result,
    }.get(type(op), lambda _: None)
    hear(op)


def a_client():
    session = ClientSession(limit_bytes=LIMIT)
    session.serve("/lamp", "std_srvs/SetBool", lambda _: None)
    session.provide("/fib", "test_msgs/Fibonacci", lambda _: None, lambda _: None)
    return session


SIDES = {
    "server": (lambda: ServerSession(limit_bytes=LIMIT), use_at_server),
    "client": (a_client, use_at_client),
}


def trouble(session, use, arrival):
    """What was wrong with an arrival, found in the frame or when it is used; None when nothing was."""
    if isinstance(arrival, (ProtocolError, BinaryPublish)):
        return arrival if isinstance(arrival, ProtocolError) else None
    assert isinstance(arrival, Op)
    try:
        encode(arrival)
        use(session, arrival)
    except ProtocolError as error:
        return error
    return None


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("seed", [1, 2])
def test_nothing_but_a_protocol_error_comes_of_damaged_frames(side, seed):
    rng = random.Random(seed)
    make, use = SIDES[side]
    session, taken, errors = make(), 0, 0
    for number in range(FRAMES):
        frame = damaged(rng.choice(WHOLE), rng)
        arrivals = session.receive(frame, now=number / 10)
        for each in arrivals:
            error = trouble(session, use, each)
            if error is None:
                taken += 1
            else:
                errors += 1
                assert len(encode(complaint(error))) < 8000
                assert str(error).endswith(".")
    assert taken > 400
    assert errors > 400
    session.on_lost()


def test_what_is_remembered_stays_bounded_whatever_comes(monkeypatch):
    monkeypatch.setattr(client_subscriptions, "MAX_SUBSCRIPTIONS", 5)
    for name in ("MAX_ADVERTISED", "MAX_CALLS", "MAX_GOALS"):
        monkeypatch.setattr(server_session, name, 5)
    monkeypatch.setattr(client_session, "MAX_GOALS", 5)
    session, rng = ServerSession(limit_bytes=2000), random.Random(3)
    for number in range(1500):
        kept = (session.goals, session.services, session.actions)
        for each in session.receive(damaged(rng.choice(WHOLE), rng), now=0.0):
            if isinstance(each, Op):
                try:
                    use_at_server(session, each)
                except ProtocolError:
                    continue
        assert all(len(each) <= 5 for each in kept), number
        assert len(session.subscriptions) <= 5
        assert sum(map(len, session.advertised.values())) <= 5


@pytest.mark.parametrize("length", range(0, 400, 7))
def test_a_frame_cut_off_anywhere_is_an_error_and_not_an_operation(length):
    whole = FROM_CLIENTS["roslibpy sends a goal"].encode()
    (found,) = ServerSession().receive(whole[: min(length, len(whole) - 1)], 0.0)
    assert isinstance(found, ProtocolError)


@pytest.mark.parametrize(
    "frame", [b"[" * 100_000, b'{"op":' * 30_000, b'{"op":"publish","topic":"/a","msg":' + b"[" * 100_000]
)
def test_what_is_deep_is_not_looked_into(frame):
    assert too_deep(frame)
    (found,) = ServerSession().receive(frame, 0.0)
    assert isinstance(found, ProtocolError)
