"""The base of every message: an immutable record that knows its ROS type name."""

from __future__ import annotations

from typing import ClassVar

import msgspec

__all__ = ["Msg"]


class Msg(msgspec.Struct, frozen=True, gc=False):
    """A ROS message, or one half of a ROS service.

    Field names are ROS's own. Units follow REP-103 (metre, second, radian) unless a field says otherwise.
    A float that is not known is NaN; it travels as `null` in JSON.
    """

    MSGTYPE: ClassVar[str] = ""
    """Full ROS 1 name of the type, as in `sensor_msgs/Imu`; a service's halves end in `Request` and `Response`."""
