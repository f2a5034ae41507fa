"""The mission on the map: the draft's points and home, what the fence refuses, and how far the robot has come."""

from __future__ import annotations

import math

from app.missions.refusals import summary
from app.screens.mission.map_pointing import MapPointing
from app.screens.mission.mission_maps import MissionMaps
from app.screens.mission.mission_panel import MissionPanel
from app.screens.shell import status_text
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import RobotInfo, TaskStatus
from widgets.core.language import tr
from widgets.map.map_robot import corners

__all__ = ["MissionOnMap"]

JUDGE_PERIOD = 1.0
"""Between two looks at what the robot would refuse from where it is now [s]."""
DEFAULT_RADIUS = 0.2
"""Of a robot that does not publish its own [m]."""


class MissionOnMap:
    """Draws on the map that is on the glass."""

    def __init__(
        self, session: Session, maps: MissionMaps, panel: MissionPanel, pointing: MapPointing
    ) -> None:
        self._session, self._maps, self._panel, self._pointing = session, maps, panel, pointing
        self._judged = -math.inf
        self._ran = False
        """A task ran when the robot last told of it."""
        maps.shown.bind(selected=lambda *_: self.show_heights())

    def show_draft(self) -> None:
        """Bring the draft up to date, on the map and in the panel."""
        draft, area = self._session.mission.draft, self._maps.shown
        area.waypoints, area.heights = list(draft.points), list(draft.levels)
        area.home = list(draft.home or ())
        if area.selected >= len(draft.points):
            area.selected = -1
        area.motion_name = draft.motion
        self._panel.refused = summary(self._session.refusals.draft(draft).values())
        self._panel.show_draft()
        self._pointing.show()
        self.show_heights()

    def show_heights(self) -> None:
        """Bring the control of heights up to date: of the point that is selected, else of all."""
        area, robot = self._maps.shown, self._session.robot
        self._panel.heights.show(self._session.mission.draft.levels, int(area.selected), robot.info)

    def tick(self) -> None:
        """Bring up to date what time changes: where ways lead to depends on where the robot is."""
        if self._session.now() - self._judged >= JUDGE_PERIOD:
            self.judge()
        if not self._maps.shown.located:
            self._maps.shown.unplaced = self._unplaced()

    def _unplaced(self) -> str:
        """What is known of where the robot is while it has told no place on the map; empty for nothing."""
        told, role = status_text.fix(self._session)
        if role != "ok":
            return ""
        if not told.startswith("±"):
            return tr("It has a satellite fix; its place on this map is not known yet")
        return tr("By satellite it is known to {accuracy}; its place on this map is not yet").format(
            accuracy=told
        )

    def judge(self) -> None:
        """Say anew what the robot would refuse."""
        self._judged = self._session.now()
        refused = summary(self._session.refusals.draft(self._session.mission.draft).values())
        if refused != self._panel.refused:
            self._panel.refused = refused
            self._panel.show_draft()
        self._pointing.judge()

    def show_info(self, info: RobotInfo) -> None:
        """The robot's size and its camera's field of view."""
        area = self._maps.shown
        area.robot_radius = info.radius or DEFAULT_RADIUS
        area.camera_fov = info.camera_fov
        area.footprint = corners(info)
        self.show_draft()

    def show_task(self, status: TaskStatus) -> None:
        """Points are marked as visited only while the robot drives the very points that are drawn."""
        area = self._maps.shown
        same = self._session.running and status.waypoints == len(area.waypoints)
        coming = status.waypoint if same and status.task == "patrol" else 0
        area.coming = coming - 1 if coming else -1
        area.visited = max(0, coming - 1) if status.motion != "random" else 0
        runs = status.state == "RUNNING"
        if runs and not self._ran:  # whoever has started it
            self._pointing.set_going()
        self._ran = runs
