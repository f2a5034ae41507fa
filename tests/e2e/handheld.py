"""The real app with real fingers, a real robot side, and a cable between them that a test can freeze or cut."""

from __future__ import annotations

import asyncio
import gc
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from kivy.base import EventLoop, runTouchApp
from kivy.clock import Clock
from kivy.uix.widget import Widget

from examples.demo.fingers import Finger, Hand
from examples.demo.frames import seldom_drawn
from examples.demo.glass import Glass, middle
from tests.bridge.wires import Wire, wire

PATIENCE = 15.0
"""How long a test waits for what must happen [s]; a fault, not a delay, uses it up."""
LEFT_FREE = 1.0
"""Control that is free for so long is not about to be taken [s]."""
HELPS = 2
"""So often a story may take again what a machine that stood still has lost."""
DRAWN = 20
"""One frame in so many is drawn: a processor that had to draw them all would have no time left for what is tested."""


class Handheld:
    """The app, moved on frame by frame by the test in real time."""

    def __init__(self, app: Any, hand: Hand) -> None:
        self.app, self.hand, self.glass = app, hand, Glass(hand)

    def until(self, condition: Callable[[], Any], what: str, seconds: float = PATIENCE) -> Any:
        """Let the app run until `condition` holds and return what it gave; fails with `what` when it does not."""
        end = time.monotonic() + seconds
        while not (found := condition()):
            assert time.monotonic() < end, f"waited {seconds:g} s for {what}; the glass says: {self.words()}"
            EventLoop.idle()
        return found

    def ask(self, act: Callable[[], object], answered: Callable[[], Any], what: str) -> Any:
        """Do `act`, wait until it is `answered` and return what that gave.

        A machine that stands still for three seconds loses the link, and with it what was asked; then it is asked anew when the
        link is back, as a person would.
        """
        helps, lost = iter(range(HELPS)), False
        act()

        def heard() -> Any:
            nonlocal lost
            session = self.app.session
            if session is None or not session.connected:
                lost = True
            elif lost:
                lost = False
                assert next(helps, None) is not None, "the link is lost again and again"
                act()
            return answered()

        return self.until(heard, what)

    def run(self, seconds: float) -> None:
        """Let the app run for so long."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            EventLoop.idle()

    def tap(self, words: str, kind: str = "Widget") -> None:
        """Tap what says `words`, when it stands still and says them yet: a list may give its row to something else meanwhile."""
        for _ in range(HELPS + 1):
            found = self.until(lambda: self.glass.labelled(words, kind), f"something that says {words!r}")[0]
            self.settle(found)
            if found in self.glass.labelled(words, kind):
                break
        self.play(self.hand.tap(middle(found)))

    def settle(self, widget: Widget) -> None:
        """Wait until the layout leaves `widget` where it is, as a person does before touching it."""
        places = [middle(widget)]
        self.until(
            lambda: places.append(middle(widget)) or (len(places) > 5 and len(set(places[-5:])) == 1),
            "it to stand still",
        )

    def play(self, steps: Iterator[None]) -> None:
        """Carry a gesture through."""
        for _ in steps:
            EventLoop.idle()

    def one(self, kind: str) -> Any:
        """The visible widget of class `kind`."""
        return self.until(lambda: self.glass.all(kind), f"a {kind}")[0]

    @property
    def asked(self) -> str:
        """Which request for control of this handheld the robot granted last; empty before it did."""
        session = self.app.session
        outcome = None if session is None else session.outcomes.get("acquire")
        return outcome.command_id if outcome is not None and outcome.phase == "accepted" else ""

    def control(self, since: str = "") -> None:
        """Wait until this handheld has control, which it has to take by itself whenever it connects.

        A machine that stands still for two seconds loses it to nobody; then it is taken again, as a person would, if the robot
        had granted what the handheld itself asked for after `since`, as of `asked`.
        """
        free: list[float] = []
        helps = iter(range(HELPS))

        def mine() -> bool:
            session = self.app.session
            if session is None or session.control != "free":
                free.clear()
            else:
                free.append(time.monotonic())
                if free[-1] - free[0] > LEFT_FREE and self.asked not in ("", since):
                    free.clear()
                    assert next(helps, None) is not None, "control is lost again and again"
                    session.take_control()
            return session is not None and bool(session.control == "mine")

        self.until(mine, "control")

    def push(self, stick: Widget, left: float, forward: float) -> Finger:
        """Put a finger on the stick and push it out; it stays there."""
        x, y = middle(stick)
        finger = self.hand.down((x, y))
        reach: float = stick.reach  # type: ignore[attr-defined]
        for share in (0.3, 0.6, 1.0):
            self.hand.move(finger, (x - left * reach * share, y + forward * reach * share))
        return finger

    def drive(self, stick: Any, moves: Callable[[], Any], seconds: float = PATIENCE) -> Finger:
        """Push the stick forward until the robot moves; the finger stays on it.

        A stick that springs back under the finger, as when the machine stood still, is pushed anew, as a person would.
        """
        finger = self.push(stick, 0.0, 1.0)
        end = time.monotonic() + seconds
        while not moves():
            assert time.monotonic() < end, (
                f"waited {seconds:g} s for the robot to drive; the glass says: {self.words()}"
            )
            EventLoop.idle()
            if stick.finger is None and not self.hand.busy:
                self.hand.up(finger)
                self.until(lambda: stick.state == "live", "a stick to push anew")
                finger = self.push(stick, 0.0, 1.0)
        return finger

    def words(self) -> list[str]:
        """Everything that can be read on the glass."""
        return self.glass.texts()


@contextmanager
def handheld(settings: Path, **options: Any) -> Iterator[Handheld]:
    """The app with its settings in a folder; closed at the end of the block."""
    from app.application import PilothouseApp

    gc.collect()  # what the last story left, which would hold this one up in the middle
    app, hand = PilothouseApp(settings_dir=settings, **options), Hand()
    unpaced, Clock._max_fps = (
        Clock._max_fps,
        60,
    )  # as the app itself runs: a loop that never rests starves the network
    EventLoop.add_input_provider(hand)
    app._run_prepare()
    runTouchApp(embedded=True)
    try:
        with seldom_drawn(DRAWN):
            yield Handheld(app, hand)
    finally:
        app.stop()
        EventLoop.remove_input_provider(hand)
        for child in list(EventLoop.window.children):
            EventLoop.window.remove_widget(child)
        Clock._max_fps = unpaced


class Cable:
    """A `Wire` that lives in a thread of its own, for tests that are no coroutines."""

    def __init__(self, to: int) -> None:
        self._to = to
        self._loop = asyncio.new_event_loop()
        self._done = asyncio.Event()
        self._ready = threading.Event()
        self._thread = threading.Thread(
            target=self._loop.run_until_complete, args=(self._serve(),), name="cable"
        )
        self._thread.start()
        self._ready.wait(PATIENCE)

    async def _serve(self) -> None:
        async with wire(self._to) as self._wire:
            self._ready.set()
            await self._done.wait()

    @property
    def url(self) -> str:
        """To connect through it."""
        return f"ws://127.0.0.1:{self._wire.port}"

    def freeze(self) -> None:
        """Nothing passes any more and nobody is told, as when a phone walks out of range."""
        self._loop.call_soon_threadsafe(self._wire.freeze)

    def thaw(self) -> None:
        """Everything that waited in the cable arrives, late."""
        self._loop.call_soon_threadsafe(self._wire.thaw)

    def cut(self) -> None:
        """Every connection breaks; new ones may come."""
        self._loop.call_soon_threadsafe(self._wire.cut)

    def close(self) -> None:
        """Break everything and end."""
        self._loop.call_soon_threadsafe(self._done.set)
        self._thread.join(PATIENCE)
        self._loop.close()


__all__ = ["Cable", "Handheld", "Wire", "handheld"]
