"""Draft of an order to the robot: its fields, the order they make, and the sentence about it."""

from __future__ import annotations

import math
from typing import Any

from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
    StringProperty,
)

from bridge.msgs.pilothouse_msgs import Mission, RobotInfo, TaskOrder
from widgets.core.base import Control
from widgets.core.task_words import lacking, will

__all__ = ["OrderDraft"]


class OrderDraft(Control):
    """Dispatches `on_command(order)` at every change."""

    sends = (TaskOrder,)

    task = StringProperty("")
    """As TaskOrder has it; empty for none yet."""
    places: ListProperty[str] = ListProperty()
    """Names in their order; empty where one is not chosen yet."""
    message = StringProperty("")
    recipient_tag = StringProperty("")
    heading = NumericProperty(math.nan)
    """[rad]; NaN for where the robot points."""
    speed = NumericProperty(math.nan)
    """[m/s]; NaN for the robot's own."""
    throttle = NumericProperty(math.nan)
    """Share of the full power, 0 to 1; NaN for the robot's own."""
    at_height = NumericProperty(math.nan)
    """[m], below water negative; NaN for the usual or the present one."""
    duration = NumericProperty(math.nan)
    """[s]; NaN until stopped."""
    charge_to = NumericProperty(math.nan)
    """Charge to stay in the dock for, 0 to 1; NaN to be done as soon as it charges."""
    robot: ObjectProperty[RobotInfo] = ObjectProperty(RobotInfo())
    """Who it is for: what it can do decides what is asked for, and how fast and how high."""
    mission: ObjectProperty[Mission] = ObjectProperty(Mission())
    """Where a patrol goes when no places are named."""
    follows = BooleanProperty(True)
    """The robot detects whether a person follows it."""

    def _order(self) -> TaskOrder:
        places = list(self.places)
        while places and not places[-1]:
            places.pop()
        return TaskOrder(
            id=self._id,
            task=self.task,
            places=places,
            message=self.message.strip(),
            recipient_tag=self.recipient_tag.strip(),
            heading=self.heading,
            speed=self.speed,
            throttle=self.throttle,
            height=self.at_height,
            duration=self.duration,
            charge_to=self.charge_to,
        )

    order = AliasProperty(
        _order,
        bind=[
            *("task", "places", "message", "recipient_tag"),
            *("heading", "speed", "throttle", "at_height", "duration", "charge_to"),
        ],
    )
    """What is asked for so far."""

    def _sentence(self) -> str:
        return will(self.order, self.mission, follows=self.follows, robot=self.robot)

    sentence = AliasProperty(_sentence, bind=["order", "mission", "follows", "robot"])
    """What will happen, or what is still lacking."""

    def _complete(self) -> bool:
        return not lacking(self.order, self.mission)

    complete = AliasProperty(_complete, bind=["order", "mission"])
    """Nothing is lacking."""

    def __init__(self, **kwargs: Any) -> None:
        self._id = 0
        super().__init__(**kwargs)

    def fill(self, order: TaskOrder) -> None:
        """Take over an order that is to be changed; nothing is dispatched."""
        self._id, self.task, self.places = order.id, order.task, list(order.places)
        self.message, self.recipient_tag = order.message, order.recipient_tag
        self.heading, self.speed, self.duration = order.heading, order.speed, order.duration
        self.throttle, self.at_height, self.charge_to = order.throttle, order.height, order.charge_to

    def set(self, **changes: Any) -> None:
        """Change properties of the order as a finger would."""
        for name, value in changes.items():
            setattr(self, name, value)
        self.dispatch("on_command", self.order)
