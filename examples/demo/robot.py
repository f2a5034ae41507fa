"""The robot side as a process of its own, on free ports."""

from __future__ import annotations

import re
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Self

__all__ = ["Restarting", "RobotProcess"]

READY = re.compile(r"^robotside: ready bridge=(?P<bridge>\S+) http=(?P<http>\S+)")


class RobotProcess:
    """`with RobotProcess(...) as robot:` serves until the end of the block."""

    def __init__(self, *options: str, log: Path, patience: float = 60.0) -> None:
        """`options` of `robotside serve`; what it says goes to `log`; it must serve within `patience` [s]."""
        serve = [
            sys.executable,
            "-u",
            "-m",
            "robotside",
            "serve",
            "--port",
            "0",
            "--http-port",
            "0",
            *options,
        ]
        log.parent.mkdir(parents=True, exist_ok=True)
        self._log = log.open("a")
        self._process = subprocess.Popen(serve, stdout=subprocess.PIPE, stderr=self._log, text=True)
        self._ready = threading.Event()
        self._reader = threading.Thread(target=self._read, name="robot's words", daemon=True)
        self._reader.start()
        self.url = ""
        """Where it serves."""
        self.web = ""
        """Its web site."""
        self.pid = self._process.pid
        if not self._ready.wait(patience) or not self.url:
            self.close()
            raise RuntimeError(
                f"The robot side did not serve within {patience:.0f} s; its words are in {log}."
            )

    def _read(self) -> None:
        words = self._process.stdout
        if words is None:
            return
        with words:
            for line in words:
                self._log.write(line)
                self._log.flush()
                match = READY.match(line)
                if match:
                    self.url, self.web = match["bridge"], match["http"]
                    self._ready.set()
        self._ready.set()

    def kill(self) -> None:
        """End it as a power cut would: nothing is sent and nothing saved."""
        self._process.kill()
        self._process.wait()
        self._reader.join(10)

    def close(self) -> int:
        """End it as `kill` would; returns its exit code, 0 when it brought the robot to rest and left."""
        if self._process.poll() is None:
            self._process.terminate()
        deadline = time.monotonic() + 10
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._reader.join(max(0.0, deadline - time.monotonic()))
        self._log.close()
        return self._process.returncode

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Restarting:
    """A robot side whose computer can lose its power and come back at the same address."""

    def __init__(self, *options: str, log: Path) -> None:
        """As of `RobotProcess`."""
        log.unlink(missing_ok=True)
        self._options, self._log = options, log
        self._robot = RobotProcess(*options, log=log)
        self.url = self._robot.url
        """Where it serves, before and after."""
        self._starting: threading.Thread | None = None

    def power_cut(self) -> None:
        """Kill it, and start it again without waiting for it."""
        self._robot.kill()
        self._starting = threading.Thread(target=self._start, name="robot's start")
        self._starting.start()

    def _start(self) -> None:
        port = self.url.rsplit(":", 1)[1].strip("/")
        self._robot = RobotProcess(*self._options, "--port", port, log=self._log)

    def close(self) -> int:
        """As of `RobotProcess`."""
        if self._starting is not None:
            self._starting.join()
        return self._robot.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
