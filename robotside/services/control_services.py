"""The services by which control is taken, asked for and given back, the robot is given to a person or to its task, and told where it is."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import (
    ChoosePlaceRequest,
    ChoosePlaceResponse,
    CommandRequest,
    CommandResponse,
    SetModeRequest,
    SetModeResponse,
    SetOptionRequest,
    SetOptionResponse,
)
from robotside.control.command_gate import STOP_SENTENCE
from robotside.control.teleop import FOLLOW_LINK, LOST_LINK_STOPS_TASK
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.services.command_service import CommandService
from robotside.services.preconditions import Preconditions
from robotside.services.task_services import TaskOrders
from robotside.station.station import Station

__all__ = ["control_services"]

Order = Callable[[Operator, CommandRequest], str | CommandResponse]

_SAID = {
    (FOLLOW_LINK, "on"): "The speed follows the link.",
    (FOLLOW_LINK, "off"): "The speed does not follow the link any more.",
    (LOST_LINK_STOPS_TASK, "on"): "A task is paused when the driver's link is lost.",
    (LOST_LINK_STOPS_TASK, "off"): "A task goes on when the driver's link is lost.",
}


def control_services(station: Station, answering: CommandService) -> Iterable[Service]:
    """What the bridge offers of who steers `station`."""
    steering, service = _ControlOrders(station), answering.service
    plain: dict[str, Order] = {
        "/control/acquire": steering.acquire,
        "/control/release": steering.release,
        "/control/request": lambda client, _: station.teleop.request(client),
        "/control/grant": lambda client, _: station.teleop.grant(client, station.now),
        "/control/object": lambda client, _: station.teleop.object(client),
    }
    for name, action in plain.items():
        yield service(name, action)
    yield service("/mode/set", steering.set_mode, "SetMode", SetModeRequest, SetModeResponse)
    yield service(
        "/localisation/choose", steering.choose_place, "ChoosePlace", ChoosePlaceRequest, ChoosePlaceResponse
    )
    yield service("/settings/set", steering.set_option, "SetOption", SetOptionRequest, SetOptionResponse)


class _ControlOrders:
    """What each service does; a method returns the sentence of success or raises Refusal."""

    def __init__(self, station: Station) -> None:
        self._station, self._tasks, self._permits = station, TaskOrders(station), Preconditions(station)

    def acquire(self, client: Operator, _: CommandRequest) -> str:
        """Take control."""
        self._permits.need_control(client)
        return "You have control."

    def release(self, client: Operator, _: CommandRequest) -> str:
        """Give control back, or take back that one asks for it."""
        station = self._station
        problem = station.teleop.release(client, station.now)
        if problem:
            raise Refusal(problem)
        driver = station.controls.driver
        return f"{driver.name} has control." if driver else "Control is free."

    def set_mode(self, client: Operator, asked: SetModeRequest) -> str | CommandResponse:
        """MANUAL pauses the task and keeps every other from starting by itself, AUTO goes on with what there is."""
        station = self._station
        if asked.mode not in ("MANUAL", "AUTO"):
            said = f"The mode is MANUAL or AUTO, not {asked.mode!r}."
            raise Refusal(Notice(Code.MODE_UNKNOWN, said, mode=asked.mode))
        if station.controls.stopped:
            raise Refusal(STOP_SENTENCE)
        self.acquire(client, asked)
        engine, agenda = station.autonomy.engine, station.agenda
        if asked.mode == "AUTO":
            if engine.active or engine.interrupted or agenda.held:
                self._tasks.resume(client, asked)
                return "The robot drives itself."
            if not agenda.manual.end():
                said = "There is no task to resume; start one."
                raise Refusal(Notice(Code.TASK_NONE_LEFT, said))
            return "The robot may start scheduled and queued tasks by itself."
        fresh = agenda.stay_manual(station.controls.name(client), station.controls.id(client))
        if not engine.running:
            return f"The robot is driven by hand{'; nothing starts by itself' if fresh else ' already'}."
        self._tasks.pause(client, asked)
        return "The robot is driven by hand; its task is paused."

    def choose_place(self, client: Operator, asked: ChoosePlaceRequest) -> str:
        """The robot is at that one of its candidates."""
        problem = self._station.placing.choose(client, asked.id)
        if problem:
            raise Refusal(problem)
        return "The robot is there."

    def set_option(self, client: Operator, asked: SetOptionRequest) -> str:
        """Switch a setting."""
        station = self._station
        self._permits.may_change(client)
        said, by = _SAID.get((asked.name, asked.value), ""), station.controls.name(client)
        name, value, text, who = (
            asked.name,
            asked.value,
            f"{said[:-1]}, says {by}.",
            station.controls.id(client),
        )
        changed = Notice(Code.SETTING_CHANGED, text, actor_id=who, name=by, setting=name, value=value)
        station.options.set(name, value, lambda: station.events.say("control", changed))
        station.controls.update_speed_cap(station.clock())
        return said
