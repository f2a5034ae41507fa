"""The services of what a robot carries, and the one that puts a simulated robot back to its start."""

from __future__ import annotations

from collections.abc import Iterable

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    LightState,
    SetLightsRequest,
    SetLightsResponse,
)
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.core.refusal import Refusal
from robotside.services.arm_service import arm_service
from robotside.services.command_service import CommandService
from robotside.services.preconditions import Preconditions
from robotside.station.station import Station

__all__ = ["equipment_services"]


def equipment_services(station: Station, answering: CommandService) -> Iterable[Service]:
    """What the bridge offers of what the robot of `station` has; nothing of what it has not."""
    equipment, service = _EquipmentOrders(station), answering.service
    mounted = station.info.payloads if station.robot.equipped else []
    if "lights" in mounted:
        yield service("/lights/set", equipment.set_lights, "SetLights", SetLightsRequest, SetLightsResponse)
    if "arm" in mounted:
        yield arm_service(station, answering)
    if station.robot.resettable:
        yield service("/robot/reset", equipment.reset)


class _EquipmentOrders:
    """What each service does; a method returns the sentence of success or raises Refusal."""

    def __init__(self, station: Station) -> None:
        self._station, self._permits = station, Preconditions(station)

    def set_lights(self, client: Operator, asked: SetLightsRequest) -> str:
        """Shine as bright as that."""
        self._permits.need_control(client)
        self._permits.tell("lights", LightState(brightness=asked.brightness))
        return f"The lights are at {asked.brightness:.0%}." if asked.brightness else "The lights are off."

    def reset(self, client: Operator, _: CommandRequest) -> str:
        """End the task and put the robot back to its start, where it stands still and knows where it is."""
        station = self._station
        self._permits.need_control(client)
        name, who = station.controls.name(client), station.controls.id(client)
        try:
            place = station.robot.reset()
        except ValueError as problem:
            raise Refusal(Notice(Code.EQUIPMENT_REFUSED, str(problem))) from problem
        station.agenda.hold("the robot was put back")
        ended = f"{name} put the robot back to its start."
        station.autonomy.engine.cancel(Notice(Code.TASK_RESET, ended, actor_id=who, name=name))
        station.teleop.put_back()
        pose = Pose2.from_msg(place)
        station.autonomy.pose_estimator.put(pose)
        robot, x, y = station.info.name, pose.x, pose.y
        said = f"{name} put {robot} back to its start."
        reset = Notice(Code.ROBOT_RESET, said, actor_id=who, name=name, robot=robot, x=x, y=y)
        station.events.say("robot", reset, "warn", at=(x, y))
        return f"{station.info.name} is put back: it stands at ({pose.x:.1f}, {pose.y:.1f})."
