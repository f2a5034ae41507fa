"""Presses and time for one of 16 actions by two switches, for a simulated user, against linear cycling as in the paper of the divers.

The user wants actions drawn from the distribution in `ACTIONS` (assumed, because there is no log of users
yet, so that the list needs about the 10.6 presses computed for such a page) and
operates the app's own engine: contacts, tree and mark. A press takes 0.35 s; one in twenty goes wrong (a step too many, or a press
that does not reach the contact), is noticed, and is made good by going round or by a hold back. STOP is one of the actions and is
both switches together, as everywhere. What B does is done when it is let go and cannot bounce any more: so much longer, 0.23 s, the user
looks before the next press. Runs of the same repeatable action come as such steps do. The other way is one list in the
order of the alphabet, the mark back at the first after each action, with the same user and the same errors. Wrong is an action that was not wanted.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Literal, NamedTuple

from app.inputs.switch_access.scan.engine import Engine, Selection
from app.inputs.switch_access.scan.plan import Planner
from app.inputs.switch_access.scan.presses import Timing
from app.inputs.switch_access.scan.target import Mark, Target
from bench.support.figures import Figure
from bench.support.harness import Context, Sides

LINEAR = "one list in the order of the alphabet"
FIGURES = (
    Figure("presses", "", "presses for an action, learned from a log, with errors", 4.0, against=LINEAR),
    Figure("seconds", "s", "time for it", against=LINEAR),
    Figure("share", "%", "time for it, of that of the list", 50),
    Figure("new_presses", "", "presses in the first session, with nothing learned"),
    Figure("faultless_presses", "", "presses without errors", against=LINEAR),
    Figure("wrong", "%", "actions that were not wanted", against=LINEAR),
)
REPEATS = 3
ACTIONS = {
    "Stop": 0.14,
    "Pause": 0.13,
    "Resume": 0.12,
    "Next waypoint": 0.02,
    "Snapshot": 0.09,
    "Slower": 0.08,
    "Speed up": 0.07,
    "Surface": 0.07,
    "Turn to next camera": 0.07,
    "Go home": 0.05,
    "Lights": 0.04,
    "Record": 0.03,
    "Start": 0.05,
    "Hold": 0.02,
    "End task": 0.01,
    "Confirm": 0.01,
}
"""How often each is wanted, of all."""
REPEATABLE = ("Slower", "Speed up", "Turn to next camera", "Snapshot")
AGAIN = 0.3
"""Share of these that are followed by the same."""
WANTED = 2000
"""Actions in one run."""
PRESS, BETWEEN = 0.15, 0.20
"""A switch is down, and up again until the next press [s]; together 0.35 s."""
BOTH = 0.35
"""STOP by both switches [s]."""
SEEN_LATER = PRESS + Timing().debounce
"""What comes of B is seen so much later than what comes of A [s]; the list, which acts at the press, has none of that."""
NOTICES = 0.35
"""After an error until the user goes on [s]."""
ERRORS = 0.05
"""Share of presses."""


class Run(NamedTuple):
    """Of one simulated user."""

    presses: float
    """For an action, mean."""
    seconds: float
    wrong: float
    """Share of actions."""


def wanted(rng: random.Random) -> list[str]:
    """What the user wants, one after the other."""
    names, weights = list(ACTIONS), list(ACTIONS.values())
    found: list[str] = []
    while len(found) < WANTED:
        (name,) = rng.choices(names, weights)
        found.append(name)
        while name in REPEATABLE and rng.random() < AGAIN:
            found.append(name)
    return found[:WANTED]


class Glass:
    """Sixteen buttons in the order of the alphabet, without STOP, which has its own way."""

    place = "drive"

    def __init__(self) -> None:
        self.marked: Mark | None = None
        names = sorted(name for name in ACTIONS if name != "Stop")
        self._targets = [Target(name, name, lambda: None, repeatable=name in REPEATABLE) for name in names]

    def targets(self) -> Sequence[Target]:
        """All of them, always."""
        return self._targets

    def mark(self, mark: Mark | None) -> None:
        """The user sees it."""
        self.marked = mark


class User:
    """Works the engine as a hand would, on a clock of its own."""

    def __init__(self, rng: random.Random, learned: dict[str, float], errors: float) -> None:
        self._rng, self._errors = rng, errors
        self.glass, self.done, self.now = Glass(), [""], 0.0
        self.presses = 0
        self.engine = Engine(self.glass, Planner({"drive": learned}), self)
        self._press("B")
        self.presses, self.now = 0, self.now

    # reports of the engine

    def stop(self, began: float) -> None:
        """STOP was pressed."""
        self.done.append("Stop")

    def do(self, chosen: Selection) -> None:
        """Something was chosen."""
        self.done.append(chosen.target.name)

    def stepped(self, sound: str, mark: Mark | None) -> None:
        """It is heard."""

    def stuck(self, switch: str, stuck: bool) -> None:
        """No switch is."""

    # what the hand does

    def want(self, name: str) -> int:
        """Press until it is done; how often something else was."""
        count, wrong = len(self.done), 0
        while True:
            if name == "Stop":
                self._both()
            else:
                self._toward(name)
            if len(self.done) > count:
                if self.done[-1] == name:
                    return wrong
                count, wrong = len(self.done), wrong + 1

    def _toward(self, name: str) -> None:
        mark = self.glass.marked
        here = mark is not None and name in {target.name for target in mark.targets}
        if here:
            self._press("B")
            self._wait(SEEN_LATER)
        elif self.engine.scan.depth and not self._within(name):
            self._press("A", self.engine.contacts.timing.hold_back + 0.05)
        else:
            self._press("A")

    def _within(self, name: str) -> bool:
        """It is somewhere in the group that was gone into."""
        scan = self.engine.scan
        return name in {one.name for one in scan.inside}

    def _press(self, switch: Literal["A", "B"], held: float = PRESS) -> None:
        self.presses += 1
        chance = self._rng.random()
        if chance < self._errors / 2:  # it does not reach the contact
            self._wait(held + BETWEEN + NOTICES)
            return
        self._down_up(switch, held)
        if chance < self._errors and switch == "A":  # once too often
            self.presses += 1
            self._down_up(switch, PRESS)
            self._wait(NOTICES)

    def _down_up(self, switch: Literal["A", "B"], held: float) -> None:
        self.engine.press(switch, switch, self.now)
        self._wait(held)
        self.engine.release(switch, self.now)
        self._wait(BETWEEN)

    def _both(self) -> None:
        self.presses += 1
        self.engine.press("A", "A", self.now)
        self.engine.press("B", "B", self.now)
        self._wait(BOTH)
        self.engine.release("A", self.now)
        self.engine.release("B", self.now)
        self._wait(BETWEEN)

    def _wait(self, seconds: float) -> None:
        """The heartbeat is every 30 ms; whole steps and the rest of one."""
        end = self.now + seconds
        while self.now < end - 1e-9:
            self.now = min(end, self.now + 0.03)
            self.engine.update(self.now)


def scanned(rng: random.Random, learned: dict[str, float], errors: float = ERRORS) -> Run:
    """By the app's engine."""
    user = User(rng, learned, errors)
    began, wrong = user.now, 0
    for name in wanted(rng):
        wrong += user.want(name)
    return Run(user.presses / WANTED, (user.now - began) / WANTED, wrong / WANTED)


