"""The content of a ROS text: kinds of values, fields, constants, and the parts of a message, service or action."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from bridge.core.errors import BridgeError

__all__ = ["Constant", "Definition", "Field", "Kind", "Many", "Part", "TextError", "Value"]

Value = bool | int | float | str | list["bool | int | float | str"]
"""A default or a constant, as the text gives it."""


class TextError(BridgeError):
    """A fault in a ROS text, or in the request for it: one sentence with place and reason."""


class Many(Enum):
    """The number of values that a field holds."""

    ONE = "one"
    ANY = "any"
    AT_MOST = "at most"
    EXACTLY = "exactly"


@dataclass(frozen=True, slots=True)
class Kind:
    """The type of a field."""

    base: str
    """Of one element: a basic type as in `float64`, `time`, `duration`, or a message as in `geometry_msgs/Pose`."""
    longest: int = 0
    """Of a text [characters]; 0 for any length."""
    many: Many = Many.ONE
    size: int = 0
    """Number of elements, at most or exactly."""

    @property
    def rostype(self) -> str:
        """As ROS writes it, as in `string<=20[<=5]`."""
        bound = f"<={self.longest}" if self.longest else ""
        array = {
            Many.ONE: "",
            Many.ANY: "[]",
            Many.AT_MOST: f"[<={self.size}]",
            Many.EXACTLY: f"[{self.size}]",
        }[self.many]
        return f"{self.base}{bound}{array}"


@dataclass(frozen=True, slots=True)
class Field:
    """One field with its comment."""

    name: str
    kind: Kind
    default: Value | None = None
    """None where the text gives none."""
    comment: str = ""


@dataclass(frozen=True, slots=True)
class Constant:
    """One constant with its comment."""

    name: str
    base: str
    value: Value
    comment: str = ""


@dataclass(frozen=True, slots=True)
class Part:
    """The source of one class: a message, a half of a service, a third of an action."""

    package: str
    name: str
    """Of the class, as in `Imu`, `TriggerRequest` or `FollowGoal`."""
    fields: tuple[Field, ...]
    constants: tuple[Constant, ...] = ()
    comment: str = ""

    @property
    def rosname(self) -> str:
        """The full ROS 1 name, as in `sensor_msgs/Imu`."""
        return f"{self.package}/{self.name}"

    @property
    def needs(self) -> tuple[str, ...]:
        """The messages that its fields are made of, without `time` and `duration`."""
        return tuple(each.kind.base for each in self.fields if "/" in each.kind.base)


@dataclass(frozen=True, slots=True)
class Definition:
    """The content of one file."""

    source: str
    """The file, for sentences."""
    parts: tuple[Part, ...] = field(default=())
