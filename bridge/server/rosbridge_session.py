"""The server's side of one connection: a client of the rosbridge protocol."""

from __future__ import annotations

import asyncio
import logging
from collections import deque
from collections.abc import Awaitable, Callable, Coroutine, Mapping
from dataclasses import dataclass
from typing import Any

import msgspec
from msgspec import UNSET, Raw

from bridge.codec import Unread, from_builtins, from_json, shown, to_json, unread
from bridge.core.compat import Compat
from bridge.core.errors import BridgeError, ProtocolError, Refused
from bridge.core.robot_catalogue import Action, Service, Session
from bridge.msgs import Msg
from bridge.protocol import (
    MISSING,
    ActionFeedback,
    ActionResult,
    Advertise,
    AdvertiseAction,
    AdvertiseService,
    Arrival,
    Auth,
    BinaryPublish,
    CallService,
    CancelActionGoal,
    Id,
    Op,
    Publish,
    SendActionGoal,
    ServerSession,
    ServiceResponse,
    SetLevel,
    Subscribe,
    Unadvertise,
    UnadvertiseAction,
    UnadvertiseService,
    Unsubscribe,
    absolute,
    arguments,
    complaint,
    service_and_id,
    too_deep,
)
from bridge.server.action_goals import Errands
from bridge.server.client_faults import Complaints
from bridge.server.client_services import Exchange
from bridge.server.flow.message_reducing import Reducing
from bridge.server.flow.outgoing_messages import Outgoing, said
from bridge.server.flow.priority_lanes import Lane, Stream
from bridge.server.flow.round_trip import Pulse
from bridge.server.flow.send_queue import Line, Outlet, Round
from bridge.server.flow.sockets import TURN, end
from bridge.server.rosapi.services import RosApi
from bridge.server.switchboard import Channel, Switchboard

__all__ = ["Client", "Offer"]

log = logging.getLogger(__name__)

FIRST = frozenset(
    {"/stop", "/stop/release"}
    | {f"/control/{what}" for what in ("acquire", "release", "request", "grant", "object")}
)
"""Services whose answers go before everything else."""

TIME = "/rosapi/get_time"
"""Who has asked this knows how the operators' clock differs from its own."""

MOST_CALLS = 256
"""So many of the robot's services may be at work for one client at a time; those of `FIRST` always may."""


LARGEST_READ = 1_048_576
"""The longest message of a client that is read and not passed on as it is [byte]; what is wrong is looked for in Python."""


@dataclass(frozen=True, slots=True)
class Offer:
    """What a server has for its clients, the same for all of them."""

    switchboard: Switchboard
    services: Mapping[str, Service]
    actions: Mapping[str, Action]
    exchange: Exchange
    rosapi: RosApi
    reducing: Reducing
    compat: Compat
    now: Callable[[], float]
    """The operators' clock [s]."""
    on_message: Callable[[Session, str, Any, float | None], None]


