"""A usage sheet as a page for a browser and as text for a terminal. Everything in it is escaped but what says otherwise."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from robotside.gateways.payloads.offered import READ, Line
from robotside.gateways.usage_sheet.sheet import Sheet, rosbridge_message

if TYPE_CHECKING:
    from mako.template import Template

__all__ = ["Parts", "as_page", "as_text", "strangers_page", "style"]

_HERE = Path(__file__).parent


@dataclass(frozen=True, slots=True)
class Parts:
    """Parts of the page that others made, in HTML, and how the app comes to the robot."""

    address: str
    """Of the rosbridge socket, as others reach it."""
    link: str = ""
    """Brings the app there; empty where no other machine reaches it."""
    qr: str = ""
    """The link as a picture."""
    offer: str = ""
    """How to pair, in place of the link; it has a secret."""
    pairs: bool = False
    """The reader manages the robot, and pairing is closed."""
    cameras: str = ""


def as_page(sheet: Sheet, parts: Parts) -> str:
    """The page."""
    shown = _template("page.mako").render(sheet=sheet, parts=parts, message=rosbridge_message, rate=_rate)
    return str(shown)


def strangers_page(name: str, said: str, stopped: str = "") -> str:
    """What a stranger sees: the robot's name, STOP, whether it is pressed, one sentence, and where to show a token."""
    return str(_template("stranger.mako").render(name=name, said=said, stopped=stopped))


def style() -> str:
    """The style of all pages of the site, in HTML."""
    return str(_template("style.mako").render())


def as_text(sheet: Sheet, cameras: str = "") -> str:
    """The same for a terminal; `cameras` says where the pictures of each are."""
    head = [sheet.name, *filter(None, [sheet.stopped]), f"{sheet.about} {sheet.state}"]
    lines = [*head, "", f"rosbridge: {sheet.bridge}", ""]
    for command in sheet.commands:
        lines += [f"# {command.doc}", command.line]
    lines += ["", *cameras.splitlines()] if cameras else []
    for gateway in sheet.gateways:
        lines += [
            "",
            f"{gateway.name}: {gateway.doc}, at {gateway.url}",
            *filter(None, [gateway.fault]),
            "",
            gateway.guide,
        ]
    lines += ["", "By rosbridge, as messages on the socket:"]
    for each in sheet.payloads:
        lines += ["", f"{each.payload.key}: {each.payload.doc}"]
        for line in each.lines:
            units = f"; {line.units}" if line.units else ""
            lines += [f"  # {line.doc} ({line.type}{units})", f"  {rosbridge_message(line)}"]
    lines += ["", "In Python:", "", *sheet.program.splitlines()]
    return "\n".join(lines) + "\n"


def _rate(line: Line) -> str:
    """How often a topic comes, in words; empty for what is sent to the robot."""
    if line.verb != READ:
        return ""
    return f"{line.rate:g} Hz" if line.rate else "on change"


@cache
def _template(name: str) -> Template:
    """Loaded when a page is first asked for: many a robot is never looked at by a browser."""
    from mako.lookup import TemplateLookup

    lookup = TemplateLookup(
        [str(_HERE)], default_filters=["h"], strict_undefined=True, input_encoding="utf-8"
    )
    return lookup.get_template(name)
