"""Records what came over the link into an MCAP file that Foxglove and the mcap tools read."""

from __future__ import annotations

import json
import logging
import queue
import threading
import time
from array import array
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec

from bridge import codec
from bridge.msgs import Msg
from widgets.core.language import tr

__all__ = ["Recorder", "schema"]

log = logging.getLogger(__name__)

PIECE = 256 * 1024
"""So much is gathered before it is written, packed [byte]: what a power cut takes, and what is read for one moment of it."""
WAITING = 2000
"""Messages that may wait for the disk; beyond that the newest are dropped, counted and said."""


def _array_schema(type_: type) -> dict[str, Any]:
    if not issubclass(type_, array):
        raise NotImplementedError(f"no JSON schema for {type_.__name__}")
    code = type_.code  # type: ignore[attr-defined]
    if code in "fd":
        return {"type": "array", "items": {"type": ["number", "null"]}}
    bits = 8 * array(code).itemsize
    least, most = (0, 2**bits - 1) if code.isupper() else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    return {"type": "array", "items": {"type": "integer", "minimum": least, "maximum": most}}


def schema(type_: type[Msg]) -> bytes:
    """The JSON schema of a message type, self-contained."""
    (root,), parts = msgspec.json.schema_components(
        [type_], schema_hook=_array_schema, ref_template="#/$defs/{name}"
    )
    return json.dumps({"type": "object", **parts.get(type_.__name__, root), "$defs": parts}).encode()


def _size(path: Path) -> int:
    return path.stat().st_size if path.exists() else 0


class Recorder:
    """Writes in a thread of its own; `put` never waits."""

    def __init__(
        self,
        path: Path,
        *,
        wall: Callable[[], float] = time.time,
        waiting: int = WAITING,
        piece: int = PIECE,
    ) -> None:
        """Start a file at `path`; OSError when it cannot be written or is there. `wall` is the time of day [s].

        At most `waiting` messages wait for the disk; `piece` is how much is written at once [byte].
        """
        from mcap.writer import Writer

        path.parent.mkdir(parents=True, exist_ok=True)
        self.path = path
        self.dropped = 0
        """Messages that did not get into the file."""
        self.problem = ""
        """One sentence when the disk failed; empty when all is well."""
        self._fault = ""
        """What the system says of that."""
        self.odd = 0
        """Messages that could not be written, with which the disk has nothing to do."""
        self._wall = wall
        self._file = path.open("xb")
        self._writer = Writer(self._file, chunk_size=piece)
        self._writer.start(library="pilothouse")
        self._channels: dict[str, int] = {}
        self._queue: queue.Queue[tuple[str, Msg, float] | None] = queue.Queue(waiting)
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)
        self._thread.start()

    def put(self, topic: str, message: Msg) -> None:
        """Record a message as received now, from any thread."""
        try:
            self._queue.put_nowait((topic, message, self._wall()))
        except queue.Full:
            self.dropped += 1

    @property
    def sentence(self) -> str:
        """How the recording stands: what was dropped or went wrong; empty when all is well."""
        if self.problem:
            return self.problem
        if self.dropped:
            return tr("Not recorded because the disk is too slow: {dropped}.").format(dropped=self.dropped)
        return tr("Messages that could not be written: {count}.").format(count=self.odd) if self.odd else ""

    def close(self) -> None:
        """Write what waits, finish the file and end the thread; a file that the disk left empty is removed."""
        self._queue.put(None)
        self._thread.join()
        if self.problem and not _size(self.path):
            self.path.unlink(missing_ok=True)
            self.problem = tr("Nothing was recorded: {strerror}.").format(strerror=self._fault)

    def _run(self) -> None:
        while (item := self._queue.get()) is not None:
            if self.problem:
                self.dropped += 1
                continue
            try:
                self._write(*item)
            except OSError as error:
                self._fail(error)
            except Exception:  # who ends the recording would wait for ever for a thread that ended by itself
                self.odd += 1
                if self.odd == 1:
                    log.exception("a message of %s is not recorded", item[0])
        try:
            with self._file:
                self._writer.finish()
        except OSError as error:
            self._fail(error)

    def _fail(self, error: OSError) -> None:
        self.dropped += 1
        self._fault = str(error.strerror or error)
        self.problem = tr("The recording has ended: {strerror}.").format(strerror=self._fault)
        log.warning("%s", self.problem)

    def _write(self, topic: str, message: Msg, at: float) -> None:
        if topic not in self._channels:
            kind = type(message)
            schema_id = self._writer.register_schema(kind.MSGTYPE, "jsonschema", schema(kind))
            self._channels[topic] = self._writer.register_channel(topic, "json", schema_id)
        stamp = round(at * 1e9)
        self._writer.add_message(self._channels[topic], stamp, codec.to_json(message), stamp)
