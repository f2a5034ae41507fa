"""The services of what a robot carries, lights and an arm, and the one that puts a simulated robot back to its start."""

from __future__ import annotations

import math
from collections.abc import Iterable

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    ArmOrder,
    CommandRequest,
    LightState,
    MoveArmRequest,
    MoveArmResponse,
    SetLightsRequest,
    SetLightsResponse,
)
from robotside.control.command_gate import STOP_SENTENCE
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.core.refusal import Refusal
from robotside.core.text import plain
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
        yield service("/arm/move", equipment.move_arm, "MoveArm", MoveArmRequest, MoveArmResponse)
    if station.robot.resettable:
        yield service("/robot/reset", equipment.reset)


class _EquipmentOrders:
    """What each service does; a method returns the sentence of success or raises Refusal."""

    def __init__(self, station: Station) -> None:
        self._station, self._permits = station, Preconditions(station)

    def set_lights(self, client: Operator, asked: SetLightsRequest) -> str:
        """Shine as bright as that."""
        self._permits.need_control(client)
        self._tell("lights", LightState(brightness=asked.brightness))
        return f"The lights are at {asked.brightness:.0%}." if asked.brightness else "The lights are off."

    def move_arm(self, client: Operator, asked: MoveArmRequest) -> str:
        """Move the arm; not while STOP is pressed."""
        if self._station.controls.stopped:
            raise Refusal(STOP_SENTENCE)
        self._permits.need_control(client)
        self._tell("arm", asked.order)
        return _goal(asked.order)

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

    def _tell(self, payload: str, order: Msg) -> None:
        trouble = self._station.robot.trouble
        if trouble:
            raise Refusal(trouble)
        try:
            self._station.robot.command(payload, order)
        except ValueError as problem:
            raise Refusal(Notice(Code.EQUIPMENT_REFUSED, str(problem))) from problem


def _goal(order: ArmOrder) -> str:
    """What was accepted, as one sentence."""
    if order.pose:
        return f"The arm goes to {plain(order.pose, 40)}."
    if not math.isnan(order.point.x):
        return f"The arm goes to ({order.point.x:.2f}, {order.point.y:.2f}, {order.point.z:.2f})."
    if len(order.angles):
        return "The arm goes to these angles."
    if not math.isnan(order.gripper):
        return f"The gripper goes to {1000 * order.gripper:.0f} mm."
    said = "Give the arm a goal: a pose, a point, angles, or a gripper opening."
    raise Refusal(Notice(Code.ARM_GOAL_MISSING, said))
