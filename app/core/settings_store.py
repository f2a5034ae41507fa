"""The settings of the handheld: one JSON file, replaced as a whole, so that a cut never leaves half of it."""

from __future__ import annotations

import contextlib
import json
import logging
import os
from pathlib import Path
from typing import Any

from app.core.newest_worker import NewestWorker
from widgets.core.language import tr

__all__ = ["Settings"]

log = logging.getLogger(__name__)


class Settings:
    """Values by name. Reading is from memory; writing happens in a thread of its own."""

    def __init__(self, folder: Path) -> None:
        """Read `folder/settings.json`; one that cannot be read is put aside, never overwritten."""
        self.path = folder / "settings.json"
        self.problem = ""
        """One sentence when the file could not be read or written; empty when all is well."""
        self._said = ""
        self._values = self._read()
        self._writer: NewestWorker[str] = NewestWorker(self._write, "settings")

    def get(self, name: str, default: Any = None) -> Any:
        """The value of `name`, or `default`."""
        return self._values.get(name, default)

    def set(self, name: str, value: Any) -> None:
        """Remember a JSON value; it is on the disk shortly after."""
        if self._values.get(name) == value and name in self._values:
            return
        self._values = {**self._values, name: value}
        self._writer.put(json.dumps(self._values, indent=1))

    def news(self) -> str:
        """The problem where it was not told by this before; else empty."""
        problem, before = self.problem, self._said
        self._said = problem
        return problem if problem != before else ""

    def flush(self, limit: float) -> bool:
        """Wait until everything is on the disk, `limit` [s] at most; whether it is, or could not be written at all."""
        return self._writer.flush(limit)

    def close(self) -> None:
        """Write what is not written and end the thread."""
        self._writer.close()

    def _read(self) -> dict[str, Any]:
        try:
            values = json.loads(self.path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (OSError, ValueError, RecursionError) as error:
            return self._put_aside(error)
        return values if isinstance(values, dict) else self._put_aside(tr("it is not a table of values"))

    def _put_aside(self, why: object) -> dict[str, Any]:
        aside = self.path.with_suffix(".unreadable.json")
        self.problem = tr("The settings could not be read and were put aside as {name}: {why}.").format(
            name=aside.name, why=why
        )
        log.warning("%s", self.problem)
        try:
            self.path.replace(aside)
        except OSError as error:
            log.warning("could not put %s aside: %s", self.path, error)
        return {}

    def _write(self, text: str) -> None:
        fresh = self.path.with_suffix(".new")
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with fresh.open("w", encoding="utf-8") as file:
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
            fresh.replace(self.path)
        except OSError as error:
            self.problem = tr("The settings could not be saved: {strerror}.").format(
                strerror=error.strerror or error
            )
            log.warning("%s", self.problem)
            with contextlib.suppress(OSError):
                fresh.unlink()
        else:
            self.problem = ""
