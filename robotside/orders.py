"""The services that clients call: each checks whether it may, does it, and answers with one sentence."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable, Iterable
from typing import Any

import msgspec

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    LONGEST_DWELL,
    MOST_LAPS,
    MOTIONS,
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
    StartTaskRequest,
    Waypoint,
)
from bridge.msgs.std_msgs import Time
from bridge.server import Service, Session
from robotside.answering import Answering
from robotside.autonomy import LOW_BELOW
from robotside.commands import Refusal
from robotside.controls import STOP_SENTENCE, Operator
from robotside.keeping import kept_services
from robotside.station import NO_MAP, Station
from robotside.steering import control_services
from robotside.words import plain

__all__ = ["runner", "services"]

MOST_POINTS = 500
"""Waypoints that one mission may have."""

LONGEST_NAME = 60
"""Characters kept of a waypoint's name."""


def services(station: Station) -> Iterable[Service]:
    """What the bridge offers for `station`."""
    orders, answering = _Orders(station), Answering(station)
    service = answering.service
    plain: dict[str, Callable[[Operator, CommandRequest], str]] = {
        "/stop/release": orders.release_stop,
        "/task/pause": orders.pause,
        "/task/resume": orders.resume,
        "/task/cancel": orders.cancel,
        "/task/go_home": orders.go_home,
    }
    yield service("/stop", orders.stop, ageless=True)
    for name, action in plain.items():
        yield service(name, action)
    yield service("/task/start", orders.start, "StartTask", StartTaskRequest)
    yield service("/mission/set", orders.set_mission, "SetMission", SetMissionRequest)
    yield service(
        "/mission/recall", orders.recall, "RecallMission", RecallMissionRequest, RecallMissionResponse
    )
    yield from kept_services(station, answering)
    yield from control_services(station, answering, orders.pause, orders.resume)
    yield _service("/mission/get", "GetMission", GetMissionRequest, GetMissionResponse, orders.mission)
    yield _service("/events/get", "GetEvents", GetEventsRequest, GetEventsResponse, orders.events)


def runner(station: Station) -> Callable[[Session, RunTaskGoal], Msg | Awaitable[Msg]]:
    """What begins a task for whoever wants to hear its end: refused while another one has not ended."""
    return Answering(station).service("/task/run", _Orders(station).run, request=RunTaskGoal).call


def _service(
    name: str, kind: str, request: type[Msg], response: type[Msg], call: Callable[[Session, Any], Msg]
) -> Service:
    return Service(name, f"pilothouse_msgs/{kind}", request, response, call)