def cycled(rng: random.Random, errors: float = ERRORS) -> Run:
    """By one list, the mark back at the first after each: a step too many means once round."""
    names = sorted(ACTIONS)
    presses, seconds = 0, 0.0
    for name in wanted(rng):
        at, goal = 0, names.index(name)
        while True:
            presses, seconds = presses + 1, seconds + PRESS + BETWEEN
            chance = rng.random()
            if chance < errors / 2:
                seconds += NOTICES
                continue
            if at == goal:
                break
            at = (at + 1) % len(names)
            if chance < errors:
                at, presses, seconds = (at + 1) % len(names), presses + 1, seconds + PRESS + BETWEEN + NOTICES
    return Run(presses / WANTED, seconds / WANTED, 0.0)


def learned() -> dict[str, float]:
    """What one session before has left in the log."""
    found: dict[str, float] = {}
    for name in wanted(random.Random(99)):
        found[name] = found.get(name, 0.0) + 1.0
    return found


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """The log of a session before."""
    known, seeds = learned(), iter(range(10_000))

    def ours() -> dict[str, float]:
        seed = next(seeds)
        run, list_ = scanned(random.Random(seed), known), cycled(random.Random(seed))
        return {
            "presses": run.presses,
            "seconds": run.seconds,
            "share": 100 * run.seconds / list_.seconds,
            "new_presses": scanned(random.Random(seed), {}).presses,
            "faultless_presses": scanned(random.Random(seed), known, 0.0).presses,
            "wrong": 100 * run.wrong,
        }

    def theirs() -> dict[str, float]:
        run, faultless = cycled(random.Random(next(seeds))), cycled(random.Random(1), 0.0)
        return {
            "presses": run.presses,
            "seconds": run.seconds,
            "faultless_presses": faultless.presses,
            "wrong": 100 * run.wrong,
        }

    yield Sides(ours, theirs)
