"""The services that clients call: each checks whether it may, does it, and answers with one sentence."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable, Iterable
from typing import Any

import msgspec

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseStamped
from bridge.msgs.pilothouse_msgs import (
    MAX_DWELL,
    MAX_LAPS,
    MOTIONS,
    REACTIONS,
    CommandRequest,
    GetEventsRequest,
    GetEventsResponse,
    GetMissionRequest,
    GetMissionResponse,
    Mission,
    RecallMissionRequest,
    RecallMissionResponse,
    RunTaskGoal,
    SetMissionRequest,
    Waypoint,
)
from bridge.msgs.std_msgs import Time
from bridge.server.server import Service, Session
from robotside.control.authority import Operator
from robotside.core.pose2 import Pose2
from robotside.core.refusal import Refusal
from robotside.core.text import plain
from robotside.records import NotRecorded
from robotside.services.command_service import Answering
from robotside.services.control_services import control_services
from robotside.services.equipment_services import equipment_services
from robotside.services.preconditions import Permits
from robotside.services.records_services import kept_services
from robotside.services.task_services import TaskOrders, task_services
from robotside.station.station import Station

__all__ = ["listener", "runner", "services"]

MOST_POINTS = 500
"""Waypoints that one mission may have."""

LONGEST_NAME = 60
"""Characters kept of a waypoint's name."""


def services(station: Station) -> Iterable[Service]:
    """What the bridge offers for `station`."""
    orders, answering = _Orders(station), Answering(station)
    service = answering.service
    yield service("/stop", orders.stop, ageless=True)
    yield service("/stop/release", orders.release_stop)
    yield from task_services(station, answering)
    yield service("/mission/set", orders.set_mission, "SetMission", SetMissionRequest)
    yield service(
        "/mission/recall", orders.recall, "RecallMission", RecallMissionRequest, RecallMissionResponse
    )
    yield from kept_services(station, answering)
    yield from control_services(station, answering)
    yield from equipment_services(station, answering)
    yield _service("/mission/get", "GetMission", GetMissionRequest, GetMissionResponse, orders.mission)
    yield _service("/events/get", "GetEvents", GetEventsRequest, GetEventsResponse, orders.events)


def runner(station: Station) -> Callable[[Session, RunTaskGoal], Msg | Awaitable[Msg]]:
    """What begins a task for whoever wants to hear its end: refused while another one has not ended."""
    return Answering(station).service("/task/run", TaskOrders(station).run, request=RunTaskGoal).call


def listener(station: Station) -> Callable[[Operator, str, Msg, float | None], None]:
    """What takes in all that clients publish. A goal is an order as those of the services; what refuses it is told to all."""
    orders = TaskOrders(station)

    def hear(client: Operator, topic: str, msg: Msg, stamp: float | None) -> None:
        if isinstance(msg, PoseStamped):
            pose = Pose2.from_msg(msg.pose)
            try:
                orders.go_to(client, Waypoint(pose.x, pose.y, pose.yaw))
            except (Refusal, NotRecorded) as problem:
                station.events.say("command", problem.notice, "warn")
        station.hear(client, topic, msg, stamp)

    return hear


def _service(
    name: str, kind: str, request: type[Msg], response: type[Msg], call: Callable[[Session, Any], Msg]
) -> Service:
    return Service(name, f"pilothouse_msgs/{kind}", request, response, call)