class _Orders:
    """What each service does; a method returns the sentence of success or raises Refusal."""

    def __init__(self, station: Station) -> None:
        self._station = station

    def stop(self, client: Operator, _: CommandRequest) -> str:
        """Latch STOP; it is not done while the robot cannot be reached, so that whoever pressed it goes on asking."""
        self._station.press_stop(self._station.controls.name(client))
        doubt = self._station.stop_doubt
        if doubt:
            raise Refusal(f"STOP is pressed, but {doubt[0].lower()}{doubt[1:]}")
        return "Stopped."

    def release_stop(self, client: Operator, _: CommandRequest) -> str:
        """Unlatch STOP."""
        self._need_control(client)
        if not self._station.controls.stopped:
            return "STOP was not pressed."
        self._station.release_stop(self._station.controls.name(client))
        return "STOP is released."

    def start(self, client: Operator, asked: StartTaskRequest) -> str:
        """Start a task on the stored mission."""
        if asked.task == "go_home":
            return self.go_home(client, asked)
        if asked.task != "patrol":
            raise Refusal(f"There is no task {asked.task!r}; there are patrol and go_home.")
        self._may_move(client)
        station = self._station
        self._check_idle()
        mission = station.mission
        if not mission.waypoints:
            raise Refusal("The mission has no points; set at least one.")
        self._check_places(mission)
        self._check_battery()
        station.controls.hold()
        station.autonomy.start_patrol(mission, station.now)
        count = len(mission.waypoints)
        return f"Patrol started: {count} {'point' if count == 1 else 'points'}, {mission.motion}."

    def run(self, client: Operator, asked: RunTaskGoal) -> str:
        """Start a task that is the only one."""
        self._check_idle()
        return self.start(client, asked)

    def go_home(self, client: Operator, _: CommandRequest) -> str:
        """Go to the stored home, whatever it is doing."""
        self._may_move(client)
        station = self._station
        if not station.mission.home:
            raise Refusal("Home is not set; set it on the map first.")
        home = station.mission.home[0]
        self._check_place("Home", home)
        station.controls.hold()
        station.autonomy.start_home(home, station.now)
        return "Going home."

    def pause(self, client: Operator, _: CommandRequest) -> str:
        """Hold the running task."""
        self._need_control(client)
        engine = self._station.autonomy.engine
        if engine.paused:
            return "The task is paused already."
        if not engine.running:
            raise Refusal("No task is running.")
        engine.pause(f"Paused by {self._station.controls.name(client)}.")
        return "Paused."

    def resume(self, client: Operator, _: CommandRequest) -> str:
        """Go on with the paused task."""
        self._may_move(client)
        engine = self._station.autonomy.engine
        if engine.running:
            return "The task is running already."
        if not engine.paused:
            raise Refusal("No task is paused.")
        self._station.controls.hold()
        engine.resume()
        return "Resumed."

    def cancel(self, client: Operator, _: CommandRequest) -> str:
        """End the task."""
        self._need_control(client)
        engine = self._station.autonomy.engine
        if not engine.active:
            raise Refusal("No task is running.")
        engine.cancel(f"Canceled by {self._station.controls.name(client)}.")
        return "Canceled."

    def set_mission(self, client: Operator, asked: SetMissionRequest) -> str:
        """Check a mission and store it."""
        problem = self._station.controls.objection(client)
        if problem:
            raise Refusal(problem)
        self._store(asked.mission)
        count = len(asked.mission.waypoints)
        later = "; the patrol that is under way keeps its own" if self._station.autonomy.engine.active else ""
        return f"Stored {count} {'point' if count == 1 else 'points'}{later}."

    def recall(self, client: Operator, asked: RecallMissionRequest) -> str:
        """Make a kept mission the stored one, as if it was set anew."""
        problem = self._station.controls.objection(client)
        if problem:
            raise Refusal(problem)
        mission = self._station.records.missions.recall(asked.name)
        self._store(mission)
        return f"{mission.name} is the mission now."

    def _store(self, mission: Mission) -> None:
        _check_words(mission)
        mission = _named(mission)
        self._check_places(mission)
        if mission.home:
            self._check_place("Home", mission.home[0])
        stamp = Time.at(self._station.clock())
        self._station.keep(msgspec.structs.replace(mission, stamp=stamp, home=mission.home[:1]))

    def mission(self, _: Operator, __: GetMissionRequest) -> GetMissionResponse:
        """Give the stored mission."""
        mission = self._station.mission
        stored = mission.stamp.seconds > 0
        return GetMissionResponse(True, "" if stored else "No mission was stored yet.", mission)

    def events(self, _: Operator, asked: GetEventsRequest) -> GetEventsResponse:
        """Give the events that a client missed."""
        return GetEventsResponse(self._station.events.since(asked.since, asked.boot))

    def _need_control(self, client: Operator) -> None:
        problem = self._station.controls.acquire(client, self._station.clock())
        if problem:
            raise Refusal(problem)

    def _may_move(self, client: Operator) -> None:
        if self._station.controls.stopped:
            raise Refusal(STOP_SENTENCE)
        self._need_control(client)
        if self._station.unfit:
            raise Refusal(self._station.unfit)
        if self._station.lost:
            raise Refusal(self._station.lost)

    def _check_idle(self) -> None:
        engine = self._station.autonomy.engine
        if engine.active:
            raise Refusal(f"A task is {engine.status.state.lower()} already; stop it first.")

    def _check_battery(self) -> None:
        battery = self._station.autonomy.battery
        if battery < LOW_BELOW:
            raise Refusal(f"The battery is at {battery:.0%}; a patrol needs at least {LOW_BELOW:.0%}.")

    def _check_places(self, mission: Mission) -> None:
        for number, point in enumerate(mission.waypoints, 1):
            self._check_place(f"Point {number}", point)

    def _check_place(self, name: str, place: Waypoint) -> None:
        if not self._station.autonomy.has_map:
            raise Refusal(NO_MAP)
        problem = self._station.fault(name, place.x, place.y)
        if problem:
            raise Refusal(problem)


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
    if not (math.isfinite(mission.dwell) and 0 <= mission.dwell <= LONGEST_DWELL):
        raise Refusal(f"The dwell must be 0 to {LONGEST_DWELL:.0f} s, not {mission.dwell} s.")
    if not 0 <= mission.laps <= MOST_LAPS:
        raise Refusal(f"The laps must be 0 to {MOST_LAPS}, not {mission.laps}.")
    if len(mission.waypoints) > MOST_POINTS:
        raise Refusal(f"A mission has at most {MOST_POINTS} points, not {len(mission.waypoints)}.")
