"""What the robot remembers while it is switched off: its mission and how it was left, as JSON files."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

import msgspec

from bridge import codec
from bridge.errors import BridgeError
from bridge.msgs.pilothouse_msgs import Mission

__all__ = ["Left", "Store"]


class Left(msgspec.Struct, frozen=True):
    """How the robot side was left, whatever ended it."""

    stopped_by: str = ""
    """Who had pressed STOP; empty when it was not pressed."""
    task: str = ""
    """Title of the task that had not ended; empty when there was none."""


class Store:
    """Keeps the mission and home in a directory; a cut of power leaves the old file or the new one, never half."""

    def __init__(self, directory: Path) -> None:
        directory.mkdir(parents=True, exist_ok=True)
        self.path = directory / "mission.json"
        self._left = directory / "left.json"

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
        _write(self.path, codec.to_json(mission))

    def left(self) -> Left:
        """How it was left; with STOP pressed by somebody when that was noted but cannot be read."""
        try:
            return msgspec.json.decode(self._left.read_bytes(), type=Left)
        except FileNotFoundError:
            return Left()
        except (OSError, ValueError):
            return Left(stopped_by="somebody")

    def leave(self, left: Left) -> None:
        """Note how it is left if it ends now; on the disk when this returns. Raises OSError when it cannot be."""
        _write(self._left, msgspec.json.encode(left))


def _write(path: Path, content: bytes) -> None:
    fresh = path.with_suffix(".new")
    try:
        with fresh.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        fresh.replace(path)
    except OSError:
        with suppress(OSError):
            fresh.unlink(missing_ok=True)
        raise
    directory = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(directory)
    finally:
        os.close(directory)
