"""Address of a tile server's tiles: a URL with places for zoom level, column and row.

address = TileAddress("https://{s}.tile.example.org/{z}/{x}/{y}{r}.png?key={key}", key="secret")
address.url((17, 38740, 84211))
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from urllib.parse import urlsplit

from widgets.core.language import tr
from widgets.map.tiles.tile_reader import Key

__all__ = ["MAX_LENGTH", "TileAddress"]

MAX_LENGTH = 1000
"""Of an address that is taken [characters]."""
SUBDOMAINS = "abc"
"""What stands for `{s}`, in turns."""
PLACES = frozenset({"z", "x", "y", "-y", "s", "r", "key"})
PLACE = re.compile(r"\{([^{}]*)\}")


@dataclass(frozen=True, slots=True)
class TileAddress:
    """ValueError, in one sentence, for an address that names no tiles."""

    template: str
    """With `{z}`, `{x}` and `{y}`, or `{-y}` where rows count from the south; `{s}` is a, b or c, `{r}` stands for @2x, `{key}` for the key."""
    key: str = ""
    """What the server knows its user by; it is never shown nor logged."""
    from_south: bool = False
    """`{y}` counts from the south too, as in TMS."""
    dense: bool = False
    """Ask for tiles of twice the pixels, where the address has `{r}`."""

    def __post_init__(self) -> None:
        wrong = self._wrong()
        if wrong:
            raise ValueError(wrong)

    def _wrong(self) -> str:
        text = self.template
        if len(text) > MAX_LENGTH or not text.isprintable() or " " in text:
            return tr("An address has at most {count} characters and no spaces.").format(count=MAX_LENGTH)
        try:
            parts = urlsplit(text.replace("{", "").replace("}", ""))
            host, user, _ = parts.hostname, parts.username, parts.port
        except ValueError:
            return tr("This is not an address: its host or port cannot be read.")
        if parts.scheme not in ("http", "https") or not host:
            return tr("An address begins with https:// or http:// and a host.")
        if user:
            return tr("An address holds no user and no password; a key goes into its own field.")
        found = PLACE.findall(text)
        unknown = [name for name in found if name not in PLACES]
        if unknown:
            return tr("The address has {{{name}}}, which nothing stands for; {{z}}, {{x}}, {{y}}, {{-y}}, {{s}}, {{r}} and {{key}} are known.").format(name=unknown[0][:20])  # fmt: skip
        missing = [name for name in ("z", "x") if name not in found] + ["y"] * (not {"y", "-y"} & set(found))
        if missing:
            return tr("The address lacks {{{name}}}; tiles are asked for by {{z}}, {{x}} and {{y}}.").format(
                name=missing[0]
            )
        if "key" in found and not self.key:
            return tr("The address has {{key}}, and no key is given.").format()
        return ""

    def url(self, tile: Key) -> str:
        """Of one tile: zoom level, column, and row from the south."""
        zoom, column, south = tile
        north = (1 << zoom) - 1 - south
        places = {
            "z": str(zoom),
            "x": str(column),
            "y": str(south if self.from_south else north),
            "-y": str(south),
            "s": SUBDOMAINS[(column + south) % len(SUBDOMAINS)],
            "r": "@2x" if self.dense else "",
            "key": self.key,
        }
        return PLACE.sub(lambda place: places[place[1]], self.template)

    @property
    def host(self) -> str:
        """Whom the tiles are asked of, as it may be shown."""
        return urlsplit(self.template.replace("{", "").replace("}", "")).hostname or ""

    @property
    def shown(self) -> str:
        """The address without what may be a key: neither query nor fragment."""
        return re.split(r"[?#]", self.template)[0]
