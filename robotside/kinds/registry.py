"""The registry of vehicle kinds by the name that `/robot/info` gives, with one generic record for all others."""

from __future__ import annotations

from dataclasses import replace

import msgspec

from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.kinds import ackermann, boat, differential, quadrotor, swimmer
from robotside.kinds.vehicle_kind import VehicleKind

__all__ = ["GENERIC", "KINDS", "described", "kind_of", "unknown"]

KINDS: dict[str, VehicleKind] = {
    kind.name: kind
    for kind in (
        differential.KIND,
        ackermann.KIND,
        boat.KIND,
        swimmer.KIND,
        quadrotor.KIND,
    )
}
"""One line per kind."""

GENERIC = replace(differential.KIND, name="", description="", docks="")
"""For a robot of an unknown kind: as if on wheels, but without chargers, and with no words of its own."""


def kind_of(name: str) -> VehicleKind:
    """The record of a kind; one without a name is on wheels, an unknown one is GENERIC."""
    return KINDS.get(name or differential.KIND.name, GENERIC)


def described(info: RobotInfo) -> RobotInfo:
    """`info` with the words, the icon and the abilities of its kind, where the robot does not give its own."""
    kind = kind_of(info.kind)
    return msgspec.structs.replace(
        info,
        description=info.description or kind.description,
        icon=info.icon or kind.icon,
        moves=info.moves or kind.moves,
        holds=info.holds or kind.holds,
        order_fields=info.order_fields or list(kind.order_fields),
        dives=info.dives or kind.dives,
        flies=info.flies or kind.flies,
    )


def unknown(name: str) -> str:
    """The sentence about a kind that is not registered; empty for the others."""
    if not name or name in KINDS:
        return ""
    return f"A robot of the kind {name!r} is not known here; it is driven as if on wheels. Known are {', '.join(KINDS)}."
