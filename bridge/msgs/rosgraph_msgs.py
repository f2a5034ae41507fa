"""rosgraph_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg, byte, uint32
from bridge.msgs.std_msgs import Header

__all__ = ["Log"]


class Log(Msg, frozen=True, gc=False):
    """One line of a program's log, as ROS 1 has it on /rosout."""

    MSGTYPE: ClassVar[str] = "rosgraph_msgs/Log"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "byte",
        "string",
        "string",
        "string",
        "string",
        "uint32",
        "string[]",
    )
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("byte",) * 5

    DEBUG: ClassVar[int] = 1
    INFO: ClassVar[int] = 2
    WARN: ClassVar[int] = 4
    ERROR: ClassVar[int] = 8
    FATAL: ClassVar[int] = 16

    header: Header = Header()
    """When it was written."""
    level: byte = 0
    """One of the levels above."""
    name: str = ""
    """The node that wrote it."""
    msg: str = ""
    """The line."""
    file: str = ""
    """Where in its source it comes from."""
    function: str = ""
    """The function there."""
    line: uint32 = 0
    """The line there."""
    topics: list[str] = []
    """What the node publishes."""
