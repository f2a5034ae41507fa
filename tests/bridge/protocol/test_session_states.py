"""Whatever a client says and in whatever order, its session stays what a plain account of it gives."""

from __future__ import annotations

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    Bundle,
    RuleBasedStateMachine,
    consumes,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)
from msgspec import UNSET

from bridge.core.compat import Compat
from bridge.core.errors import ProtocolError
from bridge.protocol import (
    COMPRESSIONS,
    ActionFeedback,
    ActionResult,
    Advertise,
    AdvertiseService,
    CallService,
    Publish,
    Reduction,
    SendActionGoal,
    ServerSession,
    ServiceResponse,
    Subscribe,
    Unadvertise,
    UnadvertiseService,
    Unsubscribe,
    client_subscriptions,
)
from bridge.protocol import server_session as module

ROOM = 6
"""Stands in for the thousand subscriptions and advertisements, so that the end is often met."""
TOPIC = st.sampled_from(["/a", "a", "/b", "c"])
ID = st.sampled_from(["x", "y", 1, None, UNSET])
SIZE = st.sampled_from([UNSET, None, 100, 200.0, 300])
COMPATS = st.sampled_from([Compat(), Compat.strict()])


def absolute(name):
    return name if name.startswith("/") else "/" + name


class Wishes(RuleBasedStateMachine):
    """Subscriptions and advertisements, with a list of them as the account."""

    def __init__(self):
        super().__init__()
        self.session = ServerSession()
        self.asked = []
        self.sticky = None
        self.offered = []
        self.services = set()

    @rule(compat=COMPATS)
    @precondition(lambda self: not self.asked and self.sticky is None)
    def choose_habits(self, compat):
        self.session.compat = self.session._subscriptions.compat = compat

    @rule(
        topic=TOPIC,
        id=ID,
        rate=st.sampled_from([0, 50, None, 100.0]),
        length=st.sampled_from([0, 1, 5]),
        size=SIZE,
        compression=st.sampled_from(COMPRESSIONS),
        reduce=st.sampled_from([None, Reduction(beams=5), Reduction(beams=9)]),
    )
    def subscribe(self, topic, id, rate, length, size, compression, reduce):
        op = Subscribe(
            topic=topic,
            id=id,
            throttle_rate=rate,
            queue_length=length,
            fragment_size=size,
            compression=compression,
            reduce=reduce,
        )
        self.say_size(size)
        self.session.note(op)
        old = [each for each in self.asked if (absolute(each.topic), each.id) == (absolute(topic), id)]
        if not old and len(self.asked) >= ROOM:
            with pytest.raises(ProtocolError):
                self.session.subscribe(op)
            return
        self.session.subscribe(op)
        if old:
            self.asked[self.asked.index(old[0])] = op
        else:
            self.asked.append(op)

    @rule(topic=TOPIC, id=ID)
    def unsubscribe(self, topic, id):
        self.session.unsubscribe(Unsubscribe(topic=topic, id=id))
        self.asked = [
            each
            for each in self.asked
            if absolute(each.topic) != absolute(topic) or (id not in (None, UNSET) and each.id != id)
        ]

    @rule(size=SIZE)
    def say_size(self, size):
        self.session.note(Publish(topic="/any", fragment_size=size))
        if size is not UNSET:
            self.sticky = size

    @rule(topic=TOPIC, id=ID)
    def advertise(self, topic, id):
        new = (absolute(topic), id) not in self.offered
        if new and len(self.offered) + len(self.services) >= ROOM:
            with pytest.raises(ProtocolError):
                self.session.advertise(Advertise(topic=topic, id=id))
            return
        self.session.advertise(Advertise(topic=topic, id=id))
        if new:
            self.offered.append((absolute(topic), id))

    @rule(topic=TOPIC, id=ID)
    def unadvertise(self, topic, id):
        self.session.unadvertise(Unadvertise(topic=topic, id=id))
        self.offered = [
            (name, each)
            for name, each in self.offered
            if name != absolute(topic) or (id not in (None, UNSET) and each != id)
        ]

    @rule(service=TOPIC)
    def serve(self, service):
        if absolute(service) not in self.services and len(self.offered) + len(self.services) >= ROOM:
            with pytest.raises(ProtocolError):
                self.session.advertise_service(AdvertiseService(service=service))
            return
        self.session.advertise_service(AdvertiseService(service=service))
        self.services.add(absolute(service))

    @rule(service=TOPIC)
    def stop_serving(self, service):
        self.session.unadvertise_service(UnadvertiseService(service=service))
        self.services.discard(absolute(service))

    @rule()
    def vanish(self):
        self.session.on_lost()
        self.asked, self.offered, self.services = [], [], set()

    @invariant()
    def deliveries_are_those_of_the_account(self):
        by_topic = {}
        for op in self.asked:
            by_topic.setdefault(absolute(op.topic), []).append(op)
        assert set(self.session.subscriptions) == set(by_topic)
        for topic, ops in by_topic.items():
            wanted = self.session.subscriptions[topic]
            lengths = [op.queue_length for op in ops]
            reductions = {op.reduce for op in ops}
            assert wanted.period == min(op.throttle_rate or 0 for op in ops) / 1000
            assert wanted.compression == max((op.compression for op in ops), key=COMPRESSIONS.index)
            assert wanted.reduction == (reductions.pop() if len(reductions) == 1 else None)
            assert wanted.fragment_size == self.cut([op.fragment_size for op in ops])
            if self.session.compat.shortest_queue:
                assert wanted.queue == min(lengths)
            else:
                assert wanted.queue == (0 if 0 in lengths else max(lengths))

    def cut(self, sizes):
        own = [size for size in sizes if size not in (None, UNSET)]
        if not self.session.compat.sticky_fragment_size:
            return min(own, default=None)
        return None if self.sticky is None else min([self.sticky, *own])

    @invariant()
    def offers_are_those_of_the_account(self):
        offered = [(topic, id) for topic, ids in self.session.advertised.items() for id in ids]
        assert sorted(offered, key=repr) == sorted(self.offered, key=repr)
        assert set(self.session.services) == self.services


