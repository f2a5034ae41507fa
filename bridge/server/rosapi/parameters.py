"""Parameters that clients keep on the robot for each other: names and JSON texts, bounded."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec

from bridge.core.errors import ProtocolError

__all__ = ["Parameters"]

MAX_PARAMETERS = 1000
"""Most parameters."""
MAX_BYTES = 1_048_576
"""Most bytes of all names and values together."""


class Parameters:
    """Values by name, as JSON texts."""

    def __init__(self, first: Mapping[str, Any] | None = None) -> None:
        """`first` are the initial values."""
        self._values: dict[str, str] = {}
        self._bytes = 0
        for name, value in (first or {}).items():
            self.set(name, msgspec.json.encode(value).decode())

    @property
    def names(self) -> list[str]:
        """The names of all parameters."""
        return list(self._values)

    def has(self, name: str) -> bool:
        """Whether there is a parameter of this name."""
        return _resolved(name) in self._values

    def search(self, name: str) -> str:
        """The full name of the parameter that `name` means at the root; empty when there is none."""
        return _resolved(name) if name and self.has(name) else ""

    def get(self, name: str, default: str = "") -> str:
        """The JSON text of a value; `default`, or `null` without one, when there is none."""
        return self._values.get(_resolved(name), default or "null")

    def set(self, name: str, value: str) -> None:
        """Set a value; ProtocolError when it is no JSON or there is no room for it."""
        try:
            msgspec.json.decode(value, type=msgspec.Raw)
        except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
            raise ProtocolError(f"The value of a parameter must be JSON, not {value[:60]!r}.") from error
        name = _resolved(name)
        grown = self._bytes - _size(name, self._values.get(name)) + _size(name, value)
        if grown > MAX_BYTES or (name not in self._values and len(self._values) >= MAX_PARAMETERS):
            raise ProtocolError(
                f"There is room for {MAX_PARAMETERS} parameters with {MAX_BYTES} bytes; {name[:60]} is too much."
            )
        self._values[name] = value
        self._bytes = grown

    def delete(self, name: str) -> bool:
        """Delete a value; False when there was none."""
        name = _resolved(name)
        value = self._values.pop(name, None)
        self._bytes -= _size(name, value)
        return value is not None


def _resolved(name: str) -> str:
    """The absolute name. ROS 2 writes `node:param` and ROS 1 `/ns/param`; a relative name is under the root."""
    return name if name.startswith("/") else f"/{name}"


def _size(name: str, value: str | None) -> int:
    return (
        0 if value is None else len(name.encode("utf-8", "replace")) + len(value.encode("utf-8", "replace"))
    )
