"""Message classes as typed immutable records, and the table of all of them by ROS name.

`python -m bridge.generate` makes one module per ROS package; `additions.py`, `arrays.py`, `base.py` and
`builtin_interfaces.py` are written by hand.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, TypeVar, overload

from bridge.msgs import (
    action_msgs,
    builtin_interfaces,
    diagnostic_msgs,
    geometry_msgs,
    nav_msgs,
    pilothouse_msgs,
    rosapi_msgs,
    rosbridge_msgs,
    rosgraph_msgs,
    sensor_msgs,
    std_msgs,
    std_srvs,
    tf2_msgs,
    unique_identifier_msgs,
    vision_msgs,
)
from bridge.msgs.base import Msg

if TYPE_CHECKING:
    from bridge.msgs.common import CommonTypes

__all__ = ["TYPES", "Msg", "ros1_name"]

_D = TypeVar("_D")
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
    rosbridge_msgs,
    rosgraph_msgs,
    pilothouse_msgs,
)


class _Types(Mapping[str, type[Msg]]):
    """Message classes by ROS 1 name: those made beforehand, and when one is asked for, those of the common packages."""

    def __init__(self, made: dict[str, type[Msg]]) -> None:
        self._made = made
        self._common: CommonTypes | None = None

    @overload
    def get(self, key: str, /) -> type[Msg] | None: ...

    @overload
    def get(self, key: str, /, default: type[Msg] | _D) -> type[Msg] | _D: ...

    def get(self, key: str, /, default: object = None) -> object:
        """The class of a type; `default` when it is not known."""
        return self._made.get(key) or self._find_common(key) or default

    def __getitem__(self, name: str) -> type[Msg]:
        found = self.get(name)
        if found is None:
            raise KeyError(name)
        return found

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and self.get(name) is not None

    def __iter__(self) -> Iterator[str]:
        return iter(self._made)

    def __len__(self) -> int:
        return len(self._made)

    def _find_common(self, name: str) -> type[Msg] | None:
        if self._common is None:
            from bridge.msgs.common import CommonTypes

            self._common = CommonTypes(self.get)
        return self._common.find(name)


TYPES: Mapping[str, type[Msg]] = _Types(
    {
        cls.MSGTYPE: cls
        for package in _PACKAGES
        for cls in vars(package).values()
        if isinstance(cls, type) and issubclass(cls, Msg) and cls.MSGTYPE
    }
)
"""All known message classes by ROS 1 name; a service has two of them, an action three, and in ROS 1 four more.

It lists those that were made beforehand. The classes of the common packages are found by their names, and made then.
"""


def ros1_name(name: str) -> str:
    """The ROS 1 form of a type name: `sensor_msgs/msg/Imu` and `sensor_msgs/Imu` both give `sensor_msgs/Imu`."""
    return name.replace("/msg/", "/").replace("/srv/", "/").replace("/action/", "/")
