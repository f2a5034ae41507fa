"""One client of the plain WebSocket: what it asks for goes to the robot's door, what it is told goes to its queue."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from typing import Any

import msgspec
from msgspec import Raw

from bridge.core.async_tasks import cancel_all
from bridge.core.errors import BridgeError, ProtocolError, Refused
from bridge.protocol import absolute
from bridge.server.callback_connection import CallbackConnection
from bridge.server.flow.outgoing_messages import text_frame
from bridge.server.flow.priority_lanes import Lane
from bridge.server.flow.round_trip import RoundTrip
from bridge.server.flow.send_queue import SendQueue, WriteBatch
from bridge.server.reception.credentials import introduce
from bridge.server.reception.places import FULL
from robotside.door.station_door import StationDoor
from robotside.gateways.plain.visitor import STOP, TIME, VALID_TIME, Visitor, refusal
from robotside.gateways.websocket.goals import Goals
from robotside.gateways.websocket.requests import (
    Call,
    Cancel,
    Id,
    Publish,
    Request,
    Run,
    Subscribe,
    Token,
    Unsubscribe,
    any_id,
    bare_word,
    read_request,
    says_stop,
)
from robotside.gateways.websocket.subscriptions import Subscriptions

__all__ = ["ARM", "Session"]

ARM = "/arm/move"
"""The service that a bare word goes to, as the name of a pose."""


class Session:
    """A `MessageHandler` of its connection; owns the calls that wait for their answer."""

    def __init__(
        self,
        ws: CallbackConnection,
        batch: WriteBatch,
        door: StationDoor,
        visitor: Visitor,
        subscribing: Callable[[SendQueue], Subscriptions],
    ) -> None:
        """`subscribing(queue)` makes the subscriptions whose messages go to the queue."""
        self.operator = visitor.operator
        self.queue = SendQueue(ws, batch, visitor.operator.address)
        self._ws, self._door, self._visitor = ws, door, visitor
        self._round_trip = RoundTrip(visitor.operator.opened)
        self._subscriptions = subscribing(self.queue)
        self._goals = Goals(visitor, self.queue)
        self._calls: set[asyncio.Task[None]] = set()
        self._carry_out: dict[type[Request], Callable[[Any], None]] = {
            Call: self._call,
            Publish: self._publish,
            Subscribe: self._subscribe,
            Unsubscribe: self._unsubscribe,
            Run: self._run,
            Cancel: self._cancel,
            Token: self._authenticate,
        }

    def say(self, said: Mapping[str, object], lane: Lane = Lane.REPLY) -> None:
        """Send an object that must not be lost."""
        self.queue.send(lane, text_frame(msgspec.json.encode(said)))

    def on_message(self, message: str | bytes) -> bool:
        """Carry a message out; what is wrong with it is answered."""
        raw = message if isinstance(message, bytes) else message.encode()
        self._visitor.heard()
        if says_stop(raw):
            self._stop(raw)
            return True
        id: Id = None
        try:
            request = self._read(raw)
            id = request.id
            self._carry_out[type(request)](request)
        except BridgeError as error:
            self._refuse(raw, error, id)
        return True

    def resume(self) -> bool:
        """Nothing is ever left of a message."""
        return True

    def on_pong(self, content: bytes) -> None:
        """Handle the answer to a ping."""
        if self._round_trip.on_pong(content, self._door.now()):
            self._note_round_trip()
        else:
            self.queue.on_pong(content)

    def on_drained(self) -> None:
        """Send what waits: everything written so far has left this process."""
        self.queue.send_waiting()

    def measure_round_trip(self) -> None:
        """Send a ping that measures the round trip; to be called every `round_trip.PING_PERIOD`."""
        content = self._round_trip.ping(self._door.now())
        if content is not None:
            self.queue.ping(content)
        self._note_round_trip()

    def check_alive(self) -> None:
        """Disconnect a client that gives no sign of life, or whose role has ended; to be called every second or so."""
        if self.operator.role(self._door.now()) < self.operator.identity.role:
            self._ws.abort()
        self.queue.check_alive()

    async def close(self) -> None:
        """End what a client asked for that is gone."""
        self._subscriptions.close()
        try:
            await self._goals.close()
            await cancel_all(self._calls)
        finally:
            self.queue.close()

    @property
    def _dated(self) -> bool:
        """What comes now was sent a moment ago."""
        return self._door.now() - self.operator.answered <= VALID_TIME

    def _read(self, raw: bytes) -> Request:
        word = bare_word(raw)
        if not word:
            return read_request(raw)
        if ARM not in self._door.services:
            raise ProtocolError(
                f"{word!r} is no JSON object, and this robot has no arm with a pose of that name."
            )
        return Call(ARM, Raw(msgspec.json.encode({"order": {"pose": word}})))

    def _stop(self, raw: bytes) -> None:
        """Press STOP, whatever else the message says."""
        try:
            request = read_request(raw)
        except ProtocolError:
            request = None
        wish = bytes(request.request) if isinstance(request, Call) else b""
        self._settle(STOP, any_id(raw), self._visitor.call(STOP, wish))

    def _call(self, asked: Call) -> None:
        name = absolute(asked.call)
        if name == STOP:
            self._settle(STOP, asked.id, self._visitor.call(STOP, bytes(asked.request)))
            return
        if self._only_stop and name != TIME:
            raise Refused(FULL)
        answer = self._visitor.call(name, bytes(asked.request), asked.stamp, dated=self._dated)
        self._settle(name, asked.id, answer)

    def _settle(self, name: str, id: Id, answer: bytes | Awaitable[bytes]) -> None:
        """Send an answer, now or when it is there."""
        if isinstance(answer, bytes):
            self._answer(name, id, answer)
            return

        async def later() -> None:
            self._answer(name, id, await answer)

        task = asyncio.create_task(later())
        self._calls.add(task)
        task.add_done_callback(self._calls.discard)

    def _publish(self, asked: Publish) -> None:
        self._check_place()
        name = absolute(asked.publish)
        self._visitor.publish(name, bytes(asked.message), asked.stamp, dated=self._dated)
        self._confirm(name, asked.id)

    def _subscribe(self, asked: Subscribe) -> None:
        self._check_place()
        name = absolute(asked.subscribe)
        self._subscriptions.subscribe(name, asked.rate)
        self._confirm(name, asked.id)

    def _unsubscribe(self, asked: Unsubscribe) -> None:
        name = absolute(asked.unsubscribe)
        self._subscriptions.unsubscribe(name)
        self._confirm(name, asked.id)

    def _run(self, asked: Run) -> None:
        self._check_place()
        self._goals.begin(asked, absolute(asked.run), dated=self._dated)

    def _cancel(self, asked: Cancel) -> None:
        self._goals.cancel(asked.cancel)
        self._confirm("cancel", asked.id)

    def _authenticate(self, asked: Token) -> None:
        before = self.operator.identity
        self._door.authenticate(self.operator, asked.token)
        introduce(self.operator, self._ws.place, self._door.now())
        who = self.operator.identity
        if who != before:
            self._subscriptions.close()  # they were asked for by somebody else
        said = {"success": True, "message": f"You are {who.name}, with the role {who.role.word}."}
        self.say({"answer": "token", "id": asked.id, "response": said})

    def _confirm(self, name: str, id: Id) -> None:
        """What was asked with an id is confirmed."""
        if id is not None:
            self.say({"answer": name, "id": id, "response": {"success": True, "message": ""}})

    def _answer(self, name: str, id: Id, response: bytes) -> None:
        lane = Lane.CONTROL if self._door.is_urgent(name) else Lane.REPLY
        said = {"answer": name} | ({} if id is None else {"id": id}) | {"response": Raw(response)}
        self.say(said, lane)

    def _refuse(self, raw: bytes, error: BridgeError, id: Id) -> None:
        id = any_id(raw) if id is None else id
        said: dict[str, object] = {"refused": raw[:60].decode(errors="replace")}
        said |= {} if id is None else {"id": id}
        self.say({**said, **msgspec.json.decode(refusal(error), type=dict)})

    def _check_place(self) -> None:
        if self._only_stop:
            raise Refused(FULL)

    @property
    def _only_stop(self) -> bool:
        return self._ws.place is not None and self._ws.place.only_stop

    def _note_round_trip(self) -> None:
        self.operator.rtt, self.operator.answered = self._round_trip.rtt, self._round_trip.answered
