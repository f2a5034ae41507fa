"""`serve` at a real terminal: asked once, kept, and not asked again."""

from __future__ import annotations

import os
import pty
import re
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from robotside.core.config import load

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
LIMIT = 120.0
"""For each thing that is to appear [s]; a fault that hangs ends the test."""
ENTER, SPACE = b"\r", b" "
WHERE_IS_THE_CURSOR = b"\x1b[6n"
_ESCAPES = re.compile(rb"\x1b\[[0-9;?]*[A-Za-z]")


class Terminal:
    """A program at a terminal of its own."""

    def __init__(self, words: list[str], home: Path) -> None:
        self._ours, theirs = pty.openpty()
        own = {
            "XDG_STATE_HOME": str(home),
            "TERM": "xterm",
            "PYTHONPATH": str(ROOT),
            "COLUMNS": "120",
            "PILOTHOUSE_NO_ASK": "",
        }
        command = [sys.executable, "-m", "robotside", *words]
        # who runs the tests by nohup has it ignored, and what is ignored stays so in a child
        before = signal.signal(signal.SIGHUP, signal.SIG_DFL)
        try:
            self.process = subprocess.Popen(
                command,
                stdin=theirs,
                stdout=theirs,
                stderr=theirs,
                cwd=home,
                env={**os.environ, **own},
                start_new_session=True,
            )
        finally:
            signal.signal(signal.SIGHUP, before)
        os.close(theirs)
        self.seen = b""
        self.told = False
        """It was told to end already."""

    def press(self, *keys: bytes) -> None:
        os.write(self._ours, b"".join(keys))

    def until(self, text: str) -> str:
        """What was shown up to `text`, which is waited for; the rest stays for the next call."""
        end = time.monotonic() + LIMIT
        while text.encode() not in self._plain():
            left = end - time.monotonic()
            assert left > 0, f"{text!r} never came; there is {self._plain()!r}"
            if not select.select([self._ours], [], [], left)[0]:
                continue
            try:
                self._take(os.read(self._ours, 65536))
            except OSError:  # it has ended
                assert text.encode() in self._plain(), f"It ended without {text!r}: {self._plain()!r}"
        before, _, self.seen = self._plain().partition(text.encode())
        return before.decode() + text

    def _take(self, said: bytes) -> None:
        self.seen += said
        if WHERE_IS_THE_CURSOR in said:
            self.press(b"\x1b[1;1R")

    def _plain(self) -> bytes:
        return _ESCAPES.sub(b"", self.seen)

    def close(self) -> int:
        """End it if it has not ended; its exit status."""
        if self.process.poll() is None and not self.told:
            self.process.send_signal(signal.SIGTERM)
        try:
            while select.select([self._ours], [], [], LIMIT)[0] and os.read(self._ours, 65536):
                pass
        except OSError:  # it has ended
            pass
        code = self.process.wait(LIMIT)
        os.close(self._ours)
        return code


FREE = ["serve", "--port", "0", "--http-port", "0"]


def test_serve_asks_once_and_starts_at_once_the_next_time(tmp_path: Path) -> None:
    first = Terminal(FREE, tmp_path)
    try:
        for question, keys in {
            "Which robot?": [ENTER],
            "In which world?": [ENTER],
            "Which payloads": [SPACE, ENTER],  # not its camera
            "Who can reach it?": [ENTER],
            "Port of rosbridge": [ENTER],
            "Port of the web site": [ENTER],
            "Which protocols": [ENTER],
        }.items():
            first.until(question)
            first.press(*keys)
        kept = first.until("asks again.")
        assert str(tmp_path / "pilothouse" / "robot.toml") in kept.replace("\r\n", "")
        first.until("robotside: ready bridge=ws://127.0.0.1:")
    finally:
        assert first.close() == 0
    config = load(tmp_path / "pilothouse" / "robot.toml")
    assert (config.serve.robot, config.serve.without) == ("sim:patrol", ("camera",))
    second = Terminal(FREE, tmp_path)
    try:
        assert "Which" not in second.until("robotside: ready")
        second.until("Camera is off")
        second.process.send_signal(signal.SIGHUP)  # the window is closed
        second.told = True
    finally:
        assert second.close() == 0


def test_who_presses_ctrl_c_has_nothing_served_and_nothing_kept(tmp_path: Path) -> None:
    asked = Terminal(FREE, tmp_path)
    try:
        asked.until("Which robot?")
        asked.press(ENTER)
        asked.until("In which world?")
        asked.press(b"\x03")
        asked.until("Nothing is served, and nothing was kept.")
        assert asked.process.wait(LIMIT) == 130
    finally:
        asked.close()
    assert list(tmp_path.rglob("*")) == []
