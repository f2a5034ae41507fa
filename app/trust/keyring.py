"""Keys of the robots that this handheld is paired with, in a file of their own that only its owner may read."""

from __future__ import annotations

import contextlib
import json
import logging
import math
import os
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bridge.client.credentials import Credentials
from bridge.core.address import LinkLost, host_and_port
from bridge.core.identity import Role
from widgets.core.language import tr

if TYPE_CHECKING:
    from bridge.client.pairing import Paired

__all__ = ["Keyring", "RobotKey", "host_of", "place_of"]

log = logging.getLogger(__name__)

CLAIM_LENGTH = 32
"""Hex digits of a fingerprint that a robot's HELLO names."""
MAX_ADDRESSES = 8
"""So many addresses of a robot are kept, the newest first."""
MAX_ROBOTS = 500
"""So many robots are kept; the one paired longest ago gives way."""
MAX_NAME = 80
"""Characters of a robot's name."""


def place_of(url: str) -> str:
    """`HOST:PORT` of an address, whatever its scheme; empty for none."""
    try:
        host, port = host_and_port(url)
    except LinkLost:
        return ""
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"


def host_of(url: str) -> str:
    """Host of an address; empty for none."""
    try:
        return host_and_port(url)[0]
    except LinkLost:
        return ""


@dataclass(frozen=True, slots=True)
class RobotKey:
    """One paired robot."""

    fingerprint: str
    """Of its certificate."""
    name: str
    """What it called itself when it was paired."""
    id: str
    """Public id of this handheld at that robot."""
    role: str
    """What this handheld may do there: `watch`, `drive` or `manage`."""
    token: str = field(repr=False)
    """By which the robot knows this handheld."""
    places: tuple[str, ...] = ()
    """`HOST:PORT` where it was met, the newest first."""
    ends: float | None = None
    """When the role ends [s, operators' clock]; None when it does not."""

    @property
    def credentials(self) -> Credentials:
        """What a connection to it takes."""
        return Credentials(self.fingerprint, self.token, self.name)

    @property
    def claim(self) -> str:
        """Beginning of the fingerprint, as a HELLO names it."""
        return self.fingerprint[:CLAIM_LENGTH]

    @classmethod
    def read(cls, kept: Any) -> RobotKey:
        """The key that a file holds; ValueError for anything else."""
        if not isinstance(kept, dict):
            raise ValueError(tr("a key is no table"))  # noqa: TRY004 - the file is wrong, not the program
        texts = {name: kept.get(name) for name in ("fingerprint", "name", "id", "role", "token")}
        if not all(isinstance(text, str) for text in texts.values()):
            raise ValueError(tr("a key lacks one of its fields"))
        places, ends = kept.get("places", ()), kept.get("ends")
        if not isinstance(places, list) or not all(isinstance(place, str) for place in places):
            raise ValueError(tr("the places of a key are no list"))
        if ends is not None and not (isinstance(ends, int | float) and math.isfinite(ends)):
            raise ValueError(tr("the end of a key is no time"))
        key = cls(**texts, places=tuple(places[:MAX_ADDRESSES]), ends=ends)  # type: ignore[arg-type]
        Role.read(key.role)
        if not key.credentials.token:
            raise ValueError(tr("a key has no token"))
        return key


