"""Services and actions that clients offer to each other: calls and goals are passed on, and answers back."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Collection
from typing import Protocol

import msgspec
from msgspec import Raw

from bridge.codec import shown, to_json
from bridge.core.errors import ProtocolError
from bridge.msgs import TYPES, ros1_name
from bridge.protocol import (
    MAX_CALLS,
    MISSING,
    ActionFeedback,
    ActionResult,
    AdvertiseAction,
    AdvertiseService,
    CallService,
    Id,
    Op,
    SendActionGoal,
    ServerSession,
    ServiceResponse,
    UnadvertiseAction,
    UnadvertiseService,
    absolute,
    arguments,
    too_deep,
)
from bridge.server.flow.priority_lanes import Lane

__all__ = ["ANSWER_TIMEOUT", "ClientServices", "Peer"]

ANSWER_TIMEOUT = 60.0
"""Time for a client's answer to a call when the caller does not set one [s]."""


class Peer(Protocol):
    """A client as other clients see it."""

    protocol: ServerSession

    def send(self, op: Op, lane: Lane = Lane.REPLY, size: int | None = None) -> None:
        """Send an operation; returns at once."""


class ClientServices:
    """The services and actions of all clients, and the calls between them."""

    def __init__(self, services: Collection[str], actions: Collection[str]) -> None:
        """`services` and `actions` are the robot's own: no client may offer those."""
        self.services: dict[str, Peer] = {}
        """Provider by absolute name of the service."""
        self.actions: dict[str, Peer] = {}
        """Provider by absolute name of the action."""
        self._own_services = services
        self._own_actions = actions
        self._asked: dict[Peer, dict[object, Callable[[], None]]] = {}

    def advertise_service(self, peer: Peer, op: AdvertiseService) -> None:
        """Have `peer` answer a service, in the place of its provider before; ProtocolError for the robot's own."""
        name = absolute(op.service)
        if name in self._own_services or name.startswith("/rosapi/"):
            raise ProtocolError(f"{shown(name)} is this robot's own service.")
        peer.protocol.advertise_service(op)
        before = self.services.get(name)
        self.services[name] = peer
        if before is not None and before is not peer:
            before.protocol.unadvertise_service(UnadvertiseService(service=name))

    def unadvertise_service(self, peer: Peer, op: UnadvertiseService) -> None:
        """End a service of `peer`; waiting callers get a refusal."""
        name = peer.protocol.unadvertise_service(op)
        if self.services.get(name) is peer:
            del self.services[name]

    def advertise_action(self, peer: Peer, op: AdvertiseAction) -> None:
        """Have `peer` carry out an action, in the place of its provider before; ProtocolError for the robot's own."""
        name = absolute(op.action)
        if name in self._own_actions:
            raise ProtocolError(f"{shown(name)} is this robot's own action.")
        peer.protocol.advertise_action(op)
        before = self.actions.get(name)
        self.actions[name] = peer
        if before is not None and before is not peer:
            before.protocol.unadvertise_action(UnadvertiseAction(action=name))

    def unadvertise_action(self, peer: Peer, op: UnadvertiseAction) -> None:
        """End an action of `peer`; the senders of goals under way get a failure."""
        name = peer.protocol.unadvertise_action(op)
        if self.actions.get(name) is peer:
            del self.actions[name]

    def call(self, caller: Peer, name: str, id: Id, op: CallService) -> None:
        """Pass a call on to the provider of the service `name`, which must exist; the answer comes later.

        ProtocolError when it cannot be passed on.
        """
        provider = self.services[name]
        size = caller.protocol.answer_size(op)
        request = _request(provider, name, op)
        op = msgspec.structs.replace(
            op, args=MISSING
        )  # which would keep all of its frame until it is answered
        if len(self._asked.get(caller, ())) >= MAX_CALLS:
            raise ProtocolError(f"{MAX_CALLS} calls of this client wait for their answer already.")
        key = object()

        def answer(response: ServiceResponse | None) -> None:
            self._settled(caller, key)
            if response is None:
                response = _failed(f"The client that answers {shown(name)} is gone.")
            elif too_deep(bytes(response.values)):
                response = _failed(f"The answer of {shown(name)} is nested too deeply.")
            told = msgspec.structs.replace(response, id=id, service=op.service)
            caller.send(told, size=size)

        asked = provider.protocol.ask(request, answer)
        patience = op.timeout if op.timeout and op.timeout > 0 else ANSWER_TIMEOUT

        def give_up() -> None:
            if provider.protocol.forget_call(asked.id):
                self._settled(caller, key)
                reason = f"{name} gave no answer within {patience:g} s."
                caller.send(msgspec.structs.replace(_failed(reason), id=id, service=op.service), size=size)

        timer = asyncio.get_running_loop().call_later(min(patience, 86_400.0), give_up)

        def forget() -> None:
            timer.cancel()
            provider.protocol.forget_call(asked.id)

        self._asked.setdefault(caller, {})[key] = forget
        provider.send(asked)

    def hand_goal(
        self,
        peer: Peer,
        name: str,
        op: SendActionGoal,
        feedback: Callable[[ActionFeedback], None],
        result: Callable[[ActionResult | None], None],
    ) -> Callable[[], None]:
        """Pass a goal on to the provider of the action `name`, which must exist; returns a function that cancels it.

        `result` is called once, with None when the result will never be known. ProtocolError when it cannot be passed
        on.
        """
        provider = self.actions[name]
        if too_deep(bytes(op.args)):
            raise ProtocolError("The goal is nested too deeply.")
        handed = provider.protocol.hand_goal(op, feedback if op.feedback else None, result)
        provider.send(handed)

        def cancel() -> None:
            back = provider.protocol.cancel_handed(handed.id)
            if back is not None:
                provider.send(back, Lane.CONTROL)

        return cancel

    def leave(self, peer: Peer) -> None:
        """Remove all services, actions and calls of a client that is gone."""
        for offered in (self.services, self.actions):
            for name in [name for name, provider in offered.items() if provider is peer]:
                del offered[name]
        for forget in self._asked.pop(peer, {}).values():
            forget()

    def _settled(self, caller: Peer, key: object) -> None:
        waiting = self._asked.get(caller, {})
        forget = waiting.pop(key, None)
        if not waiting:
            self._asked.pop(caller, None)
        if forget is not None:
            forget()


def _request(provider: Peer, name: str, op: CallService) -> CallService:
    """The call for the provider: a list of arguments becomes an object where the type is known."""
    args = bytes(op.args).strip()
    if too_deep(args):
        raise ProtocolError("args are nested too deeply.")
    if not args.startswith(b"{"):
        kind = TYPES.get(f"{ros1_name(provider.protocol.services[name].type)}Request")
        if kind is not None:
            args = to_json(arguments(op.args, kind))
    return CallService(service=name, args=Raw(args))


def _failed(reason: str) -> ServiceResponse:
    return ServiceResponse(values=Raw(msgspec.json.encode(reason)), result=False)
