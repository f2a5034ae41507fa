"""The newest measurements of the robot, and which of its sensors are alive."""

from __future__ import annotations

import math
from collections.abc import Container

from msgspec.structs import replace

from bridge.msgs import Msg
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Bumper, FlightState
from bridge.msgs.sensor_msgs import BatteryState, Imu
from robotside.autonomy.power_supply import PowerSupply
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import kind_of
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import PlanarVelocity

__all__ = ["SENSOR_TIMEOUT", "SensorHealth", "needed"]

_NAMES = {"/odom": "odometry", "/scan": "laser", "/sonar": "sonars"}

_MORE = {
    "/imu/data": "IMU",
    "/bumper": "bumper",
    "/compass": "compass",
    "/depth": "depth gauge",
    "/range/down": "height ultrasound",
    "/joint_states": "encoders",
    "/line_sensor": "line sensor",
    "/range/front": "front ultrasound",
    "/range/left": "left ultrasound",
    "/range/right": "right ultrasound",
    "/range/rear": "rear ultrasound",
}
"""Sensors that a robot may have; they count once they were heard."""


def needed(kind: str, heard: Container[str]) -> dict[str, str]:
    """Topic and name of the sensors that a robot of a `kind` needs to move by itself, of which it has `heard` some.

    What measures distances all round counts where it was heard, and has to be there on the ground: a laser, or else sonars.
    """
    ranging = next((topic for topic in ("/scan", "/sonar") if topic in heard), "")
    if not ranging and kind_of(kind).on_the_ground:
        ranging = "/scan"
    return {topic: _NAMES[topic] for topic in ("/odom", ranging) if topic}


SENSOR_TIMEOUT = 1.0
"""A sensor that was silent for longer than this is not alive [s]."""


class SensorHealth:
    """Takes the robot's messages; times are of the robot's clock [s]."""

    def __init__(self, kind: str = "wheels") -> None:
        """Of a robot of a `kind`, as its information calls it."""
        self._kind = kind
        self._measured = MeasuredState()
        self._heard: dict[str, float] = {}
        self._supply = PowerSupply()

    def on_message(self, topic: str, msg: Msg, now: float) -> None:
        """Take in one message of the robot."""
        if topic in _NAMES or topic in _MORE:
            self._heard[topic] = now
        if self._measured.charging and not self._supply.charging(now):
            self._measured = replace(self._measured, charging=False)
        if isinstance(msg, Odometry):
            x, y = _level(msg)
            moving = PlanarVelocity(x, y, msg.twist.twist.angular.z)
            if all(map(math.isfinite, moving)):
                self._measured = replace(self._measured, moving=moving)
        elif isinstance(msg, Imu) and msg.orientation_covariance[0] >= 0:
            turned = msg.orientation
            self._measured = replace(self._measured, roll=turned.roll, pitch=turned.pitch)
        elif isinstance(msg, Bumper):
            felt = msg.pressed and math.isfinite(msg.bearing)
            self._measured = replace(self._measured, touched=msg.bearing if felt else None)
        elif isinstance(msg, BatteryState):
            self._supply.on_battery(msg, now)
            self._measured = replace(self._measured, charging=self._supply.charging(now))
        elif isinstance(msg, FlightState):
            self._measured = replace(
                self._measured,
                landed=msg.phase in ("landed", "turned_over"),
                overturned=msg.phase == "turned_over",
            )

    def forget(self, topic: str) -> None:
        """The sensor of `topic` is switched off: its silence means nothing until it is heard again."""
        self._heard.pop(topic, None)

    def skip(self, seconds: float) -> None:
        """The robot's clock jumped by `seconds` [s], in which nothing could be heard."""
        self._heard = {topic: heard + seconds for topic, heard in self._heard.items()}
        self._supply.skip(seconds)

    def measured(
        self,
        pose: Pose2 | None,
        *,
        spread: float = 0.0,
        sure: bool = True,
        height: float = math.nan,
        height_spread: float = 0.0,
    ) -> MeasuredState:
        """All of it, with the pose in `map` and the height that were made of it, and how sure those are."""
        return replace(
            self._measured,
            pose=pose,
            spread=spread,
            sure=sure,
            height=height,
            height_spread=height_spread,
        )

    def silent(self, now: float) -> list[str]:
        """The names of the sensors that are not alive."""
        names = _NAMES | _MORE
        known = dict.fromkeys(needed(self._kind, self._heard), -math.inf) | self._heard
        return [names[topic] for topic, heard in known.items() if now - heard > SENSOR_TIMEOUT]


def _level(odom: Odometry) -> tuple[float, float]:
    """Speed over ground ahead and to the left of where it looks [m/s]: one that leans goes elsewhere than along its body."""
    v, turned = odom.twist.twist.linear, odom.pose.pose.orientation
    roll, pitch = turned.roll, turned.pitch
    x = v.x * math.cos(pitch) + (v.y * math.sin(roll) + v.z * math.cos(roll)) * math.sin(pitch)
    return x, v.y * math.cos(roll) - v.z * math.sin(roll)
