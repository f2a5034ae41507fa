"""The robots that can be connected to: those that say HELLO, and the addresses that were entered by hand."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from bridge.discovery.beacon import Hello

__all__ = ["Entry", "KnownRobots", "check_address"]

SILENCE_LIMIT = 3.0
"""A robot silent for longer is lost [s]; it says HELLO twice a second."""
FORGET_DELAY = 60.0
"""A robot silent for longer, and not saved, is listed no more [s]."""
PORT = 9090
"""Where a robot listens when the address does not say it."""


def check_address(text: str) -> str:
    """The `ws://HOST:PORT` of what somebody typed; ValueError with a sentence when it cannot be one."""
    typed = text.strip()
    if not typed:
        raise ValueError("Enter an address such as 192.168.1.7 or ws://192.168.1.7:9090.")
    if ":/" in typed and "://" not in typed:
        raise ValueError(f"An address begins with ws:// or wss://, not {typed[: typed.index(':/') + 2]}.")
    url = typed if "://" in typed else f"ws://{typed}"
    try:
        parts = urlsplit(url)
        host, port = parts.hostname, parts.port
    except ValueError:
        raise ValueError(f"{typed} has no valid port: it is a number from 1 to 65535.") from None
    if parts.netloc.endswith(":"):
        raise ValueError(f"{typed} has no valid port: it is a number from 1 to 65535.")
    if parts.scheme not in ("ws", "wss"):
        raise ValueError(f"An address begins with ws:// or wss://, not {parts.scheme}://.")
    if not host or any(sign in host for sign in " ,;") or port == 0:
        raise ValueError(f"{typed} is not an address such as 192.168.1.7 or ws://192.168.1.7:9090.")
    host = f"[{host}]" if ":" in host else host
    return f"{parts.scheme}://{host}:{port or PORT}{parts.path.rstrip('/')}"


def address(url: str) -> str:
    """Host of a robot, with the port where it is not the usual one."""
    parts = urlsplit(url)
    host = parts.hostname or url
    return host if parts.port in (None, PORT) else f"{host}:{parts.port}"


@dataclass(frozen=True)
class Entry:
    """One robot on the list."""

    url: str
    name: str
    """Empty when it was never heard and never connected."""
    kind: str = ""
    """As in RobotInfo."""
    description: str = ""
    battery: float = math.nan
    """0 to 1; NaN unknown."""
    driver: str = ""
    """Who has control; empty when it is free or unknown."""
    driver_id: str = ""
    """The client id that has control."""
    silent: float = math.nan
    """Since its last HELLO [s]; NaN when it never said one."""
    latency: float = math.nan
    """A round trip to it [s]; NaN when it was not measured."""
    saved: bool = False
    """Its address was entered by hand."""
    boot: str = ""
    """Alike for one robot under two addresses; empty when it never said HELLO."""
    icon: str = ""
    """As in RobotInfo; empty when it gave none."""

    @property
    def state(self) -> str:
        """`live`, `lost` (it was heard and fell silent) or `unheard` (an address that never said HELLO)."""
        if math.isnan(self.silent):
            return "unheard"
        return "lost" if self.silent > SILENCE_LIMIT else "live"

    @property
    def address(self) -> str:
        """As of `address`."""
        return address(self.url)


class KnownRobots:
    """Keeps the list. Lives in the UI thread; the HELLOs come through the mailbox."""

    def __init__(self, now: Callable[[], float], saved: Iterable[dict[str, Any]] = ()) -> None:
        """`saved` is what `save` returned once; damaged entries are left out."""
        self._now = now
        self._heard: dict[str, tuple[Hello, float]] = {}
        self._latency: dict[str, float] = {}
        self._saved: dict[str, dict[str, str]] = {}
        for entry in saved if isinstance(saved, list | tuple) else ():
            if isinstance(entry, dict) and isinstance(entry.get("url"), str):
                self._saved[entry["url"]] = {key: str(entry.get(key, "")) for key in _KEPT}

    def heard(self, hello: Hello, received: float) -> None:
        """A robot said HELLO at `received` [s], our clock."""
        self._heard[hello.url] = (hello, received)
        if hello.url in self._saved:
            self._saved[hello.url] = _kept(hello)

    def measured(self, url: str, latency: float) -> None:
        """A round trip to the robot took `latency` [s]; NaN when it did not answer."""
        self._latency[url] = latency

    def add(self, text: str) -> str:
        """Save an address that somebody typed; returns its url. ValueError with a sentence when it is none."""
        url = check_address(text)
        self._saved.setdefault(url, dict.fromkeys(_KEPT, ""))
        return url

    def name(self, url: str, name: str, kind: str, description: str, icon: str = "") -> None:
        """Remember what a saved address turned out to be."""
        if url in self._saved:
            self._saved[url] = {"name": name, "kind": kind, "description": description, "icon": icon}

    def remove(self, url: str) -> None:
        """Forget a saved address; a robot that says HELLO is listed all the same."""
        self._saved.pop(url, None)

    def save(self) -> list[dict[str, str]]:
        """The saved addresses for the settings file."""
        return [{"url": url, **kept} for url, kept in self._saved.items()]

    def entries(self) -> list[Entry]:
        """All robots: those within reach first, then those that fell silent, then addresses never heard.

        Within each they keep the order in which they were met, so that no card moves under a finger without need.
        """
        now = self._now()
        self._heard = {
            url: (hello, at)
            for url, (hello, at) in self._heard.items()
            if now - at <= FORGET_DELAY or url in self._saved
        }
        heard = [self._entry(hello, now - at) for hello, at in self._heard.values()]
        unheard = [
            Entry(
                url,
                kept["name"],
                kept["kind"],
                description=kept["description"],
                icon=kept["icon"],
                latency=self._latency.get(url, math.nan),
                saved=True,
            )
            for url, kept in self._saved.items()
            if url not in self._heard
        ]
        return [*sorted(heard, key=lambda entry: entry.state == "lost"), *unheard]

    def _entry(self, hello: Hello, silent: float) -> Entry:
        return Entry(
            hello.url,
            hello.name,
            hello.kind,
            hello.description,
            hello.battery,
            hello.driver,
            hello.driver_id,
            silent,
            self._latency.get(hello.url, math.nan),
            hello.url in self._saved,
            hello.boot,
            hello.icon,
        )


_KEPT = ("name", "kind", "description", "icon")


def _kept(hello: Hello) -> dict[str, str]:
    return {key: getattr(hello, key) for key in _KEPT}
