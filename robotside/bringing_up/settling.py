"""What `serve` goes by: an option before the environment, that before `robot.toml`, that before the default."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from robotside.bringing_up.robot_file import kept_at
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import DEFAULT_CONFIG, Config, load

__all__ = ["NO_ASK", "VARIABLES", "Ask", "blamed", "settle"]

Ask = Callable[[Path], None]
"""Asks the user what to bring up, and keeps the answers in that file."""

VARIABLES = {
    "robot": "PILOTHOUSE_ROBOT",
    "world": "PILOTHOUSE_WORLD",
    "payloads": "PILOTHOUSE_PAYLOADS",
    "without": "PILOTHOUSE_WITHOUT",
    "host": "PILOTHOUSE_HOST",
    "port": "PILOTHOUSE_PORT",
    "http_port": "PILOTHOUSE_HTTP_PORT",
    "protocols": "PILOTHOUSE_PROTOCOLS",
}
"""The environment variable of each option; PILOTHOUSE_GATEWAYS and PILOTHOUSE_CONFIG are those of `--gateway` and `--config`."""
CONFIG, GATEWAYS = "PILOTHOUSE_CONFIG", "PILOTHOUSE_GATEWAYS"
NO_ASK = "PILOTHOUSE_NO_ASK"
"""As `--no-ask`, when it is set to anything."""
_DEFAULTS: dict[str, Any] = {
    "robot": "sim:patrol",
    "world": "",
    "payloads": "",
    "without": "",
    "host": "127.0.0.1",
    "port": 9090,
    "http_port": 8080,
    "protocols": "",
}
_OF_ROBOT = ("robot", "world", "payloads", "without")


def settle(options: argparse.Namespace, environment: Mapping[str, str], ask: Ask | None = None) -> None:
    """Complete the options of `serve`; UserMistake or BadConfig with one sentence.

    `options.settings` is what robot.toml says, and `options.blame` the file when it named the robot. A robot that is
    named by option or environment is another one than that of the file `serve` keeps, which is not read then.
    """
    _from_environment(options, environment)
    said = bool(options.config or options.gateway or environment.get(GATEWAYS)) or any(
        getattr(options, name) is not None for name in ("robot", "payloads", "without", "protocols")
    )
    kept = options.config[0] if options.config else kept_at(options.state)
    if _asks(options, environment, said=said, kept=kept) and ask is not None:
        ask(kept)
    if not options.config and options.robot is None and kept.is_file():
        options.config = [kept]
        options.from_kept = True
    options.settings = load(options.config[0]) if options.config else DEFAULT_CONFIG
    options.blame = _from_file(options, options.settings)
    for name, value in _DEFAULTS.items():
        if getattr(options, name) is None:
            setattr(options, name, value)


def blamed(options: argparse.Namespace, problem: str) -> str:
    """The sentence of a problem with the robot, with the file before it where that names the robot."""
    return f"{options.blame}: [serve]: {problem}" if options.blame else problem


def _asks(options: argparse.Namespace, environment: Mapping[str, str], *, said: bool, kept: Path) -> bool:
    at_terminal = sys.stdin.isatty() and sys.stdout.isatty()
    if options.ask:
        if not at_terminal:
            raise UserMistake(
                "--ask needs a terminal; without one, options and robot.toml say what is served."
            )
        return True
    never = options.ask is False or bool(environment.get(NO_ASK)) or options.with_parent
    return at_terminal and not (never or said or kept.exists())


def _from_environment(options: argparse.Namespace, environment: Mapping[str, str]) -> None:
    if not options.config and environment.get(CONFIG):
        options.config = [Path(environment[CONFIG])]
    for name, variable in VARIABLES.items():
        text = environment.get(variable)
        if text and getattr(options, name) is None:
            setattr(options, name, _port(variable, text) if name.endswith("port") else text)


def _port(variable: str, text: str) -> int:
    if not (text.isascii() and text.isdigit() and int(text[:6]) <= 65535):
        raise UserMistake(f"{variable} is a port, 0 to 65535, not {text[:50]!r}.")
    return int(text)


def _from_file(options: argparse.Namespace, config: Config) -> str:
    """Take what the file says and nobody else; the file's name when it says which robot, empty when it does not."""
    own = options.robot is None
    told = False
    for name in _DEFAULTS:
        value = getattr(config.serve, name, None)
        is_said = value not in (None, "", ()) and (own or name not in _OF_ROBOT)
        if getattr(options, name) is None and is_said:
            setattr(options, name, ",".join(value) if isinstance(value, tuple) else value)
            told = told or name in _OF_ROBOT
    return str(options.config[0]) if told else ""
