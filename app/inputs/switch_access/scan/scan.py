"""The mark: it steps over a tree of groups, by presses or by time, and a press of B acts on it.

scan = Scan(Pace())
scan.show(tree, now)        # what there is; again whenever that changes
scan.next(now); target = scan.select(now)

A pure machine: it knows neither switches nor a screen, and time is what it is told.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from app.inputs.switch_access.scan.plan import Group, leaves
from app.inputs.switch_access.scan.target import Mark, Target
from widgets.core.language import mark, tr

__all__ = ["Pace", "Scan"]

BACK = mark("Back")
"""What the way out of a group is called."""
MAX_NAMED = 2
"""So many are named; of more the first and the last."""
MAX_LETTERS = 22
"""Of each name, at most."""


@dataclass(frozen=True, slots=True)
class Pace:
    """How the mark moves."""

    by_itself: bool = False
    """It steps by time, for one switch; else with each press of A."""
    interval: float = 1.5
    """Between two steps by itself [s]."""
    first: float = 0.7
    """The first one of a level stays so much longer [s]."""
    loops: int = 3
    """So often it goes round a level by itself; then up a level, and from the top it rests until the next press."""


@dataclass(frozen=True, slots=True)
class _Place:
    """Where the mark is."""

    awake: bool = False
    path: tuple[int, ...] = ()
    """The group that was entered on each level."""
    at: int = 0
    """Which one of the level; behind the last is the way back, where there is one."""


class Scan:
    """Asleep, nothing is marked, and the first press only wakes it."""

    def __init__(self, pace: Pace) -> None:
        self._pace = pace
        self._tree = Group(())
        self._here = _Place()
        self._before = _Place()
        """Where it was before the last step."""
        self._loops = 0
        self._step = 0
        self._until = math.nan

    @property
    def pace(self) -> Pace:
        """How the mark moves; from the next step on where it is assigned."""
        return self._pace

    @pace.setter
    def pace(self, pace: Pace) -> None:
        if pace != self._pace:
            self._pace = pace
            self.sleep()

    @property
    def awake(self) -> bool:
        """Something stands out, or would if there were anything."""
        return self._here.awake

    @property
    def depth(self) -> int:
        """Groups that were entered."""
        return len(self._here.path)

    @property
    def inside(self) -> list[Target]:
        """Everything in the group that was gone into; all there is on the top level."""
        return list(leaves(self._group(self._here.path)))

    @property
    def mark(self) -> Mark | None:
        """What stands out; None asleep and where there is nothing."""
        children = self._children(self._here.path)
        if not self._here.awake or not children:
            return None
        count, at = self._count(self._here.path), self._here.at
        if at >= len(children):
            marked = tuple(leaves(self._group(self._here.path)))
            return Mark(marked, "back", tr(BACK), at, count, self._step, self._until)
        child = children[at]
        kind: Literal["item", "group"] = "item" if isinstance(child, Target) else "group"
        return Mark(tuple(leaves(child)), kind, _words(child), at, count, self._step, self._until)

    # what there is

    def show(self, tree: Group, now: float, *, fresh: bool = False) -> None:
        """Go on over another tree: the mark stays on what it was on as far as that is there; with `fresh` it begins at the first."""
        before = self.mark
        self._tree = tree
        if not self._here.awake:
            return
        if fresh:
            self._go(_Place(True), now, entered=True)
        elif before is None or not self._kept(before):
            self._go(self._found(before) or _Place(True), now, entered=True)

    def _kept(self, before: Mark) -> bool:
        after = self.mark
        return after is not None and (after.kind, _names(after)) == (before.kind, _names(before))

    def _found(self, before: Mark | None) -> _Place | None:
        """Where the same target is now, or the group with most of the same; None for nowhere."""
        if before is None or before.kind == "back":
            return None
        names = _names(before)
        best, most = None, 0
        for path, at, child in _everywhere(self._tree, ()):
            if isinstance(child, Target) != (before.kind == "item"):
                continue
            shared = len(names & {one.name for one in leaves(child)})
            if shared > most:
                best, most = _Place(True, path, at), shared
        return best

    # what a press does

    def wake(self, now: float) -> None:
        """Begin at the first of the first level."""
        self._loops = 0
        self._go(_Place(True), now, entered=True)

    def sleep(self) -> None:
        """Nothing stands out any more."""
        self._here, self._until = _Place(), math.nan

    def next(self, now: float) -> None:
        """On to the next of the level, after the last to the first; asleep it wakes."""
        if not self._here.awake:
            self.wake(now)
            return
        count = self._count(self._here.path)
        if count:
            self._go(_Place(True, self._here.path, (self._here.at + 1) % count), now)

    def undo(self, now: float) -> None:
        """Take the last `next` back: what was a step was meant as a hold."""
        if self._before.awake and self._before.path == self._here.path:
            self._go(self._before, now)

    def back(self, now: float) -> None:
        """Out of the group, the mark on it; on the top level to the one before, from the first to the last."""
        here = self._here
        if not here.awake:
            return
        if here.path:
            self._go(_Place(True, here.path[:-1], here.path[-1]), now)
        elif count := self._count(()):
            self._go(_Place(True, (), (here.at - 1) % count), now)

    def select(self, now: float) -> Target | None:
        """What B does with the mark: the target to do, after which the mark begins anew unless that is repeatable; else None.

        Into a group, out of it, and awake where it slept.
        """
        mark, here = self.mark, self._here
        if mark is None:
            if not here.awake:
                self.wake(now)
            return None
        self._loops = 0
        if mark.kind == "group":
            self._go(_Place(True, (*here.path, here.at), 0), now, entered=True)
        elif mark.kind == "back":
            self.back(now)
        else:
            again = here if mark.targets[0].repeatable else _Place(True)
            self._go(again, now, entered=True)
            return mark.targets[0]
        return None

    def update(self, now: float, *, wait: bool = False) -> bool:
        """Step by itself where it is time to, one step however late; True if it did. With `wait` the time begins anew."""
        if not self._here.awake or not self._pace.by_itself:
            return False
        if wait:
            self._until = now + self._pace.interval
        if not now >= self._until:
            return False
        self._by_itself(now)
        return True

    def _by_itself(self, now: float) -> None:
        here = self._here
        count = self._count(here.path)
        if here.at + 1 < count:
            self._go(_Place(True, here.path, here.at + 1), now)
            return
        self._loops += 1
        if self._loops < self._pace.loops:
            self._go(_Place(True, here.path, 0), now, entered=True)
            return
        self._loops = 0
        if here.path:
            self.back(now)
        else:
            self.sleep()

    # the tree

    def _go(self, place: _Place, now: float, *, entered: bool = False) -> None:
        self._before, self._here = self._here, place
        self._step += 1
        stay = self._pace.interval + (self._pace.first if entered else 0.0)
        self._until = now + stay if self._pace.by_itself else math.nan

    def _group(self, path: tuple[int, ...]) -> Group:
        group = self._tree
        for index in path:
            child = group.children[index] if index < len(group.children) else Group(())
            group = child if isinstance(child, Group) else Group(())
        return group

    def _children(self, path: tuple[int, ...]) -> tuple[Group | Target, ...]:
        return self._group(path).children

    def _count(self, path: tuple[int, ...]) -> int:
        """Children of the level, and the way back where no hold of A leads there."""
        count = len(self._children(path))
        return count + 1 if count and path and self._pace.by_itself else count


def _names(mark: Mark) -> frozenset[str]:
    return frozenset(one.name for one in mark.targets)


def _words(child: Group | Target) -> str:
    if isinstance(child, Target):
        return child.words
    inside = list(leaves(child))
    groups = list(dict.fromkeys(one.group[0] for one in inside if one.group))
    if len(groups) == 1 and all(one.group for one in inside):
        return child.words or _from_to([_short(one.words) for one in inside])
    # a container is named once, what stands alone by itself
    named = list(dict.fromkeys(one.group[0] if one.group else _short(one.words) for one in inside))
    return child.words or _from_to(named)


def _from_to(named: list[str]) -> str:
    """The names that a group is known by: all of a few, else where it begins and where it ends."""
    named = list(dict.fromkeys(named))
    if len(named) <= MAX_NAMED:
        return " and ".join((", ".join(named[:-1]), named[-1])) if len(named) > 1 else "".join(named)
    return f"{named[0]} to {named[-1]}"


def _short(words: str) -> str:
    """What it says before it goes into detail."""
    head = words.partition(":")[0].strip() or words
    return head if len(head) <= MAX_LETTERS else f"{head[: MAX_LETTERS - 1].rstrip()}…"


def _everywhere(group: Group, path: tuple[int, ...]) -> Iterator[tuple[tuple[int, ...], int, Group | Target]]:
    for at, child in enumerate(group.children):
        yield path, at, child
        if isinstance(child, Group):
            yield from _everywhere(child, (*path, at))
