"""The mission being edited: points, home and motion, with undo, and how it stands to what the robot stored."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import msgspec

from bridge.msgs.pilothouse_msgs import MAX_DWELL, MAX_LAPS, MOTIONS, REACTIONS, Mission, Waypoint
from widgets.core.language import tr

__all__ = ["Draft", "MissionEditor"]

STEPS = 200
"""How many edits can be undone."""
NEAR = 1e-6
"""Two places closer than this are the same [m]: numbers may lose a digit on their way to the robot and back."""


@dataclass(frozen=True)
class Draft:
    """What the operator wants of a patrol."""

    points: tuple[tuple[float, float], ...] = ()
    """(x, y) in `map` [m], in the order of visiting."""
    home: tuple[float, float] | None = None
    """(x, y) in `map` [m]; None when it is not set."""
    motion: str = "loop"
    dwell: float = 5.0
    """Stay at each point in intermittent motion [s]."""
    laps: int = 0
    """Rounds to make; 0 goes on until stopped."""
    on_intruder: str = "report"
    """`stop`, `report` or `circle` when one is found."""
    name: str = ""
    """What the robot keeps the mission as; empty for none."""
    intruder_classes: tuple[str, ...] = ()
    """What counts as an intruder; empty for what the robot thinks usual."""
    heights: tuple[float | None, ...] = ()
    """Of the points, above the map's origin [m]; None, and where there are fewer, for the one that the robot has."""

    @classmethod
    def of(cls, mission: Mission) -> Draft:
        """The draft that a robot's mission was sent as; what this app does not know about how it moves is as usual."""
        home = (mission.home[0].x, mission.home[0].y) if mission.home else None
        points = tuple((point.x, point.y) for point in mission.waypoints)
        heights = tuple(_height(point.height) for point in mission.waypoints)
        reaction = "stop" if mission.stop_on_intruder else mission.on_intruder or "report"
        reaction = reaction if reaction in REACTIONS else "report"
        motion = mission.motion if mission.motion in MOTIONS else "loop"
        given = heights if any(height is not None for height in heights) else ()
        return cls(
            points,
            home,
            motion,
            mission.dwell,
            mission.laps,
            reaction,
            mission.name,
            tuple(mission.intruder_classes),
            given,
        )

    def message(self) -> Mission:
        """The same for the robot."""
        levels = zip(self.points, self.levels, strict=True)
        points = [Waypoint(x, y, height=math.nan if up is None else up) for (x, y), up in levels]
        home = [Waypoint(*self.home, name="home")] if self.home else []
        return Mission(
            waypoints=points,
            home=home,
            motion=self.motion,
            dwell=self.dwell,
            laps=self.laps,
            stop_on_intruder=self.on_intruder == "stop",
            on_intruder=self.on_intruder,
            name=self.name,
            intruder_classes=list(self.intruder_classes),
        )

    @property
    def levels(self) -> tuple[float | None, ...]:
        """The height of each point."""
        count = len(self.points)
        return (*self.heights[:count], *[None] * (count - len(self.heights)))

    def levelled(self, height: float | None, index: int = -1) -> Draft:
        """The same with the point at `index`, or every one for -1, at a `height` [m]; None for the one that the robot has."""
        levels = list(self.levels)
        for number in range(len(levels)) if index < 0 else (index,):
            levels[number] = height
        return self.routed(self.points, levels)

    def routed(self, points: Sequence[tuple[float, float]], levels: Sequence[float | None]) -> Draft:
        """The same along other points at these heights."""
        given = tuple(levels) if any(level is not None for level in levels) else ()
        return replace(self, points=tuple(points), heights=given)

    def same_as(self, other: Draft) -> bool:
        """Whether both ask the same of the robot."""
        mine, theirs = (replace(one, points=(), heights=(), home=None) for one in (self, other))
        if (
            mine != theirs
            or len(self.points) != len(other.points)
            or (self.home is None) != (other.home is None)
        ):
            return False
        places = [*zip(self.points, other.points, strict=True)]
        if self.home is not None and other.home is not None:
            places.append((self.home, other.home))
        levels = zip(self.levels, other.levels, strict=True)
        return all(math.dist(one, two) <= NEAR for one, two in places) and all(
            one is two or (one is not None and two is not None and abs(one - two) <= NEAR)
            for one, two in levels
        )


