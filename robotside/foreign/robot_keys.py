"""Keys for robots of ours that a surveillance centre goes to, in a file of their own.

["192.168.1.7:9090"]
fingerprint = "the 64 hex digits of the robot's certificate"
token = "the key that `python -m robotside token` made there"
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

import msgspec

from bridge.client.credentials import Credentials
from bridge.core.address import at_port, host_and_port
from bridge.core.toml_files import fault, read, text_of

__all__ = ["key_for", "read_keys"]


class _Key(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    fingerprint: str
    token: str


def read_keys(file: Path) -> dict[str, Credentials]:
    """The keys by `HOST:PORT`; FileFault in one sentence for a mistake, and for a file that others may read."""
    text = text_of(file)
    if os.name == "posix" and stat.S_IMODE(file.stat().st_mode) & 0o077:
        raise fault("", file.name, "", f"others may read these keys; chmod 600 {file} allows it to you alone")
    keys = read(text, dict[str, _Key], file.name)
    return {place: _credentials(place, key, text, file.name) for place, key in keys.items()}


def key_for(url: str, keys: dict[str, Credentials]) -> Credentials | None:
    """The key for the robot at a URL; None where there is none. BadAddress when it is no URL."""
    return keys.get(at_port(*host_and_port(url)))


def _credentials(place: str, key: _Key, text: str, name: str) -> Credentials:
    try:
        return Credentials(key.fingerprint, key.token)
    except ValueError as mistake:
        raise fault(text, name, f'"{place}"', str(mistake).rstrip(".")) from mistake
