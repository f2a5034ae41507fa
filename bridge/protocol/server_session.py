"""The server's side of the protocol for one client, without I/O."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec
from msgspec import UNSET, Raw

from bridge.codec import shown
from bridge.core.compat import Compat
from bridge.core.errors import ProtocolError
from bridge.protocol.arrivals import Arrival, Arrivals
from bridge.protocol.client_subscriptions import NO_IDS, ClientSubscriptions
from bridge.protocol.merging import Subscribed, checked_size
from bridge.protocol.names import MAX_NAME_LENGTH, absolute, checked_id, checked_name, spells_ros2, wrong
from bridge.protocol.ops import (
    LEVELS,
    MISSING,
    ActionFeedback,
    ActionResult,
    Advertise,
    AdvertiseAction,
    AdvertiseService,
    CallService,
    CancelActionGoal,
    Id,
    Op,
    Publish,
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

__all__ = [
    "MAX_SERVER_FRAME",
    "MAX_ADVERTISED",
    "MAX_CALLS",
    "MAX_GOALS",
    "ServerSession",
]

_TYPED = (Subscribe, Advertise, AdvertiseService, AdvertiseAction)
MAX_SERVER_FRAME = 16_777_216
"""The largest frame that a server takes, and the most that may wait in fragments [byte]."""
MAX_VALUES = 50_000
"""Most values in one binary frame, a number array counted as one."""
MAX_ADVERTISED = 1000
"""Most topics, services and actions that one client may advertise together, each id of a topic counted."""
MAX_CALLS = 1000
"""Most calls to one client that are unanswered."""
MAX_GOALS = 100
"""Most goals of one client that are under way, and as many that it carries out."""


class ServerSession:
    """The state of one client: its subscriptions and advertisements, and the requests to it."""

    def __init__(self, compat: Compat | None = None, *, limit_bytes: int = MAX_SERVER_FRAME) -> None:
        """`limit_bytes` bounds a frame, the waiting fragments, and the unpacked content of one frame [byte]."""
        self.compat = compat or Compat()
        self.advertised: dict[str, dict[Id, Advertise]] = {}
        """Topics that it publishes on: the advertisements by id, by the topic's absolute name."""
        self.services: dict[str, AdvertiseService] = {}
        """Services that it answers, by absolute name."""
        self.actions: dict[str, AdvertiseAction] = {}
        """Actions that it carries out, by absolute name."""
        self.goals: dict[Id, SendActionGoal] = {}
        """Goals of this client that others carry out, by its own ids."""
        self.level = "none"
        """The least level of remarks that the client wants: one of `LEVELS`."""
        self._subscriptions = ClientSubscriptions(self.compat)
        self.ros2 = False
        """Whether it has spelled a type as `pkg/msg/Type`, so that it wants times as `sec` and `nanosec` where it
        names no type."""
        self._limit = limit_bytes
        self._arrivals = Arrivals(limit_bytes, most_values=MAX_VALUES)
        self._calls = Calls("service_request", MAX_CALLS)
        self._goals = Goals("action_goal", MAX_GOALS)

    @property
    def fragment_size(self) -> int | None:
        """Longest text frame [characters] for everything sent to the client; None for no limit."""
        return self._subscriptions.fragment_size

    def receive(self, frame: str | bytes, now: float) -> list[Arrival]:
        """The operations in a frame that came at `now` [s], any clock that only goes forward; never raises.

        A fault stands among them as a ProtocolError that names op and id where they can be read. Fragments and
        pictures are unpacked; `fragment_size` and the spelling of types are noted.
        """
        return [self._noted(arrival) for arrival in self._arrivals.receive(frame, now)]

    def expire(self, now: float) -> list[ProtocolError]:
        """The errors of fragments that are given up at `now` [s] as incomplete; to be called every second or so."""
        return self._arrivals.expire(now)

    def note(self, op: Op) -> None:
        """Note the fragment size and the spelling of types of any operation; `receive` does it."""
        if op.fragment_size is not UNSET:
            size = checked_size(op)
            if self.compat.sticky_fragment_size and size != self.fragment_size:
                self._subscriptions.set_fragment_size(size)
        if isinstance(op, SendActionGoal):
            self._note_type(op, op.action_type)
        elif isinstance(op, _TYPED):
            self._note_type(op, op.type)

    def _note_type(self, op: Op, type: str | None) -> None:
        if type is not None and len(type) > MAX_NAME_LENGTH:
            raise wrong(op, f"A type's name has at most {MAX_NAME_LENGTH} characters, not {len(type)}.")
        self.ros2 = self.ros2 or spells_ros2(type)

    def answer_size(self, op: Op) -> int | None:
        """Longest text frame [characters] of the answer to `op`; None for no limit."""
        return self.fragment_size if self.compat.sticky_fragment_size else checked_size(op)

    def subscribe(self, op: Subscribe) -> str:
        """Add a subscription; returns the topic's absolute name. See `ClientSubscriptions.subscribe`."""
        return self._subscriptions.subscribe(op, ros2=self.ros2)

    def unsubscribe(self, op: Unsubscribe) -> str:
        """Remove a subscription; returns the topic's absolute name. An unknown one is no error."""
        return self._subscriptions.unsubscribe(op)

    @property
    def subscriptions(self) -> Mapping[str, Subscribed]:
        """The merged delivery of each topic that the client subscribed, by absolute name."""
        return self._subscriptions.deliveries

    def is_stale(self, topic: str) -> bool:
        """Whether the delivery of a topic (absolute name) is still to be merged, and `changed_subscriptions` will name it."""
        return self._subscriptions.is_stale(topic)

    def changed_subscriptions(self) -> dict[str, Subscribed]:
        """The deliveries that changed since the last call, by absolute name; new topics are not among them."""
        return self._subscriptions.changed()

    def advertise(self, op: Advertise) -> str:
        """Add an advertisement; returns the topic's absolute name. ProtocolError when it is one too many."""
        topic = checked_name(op.topic, op, "topic")
        id = checked_id(op)
        if id not in self.advertised.get(topic, {}):
            self._check_room(op)
        self.advertised.setdefault(topic, {})[id] = op
        return topic

    def unadvertise(self, op: Unadvertise) -> str:
        """Remove an advertisement; returns the topic's absolute name. An unknown one is no error."""
        topic = absolute(op.topic)
        advertised = self.advertised.get(topic, {})
        advertised.pop(op.id, None)
        if op.id in NO_IDS or not advertised:
            self.advertised.pop(topic, None)
        return topic

    def latches(self, topic: str) -> bool:
        """Whether the client latches `topic` (absolute name)."""
        return any(op.latch for op in self.advertised.get(topic, {}).values())

    def advertise_service(self, op: AdvertiseService) -> str:
        """Add a service of the client; returns its absolute name. ProtocolError when it is one too many."""
        service = checked_name(op.service, op, "service")
        if service not in self.services:
            self._check_room(op)
        self.services[service] = op
        return service

    def unadvertise_service(self, op: UnadvertiseService) -> str:
        """Remove a service; returns its absolute name. Waiting callers get None."""
        service = absolute(op.service)
        if self.services.pop(service, None) is not None:
            self._calls.fail_all(service)
        return service

    def ask(self, op: CallService, answer: Answer) -> CallService:
        """Add a call of one of the client's services; returns the operation to send.

        `answer` is called once: with the client's response as `compat` has it, or with None when the client is gone
        before. ProtocolError when too many calls wait.
        """
        service = absolute(op.service)
        return self._calls.ask(CallService(service=service, args=op.args), answer)

    def on_response(self, op: ServiceResponse) -> bool:
        """Pass the client's response to its caller; False when none waits for it."""
        if op.values is MISSING and not (op.result and self.compat.missing_values_as_defaults):
            reason = f"{absolute(op.service)} {'answered' if op.result else 'refused'} without saying more."
            op = msgspec.structs.replace(op, values=Raw(msgspec.json.encode(reason)), result=False)
        elif not op.result and self.compat.refusal_as_success and bytes(op.values).lstrip().startswith(b"{"):
            op = msgspec.structs.replace(op, result=True)
        return self._calls.on_response(op)

    def forget_call(self, id: Id) -> bool:
        """Remove the call with this id, as `ask` gave it; False when it was not waiting."""
        return self._calls.forget(id)

    def advertise_action(self, op: AdvertiseAction) -> str:
        """Add an action of the client; returns its absolute name. ProtocolError when it is one too many."""
        action = checked_name(op.action, op, "action")
        if action not in self.actions:
            self._check_room(op)
        self.actions[action] = op
        return action

    def unadvertise_action(self, op: UnadvertiseAction) -> str:
        """Remove an action; returns its absolute name. The senders of goals under way get None."""
        action = absolute(op.action)
        if self.actions.pop(action, None) is not None:
            self._goals.fail_all(action)
        return action

    def hand_goal(self, op: SendActionGoal, feedback: Feedback | None, result: Result) -> SendActionGoal:
        """Add a goal for the client to carry out; returns the operation to send. ProtocolError when it has too many.

        `feedback` is called with each feedback, `result` once: with None when the client is gone before.
        """
        action = absolute(op.action)
        handed = SendActionGoal(action=action, action_type=op.action_type, args=op.args)
        return self._goals.send(handed, feedback, result)

    def cancel_handed(self, id: Id) -> CancelActionGoal | None:
        """The operation that cancels a goal, by the id that `hand_goal` gave; None when it is over."""
        return self._goals.cancel(id)

    def on_feedback(self, op: ActionFeedback) -> bool:
        """Pass the client's feedback on to the goal's sender; False when it is not wanted."""
        return self._goals.on_feedback(op)

    def on_result(self, op: ActionResult) -> bool:
        """Pass the client's result on to the goal's sender; False when none waits for it."""
        return self._goals.on_result(op)

    def begin_goal(self, op: SendActionGoal) -> None:
        """Add a goal of the client. ProtocolError when it has one of that id already, or too many."""
        id = checked_id(op)
        checked_name(op.action, op, "action")
        if id in self.goals:
            raise wrong(op, f"A goal with the id {shown(None if id is UNSET else id)} is under way already.")
        if len(self.goals) >= MAX_GOALS:
            raise wrong(op, f"A client may have at most {MAX_GOALS} goals under way.")
        self.goals[id] = msgspec.structs.replace(op, args=MISSING)

    def goal_to_cancel(self, op: CancelActionGoal) -> SendActionGoal:
        """The client's goal that it cancels. ProtocolError when it has none of that id with that action."""
        goal = self.goals.get(op.id)
        if goal is None or absolute(goal.action) != absolute(op.action):
            raise wrong(op, f"No goal of {shown(op.action)} with this id is under way.")
        return goal

    def end_goal(self, id: Id) -> SendActionGoal | None:
        """Remove a goal of the client; None when it had none of that id."""
        return self.goals.pop(id, None)

    def set_level(self, op: SetLevel) -> None:
        """Set the least level of remarks; ProtocolError when there is no such level."""
        if op.level not in LEVELS:
            raise wrong(op, f"level must be one of {', '.join(LEVELS)}, not {shown(op.level)}.")
        self.level = op.level

    def wants(self, level: str) -> bool:
        """Whether the client wants remarks of this level."""
        return self.level != "none" and LEVELS.index(level) >= LEVELS.index(self.level)

    def on_lost(self) -> list[SendActionGoal]:
        """End everything of a client that is gone; waiting senders get None. Returns its goals under way."""
        goals = list(self.goals.values())
        for forgotten in (
            self._subscriptions,
            self.advertised,
            self.services,
            self.actions,
            self.goals,
        ):
            forgotten.clear()
        self._arrivals = Arrivals(self._limit, most_values=MAX_VALUES)  # with what was unfinished
        try:
            self._calls.fail_all()
        finally:
            self._goals.fail_all()
        return goals

    def _noted(self, arrival: Arrival) -> Arrival:
        if type(arrival) is Publish and arrival.fragment_size is UNSET:
            return arrival  # most that comes is such, and has nothing beside its own matter
        if isinstance(arrival, Op):
            try:
                self.note(arrival)
            except ProtocolError as error:
                return error
        return arrival

    def _check_room(self, op: Op) -> None:
        topics = sum(len(ids) for ids in self.advertised.values())
        if topics + len(self.services) + len(self.actions) >= MAX_ADVERTISED:
            raise wrong(op, f"A client may advertise at most {MAX_ADVERTISED} topics, services and actions.")
