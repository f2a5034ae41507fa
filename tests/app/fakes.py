"""A robot on a real socket that records what it hears and answers as it is told."""

from __future__ import annotations

import asyncio
import itertools
import math
import threading
import time
from collections.abc import Callable
from typing import Any

import msgspec

from bridge.core.identity import Identity, Role, public_id
from bridge.core.network_thread import NetworkThread
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    AcknowledgeEventsRequest,
    AcknowledgeEventsResponse,
    BringDownGatewayRequest,
    BringDownGatewayResponse,
    BringUpGatewayRequest,
    BringUpGatewayResponse,
    ChoosePlaceRequest,
    ChoosePlaceResponse,
    CommandRequest,
    CommandResponse,
    ControlStatus,
    DeletePlaceRequest,
    DeletePlaceResponse,
    DeleteScheduleRequest,
    DeleteScheduleResponse,
    Event,
    GetEventsRequest,
    GetEventsResponse,
    GetHistoryRequest,
    GetHistoryResponse,
    GetIntruderPictureRequest,
    GetIntruderPictureResponse,
    GetMissionsRequest,
    GetMissionsResponse,
    KeptMission,
    Mission,
    Place,
    PlaceArray,
    RecallMissionRequest,
    RecallMissionResponse,
    RobotInfo,
    Schedule,
    ScheduledTask,
    SetLightsRequest,
    SetLightsResponse,
    SetMissionRequest,
    SetModeRequest,
    SetModeResponse,
    SetOptionRequest,
    SetOptionResponse,
    SetPayloadRequest,
    SetPayloadResponse,
    SetPlaceRequest,
    SetPlaceResponse,
    SetQueueRequest,
    SetQueueResponse,
    SetScheduleRequest,
    SetScheduleResponse,
    StartTaskRequest,
    TaskOrder,
    TaskQueue,
    TaskRun,
)
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Time
from bridge.server.server import BridgeServer
from robotside.door.door import Door

__all__ = ["FakeRobot"]

REQUESTS: dict[str, type[Msg]] = {
    "/stop": CommandRequest,
    "/stop/hold": CommandRequest,
    "/stop/release": CommandRequest,
    "/task/pause": CommandRequest,
    "/task/resume": CommandRequest,
    "/task/cancel": CommandRequest,
    "/task/go_home": CommandRequest,
    "/control/acquire": CommandRequest,
    "/control/release": CommandRequest,
    "/control/request": CommandRequest,
    "/control/grant": CommandRequest,
    "/control/object": CommandRequest,
    "/mode/set": SetModeRequest,
    "/settings/set": SetOptionRequest,
    "/task/start": StartTaskRequest,
    "/mission/set": SetMissionRequest,
    "/task/confirm": CommandRequest,
    "/places/set": SetPlaceRequest,
    "/places/delete": DeletePlaceRequest,
    "/localisation/choose": ChoosePlaceRequest,
    "/task/queue/set": SetQueueRequest,
    "/schedule/set": SetScheduleRequest,
    "/schedule/delete": DeleteScheduleRequest,
    "/history/get": GetHistoryRequest,
    "/events/acknowledge": AcknowledgeEventsRequest,
    "/missions/get": GetMissionsRequest,
    "/mission/recall": RecallMissionRequest,
    "/lights/set": SetLightsRequest,
    "/robot/reset": CommandRequest,
    "/gateways/bring_up": BringUpGatewayRequest,
    "/gateways/bring_down": BringDownGatewayRequest,
    "/payloads/set": SetPayloadRequest,
}
RESPONSES: dict[str, type[CommandResponse]] = {
    "/mode/set": SetModeResponse,
    "/settings/set": SetOptionResponse,
    "/places/set": SetPlaceResponse,
    "/places/delete": DeletePlaceResponse,
    "/localisation/choose": ChoosePlaceResponse,
    "/task/queue/set": SetQueueResponse,
    "/schedule/set": SetScheduleResponse,
    "/schedule/delete": DeleteScheduleResponse,
    "/history/get": GetHistoryResponse,
    "/events/acknowledge": AcknowledgeEventsResponse,
    "/missions/get": GetMissionsResponse,
    "/mission/recall": RecallMissionResponse,
    "/lights/set": SetLightsResponse,
    "/gateways/bring_up": BringUpGatewayResponse,
    "/gateways/bring_down": BringDownGatewayResponse,
    "/payloads/set": SetPayloadResponse,
}
"""Of the services that answer with more than a sentence, or in a class of their own."""

