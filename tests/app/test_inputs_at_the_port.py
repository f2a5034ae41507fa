"""Each way an input can die, with the real app and a robot side of its own: when zero speed comes to the robot's port.

It draws nothing, so that it measures the inputs and not the drawing. A busy computer is late at times and a fault is
always: of a few tries the best counts. `pytest -s` prints the figures.
"""

from __future__ import annotations

import json
import math
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from kivy.base import EventLoop
from kivy.core.window import Window

from bench.support.station import serving
from tests.app.sdl_pad import EAST, VirtualPad, kivys_sdl
from tests.e2e.handheld import Handheld, handheld

WATCHED = 0.35
"""How long the port is looked at after a loss [s]."""
LIMIT = 0.2
"""From the loss to zero speed at the port [s]."""
TRIES = 10
PATIENCE = 3.0
"""How long driving off may take before it is tried again [s]."""
ESCAPE = (27, 41)
"""Key code and scan code."""


def nothing() -> None:
    """There is nothing to do."""


class Port:
    """What the robot's port was told, by the same clock as ours."""

    def __init__(self, child: Any) -> None:
        self._child = child
        self._lines: list[tuple[float, bool]] = []
        self._thread = threading.Thread(target=self._read, name="port", daemon=True)
        self._thread.start()

    def _read(self) -> None:
        for line in self._child.process.stdout:
            if line.startswith(('["drive"', '["stop"')):
                what, at, *twist = json.loads(line)
                self._lines.append((at, what == "drive" and any(abs(value) > 1e-6 for value in twist)))

    @property
    def moving(self) -> bool:
        """The newest command moves the robot."""
        return bool(self._lines) and self._lines[-1][1]

    def rested(self, since: float) -> float:
        """From `since` to the first command to rest that no other followed [s]; infinite when there is none."""
        lines = list(self._lines)
        last = max((index for index, (_, moves) in enumerate(lines) if moves), default=-1)
        return lines[last + 1][0] - since if last + 1 < len(lines) else math.inf


class Trial:
    """One handheld on the drive screen, with a finger or a gamepad that loses the stick again and again."""

    def __init__(self, glass: Handheld, port: Port) -> None:
        self.glass, self.port, self.app = glass, port, glass.app
        self.figures: dict[str, float] = {}
        self.pad: VirtualPad | None = None
        self.trembles, self._way = False, -1.0
        self.finger: Any = None

    def ready(self) -> None:
        """Connected, in control, on the drive screen, with a live stick and nothing pushed."""
        if self.app.shell is not None and self.app.shell.screen != "drive":
            self.app.show("drive")
        self.glass.until(
            lambda: self.app.session.control == "mine" and self.app.screens["drive"].stick.state == "live",
            "control and a live stick",
        )
        self.stick = self.app.screens["drive"].stick
        self.glass.settle(self.stick)

    def go(self) -> None:
        """Drive off, each time the other way, and drive on for a while."""
        self.ready()
        self._way = -self._way
        for _ in range(TRIES):
            self._push()
            self.run(0.2)
            end = time.monotonic() + PATIENCE
            while time.monotonic() < end:
                if self.port.moving:
                    return
                self.run(0.0)
            self._let_go()  # the computer was so busy that it counts as let go long ago: once more
        raise AssertionError(f"the robot does not drive off; the glass says: {self.glass.words()}")

    def _push(self) -> None:
        if self.pad is None:
            self.finger = self.glass.push(self.stick, 0.0, 0.9 * self._way)
            return
        self.pad.push(0.0)
        self.run(0.1)
        for _ in range(8):  # however long each takes: it has been looked at since
            EventLoop.idle()
        self.trembles = True

    def _let_go(self) -> None:
        self.trembles = False
        if self.finger is not None:
            self.glass.hand.up(self.finger)
            self.finger = None
        self.run(0.05)

    def tremble(self) -> None:
        """A hand is never quite still."""
        if self.pad is not None and self.trembles:
            self.pad.push((0.9 + 0.01 * (time.monotonic() % 1)) * self._way)

    def run(self, seconds: float) -> None:
        """Let the app run; the hand on the gamepad trembles."""
        end, once = time.monotonic() + seconds, True
        while once or time.monotonic() < end:
            once = False
            self.tremble()
            EventLoop.idle()

    def lose(self, name: str, happens: Callable[[], object], again: Callable[[], object] = nothing) -> None:
        """Drive, lose it, look at the port, make good what happened."""
        self.figures[name] = math.inf
        for _ in range(TRIES):
            age = self._lose_once(happens, again, trembles=name != "silent")
            self.figures[name] = min(self.figures[name], age)
            if age <= LIMIT:
                return

    def _lose_once(
        self, happens: Callable[[], object], again: Callable[[], object], *, trembles: bool
    ) -> float:
        self.go()
        self.trembles = trembles and self.pad is not None
        at = time.monotonic()
        happens()
        self.run(max(0.0, at + WATCHED - time.monotonic()))
        age = self.port.rested(at)
        self.trembles = False
        again()
        self._let_go()
        return age

    def unplug(self) -> None:
        """Pull the gamepad out."""
        if self.pad is not None:
            self.trembles = False
            self.pad.unplug()

    def tell(self) -> None:
        for name, age in self.figures.items():
            print(f"{name:32} {age * 1000:6.0f} ms")  # noqa: T201 - asked for by -s
        late = {name: round(age, 3) for name, age in self.figures.items() if not age <= LIMIT}
        assert not late, late