class Errands(RuleBasedStateMachine):
    """Calls and goals that a client is given: each is answered once, or its asker is told that it never will be."""

    calls = Bundle("calls")
    goals = Bundle("goals")

    def __init__(self):
        super().__init__()
        self.session = ServerSession()
        self.session.advertise_service(AdvertiseService(service="/s"))
        self.told = {}
        self.open = set()

    def listener(self, op_id):
        return lambda answer: self.told.setdefault(op_id[0], []).append(answer)

    @rule(target=calls)
    def call(self):
        name = []
        op = self.session.ask(CallService(service="s"), self.listener(name))
        name.append(op.id)
        assert op.id not in self.told
        self.open.add(op.id)
        return op.id

    @rule(target=goals, feedback=st.booleans())
    def hand(self, feedback):
        name = []
        op = self.session.hand_goal(
            SendActionGoal(action="a"), (lambda _: None) if feedback else None, self.listener(name)
        )
        name.append(op.id)
        self.open.add(op.id)
        return op.id

    @rule(id=consumes(calls) | st.just("service_request:/s:999"))
    def answer(self, id):
        assert self.session.on_response(ServiceResponse(id=id, service="/s")) == (id in self.open)
        self.open.discard(id)

    @rule(id=goals)
    def feed_back(self, id):
        if self.session.on_feedback(ActionFeedback(id=id, action="/a")):
            assert id in self.open

    @rule(id=goals)
    def cancel(self, id):
        assert (self.session.cancel_handed(id) is not None) == (id in self.open)

    @rule(id=goals)
    def finish(self, id):
        assert self.session.on_result(ActionResult(id=id, action="/a")) == (id in self.open)
        self.open.discard(id)

    @rule(id=calls)
    def wait_no_longer(self, id):
        if self.session.forget_call(id):
            assert id in self.open
            self.open.discard(id)
            self.told[id] = ["forgotten"]

    @rule()
    def lose(self):
        self.session.on_lost()
        assert all(self.told[id][-1] is None for id in self.open)
        self.open.clear()

    @invariant()
    def nobody_is_told_twice_or_kept_waiting(self):
        assert all(len(answers) == 1 for answers in self.told.values())
        assert not self.open & set(self.told)


@pytest.fixture(autouse=True)
def _little_room(monkeypatch):
    monkeypatch.setattr(client_subscriptions, "MAX_SUBSCRIPTIONS", ROOM)
    monkeypatch.setattr(module, "MAX_ADVERTISED", ROOM)


FEW = settings(max_examples=60, stateful_step_count=30, deadline=None)


def run(machine):
    run_state_machine_as_test(machine, settings=FEW)


def test_what_a_client_wants_and_offers_is_what_it_said():
    run(Wishes)


def test_whoever_asks_a_client_for_something_hears_once_how_it_ended():
    run(Errands)
