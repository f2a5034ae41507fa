"""The services that store a mission, recall a kept one and give the stored one."""

from __future__ import annotations

import math
from collections.abc import Iterable

import msgspec

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.additions import DETECTED_CLASSES
from bridge.msgs.pilothouse_msgs import (
    MAX_DWELL,
    MAX_LAPS,
    MOTIONS,
    REACTIONS,
    GetMissionRequest,
    GetMissionResponse,
    Mission,
    RecallMissionRequest,
    RecallMissionResponse,
    SetMissionRequest,
)
from bridge.msgs.std_msgs import Time
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.core.text import plain
from robotside.services.command_service import CommandService
from robotside.services.preconditions import Preconditions
from robotside.station.station import Station

__all__ = ["mission_services"]

MAX_POINTS = 500
"""Waypoints that one mission may have."""

MAX_NAME_LENGTH = 60
"""Characters kept of a waypoint's name."""


def mission_services(station: Station, answering: CommandService) -> Iterable[Service]:
    """The services about the mission of `station`."""
    orders, service = _MissionOrders(station), answering.service
    yield service("/mission/set", orders.set_mission, "SetMission", SetMissionRequest)
    yield service(
        "/mission/recall", orders.recall, "RecallMission", RecallMissionRequest, RecallMissionResponse
    )
    yield Service(
        "/mission/get", "pilothouse_msgs/GetMission", GetMissionRequest, GetMissionResponse, orders.mission
    )


class _MissionOrders:
    """What each service does; a method returns the sentence of success or raises Refusal or NotRecorded."""

    def __init__(self, station: Station) -> None:
        self._station, self._permits = station, Preconditions(station)

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
            return "; the running patrol takes them over at its next point"
        return "; the running patrol keeps its own"

    def _store(self, mission: Mission) -> None:
        _check_words(mission)
        mission = _named(mission)
        if mission.waypoints or mission.home:
            self._permits.has_map()
        self._station.autonomy.task_factory.check_mission(mission)
        stamp = Time.at(self._station.clock())
        self._station.missions.store(msgspec.structs.replace(mission, stamp=stamp))

    def mission(self, _: Operator, __: GetMissionRequest) -> GetMissionResponse:
        """Give the stored mission."""
        mission = self._station.records.missions.stored
        stored = mission.stamp.seconds > 0
        return GetMissionResponse(True, "" if stored else "No mission is stored yet.", mission)


def _named(mission: Mission) -> Mission:
    """The same mission with each point's name cut to a readable line, one home, and each class of intruders once."""
    replace = msgspec.structs.replace
    points, home = (
        [replace(point, name=plain(point.name, MAX_NAME_LENGTH)) for point in places]
        for places in (mission.waypoints, mission.home[:1])
    )
    classes = list(dict.fromkeys(mission.intruder_classes))
    return replace(mission, waypoints=points, home=home, intruder_classes=classes)


def _check_words(mission: Mission) -> None:
    if mission.motion not in MOTIONS:
        said = f"There is no motion {mission.motion!r}; there are {', '.join(MOTIONS)}."
        raise Refusal(Notice(Code.MOTION_UNKNOWN, said, motion=mission.motion[:20]))
    if mission.on_intruder not in ("", *REACTIONS):
        reaction = mission.on_intruder
        said = f"There is no reaction {reaction!r} to an intruder; there are {', '.join(REACTIONS)}."
        raise Refusal(Notice(Code.REACTION_UNKNOWN, said, reaction=reaction[:20]))
    strange = next((kind for kind in mission.intruder_classes if kind not in DETECTED_CLASSES), None)
    if strange is not None:
        said = f"There is no class {strange[:20]!r} of intruders; there are {', '.join(DETECTED_CLASSES)}."
        raise Refusal(Notice(Code.CLASS_UNKNOWN, said, kind=strange[:20]))
    if not (math.isfinite(mission.dwell) and 0 <= mission.dwell <= MAX_DWELL):
        said = f"The dwell must be 0 to {MAX_DWELL:.0f} s, not {mission.dwell} s."
        raise Refusal(Notice(Code.DWELL_INVALID, said, dwell=mission.dwell, max=MAX_DWELL))
    if not 0 <= mission.laps <= MAX_LAPS:
        said = f"The laps must be 0 to {MAX_LAPS}, not {mission.laps}."
        raise Refusal(Notice(Code.LAPS_INVALID, said, laps=mission.laps, max=MAX_LAPS))
    if len(mission.waypoints) > MAX_POINTS:
        count = len(mission.waypoints)
        said = f"A mission has at most {MAX_POINTS} points, not {count}."
        raise Refusal(Notice(Code.MISSION_TOO_LONG, said, count=count, max=MAX_POINTS))
