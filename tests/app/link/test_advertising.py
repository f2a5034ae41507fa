"""Topics are advertised once, and only those that a robot listens to."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.link.advertising import Advertiser
from app.link.capabilities import Capabilities
from bridge.core.topics import TOPICS

OURS = Capabilities.of({entry.name: entry.type.MSGTYPE for entry in TOPICS}, frozenset({"/stop"}))
STAMPED = Capabilities.of({"/cmd_vel": "geometry_msgs/TwistStamped"}, frozenset())
BARE = Capabilities.of({"/odom": "nav_msgs/Odometry"}, frozenset())


def advertised(*offers: Capabilities) -> list[tuple[str, str]]:
    found: list[tuple[str, str]] = []
    client: Any = SimpleNamespace(advertise=lambda topic, kind: found.append((topic, kind.MSGTYPE)))
    advertiser = Advertiser(client)
    for offer in offers:
        advertiser.follow(offer)
    return found


@pytest.mark.parametrize(
    ("offer", "expected"),
    [
        (
            OURS,
            [
                ("/cmd_vel", "geometry_msgs/Twist"),
                ("/cmd_manoeuvre", "pilothouse_msgs/Manoeuvre"),
                ("/initialpose", "geometry_msgs/PoseWithCovarianceStamped"),
            ],
        ),
        (STAMPED, [("/cmd_vel", "geometry_msgs/TwistStamped")]),
        (BARE, []),
    ],
)
def test_what_a_robot_listens_to_is_advertised(offer: Capabilities, expected: list[tuple[str, str]]) -> None:
    assert advertised(offer) == expected


def test_nothing_is_advertised_twice() -> None:
    assert advertised(BARE, STAMPED, STAMPED) == [("/cmd_vel", "geometry_msgs/TwistStamped")]