class Client:
    """One client of the rosbridge protocol."""

    def __init__(self, line: Line, round: Round, session: Session, offer: Offer) -> None:
        self.remembered = ServerSession(offer.compat)
        """What it asked for and what is asked of it."""
        self.session = session
        self.outlet = Outlet(line, round, session.address)
        self._offer = offer
        self._clock = asyncio.get_running_loop().time
        self._pulse = Pulse(session.opened)
        self._complaints = Complaints(session.address)
        self._errands = Errands(self, session, self.outlet, offer.actions, offer.exchange)
        self._tasks: set[asyncio.Task[None]] = set()
        self._again: set[str] = set()
        self._left: deque[Arrival] = deque()
        exchange = offer.exchange
        self._hear: dict[type[Op], Callable[[Any], object]] = {
            Publish: self._publish,
            CallService: self._call_service,
            Subscribe: self._subscribe,
            Unsubscribe: self._unsubscribe,
            Advertise: self._advertise,
            Unadvertise: self._unadvertise,
            AdvertiseService: lambda op: exchange.advertise_service(self, op),
            UnadvertiseService: lambda op: exchange.unadvertise_service(self, op),
            ServiceResponse: self.remembered.answered,
            AdvertiseAction: lambda op: exchange.advertise_action(self, op),
            UnadvertiseAction: lambda op: exchange.unadvertise_action(self, op),
            SendActionGoal: self._errands.begin,
            CancelActionGoal: self._errands.cancel,
            ActionFeedback: self.remembered.fed_back,
            ActionResult: self.remembered.finished,
            SetLevel: self.remembered.set_level,
            Auth: lambda _: None,
        }

    def hear(self, message: str | bytes) -> bool:
        """Do what one message of the client says; False when that takes longer than its turn, and `go_on` must follow.

        Never raises what the message can cause.
        """
        self.session.last_heard = self._offer.now()
        arrivals = self.remembered.receive(message, self._clock())
        if len(arrivals) == 1 and not self._left:
            self._try(arrivals[0])
            self._alter()
            return True
        behind = bool(self._left)
        self._left.extend(arrivals)
        return not behind and self.go_on()

    def go_on(self) -> bool:
        """Do more of what `hear` left; False when there is still more."""
        until = self._clock() + TURN
        while self._left:
            self._try(self._left.popleft())
            if self._clock() >= until:
                break
        self._alter()
        return not self._left

    def _try(self, arrival: Arrival) -> None:
        try:
            self._do(arrival)
        except ProtocolError as error:
            self._complain(error, arrival)

    def beat(self) -> None:
        """Ask for a sign of life, and give up fragments whose rest did not come; to be called every second or so."""
        for error in self.remembered.expire(self._clock()):
            self._complain(error, error)
        self.outlet.beat()

    def answered(self, content: bytes) -> None:
        """The client answered a ping."""
        if self._pulse.pong(content, self._offer.now()):
            self._tell_pulse()
        else:
            self.outlet.answered(content)

    def measure(self) -> None:
        """Ask how long the way takes; to be called every `PERIOD`."""
        content = self._pulse.ping(self._offer.now())
        if content is not None:
            self.outlet.ping(content)
        self._tell_pulse()

    def _tell_pulse(self) -> None:
        self.session.rtt, self.session.answered = self._pulse.rtt, self._pulse.answered

    def pump(self) -> None:
        """The connection takes more."""
        self.outlet.pump()

    def deliver(self, stream: Stream, message: Outgoing) -> None:
        """Have a message sent as soon as the client can take it; of a stream, the newest only."""
        if stream.heavy:
            self._offer.reducing.offer(self.outlet, stream, message)
        else:
            self.outlet.offer(stream, message)

    def send(self, op: Op, lane: Lane = Lane.REPLY, size: int | None = None) -> None:
        """Send an operation that must not be lost, in frames of at most `size` characters of it."""
        try:
            frames = said(op, size)
        except ProtocolError as error:
            log.warning("%s: %s", self.session.address, error)
            return
        self.outlet.send(lane, frames)

    async def close(self) -> None:
        """The client is gone: undo all that it asked for and offered."""
        switchboard = self._offer.switchboard
        self._offer.exchange.leave(self)
        for topic in list(self.remembered.subscriptions):
            stream = switchboard.unsubscribe(self, topic)
            if stream is not None:
                self.outlet.forget(stream)
        for topic in list(self.remembered.advertised):
            switchboard.unadvertise(self, topic)
        self._left.clear()
        self.remembered.lose()
        self._complaints.close()
        try:
            await self._errands.close()
            await end(self._tasks)
        finally:
            self.outlet.close()

    def _do(self, arrival: Op | BinaryPublish | ProtocolError) -> None:
        hear = self._hear.get(type(arrival))  # type: ignore[arg-type]
        if hear is not None:
            hear(arrival)
        elif isinstance(arrival, ProtocolError):
            raise arrival
        elif isinstance(arrival, BinaryPublish):
            self._publish_binary(arrival)
        else:
            raise ProtocolError(f"{arrival.__struct_config__.tag} is not for a server.")

    def _publish(self, op: Publish) -> None:
        channel = self._heard_on(op.topic)
        if channel.cls is not None:
            msg = unread(op.msg, channel.cls) if channel.entry is None else None
            if msg is None and len(op.msg) > LARGEST_READ:
                raise ProtocolError(
                    f"A message on {channel.name} over {LARGEST_READ} bytes must have all fields of"
                    f" {channel.type} and no other."
                )
            self._published(channel, msg or from_json(op.msg, channel.cls), op.stamp, latch=bool(op.latch))
        elif bytes(op.msg)[:1] != b"{" or too_deep(bytes(op.msg)):
            raise ProtocolError(f"A message on {channel.name} must be an object, and not nested too deeply.")
        else:
            self._published(channel, Raw(bytes(op.msg)), op.stamp, latch=bool(op.latch))

    def _publish_binary(self, op: BinaryPublish) -> None:
        channel = self._heard_on(op.topic)
        if channel.cls is None:
            raise ProtocolError(
                f"The type of {channel.name} is not known here, so it cannot be read as CBOR."
            )
        self._published(channel, from_builtins(op.msg, channel.cls), None, latch=False)

    def _heard_on(self, topic: str) -> Channel:
        channels = self._offer.switchboard.channels
        channel = channels.get(topic) or channels.get(absolute(topic))
        if channel is None:
            raise ProtocolError(f"This robot does not listen to {shown(topic)}, and nobody advertised it.")
        if channel.entry is not None and channel.entry.to != "robot":
            raise ProtocolError(f"This robot does not listen to {shown(topic)}, it speaks there.")
        return channel

    def _published(
        self, channel: Channel, msg: Msg | Raw | Unread, stamp: float | None, *, latch: bool
    ) -> None:
        if channel.entry is not None:
            latch = False
            try:
                self._offer.on_message(self.session, channel.name, msg, stamp)
            except Exception:
                log.exception("%s from %s failed", channel.name, self.session.address)
        else:
            latch = self in channel.publishers and (latch or self.remembered.latches(channel.name))
        self._offer.switchboard.pass_on(channel, msg, self, latch=latch)

    def _subscribe(self, op: Subscribe) -> None:
        topic, switchboard = absolute(op.topic), self._offer.switchboard
        switchboard.check(topic, op.type)
        switchboard.check_fields(topic, op.reduce.fields if op.reduce else None)
        self.remembered.subscribe(op)
        if self.remembered.stale(topic):
            self._again.add(topic)
            return
        try:
            switchboard.subscribe(self, topic, self.remembered.subscriptions[topic], op.type or "")
        except ProtocolError:
            self.remembered.unsubscribe(Unsubscribe(topic=op.topic, id=op.id))
            raise

    def _unsubscribe(self, op: Unsubscribe) -> None:
        topic = self.remembered.unsubscribe(op)
        if not self.remembered.stale(topic):
            stream = self._offer.switchboard.unsubscribe(self, topic)
            if stream is not None:
                self.outlet.forget(stream)

    def _alter(self) -> None:
        """What is wanted otherwise since the last frame, once for all operations of this one."""
        switchboard = self._offer.switchboard
        again, self._again = self._again, set()
        for topic, wanted in self.remembered.altered().items():
            if topic in again:
                switchboard.subscribe(self, topic, wanted)
            else:
                switchboard.alter(self, topic, wanted)

    def _advertise(self, op: Advertise) -> None:
        topic, switchboard = absolute(op.topic), self._offer.switchboard
        switchboard.check(topic, op.type)
        own = switchboard.topics.get(topic)
        if own is not None and own.to != "robot":
            raise ProtocolError(f"{topic} is this robot's own topic.")
        self.remembered.advertise(op)
        try:
            switchboard.advertise(self, topic, op.type or "")
        except ProtocolError:
            self.remembered.unadvertise(Unadvertise(topic=op.topic, id=op.id))
            raise

    def _unadvertise(self, op: Unadvertise) -> None:
        topic = self.remembered.unadvertise(op)
        if topic not in self.remembered.advertised:
            self._offer.switchboard.unadvertise(self, topic)

    def _call_service(self, op: CallService) -> None:
        name, id = service_and_id(op)
        try:
            known = self._offer.rosapi.answer(name, op.args)
            if known is not None:
                self.session.asked_time = self.session.asked_time or name == TIME
                self._answer(op, name, id, known)
                return
            service = self._offer.services.get(name)
            if service is None:
                self._call_client(op, name, id)
                return
            if len(self._tasks) >= MOST_CALLS and name not in FIRST:
                raise Refused(f"{MOST_CALLS} calls of this client wait for their answer already.")
            outcome = service.call(self.session, arguments(op.args, service.request))
            op = msgspec.structs.replace(
                op, args=MISSING
            )  # which would keep all of its frame while it is at work
            if isinstance(outcome, Msg):
                self._answer(op, name, id, to_json(outcome))
            else:
                self._begin(self._await_answer(op, name, id, outcome))
        except Exception as error:  # noqa: BLE001 -- a service may fail in any way; the caller and the log are told
            self._refuse(op, name, id, error)

    def _call_client(self, op: CallService, name: str, id: Id) -> None:
        if name not in self._offer.exchange.services:
            raise Refused(f"This robot has no service {shown(name)}.")
        self._offer.exchange.call(self, name, id, op)

    async def _await_answer(self, op: CallService, name: str, id: Id, outcome: Awaitable[Msg]) -> None:
        patience = asyncio.timeout(op.timeout if op.timeout and op.timeout > 0 else None)
        try:
            async with patience:
                answer = to_json(await outcome)
        except Exception as error:  # noqa: BLE001 -- a service may fail in any way; the caller and the log are told
            late = Refused(f"{name} gave no answer within {op.timeout or 0:g} s.")
            self._refuse(op, name, id, late if patience.expired() else error)
        else:
            self._answer(op, name, id, answer)

    def _refuse(self, op: CallService, name: str, id: Id, error: Exception) -> None:
        if isinstance(error, BridgeError):
            reason = str(error)
        else:
            log.error("%s from %s failed", op.service, self.session.address, exc_info=error)
            reason = f"The robot failed at {op.service}; its log says why."
        self._answer(op, name, id, msgspec.json.encode(reason), result=False)

    def _answer(self, op: CallService, name: str, id: Id, values: bytes, *, result: bool = True) -> None:
        response = ServiceResponse(id=id, service=op.service, values=Raw(values), result=result)
        lane = Lane.CONTROL if name in FIRST else Lane.REPLY
        self.send(response, lane, self.remembered.answer_size(op))

    def _complain(self, error: ProtocolError, arrival: Op | BinaryPublish | ProtocolError) -> None:
        """Log what was wrong with an operation, and tell who asked to be told, with its name and id."""
        if error.op is None and isinstance(arrival, Op):
            id = None if arrival.id is UNSET else arrival.id
            error = ProtocolError(str(error), op=str(arrival.__struct_config__.tag), id=id)
        self._complaints.note(error)
        if self.remembered.wants("error"):
            self.send(complaint(error))

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
