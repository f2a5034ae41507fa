"""Comments of a ROS text, which its parser ignores, by the name of their field or constant."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

__all__ = ["Comments", "read_comments", "unit_in", "without_comment"]

_NAME = re.compile(r"\s*[\w/]+(?:<=\d+)?(?:\[[<=\d]*\])?\s+(\w+)")
_UNIT = re.compile(r"(?<![\w\])])\[([A-Za-zµΩ°%(][\w /^*·.()%°-]{0,15})\]")
"""As in `[m/s2]`; what begins with a figure is a range, and what follows a name is an index."""
_UNQUOTED_TEXT = re.compile(r"\s*w?string\s+\w+\s*=\s*[^\s'\"]")


@dataclass(slots=True)
class Comments:
    """The comments of one part."""

    part: str = ""
    """Comment of the whole: the text before everything else, apart from the first field or above a constant, and that
    at the end."""
    of: dict[str, str] = field(default_factory=dict)
    """Comment of each field and constant by its name: the text right above it, then the text behind it."""


def read_comments(text: str) -> Comments:
    """The comments of one part's `text`.

    A comment behind a field goes on in the indented comment lines below it. A comment that an empty line parts from the
    next field is about the whole when it comes first, and about the next field otherwise. So is the first one of all when
    what follows it at once is a constant: a list of constants has no room for a word about the whole.
    """
    found = Comments()
    above: list[str] = []
    last = ""
    for line in text.splitlines():
        code, comment = without_comment(line)
        named = _NAME.match(code)
        if named:
            if above and not found.of and not found.part and code[named.end() :].lstrip().startswith("="):
                found.part, above = _joined(above), []
            last = named[1]
            found.of[last] = _joined([*above, *([comment] if comment is not None else [])])
            above = []
        elif comment is None:
            if above and not found.of and not found.part:
                found.part, above = _joined(above), []
            last = ""
        elif last and line[:1].isspace() and not above:
            found.of[last] = _joined([found.of[last], comment])
        else:
            above.append(comment)
            last = ""
    if above:
        found.part = _joined([found.part, *above])
    return found


def unit_in(comment: str) -> str:
    """The unit that `comment` names in square brackets, as in `[m/s]`; empty where it names none, or more than one."""
    units = set(_UNIT.findall(comment))
    return str(units.pop()) if len(units) == 1 else ""


def without_comment(line: str) -> tuple[str, str | None]:
    """`line` before its `#` and what follows that; None without one. A `#` within quotes is none.

    Neither is one in an unquoted text constant, which goes to the end of its line.
    """
    if _UNQUOTED_TEXT.match(line):
        return line, None
    quote = ""
    for index, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote and line[index - 1] != "\\" else quote
        elif letter == "#":
            return line[:index], line[index + 1 :].removeprefix(" ").rstrip()
        elif letter in "'\"":
            quote = letter
    return line, None


def _joined(lines: list[str]) -> str:
    return "\n".join(lines).strip("\n")
