"""Keys that drive while they are held: W A S D and the arrows, as a gamepad would. No Kivy in here."""

from __future__ import annotations

from collections.abc import Callable, Collection

from app.inputs.base.button_presses import Press
from app.inputs.keys.held_key import MAX_HOLD, REPEAT_TIMEOUT, HeldKey
from app.inputs.keys.key_table import ARROWS, DRIVING, KeyTable
from widgets.core.language import tr

__all__ = ["REPEAT_TIMEOUT", "MAX_HOLD", "KeyDrive"]

MIN_PUSH = 0.15
"""It begins with so much of the whole way: less is nothing to some controls."""
PLACES = {**DRIVING, **ARROWS}
PUSHES = {
    "w": (1, 0),
    "s": (-1, 0),
    "a": (0, 1),
    "d": (0, -1),
    "up": (1, 0),
    "down": (-1, 0),
    "left": (0, 1),
    "right": (0, -1),
}
"""Ahead and left."""
RIGHT = frozenset(ARROWS.values())


class KeyDrive:
    """Pushes the controls of a screen for as long as a hand holds the keys. Looked at with each heartbeat."""

    def __init__(
        self,
        now: Callable[[], float],
        table: Callable[[], KeyTable],
        *,
        is_down: Callable[[int], bool] | None = None,
        on_lost: Callable[[str], object] = lambda _: None,
    ) -> None:
        """`is_down` tells whether the key at a place of the keyboard is down, where somebody knows; `on_lost` hears why a held key ended."""
        self._now, self._table, self._is_down, self._on_lost = now, table, is_down, on_lost
        self.sticks: frozenset[str] = frozenset({"left"})
        """What is pushed now, of `left` and `right`."""
        self.wanted: Callable[[], bool] = lambda: True
        """Driving keys mean something now: there is a control on the glass, and nothing is being typed."""
        self._held: dict[str, HeldKey] = {}
        self._newest = ""
        self._slow = False
        self._began: float | None = None

    # presses

    def pressed(self, press: Press) -> bool:
        """One of the keys that drive goes down."""
        table = self._table()
        if (
            press.source != "key"
            or not (table.on and table.drives)
            or press.modifiers & {"ctrl", "alt", "meta"}
        ):
            self._newest = ""
            return False
        name = PLACES.get(press.scancode) or (press.name if not press.scancode else "")
        self._newest = name if name in PUSHES and self.wanted() else ""
        if not self._newest:
            return False
        self._held[name] = HeldKey(press, press.at, press.at)
        return True

    def released(self, press: Press) -> None:
        """It goes up."""
        self._held = {name: held for name, held in self._held.items() if held.press.same != press.same}
        self._newest = ""

    def repeated(self, key: str) -> None:
        """The system says again that the key of this name is down."""
        held = next((held for held in self._held.values() if held.press.name == key), None)
        if held is not None:
            held.repeated(self._now())

    def shifted(self, *, down: bool) -> None:
        """Shift is held, and the controls are pushed less far."""
        self._slow = down

    # driving

    @property
    def standing(self) -> str:
        """`drives` or `ready`."""
        return "drives" if self._began is not None else "ready"

    def use(self, sticks: Collection[str]) -> None:
        """Push these from now on, of `left` and `right`; where they are others than before, every key must be let go first."""
        if frozenset(sticks) != self.sticks:
            self.sticks = frozenset(sticks)
            self.forbid()

    def forbid(self) -> None:
        """Nothing may be driven now: each key must be let go before it drives again."""
        self._began = None
        for held in self._held.values():
            held.stale = True

    def lean(self) -> dict[str, tuple[float, float]] | None:
        """Ahead and left, each -1 to 1, of each of `sticks`; None while no key drives."""
        for name, held in self._held.items():
            self._judge(name, held)
        alive = [name for name, held in self._held.items() if not held.stale and not self._silent(name, held)]
        table = self._table()
        if not any(self._push(stick, alive, 1.0) != (0, 0) for stick in self.sticks) or not (
            table.on and table.drives
        ):
            self._began = None
            return None
        if self._began is None:
            self._began = self._now()
        share = min(1.0, (self._now() - self._began) / table.rise) if table.rise else 1.0
        share = min(max(share, MIN_PUSH), table.slow if self._slow else 1.0)
        return {stick: self._push(stick, alive, share) for stick in self.sticks}

    def _push(self, stick: str, alive: list[str], share: float) -> tuple[float, float]:
        """Arrows push the right one where there are two; of one control both sets are the same."""
        mine = [name for name in alive if len(self.sticks) == 1 or (name in RIGHT) == (stick == "right")]
        ahead = sum(PUSHES[name][0] for name in mine)
        left = sum(PUSHES[name][1] for name in mine)
        return share * max(-1, min(1, ahead)), share * max(-1, min(1, left))

    def _silent(self, name: str, held: HeldKey) -> bool:
        """Its repeats stay away, which only the key that went down last can be judged by."""
        return name == self._newest and held.silent(self._now())

    def _judge(self, name: str, held: HeldKey) -> None:
        """It is stale when the system has it down no longer, or when it was held for too long."""
        if held.stale:
            return
        held.stale = held.up(self._is_down)
        if not held.stale and held.too_long(self._now()):
            held.stale = True
            self._on_lost(
                tr("{name} is held for {max_hold:.0f} s: the robot rests.").format(
                    name=name.upper(), max_hold=MAX_HOLD
                )
            )
