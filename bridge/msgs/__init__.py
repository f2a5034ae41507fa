"""Message classes as typed immutable records, and the table of all of them by ROS name.

`python -m bridge.generate` makes one module per ROS package; `additions.py`, `arrays.py`, `base.py` and
`builtin_interfaces.py` are written by hand.
"""

from __future__ import annotations

from bridge.msgs import (
    action_msgs,
    builtin_interfaces,
    diagnostic_msgs,
    geometry_msgs,
    nav_msgs,
    pilothouse_msgs,
    rosapi_msgs,
    sensor_msgs,
    std_msgs,
    std_srvs,
    tf2_msgs,
    unique_identifier_msgs,
    vision_msgs,
)
from bridge.msgs.base import Msg

__all__ = ["TYPES", "Msg", "ros1_name"]

_PACKAGES = (
    builtin_interfaces,
    std_msgs,
    geometry_msgs,
    sensor_msgs,
    nav_msgs,
    diagnostic_msgs,
    std_srvs,
    tf2_msgs,
    vision_msgs,
    unique_identifier_msgs,
    action_msgs,
    rosapi_msgs,
    pilothouse_msgs,
)

TYPES: dict[str, type[Msg]] = {
    cls.MSGTYPE: cls
    for package in _PACKAGES
    for cls in vars(package).values()
    if isinstance(cls, type) and issubclass(cls, Msg) and cls.MSGTYPE
}
"""All known message classes by ROS 1 name; a service has two of them, an action three."""


def ros1_name(name: str) -> str:
    """The ROS 1 form of a type name: `sensor_msgs/msg/Imu` and `sensor_msgs/Imu` both give `sensor_msgs/Imu`."""
    return name.replace("/msg/", "/").replace("/srv/", "/").replace("/action/", "/")
