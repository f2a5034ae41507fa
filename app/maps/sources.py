"""The table of map sources in the settings: their order, which is looked at, how plainly, and how much of them is kept.

sources = Sources(settings, shipped=[parking_lot])
sources.choose(AUTOMATIC)
sources.pick(latitude, longitude)    # the first that covers the robot
"""

from __future__ import annotations

import contextlib
import secrets
from collections.abc import Callable, Iterable
from dataclasses import replace

from app.core.checked_settings import CheckedSettings
from app.core.settings_store import Settings
from app.maps.map_source import Source
from widgets.core.language import tr

__all__ = ["AUTOMATIC", "MAX_SOURCES", "NO_MAP", "Sources", "new_id"]

AUTOMATIC, NO_MAP = "automatic", "none"
"""What may be chosen besides a source: the first that covers the robot's place, or the robot's own map alone."""
MAX_SOURCES = 32
LEAST_CACHE, USUAL_CACHE, GREATEST_CACHE = 20.0, 200.0, 4000.0
"""Of tiles that are kept [MB]."""
USUAL_OPACITY = 0.6
NAME = "maps"


def new_id() -> str:
    """Of a source that is added."""
    return secrets.token_hex(4)


class Sources:
    """In the order of preference; what the operator added comes before what was shipped. For the UI thread."""

    def __init__(self, settings: Settings, shipped: Iterable[Source] = ()) -> None:
        self._settings = settings
        self._shipped = tuple(shipped)
        kept = CheckedSettings(settings.get(NAME), tr("maps"))
        self._own: list[Source] = self._read(kept)
        self._removed: tuple[int, Source] | None = None
        self._listeners: list[Callable[[], object]] = []
        self.opacity = kept.number("opacity", 0.0, 1.0, USUAL_OPACITY)
        """How plainly the pictures are seen beneath the grid, 0 to 1."""
        self.cache_megabytes = kept.number("cache_mb", LEAST_CACHE, GREATEST_CACHE, USUAL_CACHE)
        """How much of tiles that were fetched is kept [MB]."""
        chosen = kept.values.get("chosen", AUTOMATIC)
        self.chosen: str = chosen if isinstance(chosen, str) else AUTOMATIC
        """`AUTOMATIC`, `NO_MAP`, or the id of a source."""
        self.problem = kept.sentence
        """What of the settings was no good, in one sentence; empty when all is well."""

    def _read(self, kept: CheckedSettings) -> list[Source]:
        listed = kept.values.get("sources", [])
        if not isinstance(listed, list):
            kept.mistaken("sources", "a list")
            return []
        found: dict[str, Source] = {}
        for each in listed[:MAX_SOURCES]:
            try:
                source = Source.of(each)
            except ValueError:
                kept.mistaken("sources", tr("a list of maps"))
            else:
                found.setdefault(source.id, source)
        return list(found.values())

    @property
    def all(self) -> list[Source]:
        """Every source, the preferred one first."""
        return [*self._own, *self._shipped]

    def get(self, id_: str) -> Source | None:
        """The source of that id; None for another."""
        return next((one for one in self.all if one.id == id_), None)

    def covering(self, latitude: float, longitude: float) -> list[Source]:
        """Those that may have pictures of that place [deg], NaN where it is not known; the preferred one first."""
        return [one for one in self.all if one.covers(latitude, longitude)]

    def pick(self, latitude: float, longitude: float) -> Source | None:
        """The source to be looked at there: the chosen one where it covers the place, else the first that does."""
        fitting = self.covering(latitude, longitude)
        if self.chosen == NO_MAP or not fitting:
            return None
        return next((one for one in fitting if one.id == self.chosen), fitting[0])

    def choose(self, id_: str) -> None:
        """Look at that source from now on, `AUTOMATIC`, or `NO_MAP`."""
        self.chosen = id_
        self._keep()

    def set_opacity(self, opacity: float) -> None:
        """Have the pictures seen as plainly as that, 0 to 1."""
        self.opacity = min(max(opacity, 0.0), 1.0)
        self._keep()

    def set_cache(self, megabytes: float) -> None:
        """Keep that much of tiles that were fetched [MB]."""
        self.cache_megabytes = min(max(megabytes, LEAST_CACHE), GREATEST_CACHE)
        self._keep()

    def put(self, source: Source) -> None:
        """Add it as the preferred one, or change the one of that id; ValueError where there are too many."""
        index = next((i for i, one in enumerate(self._own) if one.id == source.id), None)
        if index is not None:
            self._own[index] = source
        elif len(self._own) >= MAX_SOURCES:
            raise ValueError(
                tr("There are {count} maps already; delete one first.").format(count=MAX_SOURCES)
            )
        else:
            self._own.insert(0, replace(source, shipped=False))
        self._keep()

    def move(self, id_: str, step: int) -> None:
        """Prefer it more, -1, or less, 1."""
        index = next((i for i, one in enumerate(self._own) if one.id == id_), None)
        if index is not None and 0 <= index + step < len(self._own):
            self._own.insert(index + step, self._own.pop(index))
            self._keep()

    def remove(self, id_: str) -> Source | None:
        """Take it off the list; `undo` brings it back."""
        index = next((i for i, one in enumerate(self._own) if one.id == id_), None)
        if index is None:
            return None
        self._removed = index, self._own.pop(index)
        self._keep()
        return self._removed[1]

    def undo(self) -> None:
        """Bring back what was removed last, to its place."""
        if self._removed is not None and len(self._own) < MAX_SOURCES:
            self._own.insert(*self._removed)
            self._removed = None
            self._keep()

    @property
    def can_undo(self) -> bool:
        """Something was removed and not brought back."""
        return self._removed is not None

    def bind(self, changed: Callable[[], object]) -> Callable[[], None]:
        """Call `changed` after each change; what is given back ends that."""
        self._listeners.append(changed)

        def unbind() -> None:
            with contextlib.suppress(ValueError):
                self._listeners.remove(changed)

        return unbind

    def _keep(self) -> None:
        self._settings.set(
            NAME,
            {
                "sources": [one.kept() for one in self._own],
                "chosen": self.chosen,
                "opacity": self.opacity,
                "cache_mb": self.cache_megabytes,
            },
        )
        for changed in list(self._listeners):
            changed()
