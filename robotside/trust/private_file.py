"""Files that only the robot's own user may read, written whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["write_private"]

PRIVATE = 0o600


def write_private(path: Path, content: bytes) -> None:
    """Have `content` at `path`, on the disk, for its owner only; a crash leaves what was there before. Raises OSError."""
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_name(f".{path.name}.new")
    fresh.unlink(missing_ok=True)
    opened = os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, PRIVATE)
    try:
        with os.fdopen(opened, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        fresh.replace(path)
    except BaseException:
        fresh.unlink(missing_ok=True)
        raise
    directory = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(directory)
    finally:
        os.close(directory)
