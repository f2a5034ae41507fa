"""The handheld as a program: `python main.py [ws://HOST:PORT|pilothouse://…] [--layout NAME] [--screen NAME] [--theme NAME] [--size WxH]`."""

from __future__ import annotations

import argparse
import logging
import os
import re
import signal
import sys
from collections.abc import Sequence
from typing import NoReturn

from app.device import is_android
from app.discovery.known_robots import check_address
from app.garbage_collector import spare_the_start
from app.layout import layout as layouts
from app.lean_kivy import be_lean
from app.profiles.profile_link import is_profile_link, text_of_link
from app.screens.parts.screen_table import names
from bridge.core.errors import BridgeError
from bridge.discovery.domain import VARIABLE, check_domain, discovery_domain
from bridge.trust.pairing import SCHEME, PairLink
from bridge.trust.robot_link import RobotLink, read_link

__all__ = ["end_at_once_by_signal", "main", "prepare", "quieten"]

THEMES = ("dark", "sunlight", "night")
SIZE = re.compile(r"(\d{3,5})x(\d{3,5})")


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one sentence."""

    def error(self, message: str) -> NoReturn:
        raise ValueError(message[:1].upper() + message[1:] + ("" if message.endswith(".") else "."))


def _parse(argv: Sequence[str] | None) -> argparse.Namespace:
    parser = _Parser(prog="main.py", description="Pilothouse: supervise and drive robots.")
    parser.add_argument(
        "url",
        nargs="?",
        help="address of the robot, as in ws://192.168.1.7:9090, or its link, or that of a layout",
    )
    parser.add_argument(
        "--pair", action="append", default=[], metavar="LINK", help="pair by this link without a question"
    )
    parser.add_argument(
        "--layout",
        help=f"layout of the drive screen for any robot: a .toml file, {', '.join(layouts.names())}",
    )
    parser.add_argument("--screen", default="mission", choices=names(), help="first screen after connecting")
    parser.add_argument("--theme", choices=THEMES, help="colours; default: the last choice")
    parser.add_argument("--size", help="size of the window [px], as in 412x892")
    parser.add_argument(
        "--domain",
        help=f"discovery domain: find only robots of the same one; by default {VARIABLE}, else that of all",
    )
    arguments = parser.parse_args(argv)
    _enter_domain(arguments.domain)
    for link in arguments.pair:
        PairLink.read(link)
    if arguments.url is not None and is_profile_link(arguments.url):
        text_of_link(arguments.url)
    elif arguments.url is not None and arguments.url.startswith(f"{SCHEME}:"):
        link = read_link(arguments.url)
        arguments.url = link.url if isinstance(link, RobotLink) else arguments.url
    elif arguments.url is not None:
        arguments.url = check_address(arguments.url)
    layout = arguments.layout
    if layout is not None and not layout.endswith(".toml") and layout not in layouts.names():
        raise ValueError(f"There is no layout {layout!r}; there are: {', '.join(layouts.names())}.")
    if arguments.size is not None and not SIZE.fullmatch(arguments.size):
        raise ValueError(f"A size is written as 412x892, not {arguments.size!r}.")
    return arguments


def _enter_domain(name: str | None) -> None:
    """Find robots of the domain of that `name` from now on, if any, and have the built-in simulator be of it too."""
    try:
        if name is not None:
            os.environ[VARIABLE] = check_domain(name)
        discovery_domain()
    except BridgeError as fault:
        raise ValueError(str(fault)) from fault


def prepare(size: str | None = None) -> None:
    """Set Kivy up before any of it is imported: `size` is that of the window [px], as in `412x892`."""
    spare_the_start()
    os.environ.setdefault("KIVY_NO_ARGS", "1")
    os.environ.setdefault("KIVY_CLOCK", "free_all")
    os.environ.setdefault("KIVY_LOG_MODE", "MIXED")
    os.environ.setdefault("KIVY_NO_FILELOG", "1")
    be_lean()
    from kivy.config import Config

    width, height = SIZE.fullmatch(size or "1280x800").groups()  # type: ignore[union-attr]
    Config.set("graphics", "width", width)
    Config.set("graphics", "height", height)
    Config.set("graphics", "multisamples", "0")
    Config.set("kivy", "exit_on_escape", "0")
    Config.set("input", "mouse", "mouse,disable_multitouch")
    quieten()


def quieten() -> None:
    """Have Kivy say nothing of X11's second clipboard: without it, it logs a traceback when the first field is typed in."""
    from kivy.logger import Logger

    Logger.addFilter(lambda record: not str(record.msg).startswith("Cutbuffer:"))


def end_at_once_by_signal() -> None:
    """Have SIGTERM end the app in order: SDL would have it close the window, before which an operator may be asked."""
    from kivy.base import EventLoop

    signal.signal(signal.SIGTERM, lambda *_: setattr(EventLoop, "quit", True))


def main(argv: Sequence[str] | None = None) -> int:
    """Run the handheld until its window is closed; returns 0, or 2 after saying a mistake in one sentence."""
    try:
        arguments = _parse(argv)
    except ValueError as mistake:
        print(mistake, file=sys.stderr)
        return 2
    logging.basicConfig(level=logging.WARNING)
    prepare(arguments.size)
    from app.application import PilothouseApp

    try:
        app = PilothouseApp(
            arguments.url,
            arguments.screen,
            arguments.theme,
            arguments.layout,
            pair=arguments.pair,
            poll=not is_android(),
            tour=not arguments.pair,
        )
    except layouts.LayoutError as mistake:
        print(mistake, file=sys.stderr)
        return 2
    if not is_android():  # there the system ends it otherwise
        end_at_once_by_signal()
    app.run()
    return 0


if __name__ == "__main__":
    sys.exit(main())
