"""The robots that can be connected to: those that say HELLO, and the addresses that were entered by hand.

Anybody can say HELLO, in any name and as often as he likes. So the list is bounded: a newcomer never takes the place of a
robot that is connected, saved or paired, nor of one that keeps saying HELLO.
"""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from bridge.discovery.hello import Hello, is_loopback, port_of
from bridge.trust.pairing import SCHEME
from bridge.trust.robot_link import RobotLink, read_link
from widgets.core.language import tr

__all__ = [
    "MAX_HEARD",
    "MAX_PER_KEY",
    "MAX_PER_SOURCE",
    "Entry",
    "KnownRobots",
    "check_address",
    "plain_name",
]

SILENCE_LIMIT = 2.5
"""A robot silent for longer is lost [s]; it says HELLO twice a second, and a saved one is asked once a second."""
FORGET_DELAY = 60.0
"""A robot silent for longer, and not saved, is listed no more [s]."""
MAX_HEARD = 100
"""So many robots that say HELLO are listed at most; those that are connected, saved or paired come on top."""
MAX_PER_SOURCE = 50
"""So many of them from one address at most: one machine cannot fill the list."""
MAX_PER_KEY = 3
"""So many addresses that claim the key of one paired robot are kept as it; a key in a HELLO proves nothing."""
PORT = 9090
"""Where a robot listens when the address does not say it."""


def check_address(text: str) -> str:
    """The `ws://HOST:PORT` of what somebody typed, or of a robot's link without a secret; ValueError with a sentence for anything else."""
    typed = text.strip()
    if typed.startswith(f"{SCHEME}:"):
        return _address_of(typed)
    if not typed:
        raise ValueError(tr("Enter an address such as 192.168.1.7 or ws://192.168.1.7:9090."))
    if ":/" in typed and "://" not in typed:
        raise ValueError(
            tr("An address begins with ws:// or wss://, not {typed}.").format(
                typed=typed[: typed.index(":/") + 2]
            )
        )
    url = typed if "://" in typed else f"ws://{typed}"
    try:
        parts = urlsplit(url)
        host, port = parts.hostname, parts.port
    except ValueError:
        raise ValueError(
            tr("{typed} has no valid port: it is a number from 1 to 65535.").format(typed=typed)
        ) from None
    if parts.netloc.endswith(":"):
        raise ValueError(tr("{typed} has no valid port: it is a number from 1 to 65535.").format(typed=typed))
    if parts.scheme not in ("ws", "wss"):
        raise ValueError(
            tr("An address begins with ws:// or wss://, not {scheme}://.").format(scheme=parts.scheme)
        )
    if not host or any(sign in host for sign in " ,;") or port == 0:
        raise ValueError(
            tr("{typed} is not an address such as 192.168.1.7 or ws://192.168.1.7:9090.").format(typed=typed)
        )
    host = f"[{host}]" if ":" in host else host
    return f"{parts.scheme}://{host}:{port or PORT}{parts.path.rstrip('/')}"


def _address_of(text: str) -> str:
    """The address that a robot's QR code says; ValueError with a sentence for one that is to be paired by."""
    link = read_link(text)
    if isinstance(link, RobotLink):
        return link.url
    raise ValueError(
        tr("This link is for pairing: open it, or paste it where the robot's code is asked for.")
    )


def address(url: str) -> str:
    """Host of a robot, with the port where it is not the usual one."""
    try:
        parts = urlsplit(url)
        host, port = parts.hostname or url, parts.port
    except ValueError:  # in a settings file that somebody edited
        return url
    return host if port in (None, PORT) else f"{host}:{port}"


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
    key: str = ""
    """As in Hello: a claim; empty when it made none."""
    kept: bool = False
    """It is connected, saved or, as it claims, paired: strangers never crowd it out."""
    known_for: float = 0.0
    """Since its first HELLO without a longer gap [s]; 0 when it never said one."""
    reached: bool = True
    """Who speaks for it hears the robot itself."""
    warning: str = ""
    """What is wrong with it, as a sentence; empty when nothing is known to be."""
    probe: tuple[str, int] | None = None
    """Address that its HELLO came from and port of its web server, to measure a round trip by; None without one."""

    trust: str = ""
    """`paired`, `stranger` (its link is protected, and this handheld is not paired with it), `open` (what is said to it
    can be read and changed on its way) or empty within this machine."""
    met: bool = True
    """A robot was met there, now or on an earlier day; an address that somebody typed may be a slip of the pen."""

    @property
    def state(self) -> str:
        """`live`, `lost` (it was heard and fell silent, or who speaks for it has lost it) or `unheard` (an address that never said HELLO)."""
        if math.isnan(self.silent):
            return "unheard"
        return "lost" if self.silent > SILENCE_LIMIT or not self.reached else "live"

    @property
    def address(self) -> str:
        """As of `address`."""
        return address(self.url)