@dataclass
class MissionEditor:
    """A draft with its history, and the mission that the robot confirmed to have stored.

    Nothing entered is ever lost: a mission from the robot replaces the draft only where the operator
    changed nothing since the last one.
    """

    on_change: Callable[[], object] = lambda: None
    """Called after every change of the draft or of its state."""
    draft: Draft = Draft()
    stored: Draft | None = None
    """None until the robot told its mission."""
    sent: Draft | None = None
    """Under way to the robot; None when nothing is."""
    outcome: str = ""
    """What became of sending this draft last, in one sentence; empty again once it is changed."""
    failed: bool = False
    """That was refused or not answered."""
    _recall: str = ""
    """`asked` of the robot; then `told` or `accepted`, whichever it does first; empty when nothing is recalled."""
    _told: bool = False
    """The robot told its mission since the last answer."""
    _undo: list[Draft] = field(default_factory=list)
    _redo: list[Draft] = field(default_factory=list)
    _merge: str = ""

    @property
    def state(self) -> str:
        """`empty`, `draft`, `sent` or `stored` (the robot confirmed exactly this draft)."""
        if self.sent is not None and self.sent.same_as(self.draft):
            return "sent"
        if self.stored is not None and self.stored.same_as(self.draft):
            return "stored" if self.draft.points else "empty"
        return "draft" if self.draft.points or self.stored is not None else "empty"

    @property
    def dirty(self) -> bool:
        """The robot has not confirmed this draft."""
        return self.state in ("draft", "sent")

    @property
    def can_undo(self) -> bool:
        """There is something to undo."""
        return bool(self._undo)

    @property
    def can_redo(self) -> bool:
        """There is something to redo."""
        return bool(self._redo)

    def _edit(self, draft: Draft, merge: str = "") -> None:
        """Make `draft` the present one; edits in a row that `merge` under one word are one step of undo."""
        if draft == self.draft:
            return
        if not merge or merge != self._merge:
            self._undo.append(self.draft)
            del self._undo[:-STEPS]
        self._merge = merge
        self._redo.clear()
        self.draft, self.outcome, self.failed = draft, "", False
        self.on_change()

    def add(self, x: float, y: float) -> None:
        """Append a point at (x, y) in `map` [m]."""
        _check_place(x, y)
        self._edit(replace(self.draft, points=(*self.draft.points, (x, y))))

    def move(self, index: int, x: float, y: float) -> None:
        """Put the point at `index`, from 0, to (x, y) in `map` [m]; IndexError when there is none."""
        _check_place(x, y)
        points = list(self.draft.points)
        points[self._checked(index)] = (x, y)
        self._edit(replace(self.draft, points=tuple(points)))

    def remove(self, index: int) -> None:
        """Take out the point at `index`, from 0; IndexError when there is none."""
        points, levels = list(self.draft.points), list(self.draft.levels)
        del points[self._checked(index)], levels[index]
        self._edit(self.draft.routed(points, levels))

    def reorder(self, index: int, target: int) -> None:
        """Move the point at `index` to the place `target` in the order, both from 0; IndexError when there is none."""
        points, levels = list(self.draft.points), list(self.draft.levels)
        point, level = points.pop(self._checked(index)), levels.pop(index)
        points.insert(self._checked(target), point)
        levels.insert(target, level)
        self._edit(self.draft.routed(points, levels))

    def clear(self) -> None:
        """Take out all points; home and motion stay."""
        self._edit(replace(self.draft, points=(), heights=()))

    def set_height(self, height: float | None, index: int = -1) -> None:
        """Have the point at `index`, from 0, or every one for -1, at a `height` in `map` [m]; None for the one that the robot has."""
        if height is not None and not math.isfinite(height):
            raise ValueError(tr("A height needs a number, not {height}.").format(height=height))
        if index >= 0:
            self._checked(index)
        self._edit(self.draft.levelled(height, index), merge=f"height {index}")

    def set_home(self, x: float, y: float) -> None:
        """Set the place to return to, in `map` [m]."""
        _check_place(x, y)
        self._edit(replace(self.draft, home=(x, y)))

    def set_motion(
        self,
        *,
        motion: str | None = None,
        dwell: float | None = None,
        laps: int | None = None,
        on_intruder: str | None = None,
    ) -> None:
        """Change what is given; numbers beyond their bounds are brought to them.

        ValueError for an unknown motion or reaction to an intruder.
        """
        for what, value, known in (("motion", motion, MOTIONS), ("reaction", on_intruder, REACTIONS)):
            if value is not None and value not in known:
                raise ValueError(
                    tr("The {what} is one of {known}, not {value!r}.").format(
                        what=what, known=", ".join(known), value=value
                    )
                )
        changes: dict[str, Any] = {"motion": motion, "on_intruder": on_intruder}
        changes["dwell"] = None if dwell is None else min(max(dwell, 0.0), MAX_DWELL)
        changes["laps"] = None if laps is None else min(max(laps, 0), MAX_LAPS)
        changes = {name: value for name, value in changes.items() if value is not None}
        self._edit(replace(self.draft, **changes), merge=",".join(changes))

    def set_name(self, name: str) -> None:
        """Set what the robot keeps it as; empty for none."""
        self._edit(replace(self.draft, name=name), merge="name")

    def put(self, draft: Draft) -> None:
        """Put another draft in the place of this one, as one step of undo."""
        self._edit(draft)

    def _checked(self, index: int) -> int:
        if not 0 <= index < len(self.draft.points):
            raise IndexError(f"There is no point {index + 1}; there are {len(self.draft.points)}.")
        return index

    def undo(self) -> None:
        """Take the last edit back; does nothing when there is none."""
        self._step(self._undo, self._redo)

    def redo(self) -> None:
        """Do the last undone edit again; does nothing when there is none."""
        self._step(self._redo, self._undo)

    def _step(self, source: list[Draft], target: list[Draft]) -> None:
        if source:
            target.append(self.draft)
            self.draft, self._merge = source.pop(), ""
            self.outcome, self.failed = "", False
            self.on_change()

    def sending(self) -> Mission:
        """The message to send now; the draft counts as sent until it is `answered` or the robot tells that it has it."""
        if self.sent is None:
            self._told = False
        self.sent, self.outcome, self.failed = self.draft, "", False
        self.on_change()
        return self.draft.message()

    def answered(self, draft: Draft, accepted: bool, sentence: str) -> None:
        """Tell what became of sending `draft`, which need not be the newest that was sent.

        An acceptance makes it the stored mission, unless the robot itself told meanwhile what it has.
        """
        if accepted and not self._told:
            self.stored = draft
        self._told = False
        if self.sent is not None and self.sent.same_as(draft):
            self.sent, self.outcome, self.failed = None, sentence, not accepted
        self.on_change()

    def robot_has(self, mission: Mission) -> None:
        """Take in the mission that the robot says it stored."""
        told = Draft.of(mission)
        untouched = self.stored is None and not self._undo and self.draft == Draft()
        unchanged = self.stored is not None and self.stored.same_as(self.draft)
        self.stored, self._told = told, True
        if self._recall:
            self._recall = "" if self._recall == "accepted" else "told"
            unchanged = unchanged or not self._recall
        if self.sent is not None and told.same_as(self.sent):
            self.sent = None
        if (untouched or unchanged) and not told.same_as(self.draft):
            if unchanged:
                self._undo.append(self.draft)
            self.draft = told
        self.on_change()

    def recalling(self) -> None:
        """The robot is asked for another mission of those it keeps: it goes before a draft that was edited."""
        self._recall = "asked"

    def recalled(self, accepted: bool) -> None:
        """Tell what became of that; the mission itself may come before or after this."""
        told, self._recall = self._recall == "told", ""
        if accepted and told and self.stored is not None:
            self._edit(self.stored)
        elif accepted:
            self._recall = "accepted"

    @property
    def home_to_send(self) -> Mission | None:
        """What the robot has, with the home that is drawn here; None where it has that home already, or none is drawn."""
        kept, home = self.stored or Draft(), self.draft.home
        if home is None or (kept.home is not None and math.dist(home, kept.home) <= NEAR):
            return None
        return replace(kept, home=home).message()

    def save(self) -> dict[str, Any]:
        """The draft for the settings file."""
        return msgspec.to_builtins(self.draft)  # type: ignore[no-any-return]

    def load(self, saved: object) -> bool:
        """Bring back a saved draft; False, and nothing changed, when it is none."""
        try:
            draft = msgspec.convert(saved, Draft)
        except msgspec.ValidationError:
            return False
        places = [*draft.points, *([draft.home] if draft.home is not None else [])]
        numbers = [value for place in places for value in place]
        numbers += [height for height in draft.heights if height is not None]
        known = draft.motion in MOTIONS and draft.on_intruder in REACTIONS
        if not known or not all(map(math.isfinite, [*numbers, draft.dwell])):
            return False
        self.draft = draft
        self._undo.clear()
        self._redo.clear()
        self.on_change()
        return True


def _height(told: float) -> float | None:
    """Of a point as a robot tells it: 0 and what is no number are none."""
    return told if told and math.isfinite(told) else None


def _check_place(x: float, y: float) -> None:
    if not (math.isfinite(x) and math.isfinite(y)):
        raise ValueError(tr("A place needs two numbers, not ({x}, {y}).").format(x=x, y=y))
