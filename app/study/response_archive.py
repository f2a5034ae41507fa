"""The archive of responses: everything that is kept of the log and the forms, exported into zips, erased."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.study.questionnaires import Workloads
from app.study.response_log import Response, ResponseLog, read
from app.study.study_export import export

__all__ = ["ResponseArchive"]

FOLDER = "responses"


class ResponseArchive:
    """What takes a while is for a thread of its own."""

    def __init__(self, folder: Path) -> None:
        """`folder` is the app's own."""
        self.folder, self.exports = folder / FOLDER, folder / "exports"
        self.log, self.workloads = ResponseLog(self.folder), Workloads(self.folder)

    @property
    def problem(self) -> str:
        """Why lines are lost, or how many were; empty when none are."""
        lost = self.log.dropped
        said = f"{lost} line{'s' * (lost != 1)} of the log could not be written and are lost." if lost else ""
        return self.log.problem or self.workloads.problem or said

    def read(self) -> list[Response]:
        """Everything that is kept, the oldest first; takes a while."""
        self.log.flush()
        return read(self.folder)[0]

    def export(self, settings: dict[str, Any], now: float) -> Path:
        """Write everything into one zip, with the `settings`, at `now` [s since 1970]; OSError when that fails. Takes a while."""
        self.log.flush()
        return export(self.folder, self.exports, settings, now)

    def zips(self) -> list[Path]:
        """What was exported and is still there, the oldest first."""
        return sorted(self.exports.glob("*.zip"))

    def discard(self) -> str:
        """Delete what was exported; one sentence. OSError when that fails."""
        zips = self.zips()
        for zip_ in zips:
            zip_.unlink(missing_ok=True)
        return "The zip was deleted." if len(zips) == 1 else f"{len(zips)} zips were deleted."

    def erase(self) -> str:
        """Delete all lines and forms; one sentence of what remains. OSError when that fails.

        Takes a while, after what is followed just now was forgotten.
        """
        self.log.erase()
        self.workloads.erase()
        if self.workloads.problem:
            raise OSError(self.workloads.problem)
        left = len(self.zips())
        remain = "1 zip that was exported remains" if left == 1 else f"{left} zips that were exported remain"
        return f"Everything was erased. {remain} in {self.exports}." if left else "Everything was erased."
