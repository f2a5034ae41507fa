"""Gamepads: which one drives, how far it leans, and when it must not, because it went, says nothing, or was never let go.

What they measure comes from SDL (`app.inputs.gamepad.sdl`) or, where that cannot be asked, from Kivy's events (`KivyPads`).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass

from app.inputs.gamepad.pad_map import Profile
from app.inputs.gamepad.sdl import PadState

__all__ = ["SILENCE_TIMEOUT", "Gamepads", "PadEvent", "KivyPads"]

SILENCE_TIMEOUT = 0.12
"""A pushed gamepad that measures nothing new for longer drives nothing [s]."""
REARM_TIMEOUT = 1.0
"""After a longer silence its stick must be let go before it drives again [s]."""
AXES, RIGHT_AXES, FOUR = (0, 1), (2, 3), ("a", "b", "x", "y")
"""Axes of the left and of the right stick and the four buttons, as most gamepads number them."""


@dataclass(frozen=True, slots=True)
class PadEvent:
    """Something about a gamepad that the operator is told."""

    what: str
    """`plugged`, `unplugged`, `unplugged driving`, or `silent`."""
    name: str


@dataclass(slots=True)
class _Known:
    """What is remembered of a gamepad that is plugged in."""

    state: PadState
    alive: float
    """When it measured something new [s]."""
    centred: bool = False
    """Its stick was let go since it was last forbidden to drive."""
    told_silent: bool = False


class Gamepads:
    """Looked at with each heartbeat of the user interface."""

    def __init__(
        self,
        now: Callable[[], float],
        *,
        on_news: Callable[[PadEvent], object],
        wired: Collection[str] = (),
        profile: Callable[[str], Profile] = lambda _: Profile(),
    ) -> None:
        """`wired` names those that hang on a cable: they may be silent, since one that is pulled out is gone at once.

        `profile` gives what the sticks and buttons of the gamepad of that name mean now.
        """
        self._now, self._on_news = now, on_news
        self.wired, self.profile = wired, profile
        self.on = True
        """They drive; whatever is pushed while they do not must be let go first."""
        self.sticks: frozenset[str] = frozenset({"left"})
        """Those that push something now, of `left` and `right`; the other one is not looked at."""
        self._known: dict[int, _Known] = {}
        self._driver: int | None = None

    @property
    def standing(self) -> str:
        """What the stick shows: `none`, `ready`, `drives`, `silent`, or `let go` for one that is pushed and may not drive."""
        if not self._known:
            return "none"
        if self._driver is not None:
            return "drives"
        if any(known.told_silent for known in self._known.values()):
            return "silent"
        return "let go" if any(self._pushed(known) for known in self._known.values()) else "ready"

    @property
    def states(self) -> list[PadState]:
        """What each of those that are plugged in measured last."""
        return [known.state for known in self._known.values()]

    def age(self, number: int) -> float:
        """Since when it has measured nothing new [s]; 0 for one that is not known."""
        known = self._known.get(number)
        return self._now() - known.alive if known is not None else 0.0

    def silent(self, number: int) -> bool:
        """What it says to hold is held by nobody who is known to be there: it measures nothing new, and hangs on no cable."""
        return self.age(number) > SILENCE_TIMEOUT and self.name(number) not in self.wired

    def update(self, states: Iterable[PadState]) -> None:
        """Take in what is plugged in now and what it measures; news are told from here."""
        there = {state.number: state for state in states}
        for number in self._known.keys() - there.keys():
            self._lose(number)
        for number, state in there.items():
            known = self._known.get(number)
            if known is None:
                self._known[number] = _Known(state, self._now())
                self._on_news(PadEvent("plugged", state.name))
                continue
            if state.raw != known.state.raw:
                if self._now() - known.alive > REARM_TIMEOUT and self._pushed(known):
                    known.centred = False
                known.alive = self._now()
            known.state = state

    def use(self, sticks: Collection[str]) -> None:
        """Look at these sticks from now on, of `left` and `right`; where they are others than before, all must be let go first."""
        if frozenset(sticks) != self.sticks:
            self.sticks = frozenset(sticks)
            self.forbid()

    def is_stop(self, number: int, button: str) -> bool:
        """The button of that name means STOP on that gamepad."""
        return button in self.profile(self.name(number)).stops

    def name(self, number: int) -> str:
        """What that gamepad calls itself."""
        known = self._known.get(number)
        return known.state.name if known is not None else "Gamepad"

    def button(self, number: int, button: int) -> str:
        """What Kivy's number of one of its buttons is called."""
        known = self._known.get(number)
        names = known.state.names if known is not None else {}
        usual = FOUR[button] if not names and button < len(FOUR) else f"button {button}"
        return names.get(button, usual)

    def lose(self) -> None:
        """The system took an input device away and does not say which: no gamepad drives until it is let go."""
        if self._driver is not None:
            self._on_news(PadEvent("unplugged driving", self._known[self._driver].state.name))
        self.forbid()

    def forbid(self) -> None:
        """Nothing may be driven now: each gamepad must be let go before it drives again."""
        self._driver = None
        for known in self._known.values():
            known.centred = False

    def lean(self) -> dict[str, tuple[float, float]] | None:
        """Forward and left, each -1 to 1, of each of `sticks` of the one gamepad that drives; None when none does."""
        for number, known in self._known.items():
            self._judge(number, known)
        if self._driver is None:
            return None
        lean = self._lean(self._known[self._driver])
        return {stick: lean[stick] for stick in self.sticks}

    def _lean(self, known: _Known) -> dict[str, tuple[float, float]]:
        return self.profile(known.state.name).lean(known.state)

    def _pushed(self, known: _Known) -> bool:
        """One of `sticks` is out of its middle."""
        lean = self._lean(known)
        return any(lean[stick] != (0.0, 0.0) for stick in self.sticks)

    def _judge(self, number: int, known: _Known) -> None:
        """One that is pushed drives if it was let go before, is alive, and no other does."""
        pushed = self._pushed(known)
        known.centred = known.centred or not pushed
        silent = pushed and self.silent(number)
        self._tell_silent(known, silent=silent)
        may = self.on and pushed and known.centred and not silent
        if self._driver == number:
            self._driver = number if may else None
        elif self._driver is None and may:
            self._driver = number
        elif pushed and (self._driver is not None or not self.on):
            known.centred = False

    def _tell_silent(self, known: _Known, *, silent: bool) -> None:
        """Once for each silence of one that had been let go before."""
        is_news = silent and known.centred and not known.told_silent
        known.told_silent = silent and (known.told_silent or known.centred)
        if is_news:
            self._on_news(PadEvent("silent", known.state.name))

    def _lose(self, number: int) -> None:
        known, drives = self._known.pop(number), self._driver == number
        if drives:
            self._driver = None
        self._on_news(PadEvent("unplugged driving" if drives else "unplugged", known.state.name))


