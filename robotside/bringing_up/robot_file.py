"""`robot.toml` as `serve` keeps it: where it is, and what a user chose put into it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from robotside.bringing_up.toml_edit import CannotEdit, Value, edited
from robotside.commands.state_directory import base
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import Config, GatewaySettings, load, parse
from robotside.trust.private_file import write_private

__all__ = ["Choice", "before", "keep", "keep_gateway", "kept_at"]

NAME = "robot.toml"
_HEAD = """# What `python -m robotside serve` asked; `serve --ask` asks again. Comments, and settings beside these, stay.
# docs/robot.toml.example has every setting.
"""


@dataclass(frozen=True)
class Choice:
    """What a user wants brought up."""

    robot: str = "sim:patrol"
    world: str = ""
    payloads: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    host: str = "127.0.0.1"
    port: int = 9090
    http_port: int = 8080
    pair: bool = False
    gateways: dict[str, GatewaySettings] = field(default_factory=dict)
    """By name; those that were known before and are not wanted now are not on."""


def kept_at(state: Path | None) -> Path:
    """Where the choice is kept: in the directory of `--state`, else beside those of all robots."""
    return (base() if state is None else state) / NAME


def before(path: Path) -> Config:
    """What the file says, all defaults where there is none; BadConfig when it cannot be used."""
    return load(path) if path.exists() else Config()


def keep(path: Path, choice: Choice) -> None:
    """Put `choice` into the file, for its owner only; whole, or not at all. UserMistake with one sentence."""
    _put(path, _values(choice))


def keep_gateway(path: Path, name: str, url: str | None) -> None:
    """Have the gateway `name` brought up at `url` at the next start, empty for its usual one; None for no longer.

    One that is not any longer keeps its address. UserMistake or BadConfig with one sentence where the file cannot be changed.
    """
    before(path)  # somebody may have written in it meanwhile
    here = ("gateways", name)
    if url is None:
        _put(path, {(*here, "on"): False})
        return
    said: dict[tuple[str, ...], Value | None] = {
        (*here, field): None for field in GatewaySettings.__struct_fields__
    }
    _put(path, said | {(*here, "on"): True, (*here, "url"): url})


def _put(path: Path, values: dict[tuple[str, ...], Value | None]) -> None:
    try:
        path = path.resolve()  # a link stays one
        text = path.read_text(encoding="utf-8") if path.exists() else _HEAD
        changed = edited(text, values)
        parse(changed, str(path))
        write_private(path, changed.encode())
    except CannotEdit as problem:
        raise UserMistake(f"{path} cannot be changed: {problem}; do so by hand.") from problem
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        raise UserMistake(f"The choice cannot be kept in {str(path)!r}: {why}.") from error


def _values(choice: Choice) -> dict[tuple[str, ...], Value | None]:
    """What the file has to say; None for what it must not say any more, as a role that everybody had."""
    names = ("robot", "world", "payloads", "without", "host", "port", "http_port", "pair")
    values: dict[tuple[str, ...], Value | None] = {("serve", name): getattr(choice, name) for name in names}
    for key, gateway in choice.gateways.items():
        usual = GatewaySettings()
        for name in gateway.__struct_fields__:
            value = getattr(gateway, name)
            is_said = name in ("on", "url") or value != getattr(usual, name)
            values["gateways", key, name] = value if is_said else None
    return values
