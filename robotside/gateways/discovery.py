"""Discovery of the adapters: each is a folder beside this file, and no list names them.

A folder with a module `adapter.py` is one; that module has an `ADAPTER` and imports nothing of the protocol's library, so
that a protocol that nobody asked for costs neither time nor memory.
"""

from __future__ import annotations

import importlib
import pkgutil
from importlib.util import find_spec

import robotside.gateways
from robotside.gateways.adapter import Adapter
from robotside.gateways.gateway_url import SITE, GatewayUrl, read_url

__all__ = ["adapters", "check_parts", "missing_package", "read_wish"]


def adapters() -> dict[str, Adapter]:
    """All adapters by name, in the order of their names."""
    found = {}
    for module in pkgutil.iter_modules(robotside.gateways.__path__):
        name = f"{robotside.gateways.__name__}.{module.name}.adapter"
        if module.ispkg and find_spec(name) is not None:
            found[module.name] = importlib.import_module(name).ADAPTER
    return found


def read_wish(text: str) -> tuple[Adapter, GatewayUrl]:
    """The adapter and URL of `NAME`, `NAME=URL`, or `NAME=?OPTIONS` at its usual URL; ValueError with one sentence for a mistake."""
    name, mark, url = text.partition("=")
    known = adapters()
    if name not in known:
        raise ValueError(f"There is no gateway {name[:50]!r}; there are {', '.join(known)}.")
    adapter = known[name]
    if mark and not url:
        raise ValueError(f"{name}= needs a URL, as {name}={adapter.default}.")
    if url.startswith("?"):
        url = adapter.default + url
    read = read_url(url or adapter.default, adapter.schemes)
    check_parts(adapter, read)
    return adapter, read


def check_parts(adapter: Adapter, url: GatewayUrl) -> None:
    """ValueError with one sentence for a part of the URL that nothing would use: a password that nobody asks for protects nothing."""
    if (url.user or url.password) and url.scheme not in adapter.credentials:
        raise ValueError(
            f"{adapter.name} at {url.shown} asks nobody for a user and a password: leave them out; "
            "?role= says what may be done without a token."
        )
    if url.path and url.scheme not in (SITE, *adapter.prefixes):
        raise ValueError(f"{adapter.name} at {url.address} has no path: leave out /{url.path[:60]}.")


def missing_package(adapter: Adapter) -> str:
    """The library that an adapter needs and this machine lacks; empty when it is there."""
    return "" if not adapter.package or find_spec(adapter.package) else adapter.package
