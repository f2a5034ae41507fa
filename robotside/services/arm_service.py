"""The service that moves an arm: whoever has control moves it, and the newest order replaces the one before."""

from __future__ import annotations

import asyncio
import math
from collections import OrderedDict
from collections.abc import Awaitable
from dataclasses import dataclass, field
from functools import partial

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    ArmOrder,
    ArmState,
    CommandResponse,
    MoveArmRequest,
    MoveArmResponse,
)
from robotside.control.command_gate import STOP_SENTENCE
from robotside.core.notice import Notice, coded
from robotside.core.refusal import Refusal
from robotside.core.text import plain
from robotside.services.command_service import CommandService
from robotside.services.preconditions import Preconditions
from robotside.services.stop_answer import Later
from robotside.station.station import Station

__all__ = ["ARRIVAL_TIMEOUT", "arm_service"]

ARRIVAL_TIMEOUT = 30.0
"""An answer that waits for the arm waits so long at most [s]."""
ARRIVAL_TOLERANCE = 1e-3
"""Joints [rad] and gripper [m] nearer than this to where they were sent are there."""
MAX_MOTIONS = 64
"""Motions that are remembered by the id of their command."""


def arm_service(station: Station, answering: CommandService) -> Service:
    """`/arm/move` of a `station` that has an arm; STOP ends a motion, and nothing but a new order begins one."""
    orders = _ArmOrders(station)
    service = answering.service("/arm/move", orders.move, "MoveArm", MoveArmRequest, MoveArmResponse)
    return Service(
        service.name, service.type, service.request, service.response, partial(orders.call, service)
    )


@dataclass(eq=False, slots=True)
class _Motion:
    """What became of one order."""

    first: float = math.nan
    """When the arm was first heard after the order [s, robot clock]."""
    goal: list[float] | None = None
    """Where joints and gripper go, once that was heard."""
    outcome: str = ""
    """One sentence once it is over; a Notice for one that did not come there."""
    waiting: set[asyncio.Future[str]] = field(default_factory=set)

    def end(self, outcome: str) -> None:
        """It is over; who waits for it is told so."""
        self.outcome = self.outcome or outcome
        for each in self.waiting:
            if not each.done():
                each.set_result(self.outcome)

    async def over(self) -> str:
        """Its outcome."""
        if self.outcome:
            return self.outcome
        told: asyncio.Future[str] = asyncio.get_running_loop().create_future()
        self.waiting.add(told)
        try:
            async with asyncio.timeout(ARRIVAL_TIMEOUT):
                return await told
        except TimeoutError:
            said = f"The arm was not there within {ARRIVAL_TIMEOUT:g} s."
            return Notice(Code.ARM_LATE, said, allowed=ARRIVAL_TIMEOUT)
        finally:
            self.waiting.discard(told)


class _ArmOrders:
    """Gives orders to the arm, and knows of the newest one whether it is under way."""

    def __init__(self, station: Station) -> None:
        self._station, self._permits = station, Preconditions(station)
        self._newest = _Motion(outcome="There was none.")
        self._by_id: OrderedDict[tuple[str, str], _Motion] = OrderedDict()
        """By public id of the client and id of the command."""
        station.bus.subscribe("/arm", self._watch, replay=False)

    def move(self, client: Operator, asked: MoveArmRequest) -> str:
        """Move the arm, of who has control, and not while STOP is pressed; the sentence of what is done."""
        if self._station.controls.stopped:
            raise Refusal(STOP_SENTENCE)
        self._permits.need_control(client)
        said = _accepted(asked.order)
        self._permits.tell("arm", asked.order)
        controls, before = self._station.controls, self._newest
        name, who = controls.name(client), controls.id(client)
        if not before.outcome:
            said += " This replaces an order that was not finished."
        replaced = f"{name} gave the arm another order before it was there."
        before.end(Notice(Code.ARM_REPLACED, replaced, actor_id=who, name=name))
        self._newest = _Motion()
        if asked.command_id:
            self._by_id[who, asked.command_id] = self._newest
            while len(self._by_id) > MAX_MOTIONS:
                self._by_id.popitem(last=False)
        return said

    def call(self, service: Service, client: Operator, asked: MoveArmRequest) -> Msg | Awaitable[Msg]:
        """Answer at once, or with `wait` when it is known what became of it; a repeated command waits for the first one."""
        before = self._newest
        answer = service.call(client, asked)
        if not asked.wait or (isinstance(answer, CommandResponse) and not answer.success):
            return answer
        known = self._by_id.get((self._station.controls.id(client), asked.command_id))
        motion = known if self._newest is before else self._newest
        return answer if motion is None else Later(partial(_when_over, answer, motion))

    def _watch(self, _: str, msg: Msg) -> None:
        """Look whether the newest order is carried out."""
        motion, now = self._newest, self._station.now
        if motion.outcome or not isinstance(msg, ArmState):
            return
        if self._station.controls.stopped:
            motion.end(STOP_SENTENCE)
        elif math.isnan(motion.first):
            motion.first = now  # what is heard in this step may have been measured before the order
        elif now > motion.first:
            _judge(motion, msg)


async def _when_over(answer: Msg | Awaitable[Msg], motion: _Motion) -> CommandResponse:
    """The `answer` to an order, or what became of it once it was accepted."""
    given = answer if isinstance(answer, CommandResponse) else await answer  # type: ignore[misc]
    if not given.success:
        return given
    outcome = await motion.over()
    return MoveArmResponse(not isinstance(outcome, Notice), str(outcome), **coded(outcome))


def _judge(motion: _Motion, arm: ArmState) -> None:
    """End the `motion` when the `arm` is there, or goes there no more."""
    goal = [each for each in (*arm.wanted, arm.gripper_wanted) if not math.isnan(each)]
    motion.goal = motion.goal or goal
    if goal != motion.goal:
        motion.end(Notice(Code.ARM_HELD, "The arm was held before it was there."))
    elif _rests(arm):
        motion.end("The arm is there and touches something." if arm.touching else "The arm is there.")


def _rests(arm: ArmState) -> bool:
    """It is where it was sent; a gripper of which nobody knows where it goes counts as being there."""
    pairs = [*zip(arm.angles, arm.wanted, strict=False), (arm.gripper, arm.gripper_wanted)]
    return not any(abs(now - goal) > ARRIVAL_TOLERANCE for now, goal in pairs)


def _accepted(order: ArmOrder) -> str:
    """What is accepted when the arm takes it, as one sentence."""
    if order.pose:
        return f"The arm goes to {plain(order.pose, 40)}."
    if not math.isnan(order.point.x):
        return f"The arm goes to ({order.point.x:.2f}, {order.point.y:.2f}, {order.point.z:.2f})."
    if len(order.angles):
        return "The arm goes to these angles."
    if len(order.increments):
        return "The arm moves by these increments."
    if not math.isnan(order.gripper):
        return f"The gripper goes to {1000 * order.gripper:.0f} mm."
    said = "Give the arm a goal: a pose, a point, angles, increments, or a gripper opening."
    raise Refusal(Notice(Code.ARM_GOAL_MISSING, said))