OPTIONS = {"follow_link": "follows_link", "lost_link_stops_task": "lost_link_stops_task"}
"""Settings to the fields of ControlStatus that tell them."""


class KnowsAll:
    """The gate of a robot that takes every token for its person's, and lets in who shows none."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return Identity("", "", Role.MANAGE)

    def identify(self, token: str, address: str, client: str = "") -> Identity:
        return Identity(token.partition(".")[0], "", Role.MANAGE, proven=True)

    def needed(self, verb: str, name: str) -> Role:
        return Role.WATCH


class FakeRobot:
    """Serves on this machine; everything here may be called from the test's thread."""

    def __init__(self, port: int = 0) -> None:
        """`port` is a free one of this machine where it is 0."""
        self.network = NetworkThread("fake robot")
        self.asked: list[tuple[str, CommandRequest]] = []
        self.heard: list[tuple[str, Any]] = []
        self.stamps: list[tuple[Twist, float | None, float]] = []
        """Drive commands with their stamp and when they came [s], robot clock."""
        self.clock: Callable[[], float] = time.time
        """The robot's clock [s]; one that says NaN is none."""
        self.refusals: dict[str, str] = {}
        """Service to the sentence that it refuses with."""
        self.objection: Callable[[str, Any], str | None] = lambda name, _: self.refusals.get(name)
        """What it has against a service and its request; None for nothing."""
        self.events: list[Event] = []
        self.pictures: dict[int, bytes] = {}
        """JPEG files by the event that they are kept with."""
        self.places: list[Place] = []
        self.missions: dict[str, Mission] = {}
        """Those that have a name."""
        self.queue = TaskQueue(revision=1)
        self.schedule: list[ScheduledTask] = []
        self.runs: list[TaskRun] = []
        """Newest first."""
        self._ids = itertools.count(1)
        self.changed = threading.Condition()
        self._answering = asyncio.Event()
        self._answering.set()
        self._awake = threading.Event()
        self.port = port
        self.control = ControlStatus()
        self._server: BridgeServer | None = None
        self.start()

    @property
    def url(self) -> str:
        return f"ws://127.0.0.1:{self.port}"

    def start(self) -> None:
        """Serve, on the port of before where there was one."""
        services = [
            Service(name, "x/y", kind, RESPONSES.get(name, CommandResponse), self._answer(name))
            for name, kind in REQUESTS.items()
        ]
        services.append(Service("/events/get", "x/z", GetEventsRequest, GetEventsResponse, self._tell_events))
        services.append(
            Service(
                "/events/picture",
                "x/w",
                GetIntruderPictureRequest,
                GetIntruderPictureResponse,
                self._show_picture,
            )
        )
        door = Door(services=services, on_message=self._hear, now=self._now, gate=KnowsAll())
        self._server = BridgeServer(door, now=self._now)
        self.network.start(self._server.start("127.0.0.1", self.port)).result(5)
        self.port = self._server.port
        self.publish("/robot/info", RobotInfo(name="Fake-1", kind="wheels", max_speed=0.8, max_yaw_rate=1.5))
        self.publish("/mission", Mission())
        self.publish("/control/status", self.control)
        self.network.call(self._tell_kept)

    def stop(self) -> None:
        """Stop serving, as a robot that is switched off."""
        self.network.start(self._server.close()).result(5)

    def close(self) -> None:
        """End everything."""
        self.wake()
        self.stop()
        self.network.close()

    def publish(self, topic: str, message: Msg) -> None:
        """Send a message to whoever subscribed."""
        self.network.call(self._server.publish, topic, message)

    def faint(self) -> None:
        """Neither read nor say anything until `wake`, with the connection open."""
        self._awake.clear()
        self.network.call(self._awake.wait)

    def wake(self) -> None:
        """Go on, beginning with what waits in the socket."""
        self._awake.set()

    def cut(self) -> None:
        """Break every connection; whoever connects again is served."""

        def abort() -> None:
            for socket in list(self._server._open):
                socket.transport.abort()

        self.network.call(abort)

    def hold_answers(self) -> None:
        """Hear commands and leave them without an answer for now."""
        self.network.call(self._answering.clear)

    def give_answers(self) -> None:
        """Answer what was held, and what comes."""
        self.network.call(self._answering.set)

    def until(self, condition: Callable[[], Any], seconds: float = 10.0) -> bool:
        """Wait until what was heard fulfils a condition; False when it never does."""
        with self.changed:
            return bool(self.changed.wait_for(condition, seconds))

    def services(self) -> list[str]:
        """Names of the services asked for, in order."""
        return [name for name, _ in self.asked]

    def twists(self) -> list[Twist]:
        """Drive commands heard, in order."""
        return [message for topic, message in self.heard if topic == "/cmd_vel"]

    def _now(self) -> float:
        return self.clock()

    def _hear(self, session: Operator, topic: str, message: Msg, stamp: float | None) -> None:
        with self.changed:
            self.heard.append((topic, message))
            if isinstance(message, Twist):
                self.stamps.append((message, stamp, self.clock()))
            self.changed.notify_all()

    def _answer(self, name: str) -> Callable[[Operator, Any], Any]:
        async def call(session: Operator, request: CommandRequest) -> CommandResponse:
            with self.changed:
                self.asked.append((name, request))
                self.changed.notify_all()
            await self._answering.wait()
            refusal = self.objection(name, request)
            if refusal is None and name.startswith(("/stop", "/control", "/mode/set", "/settings")):
                self._become(name, request)
            kind = RESPONSES.get(name, CommandResponse)
            more = self._keep(name, request) if refusal is None else {}
            return kind(success=refusal is None, message=refusal or "Done.", **more)

        return call

    def _become(self, name: str, request: Any) -> None:
        now, who = self.control, (request.client_id, public_id(request.client_id))
        asker = (now.requested_by, now.requested_by_id)
        changes: dict[str, Any] = {
            "/stop": {"stopped": True, "mode": "STOPPED"},
            "/stop/release": {"stopped": False, "mode": "MANUAL"},
            "/control/acquire": _asked() | _driven(*who),
            "/control/release": _asked() | ({} if asker == who else _driven(*asker)),
            "/control/grant": _asked() | _driven(*asker),
            "/control/object": _asked(),
            "/control/request": _asked(*who, self.clock() + 10.0),
            "/mode/set": {"mode": getattr(request, "mode", "")},
            "/settings/set": {
                OPTIONS.get(getattr(request, "name", ""), "follows_link"): getattr(request, "value", "")
                == "on"
            },
        }.get(name, {})
        self.control = msgspec.structs.replace(now, **changes)
        self._server.publish("/control/status", self.control)

    def wait_for(self, *orders: TaskOrder) -> None:
        """Let these be the queue, as if somebody else had set it."""
        self.queue = TaskQueue(revision=self.queue.revision + 1, orders=list(orders))
        self.publish("/task/queue", self.queue)

    def know(self, *places: Place) -> None:
        """Let these be the places there are."""
        self.places = list(places)
        self.network.call(self._tell_kept)

    def _keep(self, name: str, request: Any) -> dict[str, Any]:
        """Do what was asked about what is kept; gives what the answer says beyond its sentence."""
        if name.startswith(("/events", "/mission")):
            return self._keep_by_name(name, request)
        if name == "/history/get":
            runs = [run for run in self.runs if not request.before or run.id < request.before]
            return {"runs": runs[: request.limit]}
        more: dict[str, Any] = {}
        if name == "/places/set":
            self.places, more["id"] = self._stored(self.places, request.place)
        elif name == "/places/delete":
            self.places = [place for place in self.places if place.id != request.id]
        elif name == "/schedule/set":
            self.schedule, more["id"] = self._stored(self.schedule, request.task)
        elif name == "/schedule/delete":
            self.schedule = [task for task in self.schedule if task.id != request.id]
        elif name == "/task/queue/set":
            self._set_queue(request.orders)
        self._tell_kept()
        return more

    def happen(self, *events: Event) -> None:
        """Let these happen, one after the other."""
        for event in events:
            self.events.append(event)
            self.publish("/events", event)

    def _keep_by_name(self, name: str, request: Any) -> dict[str, Any]:
        if name == "/events/acknowledge":
            self._see_to(request)
        elif name != "/missions/get":
            self._take_mission(request.mission if name == "/mission/set" else self.missions[request.name])
        else:
            kept = [
                KeptMission(one.name, one.stamp, len(one.waypoints), one.motion, 1)
                for _, one in sorted(self.missions.items())
            ]
            return {"names": [one.name for one in kept], "missions": kept}
        return {}

    def _take_mission(self, mission: Mission) -> None:
        if mission.name:
            mission = msgspec.structs.replace(mission, stamp=Time.at(self.clock()))
            self.missions[mission.name] = mission
            self._server.publish("/mission", mission)

    def _see_to(self, request: AcknowledgeEventsRequest) -> None:
        """Note who has seen to events, the first who did, and tell everybody."""
        for index, event in enumerate(self.events):
            if event.id in request.ids and not event.acknowledged_by:
                by = request.client_name
                seen = msgspec.structs.replace(event, acknowledged_by=by, acknowledged=Time.at(self.clock()))
                self.events[index] = seen
                self._server.publish("/events", seen)

    def _set_queue(self, orders: list[TaskOrder]) -> None:
        numbered = [
            order if order.id else msgspec.structs.replace(order, id=next(self._ids) + 100)
            for order in orders
        ]
        self.queue = TaskQueue(revision=self.queue.revision + 1, orders=numbered)

    def _stored(self, kept: list[Any], one: Any) -> tuple[list[Any], int]:
        number = one.id or next(self._ids) + 100
        one = msgspec.structs.replace(one, id=number)
        return sorted([*(old for old in kept if old.id != number), one], key=lambda one: one.id), number

    def _tell_kept(self) -> None:
        self._server.publish("/places", PlaceArray(places=self.places))
        self._server.publish("/task/queue", self.queue)
        self._server.publish("/schedule", Schedule(tasks=self.schedule))

    def _show_picture(
        self, session: Operator, request: GetIntruderPictureRequest
    ) -> GetIntruderPictureResponse:
        self.asked.append(("/events/picture", request))
        file = self.pictures.get(request.event, b"")
        return GetIntruderPictureResponse(bool(file), picture=CompressedImage(format="jpeg", data=file))

    def _tell_events(self, session: Operator, request: GetEventsRequest) -> GetEventsResponse:
        same = any(event.boot == request.boot for event in self.events)
        known = request.since if same else 0
        later = [event for event in self.events if event.id > known]
        told = later[: request.most] if request.boot else later[-request.most :]
        open = request.open if same else ()
        seen = [one for one in self.events if one.id in open and one.id <= known and one.acknowledged_by]
        return GetEventsResponse([*seen, *told], bool(told) and told[-1] is not later[-1])


def _driven(name: str, client_id: str) -> dict[str, Any]:
    return {"driver": name, "driver_id": client_id}


def _asked(name: str = "", client_id: str = "", due: float = 0.0) -> dict[str, Any]:
    return {
        "requested_by": name,
        "requested_by_id": client_id,
        "handover": Time.at(due) if math.isfinite(due) else Time(),
    }
