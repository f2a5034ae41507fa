"""Usage counts of the scan: kept in the settings every few selections, with what other methods were asked for."""

from __future__ import annotations

from collections import Counter
from typing import Any

from app.inputs.base.method_app import MethodApp
from app.inputs.switch_access.scan.engine import Selection
from app.inputs.switch_access.usage import Usage

__all__ = ["LearnedUsage"]

KEY = "switches_used"
"""Name in the settings."""
SAVE_EVERY = 10
"""After so many selections the counts are put into the settings."""


class LearnedUsage:
    """Of one app."""

    def __init__(self, app: MethodApp) -> None:
        """`app` is asked for its `settings`, `methods` and `now`."""
        self._app = app
        self._usage = Usage(app.settings.get(KEY))
        self._unsaved = 0
        """Selections that are not in the settings yet."""
        self._asked_for = Counter[str]()
        """What the response log counted of each intent when it was read last."""

    @property
    def frozen(self) -> Any:
        """The counts of earlier runs: nothing moves while the app runs."""
        return self._usage.frozen

    def count(self, chosen: Selection) -> None:
        """Note what was chosen, here and in the response log."""
        log = self._log
        if log is not None and log.on:
            log.tracks.picked(chosen.target.words, chosen.presses, chosen.since, self._app.now())
        self._usage.used(chosen.place, chosen.target.name)
        self._unsaved += 1
        if self._unsaved >= SAVE_EVERY:
            self.save()

    def save(self) -> None:
        """Put the counts into the settings, with what the log says was asked for by any method: by switches it is as likely."""
        asked = self._log.usage() if self._log is not None else Counter[str]()
        fresh, self._asked_for = asked - self._asked_for, asked
        for intent, times in fresh.items():
            self._usage.used("", intent, times)
        if self._unsaved or fresh:
            self._unsaved = 0
            self._app.settings.set(KEY, self._usage.save())

    @property
    def _log(self) -> Any:
        """The response log; None where the app keeps none."""
        return self._app.methods.get("log")
