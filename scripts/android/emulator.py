"""A package on an emulator, or on a phone by its cable: installed, connected to a simulated robot on this machine, stopped, turned, photographed.

`python -m scripts.android.emulator APK` says each step, keeps the pictures in out/emulator and ends with 1 where a step failed. What the
phone shows is judged by what the robot tells: the STOP that a tap on the glass gave is the robot's own, with the phone's name on it.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import psutil

from app.layout import arrange
from app.layout.rects import Body, stop_place
from bridge.client.remote_robot import RemoteRobot
from bridge.msgs.pilothouse_msgs import ControlStatus
from scripts.android.failure import Failed, run

__all__ = ["Phone", "Screen", "passes", "served", "stop_point"]

ROOT = Path(__file__).parents[2]
PACKAGE = "io.pilothouse.pilothouse"
ACTIVITY = f"{PACKAGE}/org.kivy.android.PythonActivity"
HOST = "10.0.2.2"
"""What an emulator calls the machine that it runs on; a phone on a cable needs `adb reverse` and 127.0.0.1."""
PORT = 9190
PATIENCE = 90.0
"""A first start unpacks the app [s]."""
SERVES = 60.0
"""From its start until the robot side takes connections [s]."""
ANSWERS = 5.0
"""From a tap on STOP to the robot's word [s], on an emulator that draws by its processor."""


class Screen(NamedTuple):
    """What Android draws on."""

    width: int
    height: int
    dp: float
    """Pixels of one dp."""


def stop_point(screen: Screen) -> tuple[int, int]:
    """The middle of STOP, in pixels from the upper left corner as Android counts: where the app's own rules put it."""
    shape = arrange.form(screen.width, screen.height, screen.dp)
    room = arrange.shell(screen.width, screen.height, screen.dp)["body"]
    place = stop_place(Body(room.x, room.y, room.width, room.height), shape, screen.dp)
    return round(place.x + place.width / 2), round(screen.height - place.y - place.height / 2)


class Phone:
    """An Android device, by adb."""

    def __init__(self, adb: str = "adb") -> None:
        """`adb` is the program."""
        self._adb = adb

    def _run(self, *command: str, limit: float = 60.0) -> str:
        return run(self._adb, *command, where=ROOT, limit=limit)

    def shell(self, *command: str) -> str:
        """What a command of the device prints."""
        return self._run("shell", *command)

    def install(self, package: Path) -> None:
        """With every permission granted: no question of Android's is in the way."""
        self._run("install", "-r", "-g", str(package), limit=300.0)

    def open(self, link: str) -> None:
        """Start the app by a link, as a QR code does."""
        self.shell("am", "start", "-W", "-a", "android.intent.action.VIEW", "-d", f"'{link}'", "-n", ACTIVITY)

    def turn(self, quarters: int) -> None:
        """Hold it upright (0) or on its side (1)."""
        self.shell("settings", "put", "system", "accelerometer_rotation", "0")
        self.shell("settings", "put", "system", "user_rotation", str(quarters))

    def screen(self) -> Screen:
        """As it is held now."""
        shown = self.shell("dumpsys", "window", "displays").partition("cur=")[2].split()[0]
        width, height = (int(part) for part in shown.split("x"))
        density = self.shell("wm", "density").split()[-1]
        return Screen(width, height, int(density) / 160)

    def tap(self, x: int, y: int) -> None:
        """One finger, down and up."""
        self.shell("input", "tap", str(x), str(y))

    def process(self) -> str:
        """The app's number; empty where it does not run."""
        return self.shell("pidof", PACKAGE, "||", "true").strip()

    def photograph(self, to: Path) -> None:
        """What is on the glass, as PNG; Failed where that is none."""
        done = subprocess.run(
            [self._adb, "exec-out", "screencap", "-p"], capture_output=True, check=False, timeout=60
        )
        if not done.stdout.startswith(b"\x89PNG"):
            raise Failed("the device gives no picture of its glass.")
        to.write_bytes(done.stdout)


