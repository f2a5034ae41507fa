"""vision_msgs 4: what was seen in a picture."""

from __future__ import annotations

from typing import ClassVar

from msgspec import field

from bridge.msgs.base import Msg
from bridge.msgs.geometry_msgs import PoseWithCovariance
from bridge.msgs.std_msgs import Header

__all__ = [
    "BoundingBox2D",
    "Detection2D",
    "Detection2DArray",
    "ObjectHypothesis",
    "ObjectHypothesisWithPose",
    "Point2D",
    "Pose2D",
]


class Point2D(Msg, frozen=True, gc=False):
    """A place in the picture [pixel], from its top left corner."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Point2D"
    x: float = 0.0
    y: float = 0.0


class Pose2D(Msg, frozen=True, gc=False):
    """A place and a turn in the picture."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Pose2D"
    position: Point2D = Point2D()
    theta: float = 0.0
    """[rad]"""


class BoundingBox2D(Msg, frozen=True, gc=False):
    """A box round something, by its centre [pixel]."""

    MSGTYPE: ClassVar[str] = "vision_msgs/BoundingBox2D"
    center: Pose2D = Pose2D()
    size_x: float = 0.0
    size_y: float = 0.0


class ObjectHypothesis(Msg, frozen=True, gc=False):
    """What it may be."""

    MSGTYPE: ClassVar[str] = "vision_msgs/ObjectHypothesis"
    class_id: str = ""
    score: float = 0.0
    """0 to 1."""


class ObjectHypothesisWithPose(Msg, frozen=True, gc=False):
    """What it may be and where it is in the header's frame."""

    MSGTYPE: ClassVar[str] = "vision_msgs/ObjectHypothesisWithPose"
    hypothesis: ObjectHypothesis = ObjectHypothesis()
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)


class Detection2D(Msg, frozen=True, gc=False):
    """One thing seen."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Detection2D"
    header: Header = Header()
    results: list[ObjectHypothesisWithPose] = []
    bbox: BoundingBox2D = BoundingBox2D()
    id: str = ""


class Detection2DArray(Msg, frozen=True, gc=False):
    """Everything seen in one picture; the stamp is the picture's."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Detection2DArray"
    header: Header = Header()
    detections: list[Detection2D] = []
