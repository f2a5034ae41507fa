"""Choice of a goal: steps by which it moves, and the state of the goal that the robot was given.

class GoalPad(GoalChoice, Grip, Gauge): ...
pad.press("east"), pad.press("go")
"""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np
from kivy.properties import ListProperty, NumericProperty, ObjectProperty, OptionProperty

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    Quaternion,
)
from bridge.msgs.nav_msgs import Path
from bridge.msgs.pilothouse_msgs import TaskStatus
from bridge.msgs.std_msgs import Header
from widgets.controls.goals.goal_status import GoalStatus
from widgets.core.base import Control
from widgets.core.geometry import Points
from widgets.core.language import mark, tr

__all__ = ["BUTTONS", "MAX_COORDINATE", "OUTCOMES", "STEP", "TURN", "UNDER_WAY", "GoalChoice"]

STEP, TURN = 0.25, math.radians(15)
"""By which a press moves the goal [m] and turns it [rad]."""
MAX_COORDINATE = 1000.0
"""From the map's origin, along x and y, that a goal may be [m]."""
ARRIVAL_TOLERANCE = 0.3, math.radians(20)
"""A robot that is no farther from its goal has reached it [m], [rad]."""
BUTTONS: dict[str, tuple[int, int, str, tuple[int, int, int]]] = {
    "turn left": (0, 0, "rotate_left", (0, 0, 1)),
    "north": (1, 0, "arrow_upward", (0, 1, 0)),
    "turn right": (2, 0, "rotate_right", (0, 0, -1)),
    "west": (0, 1, "arrow_back", (-1, 0, 0)),
    "go": (1, 1, "near_me", (0, 0, 0)),
    "east": (2, 1, "arrow_forward", (1, 0, 0)),
    "here": (0, 2, "my_location", (0, 0, 0)),
    "south": (1, 2, "arrow_downward", (0, -1, 0)),
}
"""Name to column, row from above, icon, and steps in x, y and yaw. `here` puts the goal where the robot is."""
OUTCOMES = {
    "": (mark("Go"), "near_me"),
    "sent": (mark("Sent"), "hourglass_top"),
    "accepted": (mark("Going"), "route"),
    "waiting": (mark("Waiting"), "hourglass_top"),
    "paused": (mark("Paused"), "pause"),
    "there": (mark("There"), "check"),
    "unsure": (mark("Unsure"), "help"),
    "canceled": (mark("Canceled"), "cancel"),
    "failed": (mark("Failed"), "block"),
    "interrupted": (mark("Cut off"), "pause"),
    "refused": (mark("Refused"), "block"),
    "no_reply": (mark("No reply"), "help"),
}
"""What became of the goal to what the button says."""
UNDER_WAY = ("sent", "accepted", "waiting", "paused")
"""The robot has the goal, and has not done with it."""


