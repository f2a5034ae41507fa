"""The services that ask for what the robot keeps and change it: places, missions, history and events."""

from __future__ import annotations

import math
from collections.abc import Iterable

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import (
    AcknowledgeEventsRequest,
    AcknowledgeEventsResponse,
    CommandRequest,
    DeletePlaceRequest,
    DeletePlaceResponse,
    GetEventsRequest,
    GetEventsResponse,
    GetHistoryRequest,
    GetHistoryResponse,
    GetIntruderPictureRequest,
    GetIntruderPictureResponse,
    GetMissionsRequest,
    GetMissionsResponse,
    Place,
    SetPlaceRequest,
    SetPlaceResponse,
)
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Time
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.core.refusal import Refusal
from robotside.core.text import plain
from robotside.kinds.registry import kind_of
from robotside.records.places import MAX_TEXTS
from robotside.records.runs import MAX_PAGE
from robotside.services.command_service import CommandService
from robotside.services.preconditions import Preconditions
from robotside.station.station import Station
from robotside.tasks.berthing.approach import Approach
from robotside.tasks.berthing.dock_start import body_fault, starts
from robotside.tasks.berthing.pad_landing import first_goal

__all__ = ["records_services"]

MAX_ACKNOWLEDGED = 1000
"""Events that one request may name."""


def records_services(station: Station, answering: CommandService) -> Iterable[Service]:
    """What the bridge offers of what `station` keeps."""
    kept, service = _RecordsOrders(station), answering.service
    yield service("/places/set", kept.set_place, "SetPlace", SetPlaceRequest, SetPlaceResponse)
    yield service("/places/delete", kept.delete_place, "DeletePlace", DeletePlaceRequest, DeletePlaceResponse)
    yield service("/missions/get", kept.missions, "GetMissions", GetMissionsRequest, GetMissionsResponse)
    yield service("/history/get", kept.history, "GetHistory", GetHistoryRequest, GetHistoryResponse)
    yield service(
        "/events/acknowledge",
        kept.acknowledge,
        "AcknowledgeEvents",
        AcknowledgeEventsRequest,
        AcknowledgeEventsResponse,
    )
    yield service(
        "/events/picture",
        kept.picture,
        "GetIntruderPicture",
        GetIntruderPictureRequest,
        GetIntruderPictureResponse,
    )
    yield Service(
        "/events/get", "pilothouse_msgs/GetEvents", GetEventsRequest, GetEventsResponse, kept.events
    )


class _RecordsOrders:
    """What each service does."""

    def __init__(self, station: Station) -> None:
        self._station, self._records = station, station.records
        self._permits = Preconditions(station)

    def set_place(self, client: Operator, asked: SetPlaceRequest) -> SetPlaceResponse:
        """Keep a place, unless somebody else drives, or the robot can never stand there."""
        self._permits.may_change(client)
        problem = self._fault(asked.place)
        if problem:
            raise Refusal(problem)
        place = self._records.places.set(asked.place)
        said = f"{place.name} is saved."
        return SetPlaceResponse(True, said, id=place.id)

    def _fault(self, place: Place) -> Problem:
        """Why the robot can never stand at a place, or before one that is a dock; empty when it can."""
        station, name = self._station, plain(place.name, MAX_TEXTS["name"]) or "The place"
        judge = station.fault if station.autonomy.has_map else station.keeper.fault
        if place.kind == "dock" and kind_of(station.robot.info.kind).docks == "pad":
            # on a platform it is a thing on the map itself
            first = first_goal(place, judge)
            return judge(name, first.x, first.y)
        if place.kind == "dock" and math.isfinite(place.yaw):
            # at the dock itself it may well touch a wall
            way, discs = Approach.of(station.robot.info), station.autonomy.navigator.controller.discs
            docked = Pose2(place.x, place.y, place.yaw)
            first = starts(place, docked, way.standoffs, judge, slants=way.slants, discs=discs)[0]
            return body_fault(f"The place before {name}", first, judge, discs)
        return judge(name, place.x, place.y)

    def delete_place(self, client: Operator, asked: DeletePlaceRequest) -> str:
        """Forget a place."""
        self._permits.may_change(client)
        return f"{self._records.places.delete(asked.id).name} is forgotten."

    def missions(self, _: Operator, __: CommandRequest) -> GetMissionsResponse:
        """All missions that have a name."""
        found = self._records.missions.known()
        return GetMissionsResponse(True, names=[mission.name for mission in found], missions=found)

    def history(self, _: Operator, asked: GetHistoryRequest) -> GetHistoryResponse:
        """What was done, newest first."""
        if asked.before < 0 or not 1 <= asked.limit <= MAX_PAGE:
            said = (
                f"before must be 0 or more and limit 1 to {MAX_PAGE}, not {asked.before} and {asked.limit}."
            )
            code = Code.HISTORY_RANGE_INVALID
            raise Refusal(Notice(code, said, before=asked.before, limit=asked.limit))
        return GetHistoryResponse(True, runs=self._records.runs.before(asked.before, asked.limit))

    def acknowledge(self, client: Operator, asked: AcknowledgeEventsRequest) -> str:
        """Note that somebody has seen to events; needs no control."""
        if len(asked.ids) > MAX_ACKNOWLEDGED:
            count, most = len(asked.ids), MAX_ACKNOWLEDGED
            said = f"At most {most} events at once, not {count}."
            raise Refusal(Notice(Code.EVENTS_TOO_MANY, said, count=count, max=most))
        station = self._station
        now, by = Time.at(station.clock()), station.controls.name(client)
        fresh = self._records.events.acknowledge(
            asked.ids, by, now, lambda event: station.bus.publish("/events", event)
        )
        events = "event" if len(fresh) == 1 else "events"
        return f"{len(fresh)} {events} acknowledged." if fresh else "Already acknowledged."

    def picture(self, _: Operator, asked: GetIntruderPictureRequest) -> GetIntruderPictureResponse:
        """Give the picture of the intruder that an event reports."""
        ours = asked.boot in ("", self._records.events.identity)
        picture = self._records.crops.of(asked.event) if ours else b""
        if not picture:
            said = f"There is no picture with the event {asked.event}."
            raise Refusal(Notice(Code.PICTURE_MISSING, said, id=asked.event))
        return GetIntruderPictureResponse(True, picture=CompressedImage(format="jpeg", data=picture))

    def events(self, _: Operator, asked: GetEventsRequest) -> GetEventsResponse:
        """Give the events that a client missed."""
        return self._station.events.answer(asked)
