"""A stick on the glass with all the hands that push it, in virtual time, and every way in which one of them is lost."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import pytest

from app.inputs.gamepad.sdl import PadState
from app.intents.intents import Intents
from app.intents.method_permits import MethodPermits
from app.link.drive_slot import DriveSlot
from bridge.msgs.geometry_msgs import Twist
from tests.headless import Stage

__all__ = [
    "BACK",
    "ESCAPE",
    "LOSSES",
    "PAD",
    "SPACE",
    "STEP",
    "Hands",
    "Settings",
    "hands",
    "paused",
    "press",
    "small_card",
    "upright",
]

LIMIT = 0.2
"""From the loss to the last command that moves the robot [s]."""
STEP = 1 / 128
PAD = PadState(1, "Pad", 0.0, 0.0, stop=False, stop_button=1, raw=(0,))
ESCAPE, SPACE = (27, 41), (32, 44)
"""Key codes and scan codes."""
BACK = (27, 270)


class Source:
    """What SDL would tell."""

    def __init__(self) -> None:
        self.there: dict[int, PadState] = {}
        self.trembles, self.count = True, 0
        self.gone: set[Any] = set()
        self.keys: set[int] = set()

    def pads(self) -> list[PadState]:
        self.count += self.trembles
        return [replace(state, raw=(self.count,)) for state in self.there.values()]

    def lifted(self, device: str, finger: Any) -> bool:
        return finger in self.gone

    def key(self, scancode: int) -> bool:
        return scancode in self.keys

    def close(self) -> None:
        """Nothing to close."""


class Session:
    """The robot may be driven over a link that is the sender itself."""

    may_drive = True

    def __init__(self, link: DriveSlot) -> None:
        self.link = link


class Shell:
    """As much of the frame round the screens as the inputs ask for."""

    def __init__(self, screen: Any, stop: Any) -> None:
        self.screens, self.screen, self.stop = {"drive": screen, "mission": object()}, "drive", stop
        self.said: list[str] = []
        self.offers: list[tuple[str, Callable[[], None]]] = []
        self.notices = self

    def rest(self) -> None:
        self.screens["drive"].stick.rest()

    def say(self, text: str, level: str, about: str) -> None:
        self.said.append(text)

    def unsay(self, about: str) -> None:
        """Nothing is said any longer."""

    def offer(self, text: str, action: str, act: Callable[[], None], icon: str) -> None:
        self.offers.append((text, act))


class Corner:
    """STOP ALL of the connect screen."""

    def __init__(self) -> None:
        self.robots = self.presses = 0
        self.button = self

    def press(self) -> None:
        self.presses += 1


class Settings(dict[str, Any]):
    def set(self, name: str, value: Any) -> None:
        self[name] = value


class Stops:
    """What the app does of what is wanted: Back, and STOP where there is somebody to be stopped."""

    def __init__(self, hands: Any) -> None:
        self._hands = hands

    def why_not(self, intent: str) -> str:
        if intent != "stop":
            return ""
        known = self._hands.shell is not None or self._hands.session is not None
        return "" if known or self._hands.corner.button.robots else "No robot is known that could be stopped."

    def words(self, intent: str) -> str:
        return intent

    def do(self, intent: str) -> None:
        (self._hands.inputs.stop if intent == "stop" else self._hands.back)()

    def answer(self, yes: bool) -> str:
        return ""


class Hands:
    """A stick on the glass, its way to the sender, and everything that can happen to either."""

    def __init__(self, stage: Stage) -> None:
        from kivy.uix.floatlayout import FloatLayout

        from app.inputs.inputs import Inputs
        from widgets import Joystick, StopButton

        self.stage, self.source, self.slot = stage, Source(), DriveSlot(stage.time)
        self.session = Session(self.slot)
        self.devices, self.turn = frozenset({1, 2}), 0
        self.settings: dict[str, Any] = {}
        self.page = FloatLayout()
        self.stick = Joystick(max_speed=0.5, size_hint=(None, None), size=(200, 200), pos=(100, 100))
        self.stop = StopButton(size_hint=(None, None), size=(100, 100), pos=(1000, 0))
        self.stops = 0
        self.stop.bind(on_command=self._stopped)
        self.page.add_widget(self.stick)
        self.page.add_widget(self.stop)
        self.root = FloatLayout()
        self.root.add_widget(self.page)
        stage.show(self.root, stage.window.size)
        screen: Any = type("Screen", (), {"stick": self.stick, "sticks": [(self.stick, "left")]})
        self.shell: Any = Shell(screen, self.stop)
        self.stick.bind(on_command=lambda _, twist: self.slot.want(twist))
        self.sent: list[tuple[float, Twist]] = []
        self.corner = Corner()
        self.intents = Intents(Stops(self), MethodPermits(Settings()), stage.time)
        self.frozen = False
        self._beaten = 0.0
        self.back_pressed = 0
        self.inputs = Inputs(
            self, stage.time, self.source, devices=lambda: self.devices, turned=lambda: self.turn
        )
        self.inputs.open()

    # what the inputs ask the app for

    def back(self) -> bool:
        self.back_pressed += 1
        return True

    def _stopped(self, _: object) -> None:
        self.stops += 1

    # what the test does

    def pass_time(self, seconds: float) -> None:
        end = self.stage.time.now + seconds
        while self.stage.time.now < end:
            if self.frozen:
                self.stage.time.now += STEP
            else:
                self.stage.frames(1, STEP)
                if self.stage.time.now - self._beaten >= 0.03:
                    self._beaten = self.stage.time.now
                    self.inputs.update()
                    self.slot.beat()
            if (twist := self.slot.due()) is not None:
                self.sent.append((self.stage.time.now, twist))

    @property
    def moving(self) -> bool:
        return bool(self.sent) and self.sent[-1][1] != Twist()

    def push(self) -> Any:
        """A finger pushes the stick ahead and rests there without a move for a second."""
        touch = self.stage.touch(200, 200)
        touch.touch_down()
        touch.touch_move(200, 290)
        self.pass_time(1.0)
        assert self.moving
        return touch

    def lean(self) -> None:
        """A gamepad pushes it ahead for a second."""
        self.source.there = {1: PAD}
        self.pass_time(0.1)
        self.source.there = {1: replace(PAD, forward=1.0)}
        self.pass_time(1.0)
        assert self.moving

    def rests_in_time(self, lost: float) -> None:
        """And stays at rest."""
        self.pass_time(1.5)
        last = max(at for at, twist in self.sent if twist != Twist())
        assert last - lost <= LIMIT
        assert not self.moving

    def cover(self) -> Any:
        from app.screens.parts.dialogs import AddressDialog

        dialog = AddressDialog(lambda _: None)
        self.root.add_widget(dialog)
        return dialog


@pytest.fixture
def hands(stage: Stage) -> Iterator[Hands]:
    hands = Hands(stage)
    yield hands
    hands.inputs.close()


def small_card(hands: Hands, pos: tuple[int, int] = (40, 90)) -> None:
    from widgets.parts.kit import Card

    hands.page.add_widget(Card(size_hint=(None, None), size=(120, 60), pos=pos))


def end_unseen(hands: Hands, touch: Any) -> None:
    """Kivy forgets the touch and the stick is never told."""
    hands.stage.loop.touches.remove(touch)


def end_in_sdl(hands: Hands, touch: Any) -> None:
    """Kivy dropped the end, as it does while the app is paused; SDL knows it."""
    hands.source.gone.add(touch.id)


def come_again(hands: Hands, touch: Any) -> None:
    """The end was lost and the next finger, elsewhere, has the same number: Kivy makes it the same touch."""
    touch.sx, touch.sy = 0.9, 0.05
    touch.touch_down()
    touch.touch_move(200, 290)


def come_again_on_stop(hands: Hands, touch: Any) -> None:
    """As before, and the stick never sees it come down."""
    width, height = hands.stage.window.size
    touch.sx, touch.sy = 1050 / width, 50 / height
    touch.move({"x": 1050 / width, "y": 50 / height})
    hands.stage.loop.touches.remove(touch)
    touch.touch_down()
    assert hands.stop.pressed


def paused(hands: Hands) -> Callable[[], object]:
    """As the app does, and then it runs no longer."""
    hands.inputs.rest()
    hands.frozen = True
    return lambda: setattr(hands, "frozen", False)


def press(hands: Hands, keys: tuple[int, int]) -> None:
    """The key goes down, repeats as long as it is held, and up."""
    window = hands.stage.window
    for _ in range(3):
        if not window.dispatch("on_key_down", *keys, None, []):
            window.dispatch("on_keyboard", *keys, None, [])
    window.dispatch("on_key_up", *keys)


LOSSES: dict[str, Callable[[Hands, Any], object]] = {
    "lifted": lambda hands, touch: touch.touch_up(),
    "cancelled by the system": lambda hands, touch: touch.touch_up(),  # which is what SDL makes of it
    "end never told": end_unseen,
    "end held back by Kivy": lambda _, touch: touch.update_time_end(),
    "end dropped in a pause": end_in_sdl,
    "number given to another finger": come_again,
    "number given to another finger, on STOP": come_again_on_stop,
    "out of focus": lambda hands, _: setattr(hands.stage.window, "_focus", False),
    "hidden": lambda hands, _: hands.stage.window.dispatch("on_hide"),
    "minimised": lambda hands, _: hands.stage.window.dispatch("on_minimize"),
    "turned": lambda hands, _: setattr(hands.stage.window, "size", (800, 1280)),
    "turned upside down": lambda hands, _: setattr(hands, "turn", 2),
    "dialog over it": lambda hands, _: hands.cover(),
    "card over it": lambda hands, _: small_card(hands),
    "moved by the layout": lambda hands, _: setattr(hands.stick, "y", 180),
    "another screen": lambda hands, _: (hands.shell.rest(), setattr(hands.shell, "screen", "mission")),
    "may not drive": lambda hands, _: setattr(hands.session, "may_drive", False),
    "disabled": lambda hands, _: setattr(hands.stick, "state", "disabled"),
    "frozen": lambda hands, _: setattr(hands, "frozen", True),
    "paused": lambda hands, _: paused(hands),
}


@pytest.fixture
def upright(hands: Hands) -> Iterator[None]:
    """Puts the window back as it was."""
    window = hands.stage.window
    size = tuple(window.size)
    yield
    window.size, window._focus = size, True
