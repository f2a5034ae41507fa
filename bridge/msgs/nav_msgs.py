"""nav_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import Int8Array
from bridge.msgs.base import Msg, uint8, uint32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseStamped,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    TwistWithCovariance,
)
from bridge.msgs.std_msgs import Header

__all__ = [
    "GetMapRequest",
    "GetMapResponse",
    "GetPlanRequest",
    "GetPlanResponse",
    "GridCells",
    "LoadMapRequest",
    "LoadMapResponse",
    "MapMetaData",
    "OccupancyGrid",
    "Odometry",
    "Path",
    "SetMapRequest",
    "SetMapResponse",
]


class GetMapRequest(Msg, frozen=True, gc=False):
    """Ask for the map."""

    MSGTYPE: ClassVar[str] = "nav_msgs/GetMapRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class MapMetaData(Msg, frozen=True, gc=False):
    """Size and place of a grid."""

    MSGTYPE: ClassVar[str] = "nav_msgs/MapMetaData"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "float32", "uint32", "uint32", "geometry_msgs/Pose")
    UNITS: ClassVar[dict[str, str]] = {"resolution": "m"}
    map_load_time: Time = Time()
    resolution: float = 0.0
    """Edge of one cell [m]."""
    width: uint32 = 0
    """Columns, along x."""
    height: uint32 = 0
    """Rows, along y."""
    origin: Pose = Pose()
    """Pose of the outer corner of cell (0, 0)."""


class OccupancyGrid(Msg, frozen=True, gc=False):
    """A map of what is free and what is not."""

    MSGTYPE: ClassVar[str] = "nav_msgs/OccupancyGrid"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "nav_msgs/MapMetaData", "int8[]")
    header: Header = Header()
    info: MapMetaData = MapMetaData()
    data: Int8Array = field(default_factory=Int8Array)
    """Row by row from y = origin: 0 free to 100 occupied, -1 unknown."""


class GetMapResponse(Msg, frozen=True, gc=False):
    """What `GetMap` answers."""

    MSGTYPE: ClassVar[str] = "nav_msgs/GetMapResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("nav_msgs/OccupancyGrid",)
    map: OccupancyGrid = field(default_factory=OccupancyGrid)


class GetPlanRequest(Msg, frozen=True, gc=False):
    """Ask for a way without driving it."""

    MSGTYPE: ClassVar[str] = "nav_msgs/GetPlanRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "geometry_msgs/PoseStamped",
        "geometry_msgs/PoseStamped",
        "float32",
    )
    UNITS: ClassVar[dict[str, str]] = {"tolerance": "m"}
    start: PoseStamped = PoseStamped()
    goal: PoseStamped = PoseStamped()
    tolerance: float = 0.0
    """Distance from the goal where it may end [m]; 0 for as near as possible."""


class Path(Msg, frozen=True, gc=False):
    """Poses to pass, in order."""

    MSGTYPE: ClassVar[str] = "nav_msgs/Path"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/PoseStamped[]")
    header: Header = Header()
    poses: list[PoseStamped] = []


class GetPlanResponse(Msg, frozen=True, gc=False):
    """What `GetPlan` answers."""

    MSGTYPE: ClassVar[str] = "nav_msgs/GetPlanResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("nav_msgs/Path",)
    plan: Path = field(default_factory=Path)
    """Empty when there is none."""


class GridCells(Msg, frozen=True, gc=False):
    """Some cells of a grid in the header's frame."""

    MSGTYPE: ClassVar[str] = "nav_msgs/GridCells"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float32", "float32", "geometry_msgs/Point[]")
    UNITS: ClassVar[dict[str, str]] = {"cell_width": "m", "cell_height": "m", "cells": "m"}
    header: Header = Header()
    cell_width: float = 0.0
    """Edge of a cell along x [m]."""
    cell_height: float = 0.0
    """Edge of a cell along y [m]."""
    cells: list[Point] = []
    """The middle of each cell [m]."""


class LoadMapRequest(Msg, frozen=True, gc=False):
    """Load a map from a file."""

    MSGTYPE: ClassVar[str] = "nav_msgs/LoadMapRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    map_url: str = ""
    """Where it lies, as file:///PATH or package://PACKAGE/PATH."""


class LoadMapResponse(Msg, frozen=True, gc=False):
    """What `LoadMap` answers."""

    MSGTYPE: ClassVar[str] = "nav_msgs/LoadMapResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("nav_msgs/OccupancyGrid", "uint8")
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("uint8",) * 5

    RESULT_SUCCESS: ClassVar[int] = 0
    RESULT_MAP_DOES_NOT_EXIST: ClassVar[int] = 1
    RESULT_INVALID_MAP_DATA: ClassVar[int] = 2
    RESULT_INVALID_MAP_METADATA: ClassVar[int] = 3
    RESULT_UNDEFINED_FAILURE: ClassVar[int] = 255

    map: OccupancyGrid = field(default_factory=OccupancyGrid)
    """Means something only after success."""
    result: uint8 = 0
    """One of RESULT_…."""


class Odometry(Msg, frozen=True, gc=False):
    """Pose in the header's frame, velocity in the child's."""

    MSGTYPE: ClassVar[str] = "nav_msgs/Odometry"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "string",
        "geometry_msgs/PoseWithCovariance",
        "geometry_msgs/TwistWithCovariance",
    )
    header: Header = Header()
    child_frame_id: str = ""
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)
    twist: TwistWithCovariance = field(default_factory=TwistWithCovariance)


class SetMapRequest(Msg, frozen=True, gc=False):
    """Give a robot another map and tell it where it is there."""

    MSGTYPE: ClassVar[str] = "nav_msgs/SetMapRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "nav_msgs/OccupancyGrid",
        "geometry_msgs/PoseWithCovarianceStamped",
    )
    map: OccupancyGrid = field(default_factory=OccupancyGrid)
    initial_pose: PoseWithCovarianceStamped = field(default_factory=PoseWithCovarianceStamped)


class SetMapResponse(Msg, frozen=True, gc=False):
    """What `SetMap` answers."""

    MSGTYPE: ClassVar[str] = "nav_msgs/SetMapResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool",)
    success: bool = False
