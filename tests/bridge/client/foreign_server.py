"""A rosbridge server that is not ours, with the manners of the real one of ROS 1, or of ROS 2, and a robot behind it.

It shares no code with `bridge`, so that both ends of a test cannot be wrong together.

    python tests/bridge/client/foreign_server.py --port 9090 [--ros 2]

Manners of ROS 1: small packets wait for acknowledgements (Nagle), slashes are escaped, there is no `status` and no
ping, bad operations are dropped without a word, fragments count in floats and by numbers, a client's service that
answers `result: false` is reported as success, ROS 2's type names are refused, messages with fixed arrays get lost in
CBOR. Of ROS 2: `pkg/msg/Type`, sec and nanosec, actions, `/rosapi/get_ros_version`, no Nagle.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import itertools
import json
import logging
import math
import socket
import sys
import time
from collections import deque
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cbor2
from websockets.asyncio.connection import broadcast
from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.exceptions import ConnectionClosed

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))

from tests.bridge import foreign_types as types
from tests.bridge.foreign_robot import PERIODS, ForeignRobot
from tests.bridge.foreign_rosapi import RosApi
from tests.bridge.foreign_text import as_png, dump, operations, resolved
from tests.bridge.foreign_types import Unfit, internal

log = logging.getLogger(__name__)
Answer = Callable[[bool, Any], None]
"""Told whether a call went well, and the values or the reason."""


@dataclass
class Topic:
    """What is known of a topic."""

    type: str
    latch: bool = False
    last: dict[str, Any] | None = None
    publishers: set[Any] = field(default_factory=set)


@dataclass
class Wish:
    """A client's subscriptions of one topic, as one."""

    peer: Peer
    name: str
    """The topic as the client wrote it."""
    subscriptions: dict[Any, dict[str, Any]] = field(default_factory=dict)
    waiting: deque[dict[str, Any]] = field(default_factory=deque)
    last: float = -math.inf
    timer: asyncio.TimerHandle | None = None

    def least(self, key: str) -> Any:
        """The least that one of the subscriptions asks for."""
        return min(op.get(key) or 0 for op in self.subscriptions.values())

    def compression(self) -> str:
        """The one that wins."""
        asked = {op.get("compression") for op in self.subscriptions.values()}
        return next((name for name in ("cbor-raw", "cbor", "png") if name in asked), "none")

    def offer(self, kind: str, msg: dict[str, Any]) -> None:
        """Send now, or when the interval allows, or never: as the real server, which drops what comes too early."""
        period, length = self.least("throttle_rate") / 1000, self.least("queue_length")
        due = self.last + period - time.monotonic()
        if due <= 0 and not self.waiting:
            self._send(kind, msg)
        elif length:
            self.waiting.append(msg)
            while len(self.waiting) > length:
                self.waiting.popleft()
            if self.timer is None:
                self.timer = asyncio.get_running_loop().call_later(max(0.0, due), self._late, kind)

    def _late(self, kind: str) -> None:
        self.timer = None
        if self.waiting and self.subscriptions:
            self._send(kind, self.waiting.popleft())
            if self.waiting:
                period = self.least("throttle_rate") / 1000
                self.timer = asyncio.get_running_loop().call_later(period, self._late, kind)

    def _send(self, kind: str, msg: dict[str, Any]) -> None:
        self.last = time.monotonic()
        self.peer.deliver(self.name, kind, msg, self.compression())

    def end(self) -> None:
        """Nothing comes any more."""
        self.subscriptions.clear()
        if self.timer is not None:
            self.timer.cancel()