class GoalChoice(Control):
    """Dispatches `on_command(pose)`, a PoseStamped in `map`, when `go` is pressed, and only then."""

    accepts: ClassVar = (PoseWithCovarianceStamped, Path, TaskStatus)
    sends = (PoseStamped,)
    actual: ListProperty[float] = ListProperty()
    """Where the robot is: x, y [m], yaw [rad]; empty while that is not known."""
    wanted: ListProperty[float] = ListProperty()
    """Where it is to go: x, y [m], yaw [rad]; empty before the first goal."""
    followed: ListProperty[float] = ListProperty()
    """Where the robot goes while another goal is being set here: x, y [m], yaw [rad]; empty where it goes to no other."""
    outcome = OptionProperty("", options=list(OUTCOMES))
    """What became of the goal: empty while it has not been sent as it is."""
    way: ObjectProperty[Points] = ObjectProperty(
        np.zeros((0, 2)), force_dispatch=True, comparator=lambda *_: False
    )
    """The way that the robot means to take, shape (n, 2) [m]; empty when it has none."""
    step = NumericProperty(STEP)
    """By which a press moves the goal [m]."""

    def __init__(self, **kwargs: Any) -> None:
        self._status = GoalStatus()
        self._end: list[float] = []
        self._left: tuple[int, list[float]] = 0, []
        self._taken = False
        super().__init__(**kwargs)

    def show(self, msg: PoseWithCovarianceStamped | Path | TaskStatus) -> None:
        """Show where the robot is, the way it means to take, or what it does.

        The end of the way of a robot that goes to a goal is the goal while none is being set here; another task's is not.
        """
        if isinstance(msg, Path | TaskStatus):
            if isinstance(msg, Path):
                self._show_way(msg)
            else:
                self._show_task(msg)
            self._follow_up()
            return
        pose = msg.pose.pose
        place = [round(value, 3) for value in (pose.position.x, pose.position.y, pose.orientation.yaw)]
        self.actual = place if all(map(math.isfinite, place)) else []

    def _show_way(self, path: Path) -> None:
        places = [(one.pose.position.x, one.pose.position.y) for one in path.poses]
        if not places and len(self.way) and not self._status.is_reported and self.outcome == "accepted":
            self.outcome = ""  # who says nothing of its tasks says only so that it has ended
        self.way = np.array(places, dtype=np.float64).reshape(-1, 2)
        yaw = path.poses[-1].pose.orientation.yaw if places else 0.0
        end = [*places[-1], yaw] if places else []
        self._end = end if all(map(math.isfinite, end)) else []
        self._take_end()

    def _show_task(self, status: TaskStatus) -> None:
        outcome = self._status.on_status(status)
        if outcome is not None:
            self.outcome = outcome
        self._take_end()

    def _take_end(self) -> None:
        """Where another operator sends the robot is its goal here too, until a finger sets one."""
        if self._end and (self._taken or not self.wanted) and self._status.adopt():
            self.wanted, self._taken = self._end, True
            if self.outcome not in UNDER_WAY:
                self.outcome = "accepted"

    def _follow_up(self) -> None:
        """Keep in sight where the robot goes: the end of its way, or the goal that it had when another one was begun here."""
        going = self._status.going
        run, left = self._left
        now = (self._end or (left if run == going else [])) if going and self.wanted else []
        other = (
            bool(now)
            and self.outcome != "sent"
            and going != self._status.run
            and math.dist(now[:2], self.wanted[:2]) > self.step / 2
        )
        self.followed = now if other else []

    @property
    def goal(self) -> PoseStamped:
        """The goal as a message; ValueError while there is none."""
        if not self.wanted:
            raise ValueError(tr("There is no goal yet: the robot's position is unknown, and no goal is set."))
        x, y, yaw = self.wanted
        return PoseStamped(Header(frame_id="map"), Pose(Point(x, y), Quaternion.from_yaw(yaw)))

    @property
    def there(self) -> bool:
        """The robot is where it is wanted."""
        if not (self.actual and self.wanted):
            return False
        (x, y, yaw), (goal_x, goal_y, goal_yaw) = self.actual, self.wanted
        turn = abs(math.remainder(goal_yaw - yaw, math.tau))
        return math.hypot(goal_x - x, goal_y - y) <= ARRIVAL_TOLERANCE[0] and turn <= ARRIVAL_TOLERANCE[1]

    @property
    def says(self) -> tuple[str, str]:
        """Words and icon of the button in the middle."""
        if self.outcome == "accepted" and self.there:
            return tr("There"), "check"
        words, icon = OUTCOMES[self.outcome]
        return tr(words), icon

    def can(self, name: str) -> bool:
        """Whether a press of that button does anything."""
        if name == "go":
            return bool(self.wanted) and self.outcome != "sent"
        return bool(self.actual or (self.wanted and name != "here"))

    def answer(self, outcome: str) -> None:
        """What became of the goal that was sent: `sent`, `accepted`, `refused` or `no_reply`; what the robot says of it comes by `show`."""
        if outcome == "refused":
            self._status.forget()
        if outcome != "accepted" or not self._status.run:  # what it does may be heard before its answer
            self.outcome = outcome
        self._follow_up()

    def press(self, name: str) -> None:
        """Do what a button says, as a finger would."""
        if not name or not self.can(name):
            return
        if name == "go":
            self.outcome, self._taken = "sent", False
            self._status.on_sent()
            self.dispatch("on_command", self.goal)
        elif name == "here":
            self._want(self._snapped())
        else:
            x, y, yaw = self.wanted or self._snapped()
            across, up, turn = BUTTONS[name][3]
            self._want([x + across * self.step, y + up * self.step, yaw + turn * TURN])

    def _snapped(self) -> list[float]:
        """Where the robot is, on whole steps, so that the goal's figures are round."""
        x, y, yaw = self.actual
        return [round(x / self.step) * self.step, round(y / self.step) * self.step, round(yaw / TURN) * TURN]

    def _want(self, place: list[float]) -> None:
        x, y = (max(-MAX_COORDINATE, min(MAX_COORDINATE, value)) + 0.0 for value in place[:2])
        if self._status.run:
            self._left = self._status.run, list(self.wanted)
        self._status.forget()
        self._taken = False
        self.wanted, self.outcome = [x, y, math.remainder(place[2], math.tau)], ""
        self._follow_up()
