"""Rosbridge sessions, the server's end of one client's connection from its first operation to its last."""

from __future__ import annotations

import asyncio
import logging
from collections import deque
from collections.abc import Callable
from typing import Any

import msgspec
from msgspec import UNSET

from bridge.codec import unknown_fields
from bridge.core.errors import ProtocolError, Refused
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.protocol import (
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
    Op,
    Publish,
    SendActionGoal,
    ServerSession,
    ServiceResponse,
    SetLevel,
    Status,
    Subscribe,
    Unadvertise,
    UnadvertiseAction,
    UnadvertiseService,
    Unsubscribe,
    absolute,
    complaint,
    service_and_id,
)
from bridge.server.action_goals import ActionGoals
from bridge.server.client_faults import ClientFaults
from bridge.server.flow.outgoing_messages import OutgoingMessage, op_frames
from bridge.server.flow.priority_lanes import Lane, Stream
from bridge.server.flow.round_trip import RoundTrip
from bridge.server.flow.send_queue import TURN_TIME, FrameWriter, SendQueue, WriteBatch
from bridge.server.reception.credentials import introduce
from bridge.server.reception.log_limit import STRANGERS
from bridge.server.reception.places import FULL, Place
from bridge.server.server_context import ServerContext
from bridge.server.service_operations import ServiceOperations
from bridge.server.topic_operations import MAX_READ_BYTES, TopicOperations