class Peer:
    """One client."""

    def __init__(self, ws: ServerConnection, server: ForeignServer) -> None:
        self.ws = ws
        self.server = server
        self.wishes: dict[str, Wish] = {}
        self.fragment_size: int | None = None
        self.pieces: dict[Any, list[str]] = {}
        self.heard: list[dict[str, Any]] = []
        """Every operation that came."""
        self._numbers = itertools.count()

    async def run(self) -> None:
        async for raw in self.ws:
            for op in operations(raw):
                self.hear(op)

    def hear(self, op: dict[str, Any]) -> None:
        """Carry one operation out; what is wrong with it is logged and told to nobody."""
        self.heard.append(op)
        if "fragment_size" in op:
            self.fragment_size = op["fragment_size"]
        carry = getattr(self, f"_op_{op.get('op')}", None)
        if carry is None:
            log.warning("Unknown operation: %s", op.get("op"))
            return
        try:
            carry(op)
        except (Unfit, KeyError, TypeError, ValueError) as error:
            log.warning("%s: %r", op.get("op"), error)

    def say(self, **op: Any) -> None:
        """Send an operation as text, in pieces when the client asked for that."""
        self._text(dump(op, self.server.ros), op.get("id"))

    def _text(self, text: str, id: Any) -> None:
        size = self.fragment_size
        if not size or len(text) <= size:
            broadcast([self.ws], text)
            return
        id = next(self._numbers) if id is None else id
        total = (len(text) - 1) / size + 1 if self.server.ros == 1 else math.ceil(len(text) / size)
        for number, start in enumerate(range(0, len(text), size)):
            piece = {
                "op": "fragment",
                "id": id,
                "data": text[start : start + size],
                "num": number,
                "total": total,
            }
            broadcast([self.ws], dump(piece, self.server.ros))

    def deliver(self, topic: str, kind: str, msg: dict[str, Any], compression: str) -> None:
        """Send a message in the form that was asked for; some do not arrive, as from the real servers."""
        ros = self.server.ros
        if compression in ("cbor", "cbor-raw"):
            if self.fragment_size:
                log.warning("%s: CBOR cannot be sent in pieces", topic)
                return
            try:
                self._binary(topic, kind, msg, compression)
            except Unfit as error:
                log.warning("lost: %s", error)
            return
        text = dump({"op": "publish", "topic": topic, "msg": types.outward(kind, msg, ros)}, ros)
        if compression == "png":
            text = dump({"op": "png", "data": as_png(text)}, ros)
        self._text(text, None)

    def _binary(self, topic: str, kind: str, msg: dict[str, Any], compression: str) -> None:
        if self.server.ros == 2 and compression == "cbor-raw":
            raise Unfit("this server has no serialisation of ROS 2")
        if compression == "cbor":
            values = types.to_cbor(kind, msg, self.server.ros)
        else:
            values = types.stamp_now() | {"bytes": types.to_bytes(kind, msg)}
        broadcast([self.ws], cbor2.dumps({"op": "publish", "topic": topic, "msg": values}))

    def _op_advertise(self, op: dict[str, Any]) -> None:
        kind = internal(op["type"], self.server.ros)
        topic = self.server.topic(resolved(op["topic"]), kind)
        topic.latch = bool(op.get("latch"))
        topic.publishers.add((self, op.get("id")))

    def _op_unadvertise(self, op: dict[str, Any]) -> None:
        self.server.forget(resolved(op["topic"]), self, op.get("id"))

    def _op_publish(self, op: dict[str, Any]) -> None:
        name = resolved(op["topic"])
        topic = self.server.topics.get(name)
        if topic is None:
            raise Unfit(f"nobody advertised {name}")
        self.server.publish(name, topic.type, op.get("msg", {}), op.get("latch") or topic.latch, self)

    def _op_subscribe(self, op: dict[str, Any]) -> None:
        name = resolved(op["topic"])
        for key in ("fragment_size", "throttle_rate", "queue_length"):
            if not isinstance(op.get(key, 0), int):
                raise Unfit(f"{key} is no int")
        known = self.server.topics.get(name)
        if known is None and not op.get("type"):
            raise Unfit(f"{name} has no type yet")
        kind = internal(op["type"], self.server.ros) if op.get("type") else known.type
        topic = self.server.topic(name, kind)
        wish = self.wishes.setdefault(name, Wish(self, op["topic"]))
        wish.subscriptions[op.get("id")] = op
        if topic.latch and topic.last is not None:
            wish.offer(topic.type, topic.last)

    def _op_unsubscribe(self, op: dict[str, Any]) -> None:
        name = resolved(op["topic"])
        wish = self.wishes.get(name)
        if wish is None:
            return
        if op.get("id") is None:
            wish.subscriptions.clear()
        wish.subscriptions.pop(op.get("id"), None)
        if not wish.subscriptions:
            self.wishes.pop(name).end()

    def _op_call_service(self, op: dict[str, Any]) -> None:
        named, _, legacy = op["service"].partition("#")
        id = op.get("id", legacy or None)

        def answer(ok: bool, values: Any) -> None:
            known = {} if id is None else {"id": id}
            self.say(op="service_response", service=named, values=values, result=ok, **known)

        self.server.call(resolved(named), op.get("args") or {}, answer)

    def _op_service_response(self, op: dict[str, Any]) -> None:
        answer = self.server.calls.pop(op["id"], None)
        if answer is None:
            raise Unfit(f"no call {op['id']} waits")
        if isinstance(op.get("values"), dict):  # without, the caller waits for ever
            answer(True, op["values"])

    def _op_advertise_service(self, op: dict[str, Any]) -> None:
        self.server.offered[resolved(op["service"])] = (self, op["type"])

    def _op_unadvertise_service(self, op: dict[str, Any]) -> None:
        self.server.offered.pop(resolved(op["service"]), None)

    def _op_fragment(self, op: dict[str, Any]) -> None:
        if not isinstance(op["total"], int):
            raise Unfit("total is no int")
        pieces = self.pieces.setdefault(op["id"], [])
        if op["num"] != len(pieces):
            del self.pieces[op["id"]]
            raise Unfit("a fragment out of its order")
        pieces.append(op["data"])
        if len(pieces) == op["total"]:
            self.hear(json.loads("".join(self.pieces.pop(op["id"]))))

    def _op_advertise_action(self, op: dict[str, Any]) -> None:
        self.server.need_ros2()
        self.server.performers[resolved(op["action"])] = (self, op["type"])

    def _op_unadvertise_action(self, op: dict[str, Any]) -> None:
        self.server.need_ros2()
        self.server.performers.pop(resolved(op["action"]), None)

    def _op_send_action_goal(self, op: dict[str, Any]) -> None:
        self.server.need_ros2()
        self.server.begin(self, op)

    def _op_cancel_action_goal(self, op: dict[str, Any]) -> None:
        self.server.need_ros2()
        self.server.cancel(op["id"])

    def _op_action_feedback(self, op: dict[str, Any]) -> None:
        caller, wanted = self.server.goals[op["id"]]
        if wanted.get("feedback"):
            caller.say(op="action_feedback", id=wanted["id"], action=wanted["action"], values=op["values"])

    def _op_action_result(self, op: dict[str, Any]) -> None:
        if not isinstance(op.get("values", {}), dict):
            raise Unfit("values is no object")
        caller, wanted = self.server.goals.pop(op["id"])
        named = {"id": wanted["id"], "action": wanted["action"]}
        status = op.get("status", 4)
        caller.say(
            op="action_result", **named, values=op["values"], status=status, result=op.get("result", True)
        )


