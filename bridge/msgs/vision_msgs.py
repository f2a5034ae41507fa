"""vision_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from msgspec import field

from bridge.msgs.base import Msg, int32, uint16
from bridge.msgs.geometry_msgs import Pose, PoseWithCovariance, Vector3
from bridge.msgs.std_msgs import Header

__all__ = [
    "BoundingBox2D",
    "BoundingBox2DArray",
    "BoundingBox3D",
    "BoundingBox3DArray",
    "Classification",
    "Detection2D",
    "Detection2DArray",
    "Detection3D",
    "Detection3DArray",
    "LabelInfo",
    "ObjectHypothesis",
    "ObjectHypothesisWithPose",
    "Point2D",
    "Pose2D",
    "VisionClass",
    "VisionInfo",
]


class Point2D(Msg, frozen=True, gc=False):
    """A place in the picture [pixel], from its top left corner."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Point2D"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"x": "pixel", "y": "pixel"}
    x: float = 0.0
    y: float = 0.0


class Pose2D(Msg, frozen=True, gc=False):
    """A place and a turn in the picture."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Pose2D"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("vision_msgs/Point2D", "float64")
    UNITS: ClassVar[dict[str, str]] = {"theta": "rad"}
    position: Point2D = Point2D()
    theta: float = 0.0
    """[rad]"""


class BoundingBox2D(Msg, frozen=True, gc=False):
    """A box round something, by its centre [pixel]."""

    MSGTYPE: ClassVar[str] = "vision_msgs/BoundingBox2D"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("vision_msgs/Pose2D", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"size_x": "pixel", "size_y": "pixel"}
    center: Pose2D = Pose2D()
    size_x: float = 0.0
    """Width before it is turned [pixel]."""
    size_y: float = 0.0
    """Height before it is turned [pixel]."""


class BoundingBox2DArray(Msg, frozen=True, gc=False):
    """Some boxes in a picture."""

    MSGTYPE: ClassVar[str] = "vision_msgs/BoundingBox2DArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "vision_msgs/BoundingBox2D[]")
    header: Header = Header()
    boxes: list[BoundingBox2D] = []


class BoundingBox3D(Msg, frozen=True, gc=False):
    """A box round something, by its centre."""

    MSGTYPE: ClassVar[str] = "vision_msgs/BoundingBox3D"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Pose", "geometry_msgs/Vector3")
    UNITS: ClassVar[dict[str, str]] = {"center": "m", "size": "m"}
    center: Pose = Pose()
    """[m]"""
    size: Vector3 = Vector3()
    """[m]"""


class BoundingBox3DArray(Msg, frozen=True, gc=False):
    """Some boxes in space."""

    MSGTYPE: ClassVar[str] = "vision_msgs/BoundingBox3DArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "vision_msgs/BoundingBox3D[]")
    header: Header = Header()
    boxes: list[BoundingBox3D] = []


class ObjectHypothesis(Msg, frozen=True, gc=False):
    """A possible class."""

    MSGTYPE: ClassVar[str] = "vision_msgs/ObjectHypothesis"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64")
    class_id: str = ""
    score: float = 0.0
    """0 to 1."""


class Classification(Msg, frozen=True, gc=False):
    """Possible classes of a whole picture or cloud."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Classification"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "vision_msgs/ObjectHypothesis[]")
    header: Header = Header()
    results: list[ObjectHypothesis] = []


class ObjectHypothesisWithPose(Msg, frozen=True, gc=False):
    """A possible class with its pose in the header's frame."""

    MSGTYPE: ClassVar[str] = "vision_msgs/ObjectHypothesisWithPose"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("vision_msgs/ObjectHypothesis", "geometry_msgs/PoseWithCovariance")
    hypothesis: ObjectHypothesis = ObjectHypothesis()
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)


class Detection2D(Msg, frozen=True, gc=False):
    """One thing seen."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Detection2D"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "vision_msgs/ObjectHypothesisWithPose[]",
        "vision_msgs/BoundingBox2D",
        "string",
    )
    UNITS: ClassVar[dict[str, str]] = {"bbox": "pixel"}
    header: Header = Header()
    results: list[ObjectHypothesisWithPose] = []
    """Possible classes."""
    bbox: BoundingBox2D = BoundingBox2D()
    """Where in the picture [pixel]."""
    id: str = ""
    """Stays the same from picture to picture while it is followed; empty when it is not."""


class Detection2DArray(Msg, frozen=True, gc=False):
    """Everything seen in one picture; the stamp is the picture's."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Detection2DArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "vision_msgs/Detection2D[]")
    header: Header = Header()
    detections: list[Detection2D] = []


class Detection3D(Msg, frozen=True, gc=False):
    """One thing seen, in space."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Detection3D"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "vision_msgs/ObjectHypothesisWithPose[]",
        "vision_msgs/BoundingBox3D",
        "string",
    )
    UNITS: ClassVar[dict[str, str]] = {"bbox": "m"}
    header: Header = Header()
    results: list[ObjectHypothesisWithPose] = []
    """Possible classes."""
    bbox: BoundingBox3D = BoundingBox3D()
    """Where in the header's frame [m]."""
    id: str = ""
    """Stays the same while it is followed; empty when it is not."""


class Detection3DArray(Msg, frozen=True, gc=False):
    """Everything seen at once; the stamp is that of what it was seen in."""

    MSGTYPE: ClassVar[str] = "vision_msgs/Detection3DArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "vision_msgs/Detection3D[]")
    header: Header = Header()
    detections: list[Detection3D] = []


class VisionClass(Msg, frozen=True, gc=False):
    """A number and what it stands for."""

    MSGTYPE: ClassVar[str] = "vision_msgs/VisionClass"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint16", "string")
    class_id: uint16 = 0
    class_name: str = ""


class LabelInfo(Msg, frozen=True, gc=False):
    """Meanings of the numbers that a recogniser writes into pixels."""

    MSGTYPE: ClassVar[str] = "vision_msgs/LabelInfo"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "vision_msgs/VisionClass[]", "float32")
    header: Header = Header()
    class_map: list[VisionClass] = []
    threshold: float = 0.0
    """Least confidence, 0 to 1."""


class VisionInfo(Msg, frozen=True, gc=False):
    """Where to learn what a recogniser's class ids mean."""

    MSGTYPE: ClassVar[str] = "vision_msgs/VisionInfo"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "string", "string", "int32")
    header: Header = Header()
    method: str = ""
    """Name of the recogniser."""
    database_location: str = ""
    """Where its table lies."""
    database_version: int32 = 0
    """Grows whenever the table changes."""
