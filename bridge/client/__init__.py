"""The handheld's end of the socket: `RemoteRobot` for programs with threads, `BridgeClient` for those with an event loop."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bridge.client.client import BridgeClient as BridgeClient
    from bridge.client.remote_robot import RemoteGoal as RemoteGoal
    from bridge.client.remote_robot import RemoteRobot as RemoteRobot

__all__ = ["BridgeClient", "RemoteGoal", "RemoteRobot"]


def __getattr__(name: str) -> object:
    """Import a public class when it is first used, so that the room's modules can be imported one by one."""
    if name == "BridgeClient":
        from bridge.client.client import BridgeClient

        return BridgeClient
    if name in ("RemoteGoal", "RemoteRobot"):
        from bridge.client import remote_robot

        return getattr(remote_robot, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
