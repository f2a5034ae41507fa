"""What each operation does: orders by the robot's door, and what the robot last said of itself."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable, Collection
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar, cast

import msgspec

from bridge.codec import from_json, to_json
from bridge.core.async_tasks import wait
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import Topic
from bridge.msgs import Msg
from bridge.msgs import pilothouse_msgs as msgs
from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, TaskOrder
from bridge.msgs.rosapi_msgs import GetTimeResponse
from bridge.msgs.sensor_msgs import BatteryState
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads.table import key_of
from robotside.gateways.plain.callers import Callers
from robotside.gateways.plain.visitor import STOP, TIME, Visitor
from robotside.gateways.soap import callbacks, messages
from robotside.gateways.soap.callbacks import Callbacks, target_of
from robotside.gateways.soap.messages import Caller, Done
from robotside.gateways.soap.subscriptions import LIFETIME, Subscriptions, readable

__all__ = ["Call", "RobotServices", "message_of"]

M = TypeVar("M", bound=Msg)

_PLAIN = {
    "GoHome": "/task/go_home",
    "Pause": "/task/pause",
    "Resume": "/task/resume",
    "Cancel": "/task/cancel",
    "Confirm": "/task/confirm",
}
"""Operations that are a service without parameters."""


@dataclass(frozen=True, slots=True)
class Call:
    """One call of an operation."""

    operator: Operator
    """Of this request alone."""
    visitor: Visitor
    """Who calls, as long as it is there."""
    caller: Caller
    request: Any
    """As of the operation."""

    @property
    def command(self) -> dict[str, Any]:
        """What every command's request has, of the header."""
        caller = self.caller
        found = {
            "command_id": caller.command_id,
            "stamp": caller.stamp,
            "valid_for": caller.valid_for,
            "client_id": caller.client_id,
            "client_name": caller.client_name,
        }
        return {name: value for name, value in found.items() if value is not None}


def message_of(topic: Topic, msg: Msg) -> messages.Message:
    """A message of the robot as clients get it."""
    return messages.Message(topic.name, topic.type.MSGTYPE, to_json(msg).decode())


