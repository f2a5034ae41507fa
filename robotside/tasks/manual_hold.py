"""MANUAL, chosen by an operator: no task starts by itself until it is released, over restarts too."""

from __future__ import annotations

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.records import Records
from robotside.records.events import Say

__all__ = ["ManualHold"]

_SETTING = "manual by"
"""Name of the setting that says who chose it."""


class ManualHold:
    """The operator who chose it, kept with the settings; it holds even if the disk fails."""

    def __init__(self, records: Records, say: Say) -> None:
        self._records, self._say = records, say

    @property
    def by(self) -> str:
        """Who chose it; empty when what is due may start by itself."""
        return self._records.setting(_SETTING)

    @property
    def why(self) -> str:
        """Why nothing starts by itself, as the end of a sentence; empty when it may."""
        return f"{self.by} set the mode to MANUAL" if self.by else ""

    def choose(self, name: str, client_id: str = "") -> bool:
        """`name`, whose `client_id` may be empty, chose it; False when it was chosen already."""
        if self.by:
            return False
        self._records.note_setting(_SETTING, name)
        said = f"{name} set the mode to MANUAL: nothing starts by itself until it is AUTO."
        self._say("control", Notice(Code.MODE_MANUAL, said, actor_id=client_id, name=name))
        return True

    def end(self) -> bool:
        """An operator lets the robot drive itself again; False when it was not held."""
        if not self.by:
            return False
        self._records.note_setting(_SETTING, "")
        return True
