"""Topics that the handheld publishes to a robot, each advertised once.

Everything here lives in the network thread.
"""

from __future__ import annotations

from app.link.capabilities import MANOEUVRE, Capabilities
from bridge.client.client import BridgeClient
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, Twist, TwistStamped
from bridge.msgs.pilothouse_msgs import Manoeuvre

__all__ = ["INITIAL_POSE", "Advertiser"]

INITIAL_POSE = "/initialpose"
"""Topic of the place that an operator points at."""


class Advertiser:
    """Advertises what the robot listens to; what was advertised once stays so over every reconnect."""

    def __init__(self, client: BridgeClient) -> None:
        self._client = client
        self._advertised: set[str] = set()

    def follow(self, offer: Capabilities) -> None:
        """The robot offers this: advertise what it can be driven and placed by."""
        if offer.drive is not None:
            self._advertise(offer.drive, TwistStamped if offer.stamped else Twist)
        if offer.steers:
            self._advertise(MANOEUVRE, Manoeuvre)
        if offer.ours or INITIAL_POSE in offer.topics:
            self._advertise(INITIAL_POSE, PoseWithCovarianceStamped)

    def _advertise(self, topic: str, kind: type[Msg]) -> None:
        if topic not in self._advertised:
            self._advertised.add(topic)
            self._client.advertise(topic, kind)
