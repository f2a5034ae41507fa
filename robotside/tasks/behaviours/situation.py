"""The situation as behaviours see it at this moment, and what they report."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np

from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import ORIGIN, Points, Pose2
from robotside.perception.cage_finder import NOTHING_AHEAD, FrontView
from robotside.perception.pad_finder import NOTHING_BELOW, GroundView

__all__ = ["Doing", "Seen", "Situation"]

MAX_INTRUDERS = 20
"""That may wait to be gone round."""


@dataclass(frozen=True, slots=True)
class Doing:
    """The present action of a task."""

    phase: str = ""
    """planning, driving, waiting, dwelling, holding, turning, docking, undocking, charging, circling, taking off, landing, surfacing or unsure;
    empty when it does none of them."""
    text: str = ""
    """One sentence for the operator: what it does and why; empty leaves it to the task."""
    place: str = ""
    """Name of the place it heads for or stands at."""
    asks: str = ""
    """A question that a tap or a card answers."""


@dataclass(frozen=True, slots=True)
class Seen:
    """An intruder that is to be gone round."""

    id: int
    x: float
    """In `map` [m]."""
    y: float


@dataclass
class Situation:
    """Brought up to date before each tick."""

    now: float = 0.0
    """[s], robot clock."""
    idle: float = 0.0
    """How long the task was paused up to now [s]."""
    pose: Pose2 = ORIGIN
    """Of the robot in `map`."""
    sure: bool = True
    """That pose may be believed."""
    by_word: bool = False
    """It is sure by what an operator has said alone: no look has told the place from one that looks alike."""
    place_asked: bool = False
    """Several places of the map fit, and it is not known which of them it is at."""
    late: bool = False
    """The robot's computer lags too much for it to move by itself."""
    points: Points = field(default_factory=lambda: np.empty((0, 2)))
    """Points of the laser, in `base_link`."""
    confirmed_by: str = ""
    """The operator who has answered the question since the last tick; empty for none."""
    tag: str = ""
    """The tag that was read since the last tick; empty for none."""
    follows: bool | None = None
    """A person follows; None without a sensor for that."""
    follows_heard: float = -math.inf
    """When that sensor was last heard [s], robot clock."""
    flight: str = ""
    """landed, taking_off, flying or landing; empty for what does not fly."""
    charging: bool = False
    """The battery takes charge, or is full at the charger."""
    power: int = 0
    """As `power_supply_status` of `sensor_msgs/BatteryState`; 0 while unknown, as of a battery that is silent."""
    last_power: int = 0
    """The same when the battery was last heard, however long ago that was."""
    battery_heard: float = -math.inf
    """When the battery was last heard [s], robot clock."""
    charge: float = math.nan
    """0 empty to 1 full; NaN while unknown."""
    scan: LaserScan | None = None
    """The newest sweep of the laser; None without one."""
    swept: Pose2 = ORIGIN
    """Where the wheels were at that sweep, in the frame of the odometry."""
    picture: bytes = b""
    """The newest picture of the first camera, a JPEG file; empty without one."""
    picture_stamp: float = -math.inf
    """When it was taken [s]; a picture of what does not move may come again, with a stamp of its own."""
    pictured: Pose2 = ORIGIN
    """Where the wheels were at that picture, in the frame of the odometry."""
    looks_down: bool = False
    """What it does now wants pictures of what is below."""
    ground: GroundView = NOTHING_BELOW
    """The newest of those; without a picture before the first."""
    below: float = math.nan
    """To the ground straight below [m]; no finite number where that is out of reach or not measured."""
    ahead: FrontView = NOTHING_AHEAD
    """The same of the first camera, with how the robot hung in the water or in the air then."""
    moving: Pose2 = ORIGIN
    """Measured speed ahead and to the left [m/s] and turning [rad/s], over ground as far as the log knows it; 0 for what is not measured."""
    odom: Pose2 = ORIGIN
    """Where the wheels are now, in the frame of the odometry."""
    touched: bool = False
    """The bumper touches something."""
    intruders: deque[Seen] = field(default_factory=lambda: deque(maxlen=MAX_INTRUDERS))
    """Found, and not gone round yet."""
    touches: bool = False
    """What it does now may touch something: that is no accident."""
    doing: Doing = Doing()
    """The action that the last behaviour reported."""
    still: float = 0.0
    """Time of that beside the way [s]; NaN when unknown."""

    @property
    def worked(self) -> float:
        """A clock that stands still while the task is paused [s]."""
        return self.now - self.idle

    def report(
        self,
        phase: str,
        text: str = "",
        *,
        place: str = "",
        asks: str = "",
        still: float = 0.0,
        touches: bool = False,
    ) -> None:
        """Say what is done; `still` is how long it takes beside the way [s], and `touches` says that it may touch something."""
        self.doing, self.still, self.touches = Doing(phase, text, place, asks), still, touches

    def begin(self) -> None:
        """Forget what belonged to the task before."""
        self.doing, self.still, self.idle, self.touches = Doing(), 0.0, 0.0, False
        self.looks_down = False
        self.intruders.clear()
        self.forget_confirmation()

    def forget_confirmation(self) -> None:
        """Forget the answers that were given up to now."""
        self.confirmed_by = self.tag = ""
