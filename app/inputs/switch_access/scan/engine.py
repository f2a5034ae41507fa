"""From the switches' contacts to what is done on the glass: the contacts, the tree and the mark, put together.

engine = Engine(glass, Planner(used), desk)
engine.press("B", ("key", 0, 13), now); engine.release(…); engine.update(now)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import Literal, Protocol

from app.inputs.switch_access.scan.plan import Planner
from app.inputs.switch_access.scan.presses import Contacts, Event, Timing
from app.inputs.switch_access.scan.scan import Pace, Scan
from app.inputs.switch_access.scan.target import Glass, Mark, Target

__all__ = ["Desk", "Engine", "Selection"]

UPDATE_PERIOD = 0.25
"""Between two looks at what is on the glass while something is marked [s]."""
SETTLING_TIME = 0.5
"""What has begun to mean something else takes no press for so long [s]: that press meant what it did before."""

Sound = Literal["step", "back", "in", "act", "none"]
"""A step; out of a group; into one; something is done; nothing came of a press."""


@dataclass(frozen=True, slots=True)
class Selection:
    """Something that was chosen."""

    target: Target
    place: str
    began: float
    """When the press that does it began [s]."""
    ended: float
    """When it ended [s]."""
    presses: int
    """Since the one before was chosen, or since the switches were woken; holds count once."""
    since: float
    """When the first of these began [s]."""


class Desk(Protocol):
    """What the engine tells the app."""

    def stop(self, began: float) -> None:
        """STOP, whatever is marked."""

    def do(self, chosen: Selection) -> None:
        """Do it, where the operator lets switches do it."""

    def stepped(self, sound: Sound, mark: Mark | None) -> None:
        """To be heard, and the mark to be spoken."""

    def stuck(self, switch: str, stuck: bool) -> None:
        """A switch is down for too long and is ignored, or works again."""


class Engine:
    """Asleep until a press; everything in the UI thread, times are our clock's [s, monotonic]."""

    def __init__(
        self,
        glass: Glass,
        planner: Planner,
        desk: Desk,
        timing: Timing | None = None,
        pace: Pace | None = None,
    ) -> None:
        self._glass, self._planner, self._desk = glass, planner, desk
        self.contacts = Contacts(timing or Timing(), self._hear)
        self.scan = Scan(pace or Pace())
        self.first: Callable[[Event], bool] = lambda _: False
        """Asked of each press before it means anything; True takes it. STOP does not come this way."""
        self._now = 0.0
        self._place = ""
        self._shown: Mark | None = None
        self._seen = -math.inf
        """When the glass was asked last."""
        self._meant: tuple[str, str, float] = ("", "", -math.inf)
        """Name and words of the target that is marked, and since when it has them after having had others."""
        self._armed = False
        """B is down and may still come to something: when it comes up."""
        self._stood: Mark | None = None
        """What stood out when B came down."""
        self._done_by_a: Literal["", "woke", "stepped", "held"] = ""
        """What came of the press of A that is down."""
        self._only_stop: set[str] = set()
        """Switches whose last press is somebody else's, but for STOP."""
        self._presses, self._since = 0, math.nan

    @property
    def awake(self) -> bool:
        """Something is marked, or would be if there were anything to do."""
        return self.scan.awake

    def setup(self, timing: Timing, pace: Pace) -> None:
        """Go by these figures from now on."""
        self.contacts.timing, self.scan.pace = timing, pace
        self._show()

    def press(
        self, switch: Literal["A", "B"], source: Hashable, now: float, *, only_stop: bool = False
    ) -> None:
        """A key or button of `switch` came down; again where the system repeats it. With `only_stop` it can mean nothing else."""
        self._now = now
        means: Literal["A", "B"] = "B" if self.scan.pace.by_itself else switch
        (self._only_stop.add if only_stop else self._only_stop.discard)(means)
        self.contacts.down(means, source, now)

    def release(self, source: Hashable, now: float) -> None:
        """It came up, whichever it was when it came down."""
        self._now = now
        self.contacts.up("A", source, now)
        self.contacts.up("B", source, now)

    def update(self, now: float) -> None:
        """With each heartbeat."""
        self._now = now
        self.contacts.update(now)
        if not self.awake:
            return
        if now - self._seen >= UPDATE_PERIOD:
            self._refresh()
        if self.scan.update(now, wait=self.contacts.is_closed("B")):
            self._step("step" if self.awake else "none")

    def wake(self, now: float) -> None:
        """Begin at the first, as a press would."""
        self._now = now
        self.scan.wake(now)
        self._refresh()
        self._step("step")

    def sleep(self) -> None:
        """Nothing is marked any more; the next press wakes it."""
        self.scan.sleep()
        self._armed, self._presses, self._since = False, 0, math.nan
        self._show()

    def lost(self) -> None:
        """Nobody will tell when the switches come up: nothing comes of what is down."""
        self.contacts.lost()
        self._armed, self._done_by_a = False, ""

    def found(self, now: float) -> None:
        """It will be told again; what was down all the while is no new press."""
        self.contacts.found(now)

    # what the contacts tell

    def _hear(self, event: Event) -> None:
        armed = self._armed
        if event.switch == "B" or event.what == "stop":
            self._armed = False
        if event.what == "stop":
            self._desk.stop(event.began)
            self._take_back()
        elif event.what in ("stuck", "free"):
            self._done_by_a = ""
            self._desk.stuck(event.switch, event.what == "stuck")
        elif event.switch in self._only_stop:
            return
        elif event.what == "unsure":
            self._desk.stepped("none", self._shown)
        elif not self.first(event):
            self._take(event, armed=armed)

    def _take(self, event: Event, *, armed: bool) -> None:
        if event.what == "down":
            self._count(event)
            self._pressed_a() if event.switch == "A" else self._pressed_b()
        elif event.what == "held":
            self._held(event)
        elif event.switch == "A":
            self._done_by_a = ""
        elif armed:
            self._let_go(event)

    def _count(self, event: Event) -> None:
        if not self._presses:
            self._since = event.began
        self._presses += 1

    def _pressed_a(self) -> None:
        if not self.awake:
            self._done_by_a = "woke"
            self.wake(self._now)
            return
        self._done_by_a = "stepped"
        self._refresh()
        self.scan.next(self._now)
        self._step("step")

    def _pressed_b(self) -> None:
        self._armed, self._stood = True, self._shown

    def _let_go(self, event: Event) -> None:
        if self.awake:
            self._select(event.began, event.at)
        else:
            self.wake(self._now)

    def _held(self, event: Event) -> None:
        if self._done_by_a in ("", "woke"):
            return
        if self._done_by_a == "stepped":
            self.scan.undo(self._now)
        self._done_by_a = "held"
        self.scan.back(self._now)
        self._step("back")

    def _take_back(self) -> None:
        """The press of A that has become STOP was meant for no step."""
        meant, self._done_by_a = self._done_by_a, ""
        if meant == "woke":
            self.sleep()
        elif meant == "stepped":
            self.scan.undo(self._now)
            self._show()

    # what is done

    def _select(self, began: float, ended: float) -> None:
        """What stood out when B came down, if it is still there and means the same."""
        before = self._stood
        self._refresh()
        after = self._shown
        if (
            before is None
            or after is None
            or not _same(before, after)
            or began - self._meant[2] < SETTLING_TIME
        ):
            self._desk.stepped("none", after)
            return
        target = self.scan.select(self._now)
        if target is None:
            self._step("in" if after.kind == "group" else "back")
            return
        chosen = Selection(target, self._place, began, ended, self._presses, self._since)
        self._presses, self._since = 0, math.nan
        self._desk.do(chosen)
        self._seen = -math.inf  # what was done may have changed everything
        self._step("act")

    def _refresh(self) -> None:
        """Ask the glass what there is now."""
        if not self.awake:
            return
        self._seen = self._now
        place = self._glass.place
        fresh, self._place = place != self._place, place
        self.scan.show(self._planner.tree(place, self._glass.targets()), self._now, fresh=fresh)
        self._show()

    def _step(self, sound: Sound) -> None:
        self._show()
        self._desk.stepped(sound, self._shown)

    def _show(self) -> None:
        mark = self.scan.mark
        self._note(mark)
        if mark != self._shown:
            self._shown = mark
            self._glass.mark(mark)

    def _note(self, mark: Mark | None) -> None:
        """Since when what is marked means what it means."""
        if mark is None or mark.kind != "item":
            self._meant = "", "", -math.inf
            return
        target, (name, words, _) = mark.targets[0], self._meant
        if name != target.name:
            self._meant = target.name, target.words, -math.inf
        elif words != target.words:
            self._meant = target.name, target.words, self._now


def _same(before: Mark, after: Mark) -> bool:
    """B does the same with both."""
    names, now = {one.name for one in before.targets}, {one.name for one in after.targets}
    if "item" in (before.kind, after.kind):
        return before.kind == after.kind and names == now
    return bool(names & now)
