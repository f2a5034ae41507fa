"""Permissions: the role that each operation of a robot needs, as data."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from bridge.core.identity import Role

__all__ = ["ANY", "PERMISSIONS", "needed_role"]

ANY = "*"
"""Stands for every name of a verb that has no line of its own."""

_NONE = (
    "subscribe /robot/info",
    "rosapi /rosapi/get_time",
    "call /stop",
    "call /pair/scan",
    "call /pair/begin",
    "call /pair/finish",
    "call /people/me",
    "page /stop",
    "page /",
    "page /login",
    "page /logout",
    "page /healthz",
)
_WATCH = (
    f"subscribe {ANY}",
    f"camera {ANY}",
    f"rosapi {ANY}",
    f"page {ANY}",
    "call /events/get",
    "call /events/picture",
    "call /history/get",
    "call /mission/get",
    "call /missions/get",
    "call /people/remove",
)
_DRIVE = (
    "publish /cmd_vel",
    "publish /cmd_vel_stamped",
    "publish /cmd_manoeuvre",
    "publish /goal_pose",
    "publish /initialpose",
    "run /task/run",
    f"relay {ANY}",
    f"advertise {ANY}",
    "call /stop/hold",
    "call /stop/release",
    "call /control/acquire",
    "call /control/release",
    "call /control/request",
    "call /control/grant",
    "call /control/object",
    "call /mode/set",
    "call /task/start",
    "call /task/pause",
    "call /task/resume",
    "call /task/cancel",
    "call /task/confirm",
    "call /task/go_home",
    "call /task/queue/set",
    "call /mission/set",
    "call /mission/recall",
    "call /places/set",
    "call /places/delete",
    "call /schedule/set",
    "call /schedule/delete",
    "call /events/acknowledge",
    "call /arm/move",
    "call /lights/set",
    "call /localisation/choose",
)
_MANAGE = (
    "call /settings/set",
    "call /robot/reset",
    "call /gateways/bring_up",
    "call /gateways/bring_down",
    "call /payloads/set",
    "call /people/list",
    "call /people/guest",
    "call /people/invite",
    "rosapi /rosapi/set_param",
    "rosapi /rosapi/delete_param",
    "page /audit.csv",
)

PERMISSIONS: Mapping[str, Role] = MappingProxyType(
    {
        **dict.fromkeys(_NONE, Role.NONE),
        **dict.fromkeys(_WATCH, Role.WATCH),
        **dict.fromkeys(_DRIVE, Role.DRIVE),
        **dict.fromkeys(_MANAGE, Role.MANAGE),
    }
)
"""The role that each operation needs, by `VERB NAME`.

The verbs: `subscribe` and `publish` a topic of the robot, `call` a service of it, `run` an action, `camera` frames, a
`page` of the web site, `rosapi` questions, and `relay` and `advertise` for what clients offer to each other.
"""


def needed_role(verb: str, name: str) -> Role:
    """The role that `verb` with `name` needs; `MANAGE` for an operation that no line names."""
    exact = PERMISSIONS.get(f"{verb} {name}")
    return PERMISSIONS.get(f"{verb} {ANY}", Role.MANAGE) if exact is None else exact