class KivyPads:
    """Gamepads as Kivy's events tell of them, for a system whose SDL cannot be asked: none ever comes out."""

    def __init__(self) -> None:
        self._axes: dict[int, dict[int, float]] = {}
        self._events: dict[int, int] = {}
        self._down: dict[int, set[int]] = {}

    def axis(self, number: int, axis: int, value: int) -> None:
        """An axis moved; `value` is from -32768 to 32767."""
        self._axes.setdefault(number, {})[axis] = value / 32768.0
        self._events[number] = self._events.get(number, 0) + 1

    def button(self, number: int, button: int, *, down: bool) -> None:
        """A button went down or up."""
        self._axes.setdefault(number, {})
        (self._down.setdefault(number, set()).add if down else self._down.setdefault(number, set()).discard)(
            button
        )
        self._events[number] = self._events.get(number, 0) + 1

    def pads(self) -> list[PadState]:
        """Every gamepad that was heard of."""
        return [
            PadState(
                number,
                "Gamepad",
                forward=-axes.get(AXES[1], 0.0),
                left=-axes.get(AXES[0], 0.0),
                stop=False,
                stop_button=FOUR.index("b"),
                raw=(self._events[number],),
                right=(-axes.get(RIGHT_AXES[1], 0.0), -axes.get(RIGHT_AXES[0], 0.0)),
                buttons=frozenset(
                    FOUR[button] if button < len(FOUR) else f"button {button}"
                    for button in self._down.get(number, ())
                ),
            )
            for number, axes in self._axes.items()
        ]

    def lifted(self, device: str, finger: object) -> bool:
        """Nothing is known of fingers."""
        return False

    def key(self, scancode: int) -> bool:
        """Nothing is known of keys."""
        return False

    def close(self) -> None:
        """Nothing to let go of."""
