"""One client that speaks plain JSON: its messages and calls through the robot's door, and its answers."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable, Collection, Coroutine, Iterator
from contextlib import contextmanager
from typing import Any

import msgspec
from msgspec.structs import replace

from bridge.codec import from_builtins, to_json
from bridge.core.codes import Code
from bridge.core.errors import BridgeError, ProtocolError, Refused
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from bridge.msgs.rosapi_msgs import GetTimeResponse
from bridge.msgs.std_msgs import Time
from robotside.control.command_expiry import MAX_CLOCK_LEAD
from robotside.core.notice import Notice
from robotside.core.text import number
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads.table import key_of
from robotside.gateways.plain.strict_json import decode, read_message

__all__ = ["STOP", "TIME", "VALID_TIME", "Visitor", "refusal"]

VALID_TIME = 5.0
"""A message that is sent once counts for so long after its stamp [s], as a call does unless it says otherwise."""

STOP = "/stop"
TIME = "/rosapi/get_time"
"""Its answer is the operators' clock, by which a client stamps its commands."""


def refusal(error: BridgeError) -> bytes:
    """The answer that says why something is not done: `success` false, a sentence, and its code where it has one."""
    said = error.args[0] if error.args else ""
    code = said.code if isinstance(said, Notice) else ""
    return msgspec.json.encode({"success": False, "message": str(error), "code": code})


