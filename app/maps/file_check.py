"""Looks at a file in a thread of its own, to say what map it is or why it is none."""

from __future__ import annotations

import logging
import threading
from pathlib import Path

from app.maps.map_source import Source
from app.maps.maps import described
from widgets.core.language import tr

__all__ = ["FileCheck"]

log = logging.getLogger(__name__)


class FileCheck:
    """One file. What was found is looked at in the UI thread."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self.source: Source | None = None
        """What map it is; None for none."""
        self.problem = ""
        """Why it is none, in one sentence."""
        self.over = False
        self._thread = threading.Thread(target=self._run, name="map file", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self.source = described(self._path.expanduser())
        except ValueError as wrong:
            self.problem = str(wrong)
        except Exception as fault:  # a thread that ends silently would be reading for ever
            log.exception("%s", self._path)
            self.problem = tr("{file} cannot be read as a map ({fault}).").format(
                file=self._path.name, fault=type(fault).__name__
            )
        self.over = True

    def wait(self, timeout: float | None = None) -> None:
        """Until it is over, or so long [s]."""
        self._thread.join(timeout)
