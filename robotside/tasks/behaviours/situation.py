"""The situation as behaviours see it at this moment, and what they report."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np

from robotside.core.pose2 import ORIGIN, Points, Pose2

__all__ = ["Doing", "Seen", "Situation"]

MAX_INTRUDERS = 20
"""That may wait to be gone round."""


@dataclass(frozen=True, slots=True)
class Doing:
    """The present action of a task."""

    phase: str = ""
    """driving, waiting, dwelling, holding, turning, docking, circling, taking off, landing or surfacing; empty when it does none of them."""
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
    touched: bool = False
    """The bumper touches something."""
    intruders: deque[Seen] = field(default_factory=lambda: deque(maxlen=MAX_INTRUDERS))
    """Found, and not gone round yet."""
    doing: Doing = Doing()
    """The action that the last behaviour reported."""
    still: float = 0.0
    """Time of that beside the way [s]; NaN when unknown."""

    @property
    def worked(self) -> float:
        """A clock that stands still while the task is paused [s]."""
        return self.now - self.idle

    def report(
        self, phase: str, text: str = "", *, place: str = "", asks: str = "", still: float = 0.0
    ) -> None:
        """Say what is done; `still` is how long it takes beside the way [s]."""
        self.doing, self.still = Doing(phase, text, place, asks), still

    def begin(self) -> None:
        """Forget what belonged to the task before."""
        self.doing, self.still, self.idle = Doing(), 0.0, 0.0
        self.intruders.clear()
        self.forget_confirmation()

    def forget_confirmation(self) -> None:
        """Forget the answers that were given up to now."""
        self.confirmed_by = self.tag = ""