class RobotServices:
    """The operations of one robot. Each raises BridgeError with one sentence when it is not done."""

    def __init__(
        self,
        door: StationDoor,
        keys: Collection[str],
        callers: Callers,
        subscriptions: Subscriptions,
        callbacks: Callbacks,
        guide: Callable[[], str],
    ) -> None:
        """The robot's payloads `keys` are reached; `guide` tells how."""
        self._door, self._keys, self._guide = door, keys, guide
        self._callers, self._subscriptions, self._callbacks = callers, subscriptions, callbacks
        self._do: dict[str, Callable[[Call], Awaitable[object]]] = {
            "GetInfo": self._info,
            "GetStatus": self._status,
            "GetPose": self._pose,
            "GetTime": self._time,
            "ListPlaces": self._places,
            "Deliver": self._deliver,
            "GoTo": self._go_to,
            "GuideTo": self._guide_to,
            "StartTask": self._start_task,
            "MoveArm": self._move_arm,
            "CallService": self._call_service,
            "PublishMessage": self._publish,
            "GetMessage": self._message,
            "Subscribe": self._subscribe,
            "FetchMessages": self._fetch,
            "Renew": self._renew,
            "Unsubscribe": self._unsubscribe,
            "Leave": self._leave,
            "GetGuide": self._how,
            **{name: partial(self._plain, service) for name, service in _PLAIN.items()},
        }

    async def do(self, operation: str, call: Call) -> object:
        """Carry an operation out, any but STOP; its answer."""
        return await self._do[operation](call)

    async def stop(self, visitor: Visitor, caller: Caller | None) -> Done:
        """Press STOP for anyone."""
        raw = (
            b""
            if caller is None
            else to_json(CommandRequest(**Call(visitor.operator, visitor, caller, None).command))
        )
        return _done(await _answered(visitor.call(STOP, raw)))

    async def _plain(self, service: str, call: Call) -> Done:
        return await _ordered(call, service, CommandRequest(**call.command))

    async def _start(self, call: Call, order: TaskOrder) -> Done:
        instead = bool(call.request.instead)
        request = msgs.StartTaskRequest(order=order, instead=instead, **call.command)
        return await _ordered(call, "/task/start", request)

    async def _deliver(self, call: Call) -> Done:
        asked: messages.Deliver = call.request
        places = [asked.source, asked.target] + ([asked.next_] if asked.next_ else [])
        order = TaskOrder(
            task="deliver", places=places, message=asked.item or "", recipient_tag=asked.card or ""
        )
        return await self._start(call, order)

    async def _go_to(self, call: Call) -> Done:
        return await self._start(call, TaskOrder(task="go_to", places=[call.request.place]))

    async def _guide_to(self, call: Call) -> Done:
        asked: messages.GuideTo = call.request
        order = TaskOrder(task="guide", places=list(asked.place), message=asked.message or "")
        return await self._start(call, order)

    async def _start_task(self, call: Call) -> Done:
        asked: messages.StartTask = call.request
        order = TaskOrder(
            task=asked.task,
            places=list(asked.place),
            goals=[_waypoint(each) for each in asked.goal],
            message=asked.message or "",
            heading=_number(asked.heading),
            speed=_number(asked.speed),
            height=_number(asked.height),
            duration=_number(asked.duration),
        )
        return await self._start(call, order)

    async def _move_arm(self, call: Call) -> Done:
        asked: messages.MoveArm = call.request
        order = msgs.ArmOrder(
            pose=asked.pose or "",
            angles=Float64Array(asked.angle),
            increments=Float64Array(asked.increment),
            gripper=_number(asked.gripper),
        )
        return await _ordered(call, "/arm/move", msgs.MoveArmRequest(order=order, **call.command))

    async def _call_service(self, call: Call) -> messages.Answer:
        asked: messages.CallService = call.request
        raw, known = (asked.message or "").encode(), self._door.services.get(asked.service)
        if known is not None and issubclass(known.request, CommandRequest):
            raw = _with(raw, call.command)
        answer = await _answered(call.visitor.call(asked.service, raw))
        found = msgspec.json.decode(answer)
        if isinstance(found, dict) and found.get("success") is False:
            _done(answer)
        return messages.Answer(answer.decode())

    async def _publish(self, call: Call) -> Done:
        asked: messages.PublishMessage = call.request
        topic = self._door.topics.get(asked.topic)
        if topic is not None and topic.rate and not call.caller.client_id:
            said = "A client without a clientId is gone once it is answered, and a robot that it drove rests; give one."
            raise Refused(said)
        call.visitor.publish(asked.topic, asked.message.encode(), _number(call.caller.stamp))
        return Done(f"{asked.topic} was given to the robot.")

    async def _info(self, call: Call) -> messages.Info:
        self._may_read(call, "/robot/info")
        info, arm = self._door.info, _carried(self._door, self._keys, call, "/arm", msgs.ArmState)
        return messages.Info(
            info.name,
            info.kind,
            info.model,
            info.description,
            info.world,
            info.max_speed,
            info.max_yaw_rate,
            info.radius,
            tuple(info.cameras),
            tuple(info.payloads),
            tuple(info.tasks),
            tuple(arm.poses) if arm else (),
        )

    async def _status(self, call: Call) -> messages.Status:
        self._may_read(call, "/control/status")
        control = (
            _carried(self._door, self._keys, call, "/control/status", msgs.ControlStatus)
            or msgs.ControlStatus()
        )
        task = _carried(self._door, self._keys, call, "/task/status", msgs.TaskStatus) or msgs.TaskStatus()
        battery = _carried(self._door, self._keys, call, "/battery_state", BatteryState)
        return messages.Status(
            control.mode,
            control.driver,
            control.stopped,
            control.stopped_by,
            control.at_rest,
            task.task,
            task.state,
            task.reason,
            task.place,
            task.asks,
            battery.percentage if battery else None,
            key_of("/pose") in self._keys and self._door.health.position_sure,
        )

    async def _pose(self, call: Call) -> messages.Pose:
        self._may_read(call, "/pose")
        told = _last(self._door, "/pose", PoseWithCovarianceStamped)
        if told is None:
            raise Refused("The robot has not said yet where it is.")
        x, y, yaw = Pose2.from_msg(told.pose.pose)
        sure, height = self._door.health.position_sure, told.pose.pose.position.z
        return messages.Pose(x, y, yaw, told.header.stamp.seconds, sure, height)

    async def _time(self, call: Call) -> messages.Time:
        answer = await _answered(call.visitor.call(TIME, b""))
        found = msgspec.json.decode(answer)
        if "time" not in found:
            _done(answer)
        return messages.Time(from_json(answer, GetTimeResponse).time.seconds)

    async def _places(self, call: Call) -> messages.Places:
        self._may_read(call, "/places")
        told = _last(self._door, "/places", msgs.PlaceArray) or msgs.PlaceArray()
        return messages.Places(
            tuple(
                messages.Place(each.id, each.name, each.kind, each.floor, each.x, each.y, each.yaw, each.note)
                for each in told.places
            )
        )

    async def _message(self, call: Call) -> messages.Message:
        asked: messages.GetMessage = call.request
        topic = self._may_read(call, asked.topic)
        msg = None if topic.on_demand else self._door.last(topic.name)
        if msg is None:
            msg = await self._next(call.operator, topic, asked.patience or 0.0)
        if msg is None:
            raise Refused(f"There was no message on {topic.name}; wait for one by patience, in seconds.")
        return message_of(topic, msg)

    async def _next(self, operator: Operator, topic: Topic, patience: float) -> Msg | None:
        """The next message of a topic; None when none comes within `patience` [s]."""
        came: list[Msg] = []
        wake = asyncio.Event()

        def put(_: str, msg: Msg) -> None:
            came[:] = [msg]
            wake.set()

        end = self._door.subscribe(operator, topic.name, put)
        try:
            if not came:
                await wait(wake, patience)
        finally:
            end()
        return came[0] if came else None

    async def _subscribe(self, call: Call) -> messages.Subscription:
        asked: messages.Subscribe = call.request
        if not asked.topic:
            raise Refused("Subscribe to one topic at least.")
        if asked.callback is None:
            made = self._subscriptions.open(call.operator, asked.topic, LIFETIME)
        else:
            target = target_of(asked.callback, call.operator)
            self._door.check(call.operator, "advertise", "a callback")
            made = self._subscriptions.open(call.operator, asked.topic, callbacks.LIFETIME)
            self._callbacks.begin(made, target)
        return messages.Subscription(made.id, made.lifetime)

    async def _fetch(self, call: Call) -> messages.Messages:
        asked: messages.FetchMessages = call.request
        news = await self._subscriptions.find(asked.subscription).news(asked.patience or 0.0)
        return messages.Messages(tuple(message_of(topic, msg) for topic, msg in news))

    async def _renew(self, call: Call) -> messages.Subscription:
        found = self._subscriptions.find(call.request.subscription)
        return messages.Subscription(found.id, found.lifetime)

    async def _unsubscribe(self, call: Call) -> Done:
        self._subscriptions.end(self._subscriptions.find(call.request.subscription))
        return Done("The subscription has ended.")

    async def _leave(self, call: Call) -> Done:
        self._callers.leave(call.operator, call.caller.client_id or "")
        return Done("Goodbye.")

    async def _how(self, _: Call) -> messages.Guide:
        return messages.Guide(self._guide())

    def _may_read(self, call: Call, topic: str) -> Topic:
        return readable(self._door, self._keys, call.operator, topic)


