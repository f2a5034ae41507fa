"""nav_msgs: odometry, maps and paths."""

from __future__ import annotations

from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import Int8Array
from bridge.msgs.base import Msg
from bridge.msgs.geometry_msgs import Pose, PoseStamped, PoseWithCovariance, TwistWithCovariance
from bridge.msgs.std_msgs import Header, Time

__all__ = ["MapMetaData", "OccupancyGrid", "Odometry", "Path"]


class Odometry(Msg, frozen=True, gc=False):
    """Pose in the header's frame, velocity in the child's."""

    MSGTYPE: ClassVar[str] = "nav_msgs/Odometry"
    header: Header = Header()
    child_frame_id: str = ""
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)
    twist: TwistWithCovariance = field(default_factory=TwistWithCovariance)


class MapMetaData(Msg, frozen=True, gc=False):
    """Size and place of a grid."""

    MSGTYPE: ClassVar[str] = "nav_msgs/MapMetaData"
    map_load_time: Time = Time()
    resolution: float = 0.0
    """Edge of one cell [m]."""
    width: int = 0
    """Columns, along x."""
    height: int = 0
    """Rows, along y."""
    origin: Pose = Pose()
    """Pose of the outer corner of cell (0, 0)."""


class OccupancyGrid(Msg, frozen=True, gc=False):
    """A map of what is free and what is not."""

    MSGTYPE: ClassVar[str] = "nav_msgs/OccupancyGrid"
    header: Header = Header()
    info: MapMetaData = MapMetaData()
    data: Int8Array = field(default_factory=Int8Array)
    """Row by row from y = origin: 0 free to 100 occupied, -1 unknown."""


class Path(Msg, frozen=True, gc=False):
    """Poses to pass, in order."""

    MSGTYPE: ClassVar[str] = "nav_msgs/Path"
    header: Header = Header()
    poses: list[PoseStamped] = []
