"""An app on the drive screen of a robot, put away as a phone is put into a pocket, for tests that go on from there.

To connect and to make the screens takes longer than most tests of them. So a process does that once and puts the app
away; each test is a fork of it, where the app is given back as to anybody who takes the phone out of the pocket: it
connects anew, to a robot of the test's own. What the app is, wakes and says is its own code; only the threads that a
fork does not take along are started again here.
"""

from __future__ import annotations

import socket
import threading
from pathlib import Path

from app.core.newest_worker import NewestWorker
from bridge.core.network_thread import NetworkThread
from tests.app.fakes import FakeRobot
from tests.app.glass import PATIENCE, Glass
from tests.headless import Stage

__all__ = ["Sleeper", "sleeper"]


class Sleeper:
    """Made once in a process; `move` and `wake` belong into a fork of it."""

    def __init__(self, folder: Path) -> None:
        """`folder` is where the app believes that its settings are, in each fork another place."""
        from app.garbage_collector import Collector

        Collector.step = lambda *_, **__: None  # a look at all that an app is takes as long as half a test
        self._home = folder / "home"
        (folder / "first").mkdir()
        self._home.symlink_to(folder / "first")
        # nobody is given this port meanwhile, and who asks for it by name may still listen there
        self._kept = socket.socket()
        self._kept.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self._kept.bind(("127.0.0.1", 0))
        self.port: int = self._kept.getsockname()[1]
        """Where the robot has to serve that the app connects to."""
        self.stage = Stage()
        robot = FakeRobot(self.port)
        try:
            self.glass = Glass.start(self.stage, self._home)
            app = self.glass.app
            app.open(robot.url)
            self.glass.drives()
            for screen in ("tasks", "topics", "drive"):
                app.show(screen)
                self.stage.frames(3)
            self.glass.until(lambda: not app._idle.left, "something is not ready")
            app.on_pause()
            self.glass.until(lambda: not app.session.connected, "still connected")
        finally:
            robot.close()
        self._end_threads()

    def _end_threads(self) -> None:
        """A fork takes none along."""
        app = self.glass.app
        self._network = app._network._network
        self._network.close()
        app.settings.close()
        responses = app.methods.get("log").archive.log  # begins its thread anew by itself
        responses._give(None)
        responses._thread.join(PATIENCE)
        responses._thread = None
        running = [thread.name for thread in threading.enumerate() if thread is not threading.main_thread()]
        assert not running, running

    def move(self, home: Path) -> None:
        """From now on its settings are in `home`."""
        self._home.unlink()
        self._home.symlink_to(home)

    def wake(self, robot: FakeRobot) -> None:
        """Give the app back, in front of `robot`, which is at `port`, until it has control there."""
        writer = self.glass.app.settings._writer
        NetworkThread.__init__(self._network)
        NewestWorker.__init__(writer, writer._work, writer._name)
        app = self.glass.app
        app.on_resume()
        # what it knows is of before it slept
        self.glass.until(lambda: robot.control.driver, "has not asked for control")
        self.glass.until(lambda: app.session.control_status == robot.control, "has not heard of it")
        app.shell.unsay("authority")  # that control lapsed and came back
        self.glass.until(lambda: not self.glass.banners(), "something is said")


_here: Sleeper | None = None


def sleeper() -> Sleeper | None:
    """The one of this process; None where each test starts an app of its own."""
    return _here


def lay(folder: Path) -> None:
    """Put one to sleep in this process."""
    global _here  # noqa: PLW0603 - a process has one
    _here = Sleeper(folder)
