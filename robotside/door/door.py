"""The door itself: who may publish, call, run and subscribe, how often, for how long, and the sentences of refusal."""

from __future__ import annotations

import itertools
import logging
from collections.abc import Awaitable, Callable, Hashable, Iterable
from functools import partial
from typing import Any

from bridge.codec import shown
from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import STRANGER, Role
from bridge.core.robot_catalogue import Action, Operator, Service
from bridge.core.robot_door import Callback
from bridge.core.topics import TOPICS, Topic
from bridge.msgs import Msg
from robotside.core.bus import Bus
from robotside.core.topic_demand import Demand
from robotside.door.calls_in_progress import CallsInProgress
from robotside.door.gate import OPEN, Gate, check_role, who_comes
from robotside.services.audit_trail import AuditTrail

__all__ = ["URGENT", "Door"]

log = logging.getLogger(__name__)

URGENT = frozenset(
    {"/stop", "/stop/hold", "/stop/release"}
    | {f"/control/{what}" for what in ("acquire", "release", "request", "grant", "object")}
)
"""Services whose calls are always taken and whose answers go before everything else."""


def _ignore(*_: object) -> None:
    """What is done where nothing is to be done."""


class Door:
    """One robot's topics, services and actions for the operators of all gateways; belongs to one thread."""

    def __init__(
        self,
        *,
        services: Iterable[Service] = (),
        actions: Iterable[Action] = (),
        topics: Iterable[Topic] = TOPICS,
        pictures: Iterable[str] = (),
        bus: Bus | None = None,
        gate: Gate = OPEN,
        trail: AuditTrail | None = None,
        now: Callable[[], float] = float,
        on_message: Callable[[Any, str, Any, float | None], str | None] = _ignore,
        on_demand: Callable[[str, bool], None] = _ignore,
        on_gone: Callable[[Any], None] = _ignore,
    ) -> None:
        """The robot publishes on `bus`, also the topics of its `pictures`; `now` is the operators' clock [s].

        `on_message(operator, topic, msg, stamp)` takes what operators publish and gives why it is not obeyed, `on_demand(topic, wanted)` is called when
        the first asker comes who wants a topic and when the last one left, `on_gone(operator)` when an operator left.
        `gate` knows who may do what; without one everybody may do everything. What is refused at the door is recorded in `trail`.
        """
        self.services = {service.name: service for service in services}
        """By absolute name."""
        self.actions = {action.name: action for action in actions}
        """By absolute name."""
        self.topics = {topic.name: topic for topic in topics}
        """The robot's own, by absolute name."""
        self._pictures = frozenset(pictures)
        self.now = now
        """The operators' clock [s]."""
        self._on_message, self._on_gone = on_message, on_gone
        self._bus, self._gate, self._trail = bus or Bus(), gate, trail
        self._demand = Demand(on_demand)
        self._numbers = itertools.count(1)
        self._operators: set[Operator] = set()
        self._calls = CallsInProgress()
        self._subscriptions: dict[Hashable, dict[object, tuple[str, Callable[[], object]]]] = {}
        """By asker, its subscriptions: the topic and the call that ends the messages."""
        self._listeners: dict[str, dict[object, Callback]] = {
            topic.name: {} for topic in self.topics.values() if topic.to == "robot"
        }
        """By topic to the robot, who else wants its messages."""

    @property
    def connected(self) -> set[str]:
        """Ids of the people who are here and have proven it."""
        return {each.identity.id for each in self._operators if each.identity.proven}

    def service(self, name: str) -> Service:
        """The service of that name; raises Refused when there is none."""
        known = self.services.get(name)
        if known is None:
            raise Refused(f"This robot has no service {shown(name)}.")
        return known

    def action(self, name: str) -> Action:
        """The action of that name; raises Refused when there is none."""
        known = self.actions.get(name)
        if known is None:
            raise Refused(f"This robot has no action {shown(name)}.")
        return known

    def join(
        self,
        address: str,
        *,
        way: str = "",
        secure: bool = False,
        token: str = "",
        trusted: bool = True,
        role: Role | None = None,
        client: str = "",
        forgeable: bool = False,
    ) -> Operator:
        """A client came from `address`, `HOST:PORT`; the operator that it is from now on, with an id that no other has.

        It came by the gateway `way`, over TLS when `secure`, and showed `token`, empty for none. One that is not `trusted` never
        counts as a program of this machine: a web page may have opened it. `role` is that of everybody who comes that way
        without a token, None where the address decides. `client` is its name where the address is that of a broker with many
        behind it: wrong tokens count for each of them, and apart for `forgeable` addresses, as of UDP. Raises Refused for a wrong token.
        """
        try:
            identity = who_comes(
                self._gate, address, token, trusted=trusted, role=role, client=client, forgeable=forgeable
            )
        except Refused as refusal:
            if self._trail:
                self._trail.unknown(address, way, refusal)
            raise
        number = str(next(self._numbers))
        operator = Operator(number, address, self.now(), identity=identity, way=way, secure=secure)
        self._operators.add(operator)
        if token and self._trail:
            self._trail.did(operator, "auth")
        return operator

    def authenticate(self, operator: Operator, token: str) -> None:
        """`operator` shows its token after it has joined; raises Refused for a wrong one.

        Who is somebody else from now on has nothing of who it was: control that it had is free.
        """
        try:
            identity = self._gate.identify(token, operator.address)
        except Refused as refusal:
            if self._trail:
                self._trail.refused(operator, "auth", refusal)
            raise
        if operator in self._operators and identity != operator.identity:
            self._on_gone(operator)
            operator.identity = identity
        if self._trail:
            self._trail.did(operator, "auth")

    def expel(self, ids: Iterable[str]) -> None:
        """The people with these ids may nothing any more: what they drive stops, and their connections end."""
        gone = frozenset(ids) - {""}
        for operator in [each for each in self._operators if each.identity.id in gone]:
            operator.identity = STRANGER
            try:
                self._on_gone(operator)
            finally:
                operator.on_expelled()

    def check(self, operator: Operator, verb: str, name: str) -> None:
        """Raises Refused when the role of `operator` is too small; `publish`, `call` and `run` check it themselves.

        `verb` and `name` are as in `robotside.trust.permissions`.
        """
        try:
            check_role(self._gate, operator, self.now(), verb, name)
        except Refused as refusal:
            if self._trail:
                self._trail.refused(operator, f"{verb} {name}", refusal)
            raise

    def leave(self, asker: Hashable) -> None:
        """An operator or another asker is gone: end its subscriptions and, if it drove, the driving."""
        try:
            if isinstance(asker, Operator) and asker in self._operators:
                self._operators.discard(asker)
                self._calls.forget(asker.id)
                self._on_gone(asker)  # first of all: a robot that it drove stops
        finally:
            for token in list(self._subscriptions.get(asker, ())):
                self._unsubscribe(asker, token)

    def subscribe(
        self, asker: Hashable, topic: str, callback: Callback, *, wanted: bool = True
    ) -> Callable[[], None]:
        """Call back with each message of a topic of the robot, first with the last one if the topic is latched.

        The robot makes the messages while an asker has them `wanted`; with `wanted` False the asker takes only what is
        made for others. Returns the call that ends it. Raises Refused when there is no such topic.
        """
        entry = self.topics.get(topic)
        if entry is None and topic not in self._pictures:
            raise Refused(f"This robot has no topic {shown(topic)}.")
        token, callback = object(), _guarded(callback)
        if topic in self._listeners:
            self._listeners[topic][token] = callback
            stop: Callable[[], object] = partial(self._listeners[topic].pop, token)
        else:
            stop = self._bus.subscribe(topic, callback, replay=entry is not None and entry.latched)
        self._subscriptions.setdefault(asker, {})[token] = topic, stop
        try:
            if wanted:
                self._demand.set(topic, token, True)
        except Exception:
            self._unsubscribe(asker, token)
            raise
        return partial(self._unsubscribe, asker, token)

    def _unsubscribe(self, asker: Hashable, token: object) -> None:
        """End a subscription; nothing happens when it has ended already."""
        own = self._subscriptions.get(asker, {})
        if token not in own:
            return
        topic, stop = own.pop(token)
        if not own:
            del self._subscriptions[asker]
        stop()
        self._demand.set(topic, token, False)

    def check_listens(self, topic: str) -> None:
        """Raises Refused when no message of a client is taken on `topic`."""
        if topic not in self._listeners:
            why = ", it speaks there" if topic in self.topics else ""
            raise Refused(f"This robot does not listen to {shown(topic)}{why}.")

    def publish(self, operator: Operator, topic: str, msg: Msg, stamp: float | None) -> str | None:
        """Give a message of `operator` to the robot and to the subscribers of `topic`; why it is not obeyed, where that is known.

        `stamp` is when the operator meant it [s, operators' clock], None when that is not known. Raises Refused as
        `check_listens` does, and when its role is too small.
        """
        listeners = self._listeners.get(topic)
        if listeners is None:
            self.check_listens(topic)
            return None
        self.check(operator, "publish", topic)
        if self._trail:
            self._trail.published(operator, topic)
        try:
            problem = self._on_message(operator, topic, msg, stamp)
        except Exception:
            log.exception("%s from %s failed", topic, operator.address)
            problem = f"The robot failed at {topic}; its log says why."
        for callback in tuple(listeners.values()):
            callback(topic, msg)
        return problem

    def is_urgent(self, service: str) -> bool:
        """Calls of `service` are always taken and their answers go before everything else: STOP and control."""
        return service in URGENT

    def call(
        self, operator: Operator, service: str, request: Msg, timeout: float | None = None
    ) -> Msg | Awaitable[Msg]:
        """Have a service done; its answer, at once where it can be had at once.

        Not answered within `timeout` [s] it raises Refused, None and 0 wait for as long as it takes. Raises Refused with
        the sentence for the caller, now or when awaited.
        """
        known = self.service(service)
        self.check(operator, "call", service)
        if service not in URGENT:
            self._calls.check_room(operator.id)
        try:
            answer = known.call(operator, request)
        except Exception as error:
            raise _refused(service, operator, error) from error
        if isinstance(answer, Msg):
            return answer
        self._calls.begin(operator.id)
        return _answered(self._calls, operator, service, answer, timeout)

    async def run(
        self, operator: Operator, action: str, goal: Msg, on_feedback: Callable[[Msg], None]
    ) -> Msg:
        """Carry a goal out and give its result; cancelled, the goal is taken back. Raises Refused."""
        known = self.action(action)
        self.check(operator, "run", action)
        try:
            return await known.start(operator, goal, on_feedback)
        except Exception as error:
            raise _refused(action, operator, error) from error


async def _answered(
    calls: CallsInProgress, operator: Operator, service: str, answer: Awaitable[Msg], timeout: float | None
) -> Msg:
    """The answer of a call that has begun."""
    try:
        return await calls.answer(operator.id, service, answer, timeout)
    except Exception as error:
        raise _refused(service, operator, error) from error


def _refused(name: str, operator: Operator, error: Exception) -> BridgeError:
    """What the caller is answered when a service or an action fails; a fault of the program goes to the log."""
    if isinstance(error, BridgeError):
        return error
    log.error("%s from %s failed", name, operator.address, exc_info=error)
    return Refused(f"The robot failed at {name}; its log says why.")


def _guarded(callback: Callback) -> Callback:
    """The callback of a gateway, whose faults reach neither the robot nor other gateways; the first one is logged."""
    failed = False

    def call(topic: str, msg: Msg) -> None:
        nonlocal failed
        try:
            callback(topic, msg)
        except Exception:
            if not failed:
                log.exception("A gateway failed at a message on %s", topic)
            failed = True

    return call