@pytest.fixture(scope="module")
def robot() -> Iterator[tuple[str, Port]]:
    """A robot side of its own whose port tells what it is told."""
    with serving("bench.support.port", "--robot", "sim:patrol", "--world", "parking_lot") as side:
        yield side.url, Port(side.child)


@pytest.fixture
def trial(robot: tuple[str, Port], tmp_path: Any) -> Iterator[Trial]:
    url, port = robot
    with handheld(tmp_path, url=url, screen="drive", discover=False) as glass:
        glass.until(lambda: glass.app.shell is not None, "the robot's screens")
        yield Trial(glass, port)


def turn(trial: Trial) -> Callable[[], object]:
    size = tuple(Window.size)
    return lambda: setattr(Window, "size", size if tuple(Window.size) != size else size[::-1])


def cover(trial: Trial) -> tuple[Callable[[], object], Callable[[], object]]:
    from app.screens.dialogs import AddressDialog

    dialog = AddressDialog(lambda _: None)
    return lambda: trial.app.root.add_widget(dialog), dialog.close


def press_escape() -> None:
    Window.dispatch("on_key_down", *ESCAPE, None, [])
    Window.dispatch("on_key_up", *ESCAPE)


def release(trial: Trial) -> None:
    trial.glass.until(lambda: trial.app.session.stop_phase == "stopped", "STOPPED")
    trial.app.session.release_stop()
    trial.glass.until(lambda: trial.app.session.stop_phase == "ready", "the release")


def let_go(trial: Trial, pad: VirtualPad) -> None:
    pad.button(EAST, down=False)
    release(trial)


def plug_in(trial: Trial, library: Any) -> None:
    """And it is seen that there is none in between."""
    trial.glass.until(lambda: trial.stick.gamepad == "none", "the gamepad to be gone")
    trial.pad = VirtualPad(library)
    trial.glass.until(lambda: trial.stick.gamepad == "ready", "the gamepad to be seen")


def focus(on: bool) -> None:
    Window._focus = on


def test_a_finger_that_is_lost_has_zero_speed_at_the_port_in_time(trial: Trial) -> None:
    app, hand = trial.app, trial.glass.hand
    over, away = cover(trial)
    trial.lose("lifted", lambda: hand.up(trial.finger))
    trial.lose("end never told", lambda: EventLoop.touches.remove(trial.finger))
    trial.lose("out of focus", lambda: focus(False), lambda: focus(True))
    trial.lose("window hidden", lambda: Window.dispatch("on_hide"))
    turned = turn(trial)
    trial.lose("turned", turned, turned)
    trial.lose("dialog over the stick", over, away)
    trial.lose("another screen", lambda: app.show("mission"))
    trial.lose("frozen for 0.5 s", lambda: time.sleep(0.5))
    trial.lose("paused", app.on_pause, app.on_resume)
    trial.lose("control given up", app.shell.toggle_control, app.session.take_control)
    trial.lose("STOP by Escape", press_escape, lambda: release(trial))
    trial.tell()


def test_a_gamepad_that_is_lost_has_zero_speed_at_the_port_in_time(trial: Trial) -> None:
    library = kivys_sdl()
    if library is None or not hasattr(library, "SDL_JoystickAttachVirtual"):
        pytest.skip("this Kivy brings no SDL with virtual gamepads")
    trial.ready()
    pad = trial.pad = VirtualPad(library)
    trial.glass.until(lambda: trial.stick.gamepad == "ready", "the gamepad to be seen")
    over, away = cover(trial)
    trial.lose("let go", lambda: pad.push(0.0))
    trial.lose("silent", nothing)
    trial.lose("dialog over the stick", over, away)
    trial.lose("out of focus", lambda: focus(False), lambda: focus(True))
    trial.lose("frozen for 0.5 s", lambda: time.sleep(0.5))
    trial.lose("STOP by its button", lambda: pad.button(EAST, down=True), lambda: let_go(trial, pad))
    trial.lose("unplugged", trial.unplug, lambda: plug_in(trial, library))
    trial.unplug()
    trial.tell()