@contextmanager
def served(port: int) -> Iterator[psutil.Process]:
    """A simulated robot on this machine alone, where an emulator and a cable come from, until the block ends."""
    with tempfile.TemporaryDirectory() as state:
        command = [sys.executable, "-m", "robotside", "serve", "--robot", "sim:patrol", "--no-ask",
                   "--port", str(port), "--http-port", "0", "--state", state, "--with-parent"]  # fmt: skip
        server = psutil.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            yield server
        finally:
            server.terminate()
            server.wait(10)


def until(holds: Callable[[], bool], what: str, seconds: float) -> None:
    """Failed with `what` where it does not hold within that time."""
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            raise Failed(f"waited {seconds:.0f} s for {what}.")
        time.sleep(0.1)


class _Watcher:
    """What the robot says of control, heard beside the phone."""

    def __init__(self, robot: RemoteRobot) -> None:
        self._told = threading.Condition()
        self._status = ControlStatus()
        robot.on("/control/status", self._hear)

    def _hear(self, status: ControlStatus) -> None:
        with self._told:
            self._status = status
            self._told.notify_all()

    def stopped_by(self, seconds: float) -> str:
        """Who stopped the robot, waiting so long for it; Failed where nobody did."""
        with self._told:
            if not self._told.wait_for(lambda: self._status.stopped, seconds):
                raise Failed(f"STOP was tapped, and after {seconds:.0f} s the robot is not stopped.")
            return self._status.stopped_by


def _connections(server: psutil.Process, port: int) -> int:
    return sum(
        1 for one in server.net_connections("tcp") if one.status == "ESTABLISHED" and one.laddr.port == port
    )


def passes(
    phone: Phone, package: Path, out: Path, *, host: str = HOST, port: int = PORT, patience: float = PATIENCE
) -> Iterator[str]:
    """Every step, with a line for each that held; Failed at the first that did not."""
    out.mkdir(parents=True, exist_ok=True)
    phone.install(package)
    yield f"installed: {package.name}"
    with served(port) as server, RemoteRobot(f"ws://127.0.0.1:{port}") as robot:
        robot.wait(SERVES)
        watcher, before = _Watcher(robot), _connections(server, port)
        phone.turn(0)
        phone.open(f"pilothouse://{host}:{port}?n=Patrol")
        until(lambda: _connections(server, port) > before, "the phone to connect", patience)
        process = phone.process()
        yield f"connected: the app runs as {process}"
        phone.photograph(out / "upright.png")
        phone.turn(1)
        until(lambda: phone.screen().width > phone.screen().height, "the glass to turn", patience)
        phone.photograph(out / "turned.png")
        if phone.process() != process:
            raise Failed("the app ended, or began anew, when the phone was turned.")
        yield "turned: the same process goes on"
        phone.tap(*stop_point(phone.screen()))
        yield f"stopped: by {watcher.stopped_by(ANSWERS)!r}, as the robot says"
        phone.photograph(out / "stopped.png")
        phone.turn(0)
    yield f"pictures: {out}"


def main() -> int:
    """The program."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.android.emulator", description=__doc__.split("\n", 1)[0] if __doc__ else ""
    )
    parser.add_argument("package", type=Path, help="the APK")
    parser.add_argument(
        "--host", default=HOST, help="this machine as the device calls it; default %(default)s, an emulator's"
    )
    parser.add_argument(
        "--port", type=int, default=PORT, help="port of the simulated robot, default %(default)s"
    )
    parser.add_argument("--out", type=Path, default=ROOT / "out/emulator", help="folder of the pictures")
    parser.add_argument("--adb", default="adb", help="the program that talks to the device")
    given = parser.parse_args()
    try:
        for line in passes(Phone(given.adb), given.package, given.out, host=given.host, port=given.port):
            print(line, flush=True)
    except Failed as failure:
        print(f"emulator: {failure}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