class Visitor:
    """A client with an operator of its own at the door."""

    def __init__(self, door: StationDoor, operator: Operator, keys: Collection[str], name: str = "") -> None:
        """It reaches the payloads `keys`. `name` is how it calls itself where nothing else says it."""
        self.operator = operator
        self.name = name
        # so that a command that is sent again after the broker was gone counts as the same one
        self._client_id = f"{operator.way}:{name}" if name else ""
        self._door, self._keys = door, keys
        self._heard_before = operator.last_heard
        self.goals: dict[tuple[str, bytes], asyncio.Task[None]] = {}
        """What it has running, by action and id; cancelled when it is gone."""
        self.reads: dict[str, Callable[[], None]] = {}
        """What ends each topic that is made because it asked for it."""

    def heard(self) -> None:
        """A message of it came. If that is refused, it counts as not heard: control lapses of who says nothing else."""
        self._heard_before = self.operator.last_heard
        self.operator.last_heard = self._door.now()

    def _unheard(self) -> None:
        self.operator.last_heard = min(self.operator.last_heard, self._heard_before)

    @contextmanager
    def _unheard_if_refused(self) -> Iterator[None]:
        try:
            yield
        except BridgeError:
            self._unheard()
            raise

    def publish(self, topic: str, raw: bytes, stamp: float = math.nan, *, dated: bool = True) -> None:
        """Give a message to the robot, meant at `stamp` [s, operators' clock]; raises BridgeError for what it does not take or obey.

        What is sent once, such as a goal, must be as fresh as a call; of a stream the robot judges each message by itself.
        """
        with self._unheard_if_refused():
            self._check_carried(topic)
            self._door.check_listens(topic)
            known = self._door.topics[topic]
            msg = read_message(decode(raw), known.type)
            if not known.rate:
                self._check_fresh(topic, stamp, dated=dated)
            problem = self._door.publish(self.operator, topic, msg, None if math.isnan(stamp) else stamp)
        if problem:  # it was heard, as every message is that the robot judges
            raise Refused(problem)

    def call(
        self, service: str, raw: bytes, stamp: float = math.nan, *, dated: bool = True
    ) -> bytes | Coroutine[Any, Any, bytes]:
        """The answer of a service, at once where it can be had at once; a refusal is an answer too.

        A request without a stamp has `stamp` [s, operators' clock]. Where nothing else says that the call is fresh (`dated`
        False), one without any stamp is refused. STOP is pressed whatever the message says, or fails to say.
        """
        try:
            answer = self.ask(service, raw, stamp, dated=dated)
        except BridgeError as error:
            return refusal(error)
        return to_json(answer) if isinstance(answer, Msg) else _later(answer)

    def ask(
        self, service: str, raw: bytes, stamp: float = math.nan, *, dated: bool = True
    ) -> Msg | Awaitable[Msg]:
        """As `call`, with the answer as a message; raises BridgeError where it is refused at the door, now or when awaited."""
        with self._unheard_if_refused():
            if service == TIME:
                return self._time()
            self._check_carried(service)
            request = self._request(service, self._door.service(service).request, raw, stamp, dated=dated)
            answer = self._door.call(self.operator, service, request)
        if service != STOP and isinstance(answer, CommandResponse) and not answer.success:
            self._unheard()
        return answer

    def run(
        self,
        action: str,
        raw: bytes,
        stamp: float = math.nan,
        *,
        dated: bool = True,
        on_feedback: Callable[[bytes], None],
    ) -> Coroutine[Any, Any, bytes]:
        """Begin a goal of an action, of the same age as a call; its result, or why it is refused. Cancelled, it is taken back.

        `on_feedback` takes how far it is, as JSON. Raises BridgeError for a goal that cannot be read or is too old.
        """
        with self._unheard_if_refused():
            self._check_carried(action)
            goal = self._request(action, self._door.action(action).goal, raw, stamp, dated=dated)
            if not isinstance(goal, CommandRequest):  # which is judged by the stamp in itself
                self._check_fresh(action, stamp, dated=dated)
        return self._run(action, goal, lambda msg: on_feedback(to_json(msg)))

    async def _run(self, action: str, goal: Msg, on_feedback: Callable[[Msg], None]) -> bytes:
        return await _later(self._door.run(self.operator, action, goal, on_feedback))

    def leave_topic(self, name: str) -> None:
        """It wants a topic no more that it asked for."""
        stop = self.reads.pop(name, None)
        if stop is not None:
            stop()

    def leave(self) -> None:
        """It is gone: what it has running ends, and a robot that it drives stops."""
        try:
            self._door.leave(self.operator)
        finally:
            self.reads.clear()
            for task in tuple(self.goals.values()):
                task.cancel()

    def _request(self, name: str, known: type[Msg], raw: bytes, stamp: float, *, dated: bool) -> Msg:
        if name == STOP:
            return self._named(_any_request(raw, known))
        request = read_message(decode(raw), known)
        if not isinstance(request, CommandRequest):
            return request
        if math.isnan(request.stamp):
            request = replace(request, stamp=stamp)
        if math.isnan(request.stamp):  # of one with a stamp the service judges
            self._check_fresh(name, math.nan, dated=dated)
        return self._named(request)

    def _check_fresh(self, name: str, stamp: float, *, dated: bool) -> None:
        """Raises Refused for a command that is older than `VALID_TIME` by its stamp, or may be where nothing says it is not."""
        if math.isnan(stamp):
            if not dated:
                said = f"{name} is not done: nothing says how old it is. Give a stamp, or an expiry of the message."
                raise Refused(Notice(Code.GATEWAY_UNDATED, said, operation=name))
            return
        age = self._door.now() - stamp
        if age > VALID_TIME:
            late = f"{name} is too old: given {number(age)} s ago, valid for {number(VALID_TIME)} s."
            raise Refused(Notice(Code.COMMAND_LATE, late, age=age, allowed=VALID_TIME))
        if age < -MAX_CLOCK_LEAD:
            ahead = f"{name} is not done: its clock is {number(-age)} s ahead of the robot's."
            raise Refused(Notice(Code.COMMAND_AHEAD, ahead, seconds=-age, allowed=MAX_CLOCK_LEAD))

    def _named(self, request: Msg) -> Msg:
        """The request with the id and name that the client gave before, or its own, where it gives none."""
        if not isinstance(request, CommandRequest):
            return request
        self._client_id = request.client_id or self._client_id
        self.name = request.client_name or self.name
        return replace(request, client_id=self._client_id, client_name=self.name)

    def _time(self) -> GetTimeResponse:
        self._door.check(self.operator, "rosapi", TIME)
        self.operator.asked_time = True
        return GetTimeResponse(Time.at(self._door.now()))

    def _check_carried(self, name: str) -> None:
        if key_of(name) not in self._keys:
            said = f"This gateway does not carry {name[:100]}."
            raise Refused(Notice(Code.GATEWAY_LEFT_OUT, said, operation=name[:100]))


def _any_request(raw: bytes, known: type[Msg]) -> Msg:
    """What can be read of a STOP; an empty request when nothing can."""
    try:
        return from_builtins(decode(raw), known)
    except ProtocolError:
        return known()


async def _later(answer: Awaitable[Msg]) -> bytes:
    try:
        return to_json(await answer)
    except BridgeError as error:
        return refusal(error)
