"""What the robot remembers while it is switched off: its mission, as a JSON file."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from bridge import codec
from bridge.errors import BridgeError
from bridge.msgs.pilothouse_msgs import Mission

__all__ = ["Store"]


class Store:
    """Keeps the mission and home in a directory; a cut of power leaves the old file or the new one, never half."""

    def __init__(self, directory: Path) -> None:
        directory.mkdir(parents=True, exist_ok=True)
        self.path = directory / "mission.json"

    def load(self) -> tuple[Mission, str]:
        """The stored mission, and one sentence when there was a file that could not be used, else an empty one.

        Such a file is moved aside, so that nothing is lost and the next start is clean.
        """
        try:
            raw = self.path.read_bytes()
        except FileNotFoundError:
            return Mission(), ""
        except OSError as error:
            return Mission(), f"The stored mission cannot be read: {error.strerror}."
        try:
            return codec.from_json(raw, Mission), ""
        except (BridgeError, ValueError) as error:
            return Mission(), self._set_aside(error)

    def _set_aside(self, error: Exception) -> str:
        aside = self.path.with_suffix(".damaged.json")
        with suppress(OSError):
            self.path.replace(aside)
        return f"The stored mission was damaged and is set aside as {aside.name}: {error}"

    def save(self, mission: Mission) -> None:
        """Keep `mission`; when this returns it is on the disk. Raises OSError when it cannot be written."""
        fresh = self.path.with_suffix(".new")
        with fresh.open("wb") as file:
            file.write(codec.to_json(mission))
            file.flush()
            os.fsync(file.fileno())
        fresh.replace(self.path)
        directory = os.open(self.path.parent, os.O_RDONLY)
        try:
            os.fsync(directory)
        finally:
            os.close(directory)