def _carried(door: StationDoor, keys: Collection[str], call: Call, topic: str, cls: type[M]) -> M | None:
    """The newest message of a topic as part of an answer; None where there is none or this gateway does not carry it."""
    if key_of(topic) not in keys:
        return None
    door.check(call.operator, "subscribe", topic)
    return _last(door, topic, cls)


def _last(door: StationDoor, topic: str, cls: type[M]) -> M | None:
    msg = door.last(topic)
    return msg if isinstance(msg, cls) else None


async def _answered(answer: bytes | Awaitable[bytes]) -> bytes:
    return answer if isinstance(answer, bytes) else await answer


def _done(answer: bytes) -> Done:
    """The answer to a command; raises Refused with the robot's own sentence and code when it was not done."""
    found = from_json(answer, CommandResponse)
    if not found.success:
        raise Refused(Notice.of(found.message, found))
    return Done(found.message)


async def _ordered(call: Call, service: str, request: CommandRequest) -> Done:
    return _done(await _answered(call.visitor.call(service, to_json(request))))


def _waypoint(goal: messages.Waypoint) -> msgs.Waypoint:
    return msgs.Waypoint(goal.x, goal.y, _number(goal.yaw), height=_number(goal.height))


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def _with(raw: bytes, command: dict[str, Any]) -> bytes:
    """A request in JSON with what the header says, where it says nothing itself; as it is where it cannot be read."""
    try:
        found = msgspec.json.decode(raw or b"{}")
    except msgspec.DecodeError:
        return raw
    return (
        raw
        if not isinstance(found, dict)
        else msgspec.json.encode({**command, **cast("dict[str, Any]", found)})
    )
