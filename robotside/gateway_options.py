"""Gateways as a user asks for them: `--gateway mqtt=mqtt://HOST:1883`, `--protocols`, or the environment."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from robotside.commands.user_mistake import UserMistake

if TYPE_CHECKING:  # a robot that nobody asked a gateway of does not load them
    from robotside.gateways.adapter import Adapter
    from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["ALWAYS", "VARIABLE", "add_options", "for_robot", "wishes"]

VARIABLE = "PILOTHOUSE_GATEWAYS"
"""The environment variable that asks for gateways, with spaces between them; a URL with a password is not seen there by others."""
ALWAYS = ("rosbridge", "http")
"""The protocols that every robot has."""


def add_options(serve: argparse.ArgumentParser) -> None:
    """Add the options of gateways."""
    serve.add_argument(
        "--gateway",
        action="append",
        default=[],
        metavar="NAME[=URL]",
        help="bring up a gateway: mqtt, which brings a broker, or 'mqtt=mqtt://HOST:1883?role=drive&payloads=arm,wheels&rate=5'; may be given "
        f"several times, and in {VARIABLE} with spaces between. docs/gateways.md lists them",
    )
    serve.add_argument(
        "--protocols",
        default="",
        help="protocols by name, with commas between; rosbridge and http always run, others are gateways at their usual URL",
    )


def wishes(
    options: argparse.Namespace, environment: Mapping[str, str] = os.environ
) -> list[tuple[Adapter, GatewayUrl]]:
    """The gateways that were asked for, each once; UserMistake with one sentence for a mistake."""
    texts = [*options.gateway, *environment.get(VARIABLE, "").split()]
    named = [word for word in options.protocols.split(",") if word and word not in ALWAYS]
    if not texts and not named:
        return []
    from robotside.gateways.discovery import adapters

    known = adapters()
    unknown = sorted(set(named) - set(known))
    if unknown:
        there = ", ".join((*ALWAYS, *known))
        raise UserMistake(f"There is no protocol {', '.join(unknown)}; there are {there}.")
    asked = {text.partition("=")[0] for text in texts}
    return _read([*texts, *(word for word in dict.fromkeys(named) if word not in asked)])


def _read(texts: list[str]) -> list[tuple[Adapter, GatewayUrl]]:
    from robotside.gateways.discovery import missing_package, read_wish

    found: dict[str, tuple[Adapter, GatewayUrl]] = {}
    for text in texts:
        try:
            adapter, url = read_wish(text)
        except ValueError as problem:
            raise UserMistake(f"--gateway: {problem}") from problem
        if adapter.name in found:
            raise UserMistake(f"--gateway asks for {adapter.name} twice; one robot has one of each.")
        lacking = missing_package(adapter)
        if lacking:
            said = f"The gateway {adapter.name} needs {lacking}, which is not installed"
            raise UserMistake(f"{said}: pip install 'pilothouse[gateways]' brings it.")
        found[adapter.name] = adapter, url
    return list(found.values())


def for_robot(asked: list[tuple[Adapter, GatewayUrl]], number: int) -> list[tuple[Adapter, GatewayUrl]]:
    """The gateways of the robot of this number, from 0 on: those that listen have one more port for each further robot."""
    found = []
    for adapter, url in asked:
        port = url.port + number if url.scheme in adapter.listens and url.port else url.port
        if port > 65535:
            raise UserMistake(
                f"Robot {number + 1} would have port {port} for {adapter.name}; a port is 0 to 65535."
            )
        found.append((adapter, replace(url, port=port)))
    return found
