"""Classes of the common ROS packages that no part of this robot needs, made when one is first asked for.

Their text is in `bridge/definitions/common/`, one file for each package. Where that is missing, as in the APK, no such
type is known.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

from bridge.msgs.base import Msg
from bridge.msgs.making import BUILT_IN, SCALARS, FieldOf, make_class

__all__ = ["CommonTypes"]

HOME = Path(__file__).parent.parent / "definitions" / "common"
Find = Callable[[str], type[Msg] | None]
"""Returns the class of a ROS 1 name, None for an unknown one."""

_HEAD = re.compile(r"^== (msg|srv|action)/(\w+)\n", re.MULTILINE)
_RULE = re.compile(r"^---\n?", re.MULTILINE)
_LINE = re.compile(r"(?P<base>[\w/]+)(?:\[(?P<length>\d*)\])? (?P<name>\w+)(?:=(?P<value>.*))?")
_PARTS = {"msg": ("",), "srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}
_ROS1_ACTION = {
    "ActionGoal": "std_msgs/Header header\nactionlib_msgs/GoalID goal_id\n{0}Goal goal\n",
    "ActionResult": "std_msgs/Header header\nactionlib_msgs/GoalStatus status\n{0}Result result\n",
    "ActionFeedback": "std_msgs/Header header\nactionlib_msgs/GoalStatus status\n{0}Feedback feedback\n",
    "Action": "{0}ActionGoal action_goal\n{0}ActionResult action_result\n{0}ActionFeedback action_feedback\n",
}
"""What ROS 1 makes of an action beside its three parts: its topics carry these messages."""


class CommonTypes:
    """The classes of the packages in one folder."""

    def __init__(self, find: Find, home: Path = HOME) -> None:
        """`find` returns the class of any type, those of this folder as well."""
        self._find = find
        self._files = {path.stem: path for path in home.glob("*.txt")}
        self._texts: dict[str, dict[str, str]] = {}
        self._made: dict[str, type[Msg]] = {}

    def names(self) -> list[str]:
        """The names of all types in this folder; reads every file."""
        return sorted(f"{package}/{name}" for package in self._files for name in self._package(package))

    def find(self, name: str) -> type[Msg] | None:
        """The class called `name`, as in `visualization_msgs/Marker`; None when it is not here."""
        made = self._made.get(name)
        package, _, called = name.partition("/")
        if made is None and package in self._files:
            text = self._package(package).get(called)
            if text is not None:
                made = self._made[name] = self._class(name, text)
        return made

    def _package(self, package: str) -> dict[str, str]:
        """The text of each class of a package, by its name."""
        found = self._texts.get(package)
        if found is None:
            found = self._texts[package] = dict(_parts(package, self._files[package].read_text("utf-8")))
        return found

    def _class(self, name: str, text: str) -> type[Msg]:
        fields: list[FieldOf] = []
        constants: list[tuple[str, bool | int | float | str]] = []
        kinds: list[str] = []
        for line in text.splitlines():
            found = _LINE.fullmatch(line)
            if found is None:
                continue
            base, length, called, value = found.group("base", "length", "name", "value")
            if value is not None:
                constants.append((called, _value(base, value)))
                kinds.append(base)
            else:
                number = -1 if length is None else int(length or 0)
                fields.append((called, (base, number), None if base in SCALARS else self._part(base)))
        return make_class(name, tuple(fields), tuple(constants), tuple(kinds), "of a common package.")

    def _part(self, name: str) -> type[Msg]:
        found = BUILT_IN.get(name) or self._find(name)
        if found is None:
            raise LookupError(f"bridge/definitions/common lacks {name}.")
        return found


def _parts(package: str, text: str) -> Iterator[tuple[str, str]]:
    """Name and text of each class."""
    _, *pieces = _HEAD.split(text)
    for kind, name, body in zip(pieces[::3], pieces[1::3], pieces[2::3], strict=True):
        for ending, part in zip(_PARTS[kind], _RULE.split(body), strict=True):
            yield f"{name}{ending}", part
        if kind == "action":
            for ending, part in _ROS1_ACTION.items():
                yield f"{name}{ending}", part.format(f"{package}/{name}")


def _value(base: str, text: str) -> bool | int | float | str:
    if base in ("string", "wstring"):
        return text
    if base == "bool":
        return text in ("True", "true", "1")
    return float(text) if base.startswith("float") else int(text)