class _Orders:
    """What each service does; a method returns the sentence of success or raises Refusal."""

    def __init__(self, station: Station) -> None:
        self._station, self._permits = station, Permits(station)

    def stop(self, client: Operator, asked: CommandRequest) -> str:
        """Latch STOP; it is not done while the robot cannot be reached, so that whoever pressed it goes on asking."""
        controls = self._station.controls
        given = math.inf if math.isnan(asked.stamp) else asked.stamp
        self._station.press_stop(controls.name(client), controls.id(client), given)
        doubt = self._station.stop_doubt
        if doubt:
            raise Refusal(f"STOP is pressed, but {doubt[0].lower()}{doubt[1:]}")
        return f"Stopped. {self._station.stop_unkept}".strip()

    def release_stop(self, client: Operator, asked: CommandRequest) -> str:
        """Unlatch STOP, unless it was pressed after that was asked for: the release was late on its way."""
        self._permits.need_control(client)
        controls = self._station.controls
        if not controls.stopped:
            return "STOP was not pressed."
        if asked.stamp < controls.stop_given:
            raise Refusal("STOP was pressed after that was asked for: it stays.")
        self._station.release_stop(self._station.controls.name(client))
        return "STOP is released."

    def set_mission(self, client: Operator, asked: SetMissionRequest) -> str:
        """Check a mission and store it."""
        self._permits.may_set_off(client, self._station.autonomy.patrols_mission)
        self._store(asked.mission)
        count = len(asked.mission.waypoints)
        return f"Stored {count} {'point' if count == 1 else 'points'}{self._later(asked.mission)}."

    def recall(self, client: Operator, asked: RecallMissionRequest) -> str:
        """Make a kept mission the stored one, as if it was set anew."""
        self._permits.may_set_off(client, self._station.autonomy.patrols_mission)
        mission = self._station.records.missions.recall(asked.name)
        self._store(mission)
        return f"{mission.name} is the mission now{self._later(mission)}."

    def _later(self, mission: Mission) -> str:
        """What becomes of the patrol that is under way."""
        if not self._station.autonomy.patrols_mission:
            return ""
        if mission.waypoints:
            return "; the patrol that is under way takes them over at its next point"
        return "; the patrol that is under way keeps its own"

    def _store(self, mission: Mission) -> None:
        _check_words(mission)
        mission = _named(mission)
        places = [(f"Point {number}", point) for number, point in enumerate(mission.waypoints, 1)]
        for name, place in (*places, *(("Home", home) for home in mission.home[:1])):
            self._permits.has_map()
            problem = self._station.fault(name, place.x, place.y)
            if problem:
                raise Refusal(problem)
        stamp = Time.at(self._station.clock())
        self._station.keep(msgspec.structs.replace(mission, stamp=stamp, home=mission.home[:1]))

    def mission(self, _: Operator, __: GetMissionRequest) -> GetMissionResponse:
        """Give the stored mission."""
        mission = self._station.records.missions.stored
        stored = mission.stamp.seconds > 0
        return GetMissionResponse(True, "" if stored else "No mission was stored yet.", mission)

    def events(self, _: Operator, asked: GetEventsRequest) -> GetEventsResponse:
        """Give the events that a client missed."""
        return self._station.events.answer(asked)


def _named(mission: Mission) -> Mission:
    """The same mission with each point's name cut to a readable line."""
    replace = msgspec.structs.replace
    points, home = (
        [replace(point, name=plain(point.name, LONGEST_NAME)) for point in places]
        for places in (mission.waypoints, mission.home[:1])
    )
    return replace(mission, waypoints=points, home=home)


def _check_words(mission: Mission) -> None:
    if mission.motion not in MOTIONS:
        raise Refusal(f"There is no motion {mission.motion!r}; there are {', '.join(MOTIONS)}.")
    if mission.on_intruder not in ("", *REACTIONS):
        said = f"There is no reaction {mission.on_intruder!r} to an intruder"
        raise Refusal(f"{said}; there are {', '.join(REACTIONS)}.")
    if not (math.isfinite(mission.dwell) and 0 <= mission.dwell <= MAX_DWELL):
        raise Refusal(f"The dwell must be 0 to {MAX_DWELL:.0f} s, not {mission.dwell} s.")
    if not 0 <= mission.laps <= MAX_LAPS:
        raise Refusal(f"The laps must be 0 to {MAX_LAPS}, not {mission.laps}.")
    if len(mission.waypoints) > MOST_POINTS:
        raise Refusal(f"A mission has at most {MOST_POINTS} points, not {len(mission.waypoints)}.")
