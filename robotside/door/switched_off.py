"""What is switched off at the door of a robot: it is not offered, and what is asked of it is refused."""

from __future__ import annotations

from collections.abc import Iterable

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.robot_door import Callback
from bridge.msgs import Msg
from robotside.core.notice import Notice

__all__ = ["SwitchedOff"]


class SwitchedOff:
    """Topics, services, actions and cameras by name, each with the payload that is off."""

    def __init__(self) -> None:
        self._payloads: dict[str, str] = {}

    def __contains__(self, name: str) -> bool:
        return name in self._payloads

    def set(self, payload: str, names: Iterable[str], *, on: bool) -> None:
        """The `names` of a `payload` are on or off from now on."""
        for name in names:
            if on:
                self._payloads.pop(name, None)
            else:
                self._payloads[name] = payload

    def refusal(self, name: str) -> Refused | None:
        """Why `name` is not to be had; None when it is on."""
        payload = self._payloads.get(name)
        if payload is None:
            return None
        said = f"{name} is not there: {payload.replace('_', ' ')} is switched off."
        return Refused(Notice(Code.PAYLOAD_OFF, said, payload=payload))

    def muted(self, callback: Callback) -> Callback:
        """`callback` for as long as its topic is on."""

        def call(topic: str, msg: Msg) -> None:
            if topic not in self._payloads:
                callback(topic, msg)

        return call