@dataclass(slots=True)
class _Heard:
    hello: Hello
    at: float
    """When it came [s]."""
    first: float
    """When the first came [s]."""
    source: str
    """The address that it came from; empty when that is not known."""


class KnownRobots:
    """Keeps the list. Lives in the UI thread; the HELLOs come through the mailbox."""

    def __init__(
        self,
        now: Callable[[], float],
        saved: Iterable[dict[str, Any]] = (),
        *,
        connected: Callable[[], Collection[str]] = tuple,
        paired: Callable[[], Mapping[str, str]] = dict,
    ) -> None:
        """`saved` is what `save` returned once; damaged entries are left out.

        `connected` are the urls that are connected now; `paired` is the key of each paired robot, as in `Hello`, by its name.
        """
        self._now, self._connected, self._paired = now, connected, paired
        self._heard: dict[str, _Heard] = {}
        self._latency: dict[str, float] = {}
        self._saved: dict[str, dict[str, str]] = {}
        for entry in saved if isinstance(saved, list | tuple) else ():
            if isinstance(entry, dict) and isinstance(entry.get("url"), str):
                self._saved[entry["url"]] = {key: str(entry.get(key, "")) for key in _KEPT}

    def heard(self, hello: Hello, received: float, source: str = "") -> None:
        """A robot said HELLO at `received` [s], our clock, from the address `source`."""
        known = self._heard.get(hello.url)
        if known is None and not self._is_kept(hello) and not self._has_room(source):
            return
        self._heard[hello.url] = _Heard(hello, received, known.first if known else received, source)
        if hello.url in self._saved:
            self._saved[hello.url] = _kept(hello)

    def _has_room(self, source: str) -> bool:
        """Whether one more stranger is listed; one that fell silent makes room for it."""
        for alike, most in (
            ([url for url, one in self._heard.items() if source and one.source == source], MAX_PER_SOURCE),
            (list(self._heard), MAX_HEARD),
        ):
            if len(alike) >= most and not self._drop_silent(alike):
                return False
        return True

    def _drop_silent(self, urls: list[str]) -> bool:
        """Drop the one of `urls` that is silent for longest; False when all of them are heard, or kept."""
        silent = [
            (one.at, url)
            for url in urls
            if self._now() - (one := self._heard[url]).at > SILENCE_LIMIT and not self._is_kept(one.hello)
        ]
        if not silent:
            return False
        url = min(silent)[1]
        del self._heard[url]
        self._latency.pop(url, None)
        return True

    def _is_kept(self, hello: Hello) -> bool:
        if hello.url in self._saved or hello.url in self._connected():
            return True
        if not hello.key or hello.key not in self._paired().values():
            return False
        claims = [url for url, one in self._heard.items() if one.hello.key == hello.key]
        return len(claims) < MAX_PER_KEY or hello.url in claims[:MAX_PER_KEY]

    def claim(self, url: str) -> str:
        """The key that the robot at `url` claims in its HELLO; empty where it makes no claim."""
        heard = self._heard.get(url)
        return heard.hello.key if heard else ""

    def name_of(self, url: str) -> str:
        """What the robot at `url` is called; empty where that is not known."""
        heard = self._heard.get(url)
        return heard.hello.name if heard else self._saved.get(url, {}).get("name", "")

    def measured(self, url: str, latency: float) -> None:
        """A round trip to the robot took `latency` [s]; NaN when it did not answer."""
        if url in self._heard or url in self._saved:
            self._latency[url] = latency

    def add(self, text: str, *, met: bool = False) -> str:
        """Save an address that somebody typed; returns its url. ValueError with a sentence when it is none.

        `met` says that a robot has answered there.
        """
        url = check_address(text)
        kept = self._saved.setdefault(url, dict.fromkeys(_KEPT, ""))
        if met:
            kept["met"] = _MET
        return url

    def name(self, url: str, name: str, kind: str, description: str, icon: str = "") -> None:
        """Remember what a saved address turned out to be."""
        if url in self._saved:
            told = {"name": name, "kind": kind, "description": description, "icon": icon}
            self._saved[url] = {**told, "met": _MET}

    def remove(self, url: str) -> dict[str, str] | None:
        """Forget a saved address; a robot that says HELLO is listed all the same. What was known of it, for `restore`."""
        return self._saved.pop(url, None)

    def restore(self, url: str, kept: dict[str, str]) -> None:
        """Take back an address that was forgotten."""
        self._saved.setdefault(url, kept)

    def save(self) -> list[dict[str, str]]:
        """The saved addresses for the settings file."""
        return [{"url": url, **kept} for url, kept in self._saved.items()]

    def entries(self) -> list[Entry]:
        """All robots: those within reach first, then those that fell silent, then addresses never heard.

        Within each they keep the order in which they were met, so that no card moves under a finger without need.
        """
        now = self._now()
        self._heard = {
            url: one for url, one in self._heard.items() if now - one.at <= FORGET_DELAY or url in self._saved
        }
        self._latency = {
            url: latency for url, latency in self._latency.items() if url in self._heard or url in self._saved
        }
        here = {one.hello.boot for one in self._heard.values() if self._is_here(one, now)}
        heard = [
            self._entry(one, now)
            for one in self._heard.values()
            if not one.hello.boot
            or one.hello.boot not in here
            or is_loopback(one.source)
            or self._is_kept(one.hello)
        ]
        unheard = [
            Entry(
                url,
                kept["name"],
                kept["kind"],
                description=kept["description"],
                icon=kept["icon"],
                latency=self._latency.get(url, math.nan),
                saved=True,
                kept=True,
                met=bool(kept["name"] or kept["met"]),
            )
            for url, kept in self._saved.items()
            if url not in self._heard
        ]
        return [*sorted(heard, key=lambda entry: entry.state == "lost"), *unheard]

    def _is_here(self, one: _Heard, now: float) -> bool:
        """A robot of this machine: it is listed under its loopback address, and not again under the others."""
        return is_loopback(one.source) and now - one.at <= SILENCE_LIMIT

    def _entry(self, one: _Heard, now: float) -> Entry:
        hello = one.hello
        port = port_of(hello.http) if hello.http else None
        return Entry(
            hello.url,
            hello.name,
            hello.kind,
            hello.description,
            hello.battery,
            hello.driver,
            now - one.at,
            self._latency.get(hello.url, math.nan),
            hello.url in self._saved,
            hello.boot,
            hello.icon,
            hello.key,
            self._is_kept(hello),
            one.at - one.first,
            hello.reached,
            self._warning(hello),
            (one.source, port) if one.source and port else None,
        )

    def _warning(self, hello: Hello) -> str:
        name = plain_name(hello.name)
        for paired, key in self._paired().items():
            if plain_name(paired) == name and hello.key != key:
                return tr("Not your paired {paired}: another robot uses its name.").format(paired=paired)
        return ""


_KEPT = ("name", "kind", "description", "icon", "met")
"""What is saved with an address; `met` is `yes` once a robot has answered there, whatever it told of itself."""
_MET = "yes"


def _kept(hello: Hello) -> dict[str, str]:
    told = {key: getattr(hello, key) for key in ("name", "kind", "description", "icon")}
    return {**told, "met": _MET}


def plain_name(name: str) -> str:
    """The same for names that look alike: width, case and blanks do not tell robots apart."""
    return "".join(unicodedata.normalize("NFKC", name).casefold().split())
