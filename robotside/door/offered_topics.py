"""The topics of the table that a robot has: those of its equipment, and those that the robot side makes for any."""

from __future__ import annotations

from bridge.core.topics import SONARS, TOPICS, camera_topics
from bridge.msgs.pilothouse_msgs import RobotInfo, SonarRing
from robotside.core.bus import Bus

__all__ = ["EQUIPMENT_TOPICS", "SERVED", "OfferedTopics"]

_RING = {f"/sonar/{number}": number for number in range(SONARS)}
_PICTURES = {topic.name for topic in TOPICS if topic.name.endswith("/image/compressed")}
_TRUTH = "/sim/ground_truth"

SERVED = frozenset({"/gateways", "/payloads"})
"""What is made by who serves the robot."""

EQUIPMENT_TOPICS = frozenset(
    {
        "/odom",
        "/imu/data",
        "/fix",
        "/scan",
        "/bumper",
        "/line_sensor",
        "/range/front",
        "/range/left",
        "/range/right",
        "/range/rear",
        "/range/down",
        "/battery_state",
        "/joint_states",
        "/motors",
        "/manoeuvre",
        "/sonar",
        "/ackermann",
        "/rudder",
        "/compass",
        "/depth",
        "/flight",
        "/arm",
        "/lights",
        "/tag",
        "/following",
        "/map",
    }
)
"""What only a robot tells that has something to tell it with."""


class OfferedTopics:
    """Looks at what a robot has told so far: one says everything once when it starts, and goes on to have it."""

    def __init__(self, info: RobotInfo, bus: Bus, *, simulated: bool) -> None:
        """`info` names its cameras; where it really is only a `simulated` one knows."""
        self._bus, self._simulated = bus, simulated
        self._pictures = set(camera_topics(info.cameras).values())

    def __call__(self, topic: str) -> bool:
        """Whether it has a topic of this name; of others than the table's it is not for this to say."""
        if topic in EQUIPMENT_TOPICS:
            return self._bus.last(topic) is not None
        if topic in _PICTURES:
            return topic in self._pictures
        if topic in _RING:
            ring = self._bus.last("/sonar")
            return isinstance(ring, SonarRing) and _RING[topic] < len(ring.ranges)
        if topic == "/detections":
            return bool(self._pictures)
        return topic not in SERVED and (topic != _TRUTH or self._simulated)
