"""Gateways as a user asks for them: `--gateway mqtt=mqtt://HOST:1883`, `--protocols`, the environment, or robot.toml."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from bridge.core.identity import Role
from robotside.bringing_up.robot_file import keep_gateway
from robotside.bringing_up.settling import GATEWAYS as VARIABLE
from robotside.bringing_up.settling import blamed
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import BadConfig, GatewaySettings
from robotside.core.installing import how_to_install

if TYPE_CHECKING:  # a robot that nobody asked a gateway of does not load them
    from robotside.gateways.adapter import Adapter
    from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["ALWAYS", "VARIABLE", "add_options", "for_robot", "keeper", "required", "wishes", "without"]

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
        f"several times, in {VARIABLE} with spaces between, and as [gateways.mqtt] of robot.toml. docs/gateways.md lists them",
    )
    serve.add_argument(
        "--protocols",
        help="protocols by name, with commas between, and no gateway beside those and --gateway; rosbridge and http always run, others are "
        "gateways at the URL that the environment or robot.toml names, else at their usual one",
    )


def wishes(
    options: argparse.Namespace, environment: Mapping[str, str] = os.environ
) -> list[tuple[Adapter, GatewayUrl]]:
    """The gateways that were asked for, each once; UserMistake with one sentence for a mistake.

    By option, by environment, or by robot.toml, whose settings are `options.settings`: the first of them that names one counts.
    """
    named = [word for word in (options.protocols or "").split(",") if word and word not in ALWAYS]
    in_environment, in_file = environment.get(VARIABLE, "").split(), options.settings.gateways
    if not (options.gateway or in_environment or named or in_file):
        return []
    from robotside.gateways.discovery import adapters

    known = adapters()
    unknown = sorted(set(named) - set(known))
    if unknown:
        there = ", ".join((*ALWAYS, *known))
        raise UserMistake(f"There is no protocol {', '.join(unknown)}; there are {there}.")
    asked = _read("--gateway", options.gateway)
    others = _read(VARIABLE, in_environment)
    for name, settings in in_file.items():
        if name not in others and (settings.on or name in named):
            others[name] = _of_file(str(options.config[0]), name, settings)
    if options.protocols:
        others = {name: others[name] if name in others else _wish("--protocols", name) for name in named}
    found = list((others | asked).values())
    for adapter, _ in found:
        _check_package(adapter)
    return found


def required(options: argparse.Namespace) -> frozenset[str]:
    """Names of the gateways that an option of this very command asks for: without them it does not serve."""
    named = {word for word in (options.protocols or "").split(",") if word and word not in ALWAYS}
    return frozenset(named | {text.partition("=")[0] for text in options.gateway})


def _read(where: str, texts: list[str]) -> dict[str, tuple[Adapter, GatewayUrl]]:
    found: dict[str, tuple[Adapter, GatewayUrl]] = {}
    for text in texts:
        adapter, url = _wish(where, text)
        if adapter.name in found:
            raise UserMistake(f"{where} asks for {adapter.name} twice; one robot has one of each.")
        found[adapter.name] = adapter, url
    return found


def _wish(where: str, text: str) -> tuple[Adapter, GatewayUrl]:
    from robotside.gateways.discovery import read_wish

    try:
        return read_wish(text)
    except ValueError as problem:
        raise UserMistake(f"{where}: {problem}") from problem


def _of_file(file: str, name: str, settings: GatewaySettings) -> tuple[Adapter, GatewayUrl]:
    """The gateway that a file asks for."""
    where = f"{file}: gateways.{name}"
    adapter, url = _wish(f"{where}.url" if settings.url else where, f"{name}={settings.url}".rstrip("="))
    from robotside.gateways.payloads.offered import chosen_keys

    try:
        keys = chosen_keys(settings.payloads) if settings.payloads else url.keys
    except ValueError as problem:
        raise UserMistake(f"{where}.payloads: {problem}") from problem
    whole = replace(
        url,
        user=settings.user or url.user,
        password=settings.password or url.password,
        role=url.role if settings.role is None else Role.read(settings.role),
        keys=keys,
        rate=url.rate if settings.rate is None else settings.rate,
    )
    from robotside.gateways.discovery import check_parts

    try:
        check_parts(adapter, whole)
    except ValueError as problem:
        raise UserMistake(f"{where}: {problem}") from problem
    return adapter, whole


def _check_package(adapter: Adapter) -> None:
    from robotside.gateways.discovery import missing_package

    lacking = missing_package(adapter)
    if lacking:
        said = f"The gateway {adapter.name} needs {lacking}, which is not installed"
        raise UserMistake(f"{said}: {how_to_install('gateways')} brings it.")


def without(options: argparse.Namespace) -> tuple[str, ...]:
    """The payloads that are off from the start; UserMistake with one sentence for one that there is not."""
    words = tuple(filter(None, options.without.split(",")))
    if words:
        from robotside.gateways.payloads.offered import chosen_keys

        try:
            chosen_keys(words)
        except ValueError as problem:
            raise UserMistake(blamed(options, f"--without: {problem}")) from problem
    return words


def keeper(files: Sequence[Path], robots: int) -> Callable[[str, str | None], str] | None:
    """Keeps in its robot.toml which gateways clients bring up and down; None where one robot has not one file of its own.

    It takes a name and a URL, empty for the usual one, None for down, and gives the sentence of why it is not kept.
    """
    if len(files) != 1 or robots != 1:
        return None

    def keep(name: str, url: str | None) -> str:
        try:
            keep_gateway(files[0], name, url)
        except (UserMistake, BadConfig) as problem:
            return str(problem)
        return ""

    return keep


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
