"""Snapshots of the camera and recordings of everything that came, as files."""

from __future__ import annotations

import itertools
import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from app.link.channels import EVENT
from bridge.core.camera_frames import Frame
from bridge.core.topics import TOPICS
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time
from widgets.core.language import tr

if TYPE_CHECKING:
    from app.link.recorder import Recorder
    from app.session.session import Session

__all__ = ["PICTURES", "RECORDINGS", "SNAPSHOTS", "Recordings"]

PICTURES = "/camera/image/compressed"
"""Topic that the camera's frames are recorded as."""
PICTURE_PERIOD = 0.2
"""Between two recorded frames [s]: all of them would fill the disk with what no eye tells apart."""
RECORDINGS, SNAPSHOTS = "recordings", "pictures"
"""Folders below each of its own."""
NAME = "%Y-%m-%d_%H-%M-%S"
"""Files are called by the time of day; where one is called so already, `_2` and so on follow."""


class Recordings:
    """Writes files below one folder and says what became of them."""

    def __init__(
        self,
        folder: Path,
        say: Callable[[str, str], object],
        wall: Callable[[], float] = time.time,
        now: Callable[[], float] = time.monotonic,
        *,
        old: Path | None = None,
    ) -> None:
        """`say` gets one sentence and its level; `wall` is the time of day [s], `now` a clock nobody sets [s].

        `old` is a folder that files were written to before, which are still found; None for none.
        """
        self.folders = tuple(dict.fromkeys(one for one in (folder, old) if one is not None))
        """Where files are looked for; the first is written to."""
        self._folder, self._say, self._wall, self._now = folder, say, wall, now
        self._began = now()
        self._pictured = -math.inf
        self.recorder: Recorder | None = None
        """The recording that runs; None when none does."""
        self.frame: Frame | None = None
        """The newest camera frame as it came; None before the first."""

    def _path(self, folder: str, ending: str) -> Path:
        place, name = self._folder / folder, time.strftime(NAME, time.localtime(self._wall()))
        taken = {path.name for path in place.glob(name + "*")}
        names = itertools.chain([name], (f"{name}_{number}" for number in itertools.count(2)))
        return place / next(free for one in names if (free := one + ending) not in taken)

    def kept(self) -> list[Path]:
        """Recordings and pictures in all its folders, the newest first by their names."""
        found = [
            path
            for folder in self.folders
            for place, pattern in ((RECORDINGS, "*.mcap"), (SNAPSHOTS, "*.jpg"))
            for path in (folder / place).glob(pattern)
            if path.is_file() and not path.name.startswith(".")
        ]
        return sorted(found, key=lambda path: path.name, reverse=True)

    def snapshot(self) -> Path | None:
        """Keep the newest camera frame as a file; None when there is none or it cannot be written."""
        if self.frame is None:
            return None
        path = self._path(SNAPSHOTS, ".jpg")
        try:
            _save(path, self.frame.jpeg)
        except OSError as error:
            self._say(
                tr("The snapshot could not be saved: {strerror}.").format(strerror=error.strerror or error),
                "warn",
            )
            return None
        self._say(tr("Snapshot saved as {name}.").format(name=path.name), "ok")
        return path

    def toggle(self, session: Session | None) -> None:
        """Start recording, or finish the one that runs and say where it is."""
        if self.recorder is None:
            self.start(self._path(RECORDINGS, ".mcap"), session)
        else:
            self.stop()

    def start(self, path: Path, session: Session | None) -> bool:
        """Record into `path`, beginning with what the robot said once; False, and said, when it cannot be written.

        One that runs is finished first. A file that is there already is never written over.
        """
        from app.link.recorder import Recorder  # when there is something to record, for a quick start

        self.stop()
        try:
            self.recorder = Recorder(path, wall=self._wall)
        except OSError as error:
            self._say(
                tr("The recording could not start: {strerror}.").format(strerror=error.strerror or error),
                "warn",
            )
            return False
        self._began = self._now()
        for entry in TOPICS:
            if session is not None and entry.latched:
                self.put(entry.name, session.feeds.latest(entry.name))
        return True

    @property
    def files(self) -> list[Path]:
        """What has been recorded, the newest first; the one that is being written is not among them."""
        running = self.recorder.path if self.recorder is not None else None
        return [path for path in self.kept() if path.suffix == ".mcap" and path != running]

    def see(self, frame: Frame) -> None:
        """A camera frame came, in the network thread: kept for a snapshot, and recorded now and then."""
        self.frame = frame
        recorder, now = self.recorder, self._now()
        if recorder is None or now - self._pictured < PICTURE_PERIOD:
            return
        self._pictured = now
        stamp = Time(math.floor(frame.stamp), int(frame.stamp % 1 * 1e9)) if frame.stamp > 0 else Time()
        recorder.put(PICTURES, CompressedImage(Header(stamp, "camera"), "jpeg", frame.jpeg))

    def put(self, channel: str, message: object) -> None:
        """Record what came, where a recording runs."""
        if self.recorder is not None and isinstance(message, Msg):
            self.recorder.put("/events" if channel == EVENT else channel, message)

    def check(self) -> None:
        """Say what was not recorded; a recording that the disk has ended is finished."""
        if self.recorder is None:
            return
        if self.recorder.problem:
            self.stop()
        elif self.recorder.sentence:
            self._say(self.recorder.sentence, "warn")

    def stop(self) -> None:
        """Finish the recording and say what became of it; nothing when none runs."""
        recorder, self.recorder = self.recorder, None
        if recorder is None:
            return
        recorder.close()
        saved = "" if recorder.problem else tr("Recording saved as {name}. ").format(name=recorder.path.name)
        self._say((saved + recorder.sentence).strip(), "warn" if recorder.sentence else "ok")

    @property
    def clock(self) -> str:
        """How long the recording runs, as in `04:31`; `Record` while none does."""
        if self.recorder is None:
            return tr("Record")
        seconds = int(self._now() - self._began)
        return f"{seconds // 60:02d}:{seconds % 60:02d}"


def _save(path: Path, data: bytes) -> None:
    """Write a new file whole or leave none; OSError when it cannot be written or is there already."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("xb") as file:
        try:
            file.write(data)
            file.flush()
        except OSError:
            path.unlink(missing_ok=True)
            raise
