"""Reception of what a server sends: messages to their subscribers, answers to their callers."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from typing import NamedTuple, TypeVar

from bridge.client.connection import Connection
from bridge.client.liveness import Liveness
from bridge.client.service_provider import ServiceProvider
from bridge.codec import from_builtins, from_json
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.protocol import (
    ActionFeedback,
    ActionResult,
    Arrival,
    BinaryPublish,
    CallService,
    CancelActionGoal,
    ClientSession,
    Op,
    Publish,
    SendActionGoal,
    ServiceResponse,
    Status,
)
from bridge.rosbytes import deserialize

__all__ = ["Flow", "MessageReceiver", "Traffic"]

log = logging.getLogger(__name__)
M = TypeVar("M", bound=Msg)

_CBOR_RAW_KEYS = {"secs", "nsecs", "bytes"}
"""The fields of a message in cbor-raw: when the server received it, and itself in the bytes of ROS."""
_MAX_REPORTED = 100
"""Most topics and operations whose first error is a warning; all other errors are debug messages."""

_MAX_MEASURED = 2000
"""Topics whose traffic is counted; of more nothing is known."""


class Flow(NamedTuple):
    """All that came of one topic so far."""

    size: int = 0
    """Of its operations as they are read: texts and binary frames after decompression [bytes]."""
    messages: int = 0
    """Messages."""
    received: float = math.nan
    """When the newest came [s], the client's clock."""


class Traffic:
    """What came of each topic that is subscribed to. Counted in the thread of the client, read in any."""

    def __init__(self) -> None:
        self._flows: dict[str, Flow] = {}

    def add(self, topic: str, size: int, received: float) -> None:
        """One more message, of `size` [bytes]."""
        before = self._flows.get(topic)
        if before is None:
            if len(self._flows) >= _MAX_MEASURED:
                return
            before = Flow()
        self._flows[topic] = Flow(before.size + size, before.messages + 1, received)

    def read(self) -> dict[str, Flow]:
        """All topics as they are now."""
        return self._flows.copy()


class MessageReceiver:
    """Handles the operations that come over a client's connections, one connection at a time."""

    def __init__(
        self, session: ClientSession, provider: ServiceProvider, url: str, now: Callable[[], float]
    ) -> None:
        """`url` is the server's, for the log; `now` is the client's clock [s]."""
        self._session = session
        self._provider = provider
        self._url = url
        self._now = now
        self._received = -math.inf
        self._reported: set[str] = set()
        self.traffic = Traffic()
        """Of the topics that come, over all connections."""
        self._unread = 0
        """Of frames that made no whole operation yet [bytes]."""

    async def run(self, connection: Connection, liveness: Liveness) -> None:
        """Handle everything that comes until the connection ends."""
        async for raw in connection.messages():
            self._received = now = self._now()
            liveness.on_message(now)
            self._unread += len(raw)
            for arrival in self._session.receive(raw, now):
                if isinstance(arrival, (Publish, BinaryPublish)):
                    self.traffic.add(arrival.topic, self._unread, now)
                self._unread = 0
                try:
                    self._handle(arrival, liveness)
                except ProtocolError as error:
                    self._report(error.op or "", error)

    def _handle(self, arrival: Arrival, liveness: Liveness) -> None:
        if isinstance(arrival, (Publish, BinaryPublish)):
            self._deliver(arrival, liveness)
        elif isinstance(arrival, ServiceResponse):
            if self._session.on_response(arrival):
                liveness.on_answer()
        elif isinstance(arrival, ActionFeedback):
            self._session.on_feedback(arrival)
        elif isinstance(arrival, ActionResult):
            self._session.on_result(arrival)
        elif isinstance(arrival, Status):
            log.warning("%s says: %s", self._url, arrival.msg)
        elif isinstance(arrival, (CallService, SendActionGoal)):
            self._handle_request(arrival, liveness)
        elif isinstance(arrival, CancelActionGoal):
            self._session.goal_cancelled(arrival)
        else:
            self._reject(arrival, liveness)

    def _handle_request(self, op: CallService | SendActionGoal, liveness: Liveness) -> None:
        try:
            if isinstance(op, CallService):
                self._session.called(op)
            else:
                self._session.goal_given(op)
        except ProtocolError as error:
            if liveness.robot:
                self._provider.refuse(op, error)
            else:
                liveness.on_strange()  # an echo, for instance
            raise

    def _reject(self, arrival: Op | ProtocolError, liveness: Liveness) -> None:
        if isinstance(arrival, ProtocolError):
            if arrival.op is None:
                liveness.on_strange()
            raise arrival
        liveness.on_strange()
        name = str(arrival.__struct_config__.tag)
        raise ProtocolError(f"{name} is for servers; it is passed over.", op=name)

    def _deliver(self, op: Publish | BinaryPublish, liveness: Liveness) -> None:
        decoded: dict[type[Msg], Msg] = {}
        for subscription in self._session.subscribers(op.topic):
            kind = subscription.type
            try:
                if kind not in decoded:
                    decoded[kind] = _decoded(op, kind, self._session.ros2)
                subscription.callback(decoded[kind], self._received)
            except ProtocolError as error:
                self._report(op.topic, ProtocolError(f"{op.topic} is left out: {error}"))
            except Exception:
                log.exception("Showing %s failed", op.topic)
        if decoded:
            liveness.on_answer()

    def _report(self, about: str, error: ProtocolError) -> None:
        """Log an error: as a warning the first time of a topic or operation, else for debugging only."""
        new = about not in self._reported and len(self._reported) < _MAX_REPORTED
        if new:
            self._reported.add(about)
        log.log(logging.WARNING if new else logging.DEBUG, "From %s: %s", self._url, error)


def _decoded(op: Publish | BinaryPublish, type: type[M], cdr: bool) -> M:
    if isinstance(op, Publish):
        return from_json(op.msg, type)
    if isinstance(op.msg, dict) and op.msg.keys() == _CBOR_RAW_KEYS and isinstance(op.msg["bytes"], bytes):
        return deserialize(op.msg["bytes"], type, cdr)
    return from_builtins(op.msg, type)
