"""The messages of the socket, as typed immutable records, and the table of all of them by ROS name."""

from __future__ import annotations

from bridge.msgs import (
    diagnostic_msgs,
    geometry_msgs,
    nav_msgs,
    pilothouse_msgs,
    sensor_msgs,
    std_msgs,
    tf2_msgs,
    vision_msgs,
)
from bridge.msgs.base import Msg

__all__ = ["TYPES", "Msg", "ros1_name"]

_PACKAGES = (
    std_msgs,
    geometry_msgs,
    sensor_msgs,
    nav_msgs,
    diagnostic_msgs,
    tf2_msgs,
    vision_msgs,
    pilothouse_msgs,
)

TYPES: dict[str, type[Msg]] = {
    cls.MSGTYPE: cls
    for package in _PACKAGES
    for cls in vars(package).values()
    if isinstance(cls, type) and issubclass(cls, Msg) and cls.MSGTYPE
}
"""Every known message class by its ROS 1 name."""


def ros1_name(name: str) -> str:
    """The ROS 1 form of a type name: `sensor_msgs/msg/Imu` and `sensor_msgs/Imu` both give `sensor_msgs/Imu`."""
    return name.replace("/msg/", "/").replace("/srv/", "/")