__all__ = ["RosbridgeSession"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

_ON_RESERVE = (Auth, CallService, SetLevel)
"""Operations that are heard on a place of the reserve; of calls STOP and the time are answered."""


class RosbridgeSession:
    """One client of the rosbridge protocol; a `MessageHandler` of its connection."""

    def __init__(
        self,
        writer: FrameWriter,
        batch: WriteBatch,
        operator: Operator,
        context: ServerContext,
        place: Place | None = None,
    ) -> None:
        """`writer` is the connection, `batch` gathers what leaves in this step of the loop, `place` is that of the
        connection."""
        self.protocol = ServerSession(context.compat)
        """The state of the protocol: subscriptions, advertisements, pending calls and goals."""
        self.operator = operator
        self._batch = batch
        self.queue = SendQueue(writer, batch, operator.address)
        self._context = context
        self._place = place
        self._clock = asyncio.get_running_loop().time
        self._round_trip = RoundTrip(operator.opened)
        self._faults = ClientFaults(operator.address)
        self._topics = TopicOperations(self, operator, self.queue, context)
        self._services = ServiceOperations(self, operator, context, self._only_stop)
        self._goals = ActionGoals(self, operator, self.queue, context.door, context.client_services)
        self._unhandled: deque[Arrival] = deque()
        self._handlers = self._make_handlers()

    def _make_handlers(self) -> dict[type[Arrival], Callable[[Any], object]]:
        offered = self._context.client_services
        return {
            Publish: self._topics.publish,
            BinaryPublish: self._topics.publish_binary,
            Subscribe: self._topics.subscribe,
            Unsubscribe: self._topics.unsubscribe,
            Advertise: self._topics.advertise,
            Unadvertise: self._topics.unadvertise,
            CallService: self._services.call,
            AdvertiseService: self._advertise_service,
            UnadvertiseService: lambda op: offered.unadvertise_service(self, op),
            ServiceResponse: self.protocol.on_response,
            AdvertiseAction: self._advertise_action,
            UnadvertiseAction: lambda op: offered.unadvertise_action(self, op),
            SendActionGoal: self._goals.begin,
            CancelActionGoal: self._goals.cancel,
            ActionFeedback: self.protocol.on_feedback,
            ActionResult: self.protocol.on_result,
            SetLevel: self.protocol.set_level,
            Auth: self._authenticate,
        }

    def _advertise_service(self, op: AdvertiseService) -> None:
        self._check_advertise(op.service)
        self._context.client_services.advertise_service(self, op)

    def _advertise_action(self, op: AdvertiseAction) -> None:
        self._check_advertise(op.action)
        self._context.client_services.advertise_action(self, op)

    def _check_advertise(self, name: str) -> None:
        try:
            self._context.door.check(self.operator, "advertise", absolute(name))
        except Refused as refusal:
            raise ProtocolError(str(refusal)) from refusal

    def _authenticate(self, op: Auth) -> None:
        """Learn who the client is by its token; a `status` tells it the outcome, whatever remarks it wants."""
        if not op.token:
            return
        level, said = "info", ""
        try:
            self._context.door.authenticate(self.operator, op.token)
        except Refused as refusal:
            level, said = "error", str(refusal)
        else:
            introduce(self.operator, self._place, self._context.now())
            identity = self.operator.identity
            said = f"You are {identity.name}, with the role {identity.role.word}."
        self.send(Status(id=op.id, level=level, msg=said))

    def on_message(self, message: str | bytes) -> bool:
        """Handle one message of the client; False when that takes longer than its turn, and `resume` must follow.

        Errors that the message causes are logged and answered, never raised.
        """
        self.operator.last_heard = self._context.now()
        arrivals = self.protocol.receive(message, self._clock())
        if len(arrivals) == 1 and not self._unhandled:
            self._handle(arrivals[0])
            self._topics.apply_changes()
            return True
        behind = bool(self._unhandled)
        self._unhandled.extend(arrivals)
        return not behind and self.resume()

    def resume(self) -> bool:
        """Handle more of what `on_message` left; False when there is still more."""
        until = self._clock() + TURN_TIME * self._batch.share
        while self._unhandled:
            self._handle(self._unhandled.popleft())
            if self._clock() >= until:
                break
        self._topics.apply_changes()
        return not self._unhandled

    def on_pong(self, content: bytes) -> None:
        """Handle the answer to a ping."""
        if self._round_trip.on_pong(content, self._context.now()):
            self._note_round_trip()
        else:
            self.queue.on_pong(content)

    def on_drained(self) -> None:
        """Send what waits: everything written so far has left this process."""
        self.queue.send_waiting()

    def check_alive(self) -> None:
        """Disconnect a client that is silent, and give up unfinished fragments; to be called every second or so."""
        for error in self.protocol.expire(self._clock()):
            self._report(error, error)
        self.queue.check_alive()

    def measure_round_trip(self) -> None:
        """Send a ping that measures the round trip; to be called every `round_trip.PING_PERIOD`."""
        content = self._round_trip.ping(self._context.now())
        if content is not None:
            self.queue.ping(content)
        self._note_round_trip()

    def deliver(self, stream: Stream, message: OutgoingMessage) -> None:
        """Send a message as soon as the client can take it; of a stream only the newest one waits."""
        if stream.heavy:
            self._context.reducer.offer(self.queue, stream, message)
        else:
            self.queue.offer(stream, message)

    def send(self, op: Op, lane: Lane = Lane.REPLY, size: int | None = None) -> None:
        """Send an operation that must not be lost, in fragments of at most `size` characters."""
        try:
            frames = op_frames(op, size)
        except ProtocolError as error:
            log.warning("%s: %s", self.operator.address, error)
            return
        self.queue.send(lane, frames)

    async def close(self) -> None:
        """End the session of a client that is gone: undo all that it asked for and offered."""
        self._context.client_services.leave(self)
        self._topics.close()
        self._unhandled.clear()
        self.protocol.on_lost()
        self._faults.close()
        try:
            await self._goals.close()
            await self._services.close()
        finally:
            self.queue.close()

    def _handle(self, arrival: Arrival) -> None:
        try:
            handler = self._handlers.get(type(arrival))
            if handler is not None and self._only_stop() and not isinstance(arrival, _ON_RESERVE):
                raise ProtocolError(FULL)
            if handler is not None:
                handler(arrival)
                if self.protocol.wants("warning"):
                    self._remark_misspelt(arrival)
            elif isinstance(arrival, ProtocolError):
                self._report(arrival, arrival)
            elif isinstance(arrival, Op):
                raise ProtocolError(f"{arrival.__struct_config__.tag} is not for a server.")
        except ProtocolError as error:
            self._report(error, arrival)

    def _remark_misspelt(self, op: Arrival) -> None:
        """Name the fields of a message or of arguments that are passed over because their type has no such field."""
        cls: type[Msg] | None = None
        if isinstance(op, Publish):
            about, raw = op.topic, op.msg
            channel = self._context.switchboard.channels.get(absolute(about))
            cls = channel.cls if channel else None
        elif isinstance(op, CallService):
            about, raw = service_and_id(op)[0], op.args
            known = self._context.door.services.get(about)
            cls = known.request if known else None
        else:
            return
        if cls is None or len(raw) > MAX_READ_BYTES:
            return
        try:
            names = unknown_fields(msgspec.json.decode(raw), cls)
        except msgspec.MsgspecError:
            return  # a number beyond all numbers in a field that is passed over
        if names:
            said = f"{about} ({cls.MSGTYPE}) has no field {', '.join(names)}; it is passed over."
            remark = complaint(ProtocolError(said, op=str(op.__struct_config__.tag)))
            self.send(msgspec.structs.replace(remark, level="warning", id=op.id))

    def _only_stop(self) -> bool:
        return self._place is not None and self._place.only_stop

    def _note_round_trip(self) -> None:
        self.operator.rtt, self.operator.answered = self._round_trip.rtt, self._round_trip.answered

    def _report(self, error: ProtocolError, arrival: Arrival) -> None:
        """Log what is wrong with an operation, and send it to a client that wants errors, with op and id."""
        if error.op is None and isinstance(arrival, Op):
            id = None if arrival.id is UNSET else arrival.id
            error = ProtocolError(str(error), op=str(arrival.__struct_config__.tag), id=id)
        self._faults.note(error)
        if self.protocol.wants("error"):
            self.send(complaint(error))