class Keyring:
    """All keys of this handheld. Lives in the UI thread; a change is on the disk when its method returns."""

    def __init__(self, folder: Path) -> None:
        """Read `folder/keys.json`; one that cannot be read is put aside, never overwritten."""
        self.path = folder / "keys.json"
        self.problem = ""
        """One sentence when the file could not be read or written; empty when all is well."""
        self._keys: dict[str, RobotKey] = {key.fingerprint: key for key in self._read()}

    def __iter__(self) -> Iterator[RobotKey]:
        """The paired robots, the newest last."""
        return iter(tuple(self._keys.values()))

    def get(self, fingerprint: str) -> RobotKey | None:
        """The key of the robot with that certificate; None where it is not paired."""
        return self._keys.get(fingerprint)

    def find(self, url: str, claim: str = "") -> RobotKey | None:
        """The key for the robot at `url`, which claims to be the one whose fingerprint begins with `claim`.

        Without a claim it is the robot that was met there last. None where no paired robot is expected there. A claim
        proves nothing: the connection does.
        """
        if claim:
            return next((key for key in self._keys.values() if key.claim == claim), None)
        place = place_of(url)
        return next((key for key in reversed(self._keys.values()) if place and place in key.places), None)

    @property
    def claims(self) -> dict[str, str]:
        """Claim of each paired robot by its name."""
        return {key.name: key.claim for key in self._keys.values()}

    def add(self, paired: Paired) -> RobotKey:
        """Keep what pairing left, in place of what was known of that robot."""
        before = self._keys.pop(paired.fingerprint, None)
        key = RobotKey(
            paired.fingerprint,
            paired.robot,
            paired.id,
            paired.role.word,
            paired.token,
            before.places if before else (),
            paired.ends if math.isfinite(paired.ends) else None,
        )
        self._keys[key.fingerprint] = key
        while len(self._keys) > MAX_ROBOTS:
            del self._keys[next(iter(self._keys))]
        self.met(key.fingerprint, paired.url)
        return self._keys[key.fingerprint]

    def met(self, fingerprint: str, url: str) -> None:
        """The robot has proved at `url` that it is the one: it is expected there from now on, and no other is."""
        key, place = self._keys.get(fingerprint), place_of(url)
        if key is None or not place:
            return
        changed = dict(self._keys)
        for one in changed.values():
            places = tuple(known for known in one.places if known != place)
            changed[one.fingerprint] = replace(one, places=places)
        places = (place, *changed[fingerprint].places)[:MAX_ADDRESSES]
        changed[fingerprint] = replace(changed[fingerprint], places=places)
        self._keep(changed)

    def forget(self, fingerprint: str) -> RobotKey | None:
        """Forget a robot; returns its key, which `restore` takes back. None where it is not paired."""
        key = self._keys.get(fingerprint)
        self._keep({name: one for name, one in self._keys.items() if name != fingerprint})
        return key

    def restore(self, key: RobotKey) -> None:
        """Take back a key that was forgotten."""
        self._keep({**self._keys, key.fingerprint: key})

    def _keep(self, keys: dict[str, RobotKey]) -> None:
        if keys != self._keys or not self.path.exists():
            self._keys = keys
            self._write()

    def _read(self) -> list[RobotKey]:
        try:
            kept = json.loads(self.path.read_text(encoding="utf-8"))
            if not isinstance(kept, list):
                raise ValueError(tr("it is no list of keys"))  # noqa: TRY004 - damaged like any other text
            return [RobotKey.read(one) for one in kept[:MAX_ROBOTS]]
        except FileNotFoundError:
            return []
        except (OSError, ValueError, RecursionError) as error:
            return self._put_aside(error)

    def _put_aside(self, why: object) -> list[RobotKey]:
        aside = self.path.with_suffix(".unreadable.json")
        self.problem = tr(
            "The keys of paired robots could not be read: pair again. The file is kept as {name}."
        ).format(name=aside.name)
        log.warning("%s (%s)", self.problem, why)
        try:
            self.path.replace(aside)
        except OSError as error:
            log.warning("could not put %s aside: %s", self.path, error)
        return []

    def _write(self) -> None:
        fresh = self.path.with_suffix(".new")
        text = json.dumps([asdict(key) for key in self._keys.values()], indent=1)
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            fresh.unlink(missing_ok=True)
            opened = os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(opened, "w", encoding="utf-8") as file:
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
            fresh.replace(self.path)
        except OSError as error:
            self.problem = tr("The keys of paired robots could not be saved: {strerror}.").format(
                strerror=error.strerror or error
            )
            log.warning("%s", self.problem)
            with contextlib.suppress(OSError):
                fresh.unlink()
        else:
            self.problem = ""
