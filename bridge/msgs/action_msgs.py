"""action_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg, int8
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.unique_identifier_msgs import UUID

__all__ = ["CancelGoalRequest", "CancelGoalResponse", "GoalInfo", "GoalStatus", "GoalStatusArray"]


class GoalInfo(Msg, frozen=True, gc=False):
    """Which goal, and since when."""

    MSGTYPE: ClassVar[str] = "action_msgs/GoalInfo"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("unique_identifier_msgs/UUID", "time")
    goal_id: UUID = UUID()
    stamp: Time = Time()
    """When it was accepted."""


class CancelGoalRequest(Msg, frozen=True, gc=False):
    """Give goals up: one by its identity, all up to a time, or with both 0 all."""

    MSGTYPE: ClassVar[str] = "action_msgs/CancelGoalRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("action_msgs/GoalInfo",)
    goal_info: GoalInfo = GoalInfo()


class CancelGoalResponse(Msg, frozen=True, gc=False):
    """What `CancelGoal` answers."""

    MSGTYPE: ClassVar[str] = "action_msgs/CancelGoalResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int8", "action_msgs/GoalInfo[]")
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("int8",) * 4

    ERROR_NONE: ClassVar[int] = 0
    ERROR_REJECTED: ClassVar[int] = 1
    ERROR_UNKNOWN_GOAL_ID: ClassVar[int] = 2
    ERROR_GOAL_TERMINATED: ClassVar[int] = 3
    """It was over already."""

    return_code: int8 = 0
    """One of ERROR_…."""
    goals_canceling: list[GoalInfo] = []
    """Those that are now being given up."""


class GoalStatus(Msg, frozen=True, gc=False):
    """Status of a goal."""

    MSGTYPE: ClassVar[str] = "action_msgs/GoalStatus"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("action_msgs/GoalInfo", "int8")
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("int8",) * 7

    STATUS_UNKNOWN: ClassVar[int] = 0
    STATUS_ACCEPTED: ClassVar[int] = 1
    """It waits to be begun."""
    STATUS_EXECUTING: ClassVar[int] = 2
    STATUS_CANCELING: ClassVar[int] = 3
    """It is being given up as was asked."""
    STATUS_SUCCEEDED: ClassVar[int] = 4
    STATUS_CANCELED: ClassVar[int] = 5
    STATUS_ABORTED: ClassVar[int] = 6
    """The robot gave it up."""

    goal_info: GoalInfo = GoalInfo()
    status: int8 = 0
    """One of STATUS_…."""


class GoalStatusArray(Msg, frozen=True, gc=False):
    """Status of all goals of an action."""

    MSGTYPE: ClassVar[str] = "action_msgs/GoalStatusArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("action_msgs/GoalStatus[]",)
    status_list: list[GoalStatus] = []
