"""`robotside guide`: how a robot that runs on this computer is used, as its own usage sheet says it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from urllib.parse import urlsplit

from bridge.core.address import at_port
from robotside.bringing_up.robot_file import before, kept_at
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import BadConfig
from robotside.gateways.addresses import EVERYWHERE

__all__ = ["add", "run"]

TIMEOUT = 5.0
"""For the robot to answer [s]."""
MAX_BYTES = 1_000_000
"""Of what is shown."""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    guide = commands.add_parser(
        "guide", help="show how a robot that runs here is used: every protocol and topic, with lines to paste"
    )
    guide.add_argument(
        "--at",
        metavar="URL",
        default="",
        help="its web site, by default that of the robot.toml that serve keeps, else http://127.0.0.1:8080",
    )
    guide.add_argument("--state", type=Path, default=None, help="as of serve")
    guide.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Ask the robot and show what it answers."""
    site = options.at or _usual(options.state)
    if urlsplit(site).scheme != "http":
        raise UserMistake(
            f"--at is a URL as http://127.0.0.1:8080, not {site[:100]!r}; a browser shows others."
        )
    sys.stdout.write(_asked(site))
    return 0


def _usual(state: Path | None) -> str:
    try:
        serve = before(kept_at(state)).serve
    except BadConfig:
        return "http://127.0.0.1:8080"
    host = "127.0.0.1" if serve.host in (None, *EVERYWHERE) else str(serve.host)
    return f"http://{at_port(host, serve.http_port or 8080)}"


def _asked(site: str) -> str:
    from http.client import HTTPException
    from urllib.error import HTTPError, URLError
    from urllib.request import ProxyHandler, build_opener

    opener = build_opener(ProxyHandler({}))  # a robot of this computer is not asked by way of others
    try:
        with opener.open(f"{site.rstrip('/')}/usage.txt", timeout=TIMEOUT) as answer:
            return str(answer.read(MAX_BYTES).decode("utf-8", "replace"))
    except HTTPError as refusal:
        said = refusal.read(1000).decode("utf-8", "replace").strip()
        raise UserMistake(f"{site} answers: {said or refusal.reason}") from refusal
    except (OSError, HTTPException, ValueError) as error:
        cause = error.reason if isinstance(error, URLError) else error
        why = (getattr(cause, "strerror", None) or str(cause) or type(cause).__name__).lower()
        raise UserMistake(f"No robot answers at {site}: {why}; --at names another.") from error