class ForeignServer:
    """The graph: topics, services, actions, and who has to do with them."""

    def __init__(
        self, ros: int = 1, *, nagle: bool | None = None, now: Callable[[], float] = time.time
    ) -> None:
        """`ros` is whose manners, 1 or 2. `nagle` None means as that one's sockets."""
        self.ros, self.port = ros, 0
        self.robot = ForeignRobot()
        self.topics: dict[str, Topic] = {}
        self.command = "/cmd_vel"
        self.taken: dict[str, list[dict[str, Any]]] = {}  # what the robot heard beside its command
        self.offered: dict[str, tuple[Peer, str]] = {}
        self.performers: dict[str, tuple[Peer, str]] = {}
        self.calls: dict[str, Answer] = {}
        self.goals: dict[str, tuple[Peer, dict[str, Any]]] = {}
        self.peers: set[Peer] = set()
        self.deaf = False
        """While it is set every client is accepted and none is listened to."""
        self._nagle = ros == 1 if nagle is None else nagle
        self._numbers = itertools.count(1)
        self.counting: dict[str, asyncio.Task[None]] = {}
        self._work: list[asyncio.Task[None]] = []
        self._listening: Server | None = None
        self.rosapi = RosApi(self, now)
        for name, (_, kind) in PERIODS.items():
            self.topic(name, kind).publishers.add("robot")
        self.topic(self.command, "geometry_msgs/Twist")
        self.publish("/robot_description", "std_msgs/String", {"data": "<robot name='disc'/>"}, True)

    async def start(self, port: int = 0, host: str = "127.0.0.1") -> None:
        options: dict[str, Any] = {"compression": None, "ping_interval": None, "close_timeout": 0.2}
        self._listening = await serve(self._serve, host, port, max_size=10_000_000, **options)
        self.port = next(iter(self._listening.sockets)).getsockname()[1]
        self._work = [asyncio.create_task(self._publishing(*line)) for line in PERIODS.items()]
        self._work.append(asyncio.create_task(self._moving()))

    async def close(self) -> None:
        work = [*self._work, *self.counting.values()]
        for task in work:
            task.cancel()
        await asyncio.gather(*work, return_exceptions=True)
        for peer in list(self.peers):
            peer.ws.transport.abort()
        if self._listening is not None:
            self._listening.close()
            await self._listening.wait_closed()

    async def _serve(self, ws: ServerConnection) -> None:
        sock = ws.transport.get_extra_info("socket")
        sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 0 if self._nagle else 1)
        peer = Peer(ws, self)
        self.peers.add(peer)
        try:
            with contextlib.suppress(ConnectionClosed):
                await (ws.wait_closed() if self.deaf else peer.run())
        finally:
            self.peers.discard(peer)
            self._undo(peer)

    def _undo(self, peer: Peer) -> None:
        for wish in peer.wishes.values():
            wish.end()
        for name in list(self.topics):
            self.forget(name, peer, None)
        for offers in (self.offered, self.performers):
            for name in [name for name, (owner, _) in offers.items() if owner is peer]:
                del offers[name]

    async def _moving(self) -> None:
        last = time.monotonic()
        while True:
            await asyncio.sleep(0.02)
            now = time.monotonic()
            self.robot.step(now - last)
            last = now

    async def _publishing(self, name: str, line: tuple[float, str]) -> None:
        period, kind = line
        while True:
            if any(name in peer.wishes for peer in self.peers):
                self.publish(name, kind, self.robot.measure(name))
            await asyncio.sleep(period)

    def need_ros2(self) -> None:
        """Unfit where there are no actions."""
        if self.ros != 2:
            raise Unfit("Unknown operation")

    def topic(self, name: str, kind: str) -> Topic:
        """A topic that is there from now on; Unfit when it has another type or one that nobody knows."""
        if kind not in types.TYPES:
            raise Unfit(f"no type {kind}")
        found = self.topics.setdefault(name, Topic(kind))
        if found.type != kind:
            raise Unfit(f"{name} is {found.type}, not {kind}")
        return found

    def forget(self, name: str, peer: Peer, id: Any) -> None:
        """One advertisement of a client's, or with `id` None all of them, is taken back."""
        topic = self.topics.get(name)
        if topic is not None:
            topic.publishers -= {who for who in topic.publishers if who[0] is peer and id in (None, who[1])}

    def publish(
        self, name: str, kind: str, msg: dict[str, Any], latch: bool = False, by: Any = "robot"
    ) -> None:
        """Hand a message to the robot and to everybody who wants it; Unfit when it is none of `kind`."""
        topic = self.topic(name, kind)
        made = types.shaped(kind, msg)
        topic.publishers.add((by, None) if isinstance(by, Peer) else by)
        topic.latch = topic.latch or latch
        topic.last = made
        if name == self.command:
            self.robot.command(made.get("twist", made))
        self.taken.get(name, []).append(made)
        for peer in list(self.peers):
            if name in peer.wishes:
                peer.wishes[name].offer(kind, made)

    def call(self, name: str, args: Any, answer: Answer) -> None:
        """Have a service answer, of our own or of a client."""
        if name in self.offered:
            peer, _ = self.offered[name]
            id = f"service_request:{name}:{next(self._numbers)}"
            self.calls[id] = answer
            peer.say(op="call_service", id=id, service=name, args=args)
            return
        try:
            answer(True, self.rosapi.answer(name, args))
        except LookupError:
            answer(False, f"Service {name} does not exist")
        except (Unfit, ValueError, TypeError) as error:
            answer(False, f"service [{name}] responded with an error: b'{error}'")

    def begin(self, caller: Peer, op: dict[str, Any]) -> None:
        """Pass a goal on to whoever performs it, or count to it ourselves."""
        name = resolved(op["action"])
        id = f"action_goal:{name}:{next(self._numbers)}"
        if name in self.performers:
            self.goals[id] = (caller, op)
            kind = self.performers[name][1]
            goal = {"action": name, "action_type": kind, "args": op.get("args", {}), "feedback": True}
            self.performers[name][0].say(op="send_action_goal", id=id, **goal)
        elif name == "/fibonacci":
            self.counting[op["id"]] = asyncio.create_task(self._count(caller, op))
        else:
            values = f"Action server {name} is not available"
            caller.say(
                op="action_result", id=op.get("id"), action=name, values=values, status=0, result=False
            )

    def cancel(self, id: Any) -> None:
        """Have a goal given up, by the id that its sender gave it."""
        if id in self.counting:
            self.counting[id].cancel()
        for ours, (_, op) in self.goals.items():
            if op["id"] == id:
                name = resolved(op["action"])
                self.performers[name][0].say(op="cancel_action_goal", id=ours, action=name)

    async def _count(self, caller: Peer, op: dict[str, Any]) -> None:
        named = {"id": op["id"], "action": op["action"]}
        sequence, status = [0, 1], 5
        try:
            for _ in range(op.get("args", {}).get("order", 0) - 1):
                await asyncio.sleep(0.02)
                sequence.append(sequence[-1] + sequence[-2])
                if op.get("feedback"):
                    caller.say(op="action_feedback", **named, values={"sequence": sequence})
            status = 4
        except asyncio.CancelledError:
            log.info("%s was given up", op["id"])
        del self.counting[op["id"]]
        caller.say(op="action_result", **named, values={"sequence": sequence}, status=status, result=True)


@contextlib.asynccontextmanager
async def foreign(ros: int = 1, **options: Any) -> AsyncIterator[ForeignServer]:
    """A server that is not ours on a free port of loopback, or on `port`."""
    port = options.pop("port", 0)
    made = ForeignServer(ros, **options)
    await made.start(port)
    try:
        yield made
    finally:
        await made.close()


async def _main(port: int, ros: int) -> None:
    async with foreign(ros, port=port) as made:
        print(f"ROS {ros} at ws://127.0.0.1:{made.port}", flush=True)  # noqa: T201 - the one line that who starts it waits for
        await asyncio.get_running_loop().create_future()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--port", type=int, default=9090)
    parser.add_argument("--ros", type=int, choices=(1, 2), default=1)
    asked = parser.parse_args()
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(_main(asked.port, asked.ros))
