"""What the robot says of a broker that is not reached, once for each loss, and of one that is there again."""

from __future__ import annotations

from bridge.core.codes import Code
from bridge.core.identity import Role
from robotside.core.notice import Notice
from robotside.gateways.broker.line import Line
from robotside.records.events import Say

__all__ = ["Losses", "say_open"]


class Losses:
    """The loss of a broker's lines: that of commands, and that of STOP alone."""

    def __init__(self, way: str, broker: str, address: str, say: Say) -> None:
        """The gateway `way` goes to the `broker`, as in `MQTT broker`, at `address`."""
        self._way, self._broker, self._address, self._say = way, broker, address, say
        self._is_told = self._is_broker = False

    def lost(self, reason: str) -> None:
        """The broker is gone, or was not to be had."""
        if not self._is_broker:
            self._is_broker = True
            self._tell(f"The {self._broker} at {self._address} is not reached", reason)

    def check(self, commands: Line, stop: Line) -> None:
        """Tell of STOP's line when it alone is lost, and of the broker once both are there to stay; call it every second or so."""
        if commands.is_up and stop.fault and not self._is_told:
            what = f"STOP has no connection of its own to the {self._broker} at {self._address}"
            self._tell(what, stop.fault)
        elif self._is_told and commands.is_standing and stop.is_standing:
            self._is_told = self._is_broker = False
            notice = Notice(Code.GATEWAY_UP, f"The {self._broker} is reached again.", gateway=self._way)
            self._say("control", notice)

    def _tell(self, what: str, reason: str) -> None:
        self._is_told = True
        said = f"{what}: {reason}. It is tried again."
        self._say("control", Notice(Code.GATEWAY_LOST, said, gateway=self._way, reason=reason), "warn")


def say_open(say: Say, way: str, how: str, role: Role | None) -> None:
    """Say that everybody who comes by the gateway `way`, `how` as in `reaches the broker`, may do more than watch."""
    if role is not None and role > Role.WATCH:
        said = f"Everybody who {how} may {role.word} without a key."
        say("control", Notice(Code.GATEWAY_OPEN, said, gateway=way, role=role.word), "warn")
