"""The door of a station: its services and actions, what it listens to, and STOP for who has no session."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator
from typing import NamedTuple

from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator, Service
from bridge.core.robot_door import Callback
from bridge.core.topics import TOPICS, camera_topics
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandResponse, RobotInfo
from robotside.core.notice import coded
from robotside.core.refusal import Refusal
from robotside.door.derived_topics import DerivedTopics
from robotside.door.door import Door
from robotside.door.gate import OPEN, Gate
from robotside.door.offered_topics import OfferedTopics
from robotside.door.switched_off import SwitchedOff
from robotside.records.audit_export import csv_lines
from robotside.records.database.audit_rows import UNPROVEN
from robotside.records.database.storage import NotWritten
from robotside.services.audit_trail import AuditTrail
from robotside.services.catalogue import catalogue
from robotside.services.command_messages import listener
from robotside.services.command_service import CommandService
from robotside.services.stop_answer import stop_answer
from robotside.services.stop_services import press_stop
from robotside.station.station import Station

__all__ = ["Health", "StationDoor"]


class Health(NamedTuple):
    """How a station is, for who watches over many."""

    robot: str
    """Its name."""
    boot: str
    """The identity of its log of events; another one after the log was lost."""
    task: str
    """The task that runs or ran last, one of `bridge.msgs.pilothouse_msgs.TASKS`; empty for none."""
    state: str
    """Of the task, as in TaskStatus."""
    reached: bool
    """The robot is heard; all else is as it was when it was heard last."""
    position_sure: bool
    """It is certain where it is."""
    stopped: bool
    """STOP is pressed."""


class StationDoor(Door):
    """The door of one station; every gateway stands behind the same one."""

    def __init__(self, station: Station, gate: Gate = OPEN, services: Iterable[Service] = ()) -> None:
        """`gate` knows who may do what; `services` are those beside the station's own.

        Derived topics are those of the motors that the robot has told of by now.
        """
        self._station = station
        self._derived = DerivedTopics(station.bus)
        self.trail = AuditTrail(station.records.audit, station.clock)
        """What is done through this door, for the audit log."""
        self._leave = station.bus.subscribe("/control/status", self._on_control)
        self._off = SwitchedOff()
        self._made: dict[str, Callable[[bool], None]] = {}
        self.answering = CommandService(station, self.trail)
        """Runs the station's commands, each once."""
        own, actions = catalogue(station, self.answering)
        self._cameras = camera_topics(station.info.cameras)
        super().__init__(
            services=(*own.values(), *map(self.trail.watched, services)),
            actions=actions.values(),
            topics=(*TOPICS, *self._derived.topics),
            pictures=self._cameras.values(),
            bus=station.bus,
            gate=gate,
            trail=self.trail,
            now=station.clock,
            on_message=listener(station),
            on_demand=self._want,
            on_gone=station.on_gone,
        )
        self._has = OfferedTopics(station.info, station.bus, simulated=station.robot.resettable)

    @property
    def info(self) -> RobotInfo:
        """Who the robot is."""
        return self._station.info

    def offers(self, topic: str) -> bool:
        """Whether the robot has a topic of the table, by its name, and it is switched on."""
        return topic not in self._off and (topic in self._made or self._has(topic))

    def is_off(self, name: str) -> bool:
        """Whether a topic, service or action is switched off."""
        return name in self._off

    def also(self, services: Iterable[Service]) -> None:
        """Offer `services` too: those of who serves this robot."""
        self.services.update({service.name: service for service in services})

    def make(self, topic: str, want: Callable[[bool], None]) -> None:
        """`want` is told when somebody begins to want `topic`, and when nobody does any longer."""
        self._made[topic] = want

    def switch(self, payload: str, names: Collection[str], *, on: bool, power: bool = True) -> None:
        """The topics, services and actions of a `payload` are on or off from now on; nothing else of the robot changes.

        Who subscribed to its topics hears nothing while they are off, and is sent them again afterwards. With `power`
        its sensors are switched too, for everybody.
        """
        cameras = [camera for camera, topic in self._cameras.items() if topic in names]
        self._off.set(payload, (*names, *cameras), on=on)
        topics = [name for name in names if name not in self.services and name not in self.actions]
        if power:
            self._station.sensors.switch(topics, on)
        for topic in topics if on else ():
            entry, last = self.topics.get(topic), self.last(topic)
            if entry is not None and entry.latched and last is not None:
                self._station.bus.publish(topic, last)

    def permits(self, operator: Operator, verb: str, name: str) -> bool:
        """Whether the role of `operator` is enough for an operation, be it switched on or off; as `check`."""
        try:
            super().check(operator, verb, name)
        except Refused:
            return False
        return True

    def check(self, operator: Operator, verb: str, name: str) -> None:
        """Raises Refused when the role of `operator` is too small, or when that is switched off."""
        super().check(operator, verb, name)
        refusal = self._off.refusal(name)
        if refusal is not None:
            self.trail.refused(operator, f"{verb} {name}", refusal)
            raise refusal

    def subscribe(
        self, asker: Hashable, topic: str, callback: Callback, *, wanted: bool = True
    ) -> Callable[[], None]:
        """As every door's; while the topic is switched off nothing comes."""
        return super().subscribe(asker, topic, self._off.muted(callback), wanted=wanted)

    def audit_lines(self) -> Iterator[str]:
        """The audit log as lines of CSV, which takes up to a second: to be called in a thread of its own. Raises Refused."""
        try:
            return csv_lines(self._station.records.audit.rows())
        except NotWritten as problem:
            raise Refused(f"The audit log cannot be read: {problem}") from problem

    @property
    def health(self) -> Health:
        """How it is now."""
        station, status = self._station, self._station.autonomy.engine.status
        return Health(
            station.info.name,
            station.events.boot,
            status.task,
            status.state,
            station.robot.reached,
            station.robot.reached and station.autonomy.pose_estimator.sure,
            station.controls.stopped,
        )

    def last(self, topic: str) -> Msg | None:
        """The newest message of a topic, None when there was none."""
        return self._station.bus.last(topic)

    async def stop(self, operator: Operator, name: str = "") -> CommandResponse:
        """Press STOP for `operator`, who has no session and calls itself `name`; no success while the robot may not have obeyed.

        Who proved who it is presses under its own name; another name is repeated with the address that it came from.

        STOP acts and is published at once; the answer comes when it is saved, or a moment later and says that it is not.
        """
        who, where = operator.identity, operator.address.rpartition(":")[0]
        said = f"{name} at {where}{UNPROVEN}" if name else f"a browser at {where}"
        called, id = (who.name, who.id) if who.proven else (said, "")
        with self._station.records.together():
            try:
                answer = CommandResponse(True, press_stop(self._station, called, id))
            except Refusal as refusal:
                answer = CommandResponse(False, refusal.notice, **coded(refusal.notice))
            self._station.publish_control()
            outcome = "done" if answer.success else f"refused {answer.code}"
            self.trail.stopped(operator, name, outcome)
        later = stop_answer(self._station, answer)
        return later if isinstance(later, CommandResponse) else await later

    def close(self) -> None:
        """Let go of the station; no other call follows."""
        self._derived.close()
        self._leave()

    def _on_control(self, *_: object) -> None:
        self.trail.control(self._station.controls.driver)

    def _want(self, topic: str, wanted: bool) -> None:
        if topic in self._made:
            self._made[topic](wanted)
        self._derived.want(topic, wanted)
        self._station.demand.set(topic, self, wanted)
