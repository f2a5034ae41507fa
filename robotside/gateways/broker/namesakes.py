"""Other robots of the same name at one broker: nobody can say which of them obeys, so each of them takes STOP only."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from bridge.core.codes import Code
from bridge.core.errors import Refused
from robotside.core.notice import Notice
from robotside.records.events import Say

__all__ = ["LOST", "OFFLINE", "ONLINE", "Namesakes"]

ONLINE, OFFLINE, LOST = "online", "offline", "lost"
"""What a robot's state says at the broker."""
HOLD_TIME = 6.0
"""A namesake that says no more that it is online counts for so long [s]: what a broker kept of one may be long past."""
MAX_NAMESAKES = 16
"""So many are told apart."""


class _State(msgspec.Struct):
    state: str
    boot: str


class Namesakes:
    """Who else says on the state topic that it is this robot. Pure: every call is told the time [s]."""

    def __init__(self, way: str, broker: str, boot: str, name: str, say: Say) -> None:
        """`boot` is this robot's own identity, `name` its name; the gateway `way` goes to the `broker`, as in `MQTT broker`."""
        self._way, self._broker = way, broker
        self._boot, self._name, self._say = boot, name, say
        self._until: dict[str, float] = {}

    def __bool__(self) -> bool:
        """There is one."""
        return bool(self._until)

    def hear(self, raw: bytes, now: float, on_first: Callable[[], None]) -> bool:
        """A state was published. `on_first()` is called when it makes a first namesake. True when ours is to be said again."""
        try:
            heard = msgspec.json.decode(raw, type=_State)
        except (msgspec.DecodeError, UnicodeDecodeError):
            return False
        if heard.state != ONLINE:
            return self._until.pop(heard.boot, None) is not None or heard.boot == self._boot
        is_known = heard.boot in self._until
        if heard.boot == self._boot or (not is_known and len(self._until) >= MAX_NAMESAKES):
            return False
        is_first = not self._until
        self._until[heard.boot] = now + HOLD_TIME
        if is_first:
            on_first()
            self._say("control", self._notice(), "alarm")
        return is_first

    def update(self, now: float) -> bool:
        """Forget who is silent; to be called every second or so. True when ours is to be said, so that the others know."""
        before = bool(self._until)
        self._until = {boot: until for boot, until in self._until.items() if now < until}
        return before

    def check(self) -> None:
        """Raises Refused while there is one."""
        if self._until:
            raise Refused(self._notice())

    def _notice(self) -> Notice:
        said = (
            f"Another robot at the {self._broker} is named {self._name} too, so both take STOP only. "
            "Give one of them another --name."
        )
        return Notice(Code.GATEWAY_NAMESAKE, said, gateway=self._way, name=self._name)
