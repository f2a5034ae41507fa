"""The client's side of the protocol, without I/O: subscriptions, advertisements, pending calls and goals."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeVar

import msgspec
from msgspec import UNSET, Raw

from bridge.codec import shown
from bridge.msgs import Msg
from bridge.protocol.arrivals import Arrival, Arrivals
from bridge.protocol.names import absolute, checked_id, ros2_name, service_and_id, wrong
from bridge.protocol.ops import (
    ActionFeedback,
    ActionResult,
    Advertise,
    AdvertiseAction,
    AdvertiseService,
    CallService,
    CancelActionGoal,
    Id,
    Op,
    SendActionGoal,
    ServiceResponse,
    SetLevel,
    Subscribe,
    Unadvertise,
    UnadvertiseAction,
    UnadvertiseService,
    Unsubscribe,
)
from bridge.protocol.pending import Answer, Calls, Feedback, Goals, Result

__all__ = ["MAX_CLIENT_FRAME", "ClientSession", "Given", "Provided", "Served", "Subscription"]

AnyOp = TypeVar("AnyOp", bound=Op)
MAX_CLIENT_FRAME = 33_554_432
"""The largest frame that a client takes, as for a big map, and the most that may wait in fragments [byte]."""
_MAX_FILTERED_BYTES = 1_048_576
"""Bytes in filtered rows of pictures that a client reads of a frame: it gets what it asked for."""
_MAX_VALUES = 250_000
"""Most values in one binary frame to a client, a number array counted as one: a path of some thousand poses."""
MAX_CALLS = 1000
"""Most calls that wait for their answer."""
MAX_GOALS = 1000
"""Most goals under way, and as many to carry out."""


@dataclass(frozen=True, slots=True)
class Subscription:
    """One subscription of a client, kept over reconnects."""

    op: Subscribe
    type: type[Msg]
    callback: Callable[[Any, float], object]
    """Takes the message and when it was received [s], the client's clock."""


@dataclass(frozen=True, slots=True)
class Served:
    """One service that a client answers, kept over reconnects."""

    op: AdvertiseService
    call: Callable[[CallService], object]
    """Takes the call; the answer goes out with its `id` and `service`."""


@dataclass(frozen=True, slots=True)
class Provided:
    """One action that a client carries goals out of, kept over reconnects."""

    op: AdvertiseAction
    start: Callable[[SendActionGoal], object]
    """Takes the goal; feedback and result are sent with its `id` and `action`."""
    cancel: Callable[[Id], object]
    """Takes the id of a goal that is cancelled, or whose sender is gone."""


@dataclass(frozen=True, slots=True)
class Given:
    """A goal that the server gave to a client."""

    op: SendActionGoal
    provided: Provided


