"""Files of older programs beside the database: the mission and the last state of the robot side, as JSON."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import msgspec

from bridge.codec import from_json
from bridge.core.errors import BridgeError
from bridge.msgs.pilothouse_msgs import Mission

__all__ = ["LeftBehind", "left_behind", "put_away"]

_FILES = ("mission.json", "left.json")


class _Left(msgspec.Struct, frozen=True):
    stopped_by: str = ""
    task: str = ""


class LeftBehind(msgspec.Struct, frozen=True):
    """What was found."""

    mission: Mission | None
    """None when there was none that can be used."""
    stopped_by: str
    """Who had pressed STOP; empty when it was not pressed."""
    problems: list[str]
    """What cannot be used, one sentence each."""


def left_behind(directory: Path) -> LeftBehind:
    """Look into `directory`. STOP counts as pressed when that was noted but cannot be read."""
    mission, problems = None, []
    try:
        mission = from_json((directory / "mission.json").read_bytes(), Mission)
    except FileNotFoundError:
        pass
    except (OSError, BridgeError, ValueError) as error:
        problems.append(f"The stored mission was damaged and is left as mission.json.taken: {error}")
    try:
        left = msgspec.json.decode((directory / "left.json").read_bytes(), type=_Left)
    except FileNotFoundError:
        left = _Left()
    except (OSError, ValueError):
        left = _Left("somebody")
    return LeftBehind(mission, left.stopped_by, problems)


def put_away(directory: Path) -> None:
    """Rename the files, whose content is in the database now."""
    for name in _FILES:
        with suppress(OSError):
            (directory / name).rename(directory / f"{name}.taken")
