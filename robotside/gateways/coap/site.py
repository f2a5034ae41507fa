"""What the CoAP gateway answers: topics to read and observe, topics to publish on, services to call, STOP and the guide."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from typing import Any

import msgspec
from aiocoap.message import Message
from aiocoap.numbers.codes import Code as CoapCode

from bridge.core.errors import BridgeError, Refused
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import Topic
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.server.reception.log_limit import STRANGERS
from robotside.door.station_door import StationDoor
from robotside.gateways.coap.blocks import BlocksIn, BlocksOut
from robotside.gateways.coap.datagrams import Tuning, is_stop
from robotside.gateways.coap.observation import Observation
from robotside.gateways.coap.observers import FIRST_TIMEOUT, Observers
from robotside.gateways.coap.requests import (
    IMAGE,
    JSON,
    LINKS,
    TEXT,
    Asked,
    Body,
    Failure,
    address_of,
    body_of,
    code_of,
    failure,
    failure_of,
    key_of_request,
    read_asked,
)
from robotside.gateways.payloads.table import key_of
from robotside.gateways.plain.turns import Turns
from robotside.gateways.plain.visitor import STOP, TIME
from robotside.gateways.plain.visitors import Visitors

__all__ = ["BYE", "CORE", "GUIDE", "MAX_UNDER_WAY", "CoapSite"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

MAX_UNDER_WAY = 64
"""Requests that wait for their answer at a time; STOP always may."""
GUIDE, CORE, BYE = "/guide", "/.well-known/core", "/bye"


class CoapSite:
    """Answers requests; `answer` is called in a task of its own for each."""

    def __init__(
        self,
        door: StationDoor,
        clients: Visitors,
        keys: Collection[str],
        rate: float,
        *,
        plain_from: Callable[[str], bool],
        pages: Callable[[str, Operator], Body],
        turns: Turns,
    ) -> None:
        """`rate` is that of who observes without one [Hz]; only payloads among `keys` are carried, and only STOP is
        answered to hosts from which `plain_from` takes nothing. `pages(path, operator)` is the guide, and the list of all.
        Requests begin in their `turns`, STOP at once.
        """
        self._door, self._clients, self._keys = door, clients, keys
        self._plain_from, self._pages, self._turns = plain_from, pages, turns
        self._in, self._out = BlocksIn(), BlocksOut()
        self._clock = asyncio.get_running_loop().time
        self._under_way = 0
        self.observers = Observers(door, clients, rate, self._out, self._clock)
        """Who is notified."""

    async def answer(self, pipe: Any) -> None:
        """Answer one request; for an observation this goes on until the client is gone."""
        response = await self._respond(pipe)
        if response is not None:
            pipe.add_response(response, is_last=True)

    def close(self) -> None:
        """Tell the observers that it is over; who runs the requests ends them."""
        self.observers.close()
        self._in.clear()
        self._out.clear()

    async def _respond(self, pipe: Any) -> Any:
        """The answer; None when it went through the pipe."""
        request = pipe.request
        accept = None
        try:
            if is_stop(request):
                return await self._press_stop(request)
            await self._turns.take(("coap", request.remote.host))
            if self._under_way >= MAX_UNDER_WAY:
                raise Failure(
                    CoapCode.SERVICE_UNAVAILABLE, f"{MAX_UNDER_WAY} requests are under way.", max_age=1
                )
            asked = read_asked(request)
            accept = asked.accept
            self._check_plain(request.remote.host)
            if request.code == CoapCode.GET:
                return await self._read(pipe, asked)
            if request.code in (CoapCode.POST, CoapCode.PUT):
                with self._counted():
                    return await self._command(request, asked)
            raise failure(f"{request.code} is not done; GET, POST and PUT are.", CoapCode.METHOD_NOT_ALLOWED)
        except Failure as problem:
            return _tuned(problem.message(accept))
        except BridgeError as error:
            return _tuned(failure_of(error).message(accept))
        except Exception:
            log.exception("A request from %s failed", request.remote)
            said = "The robot failed at this; its log says why."
            return _tuned(Failure(CoapCode.INTERNAL_SERVER_ERROR, said).message(accept))

    async def _press_stop(self, request: Any) -> Any:
        """Press STOP for anyone, whatever else the request says; a wrong token is no reason not to."""
        said = dict(part.partition("=")[::2] for part in request.opt.uri_query)
        client, token, address = said.get("client", "")[:64], said.get("token", ""), address_of(request)
        try:
            visitor = self._clients.newcomer(client, token, address)
        except Refused:
            visitor = self._clients.newcomer(client, "", address)
        try:
            answer = visitor.call(STOP, bytes(request.payload))
            raw = answer if isinstance(answer, bytes) else await answer
        finally:
            self._clients.leave(visitor)
        return _tuned(Message(code=_outcome(raw)[0], payload=raw, content_format=JSON))

    async def _command(self, request: Any, asked: Asked) -> Any:
        """Publish or call."""
        if asked.accept not in (None, JSON, TEXT):
            raise failure("Answers are JSON or text.", CoapCode.NOT_ACCEPTABLE)
        key, now = key_of_request(request, asked), self._clock()
        kept = self._out.kept(request, key, now)
        if kept is not None:
            return _tuned(self._out.answer(request, key, kept, now, code=CoapCode.CHANGED))
        if request.opt.block2 is not None and request.opt.block2.block_number:
            raise failure("That answer is not kept any more.", CoapCode.REQUEST_ENTITY_INCOMPLETE)
        form = request.opt.content_format
        if form not in (None, JSON, TEXT):
            raise failure(
                f"A message is JSON or text, of the content format {JSON} or {TEXT}, not {int(form)}.",
                CoapCode.UNSUPPORTED_CONTENT_FORMAT,
            )
        payload = self._in.take(request, key, now)
        raw = await self._carry_out(asked, payload, address_of(request))
        response = Message(code=CoapCode.CHANGED)
        if raw:
            code, word, said = _outcome(raw)
            if code is not CoapCode.CHANGED:
                raise Failure(code, said, word)
            form = TEXT if asked.accept == TEXT else JSON
            response = self._out.answer(request, key, Body(raw, form), now, code=CoapCode.CHANGED)
        if request.opt.block1 is not None:
            response.opt.block1 = request.opt.block1
        return _tuned(response)

    async def _carry_out(self, asked: Asked, payload: bytes, address: str) -> bytes:
        """The answer of a service; empty for what was published."""
        name = asked.path
        if name == BYE:
            self._clients.leave_name(asked.client, asked.token, address)
            return b""
        self._check_there(name)
        visitor = self._clients.visit(asked.client, asked.token, address)
        if name in self._door.services or name == TIME:
            answer = visitor.call(name, payload, asked.stamp, dated=False)
            return answer if isinstance(answer, bytes) else await answer
        visitor.publish(name, payload, asked.stamp, dated=False)
        return b""

    def _check_there(self, name: str) -> None:
        """Raises Failure for what is neither a service nor a topic to publish on."""
        topic = self._door.topics.get(name)
        if name == TIME or (
            key_of(name) in self._keys and (name in self._door.services or topic is not None)
        ):
            if topic is not None and topic.to != "robot":
                raise failure(f"The robot speaks on {name}: GET it.", CoapCode.METHOD_NOT_ALLOWED)
            return
        raise failure(f"This gateway does not carry {name[:100]}.", CoapCode.NOT_FOUND)

    async def _read(self, pipe: Any, asked: Asked) -> Any:
        """The newest message of a topic, or a page."""
        request, now = pipe.request, self._clock()
        visitor = self._clients.visit(asked.client, asked.token, address_of(request))
        key = key_of_request(request, asked)
        kept = self._out.kept(request, key, now)
        if asked.path in (GUIDE, CORE, "/"):
            if asked.accept not in (None, LINKS if asked.path == CORE else TEXT):
                raise failure("The guide is text, and the list of all is links.", CoapCode.NOT_ACCEPTABLE)
            body = kept or self._pages(asked.path, visitor.operator)
            return _tuned(self._out.answer(request, key, body, now))
        topic = self._topic(asked.path)
        self._door.check(visitor.operator, "subscribe", topic.name)
        _check_accept(topic, asked)
        if kept is not None:
            return _tuned(self._out.answer(request, key, kept, now))
        if request.opt.observe == 0 and self.observers.has_room(request.remote.host):
            return await self.observers.observe(pipe, asked, topic)
        with self._counted():
            msg = await self._newest(visitor.operator, topic)
        if msg is None:
            raise failure(f"Nothing was said on {topic.name} yet.", CoapCode.NOT_FOUND)
        return _tuned(self._out.answer(request, key, body_of(msg, asked), now))

    def _topic(self, name: str) -> Topic:
        topic = self._door.topics.get(name)
        if key_of(name) not in self._keys or (topic is None and name not in self._door.services):
            raise failure(f"This gateway does not carry {name[:100]}.", CoapCode.NOT_FOUND)
        if topic is None or topic.to == "robot":
            raise failure(f"{name} is not read: POST to it.", CoapCode.METHOD_NOT_ALLOWED)
        return topic

    async def _newest(self, operator: Operator, topic: Topic) -> Msg | None:
        """The newest message; of a topic that is made on demand the next one."""
        if not topic.on_demand:
            return self._door.last(topic.name)
        observation = Observation(self._door, operator, topic, 0.0, self._clock)
        try:
            return await observation.first(FIRST_TIMEOUT)
        finally:
            observation.close()

    def _check_plain(self, host: str) -> None:
        if not self._plain_from(host):
            said = "This robot speaks without TLS to its own machine only; only STOP is answered here."
            raise failure(said, CoapCode.UNAUTHORIZED)

    @contextmanager
    def _counted(self) -> Iterator[None]:
        self._under_way += 1
        try:
            yield
        finally:
            self._under_way -= 1


def _tuned(response: Any) -> Any:
    response.transport_tuning = Tuning()
    return response


def _check_accept(topic: Topic, asked: Asked) -> None:
    if asked.accept in (None, JSON, TEXT) or (
        asked.accept == IMAGE and issubclass(topic.type, CompressedImage)
    ):
        return
    raise failure(f"{topic.name} comes as JSON or text.", CoapCode.NOT_ACCEPTABLE)


def _outcome(raw: bytes) -> tuple[CoapCode, str, str]:
    """CoAP's code for the answer of a service, and the code and sentence of a refusal."""
    found = msgspec.json.decode(raw)
    if not isinstance(found, dict) or found.get("success") is not False:
        return CoapCode.CHANGED, "", ""
    word, said = str(found.get("code", "")), str(found.get("message", ""))
    return code_of(word) if word else CoapCode.BAD_REQUEST, word, said