class ClientSession:
    """The state of a client.

    Subscriptions and advertisements are kept for ever, calls and goals until answered or until the connection is
    lost.
    """

    def __init__(self, *, limit_bytes: int = MAX_CLIENT_FRAME) -> None:
        """`limit_bytes` bounds a frame, the waiting fragments, and the unpacked content of one frame [byte]."""
        self.subscriptions: dict[str, dict[Id, Subscription]] = {}
        """By topic and id."""
        self.advertised: dict[str, Advertise] = {}
        """By topic."""
        self.services: dict[str, Served] = {}
        """By absolute name."""
        self.actions: dict[str, Provided] = {}
        """By absolute name."""
        self.given: dict[Id, Given] = {}
        """Goals to carry out, by the id that the server gave them."""
        self.level: str | None = None
        """Level of remarks that the server is asked for on a new connection; None for not asking."""
        self.ros2 = False
        """Whether the server's types are spelled `pkg/msg/Type`; operations to send are then spelled so."""
        self.calls = Calls("call", MAX_CALLS)
        """Calls until answered."""
        self.goals = Goals("goal", MAX_GOALS)
        """Goals of this client until their result."""
        self._limit = limit_bytes
        self._arrivals = self._nothing_yet()
        self._numbers = itertools.count(1)

    def receive(self, frame: str | bytes, now: float) -> list[Arrival]:
        """The operations in a frame that came at `now` [s], any clock that only goes forward; never raises.

        A fault stands among them as a ProtocolError. Fragments and pictures are unpacked.
        """
        return self._arrivals.receive(frame, now)

    def subscribe(
        self, op: Subscribe, type: type[Msg], callback: Callable[[Any, float], object]
    ) -> tuple[Subscribe, Unsubscribe]:
        """Add a subscription; returns the operation to send now and the one to send at its end."""
        named = msgspec.structs.replace(op, id=f"subscribe:{op.topic}:{next(self._numbers)}")
        self.subscriptions.setdefault(op.topic, {})[named.id] = Subscription(named, type, callback)
        return self._spelled(named), Unsubscribe(topic=op.topic, id=named.id)

    def unsubscribe(self, op: Unsubscribe) -> bool:
        """Remove a subscription; False when it was removed before."""
        of_topic = self.subscriptions.get(op.topic, {})
        known = of_topic.pop(op.id, None) is not None
        if not of_topic:
            self.subscriptions.pop(op.topic, None)
        return known

    def subscribers(self, topic: str) -> list[Subscription]:
        """The subscriptions of `topic`."""
        return list(self.subscriptions.get(topic, {}).values())

    def advertise(self, topic: str, type: type[Msg], *, latch: bool = False) -> Advertise:
        """Add an advertisement of `topic`; returns the operation to send now."""
        op = Advertise(topic=topic, type=type.MSGTYPE, latch=latch, id=f"advertise:{topic}")
        self.advertised[topic] = op
        return self._spelled(op)

    def unadvertise(self, topic: str) -> Unadvertise | None:
        """Remove an advertisement; returns the operation to send, None when there was none."""
        op = self.advertised.pop(topic, None)
        return None if op is None else Unadvertise(topic=topic, id=op.id)

    def call(self, service: str, args: bytes, answer: Answer, *, timeout: float | None = None) -> CallService:
        """Add a call; returns the operation to send. ProtocolError when too many wait for their answer.

        `answer` is called once at most, with None when the connection is lost first. `timeout` is how long the server
        may wait for the provider [s].
        """
        return self.calls.ask(CallService(service=service, args=Raw(args), timeout=timeout), answer)

    def on_response(self, op: ServiceResponse) -> bool:
        """Pass a response to its caller; False when none waits for it."""
        return self.calls.on_response(op)

    def serve(self, service: str, type: str, call: Callable[[CallService], object]) -> AdvertiseService:
        """Add a service of ROS type `type`; returns the operation to send now."""
        op = AdvertiseService(service=service, type=type)
        self.services[absolute(service)] = Served(op, call)
        return self._spelled(op)

    def stop_serving(self, service: str) -> UnadvertiseService | None:
        """Remove a service; returns the operation to send, None when there was none."""
        served = self.services.pop(absolute(service), None)
        return None if served is None else UnadvertiseService(service=served.op.service)

    def called(self, op: CallService) -> None:
        """Pass a call of the server to its service. ProtocolError when there is none."""
        served = self.services.get(service_and_id(op)[0])
        if served is None:
            raise wrong(op, f"This client has no service {shown(op.service)}.")
        served.call(op)

    def goal(
        self, action: str, type: str, args: bytes, feedback: Feedback | None, result: Result
    ) -> SendActionGoal:
        """Add a goal for the server; returns the operation to send. ProtocolError when too many are under way.

        `feedback` is called with each feedback, None for not asking; `result` once at most, with None when the
        connection is lost first.
        """
        op = SendActionGoal(action=action, action_type=type, args=Raw(args))
        return self._spelled(self.goals.send(op, feedback, result))

    def cancel(self, id: Id) -> CancelActionGoal | None:
        """The operation that cancels a goal; its result is still to come. None when it is not under way."""
        return self.goals.cancel(id)

    def on_feedback(self, op: ActionFeedback) -> bool:
        """Pass feedback on to the goal's sender; False when it is not wanted."""
        return self.goals.on_feedback(op)

    def on_result(self, op: ActionResult) -> bool:
        """Pass a result on to the goal's sender; False when none waits for it."""
        return self.goals.on_result(op)

    def provide(
        self,
        action: str,
        type: str,
        start: Callable[[SendActionGoal], object],
        cancel: Callable[[Id], object],
    ) -> AdvertiseAction:
        """Add an action of ROS type `type`; returns the operation to send now."""
        op = AdvertiseAction(action=action, type=type)
        self.actions[absolute(action)] = Provided(op, start, cancel)
        return self._spelled(op)

    def stop_providing(self, action: str) -> UnadvertiseAction | None:
        """Remove an action; returns the operation to send, None when there was none. Goals under way continue."""
        provided = self.actions.pop(absolute(action), None)
        return None if provided is None else UnadvertiseAction(action=provided.op.action)

    def goal_given(self, op: SendActionGoal) -> None:
        """Pass a goal of the server to its action.

        ProtocolError when there is none, when a goal with that id is under way already, or when there are too many.
        """
        provided = self.actions.get(absolute(op.action))
        if provided is None:
            raise wrong(op, f"This client has no action {shown(op.action)}.")
        id = checked_id(op)
        if id in self.given:
            raise wrong(op, f"A goal with the id {shown(None if id is UNSET else id)} is under way already.")
        if len(self.given) >= MAX_GOALS:
            raise wrong(op, f"At most {MAX_GOALS} goals may be under way.")
        self.given[id] = Given(op, provided)
        provided.start(op)

    def goal_cancelled(self, op: CancelActionGoal) -> bool:
        """Cancel a goal of the server; False when it is not under way."""
        given = self.given.get(op.id)
        if given is not None:
            given.provided.cancel(op.id)
        return given is not None

    def goal_ended(self, id: Id) -> bool:
        """Remove a goal of the server; False when it was removed before."""
        return self.given.pop(id, None) is not None

    def on_lost(self) -> None:
        """End everything that belongs to the lost connection: answers, unfinished fragments, goals of the server."""
        self._arrivals = self._nothing_yet()
        given, self.given = self.given, {}
        with contextlib.ExitStack() as stack:
            for each in reversed(given.values()):
                stack.callback(each.provided.cancel, each.op.id)
            stack.callback(self.goals.fail_all)
            stack.callback(self.calls.fail_all)

    def opening(self) -> Iterator[Op]:
        """All operations to send on a new connection."""
        if self.level is not None:
            yield SetLevel(level=self.level)
        for advertised in list(self.advertised.values()):
            yield self._spelled(advertised)
        for served in list(self.services.values()):
            yield self._spelled(served.op)
        for provided in list(self.actions.values()):
            yield self._spelled(provided.op)
        for of_topic in list(self.subscriptions.values()):
            for subscription in list(of_topic.values()):
                yield self._spelled(subscription.op)

    def _nothing_yet(self) -> Arrivals:
        return Arrivals(self._limit, filtered=_MAX_FILTERED_BYTES, most_values=_MAX_VALUES)

    def _spelled(self, op: AnyOp) -> AnyOp:
        """The operation with its type as the server spells types."""
        if not self.ros2:
            return op
        if isinstance(op, SendActionGoal):
            return msgspec.structs.replace(op, action_type=ros2_name(op.action_type, "action"))
        kind = (
            "srv"
            if isinstance(op, AdvertiseService)
            else "action"
            if isinstance(op, AdvertiseAction)
            else "msg"
        )
        if isinstance(op, (Subscribe, Advertise, AdvertiseService, AdvertiseAction)) and op.type:
            return msgspec.structs.replace(op, type=ros2_name(op.type, kind))
        return op
