"""Snapshots of living objects: what changes of them is saved and put back in place, so that no closure loses its object.

A copy would not do: what the robot side is made of refers to itself by closures, which a copy leaves at the original.
"""

from __future__ import annotations

import enum
import functools
import itertools
import logging
import types
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import msgspec
import numpy as np

__all__ = ["NOTHING", "Living", "Snapshot", "Unlearned"]

NOTHING = "nothing"
"""Stands for what tells nothing."""

_NONE: frozenset[str] = frozenset()

Snapshot = list[tuple[Any, Any]]
"""Objects and what they held, not deeper."""

_ATOMS = (
    str, bytes, int, float, complex, bool, type(None), type, types.ModuleType, enum.Enum, np.ndarray, np.generic,
    msgspec.Struct, logging.Logger, types.BuiltinFunctionType, itertools.count, types.CodeType,
)  # fmt: skip
"""Values, and what holds nothing that changes."""


def _slots(kind: type) -> tuple[str, ...]:
    names = [name for each in kind.__mro__ for name in _as_names(each.__dict__.get("__slots__", ()))]
    return tuple(name for name in names if name not in ("__dict__", "__weakref__"))


_slots = functools.cache(_slots)


def _as_names(slots: object) -> tuple[str, ...]:
    return (slots,) if isinstance(slots, str) else tuple(slots)  # type: ignore[arg-type]


def _attributes(thing: Any) -> dict[str, Any]:
    own = dict(vars(thing)) if hasattr(thing, "__dict__") else {}
    for name in _slots(type(thing)):
        if hasattr(thing, name):
            own[name] = getattr(thing, name)
    return own


def _cell(thing: types.CellType) -> tuple[Any, ...]:
    try:
        return (thing.cell_contents,)
    except ValueError:
        return ()


def _nothing(_: Any) -> None:
    return None


@functools.cache
def _reader(kind: type) -> Callable[[Any], Any]:
    """How a thing of this class is read; looked up once for a class, since it is read millions of times."""
    if issubclass(kind, dict):
        return dict
    if issubclass(kind, list | set | deque):
        return tuple
    if issubclass(kind, types.CellType):
        return _cell
    if issubclass(kind, tuple | frozenset | types.FunctionType | types.MethodType | functools.partial):
        return _nothing
    return _attributes if _slots(kind) or not kind.__dictoffset__ else _own


def _own(thing: Any) -> dict[str, Any]:
    return dict(vars(thing))


def held(thing: Any) -> Any:
    """What `thing` holds, not deeper; None for what cannot change."""
    return _reader(type(thing))(thing)


def _put_attributes(thing: Any, content: dict[str, Any]) -> None:
    for name, value in content.items():
        object.__setattr__(thing, name, value)
    if hasattr(thing, "__dict__"):
        for name in vars(thing).keys() - content.keys():
            del vars(thing)[name]


def _put_own(thing: Any, content: dict[str, Any]) -> None:
    own = vars(thing)
    own.update(content)
    if len(own) > len(content):
        for name in own.keys() - content.keys():
            del own[name]


def _put_pairs(thing: Any, content: Any) -> None:
    thing.clear()
    thing.update(content)


def _put_all(thing: Any, content: tuple[Any, ...]) -> None:
    thing.clear()
    thing.extend(content)


def _put_cell(thing: types.CellType, content: tuple[Any, ...]) -> None:
    if content:
        thing.cell_contents = content[0]


@functools.cache
def _writer(kind: type) -> Callable[[Any, Any], None]:
    """How a thing of this class is put back."""
    if issubclass(kind, dict | set):
        return _put_pairs
    if issubclass(kind, list | deque):
        return _put_all
    if issubclass(kind, types.CellType):
        return _put_cell
    return _put_own if _reader(kind) is _own else _put_attributes


def put_back(thing: Any, content: Any) -> None:
    """Have `thing` hold that again."""
    _writer(type(thing))(thing, content)


def parts(thing: Any, content: Any) -> Iterator[Any]:
    """What `thing` refers to."""
    if isinstance(thing, dict):
        yield from thing.keys()
        yield from thing.values()
    elif isinstance(thing, tuple | frozenset):
        yield from thing
    elif isinstance(thing, types.FunctionType):
        yield from thing.__closure__ or ()
        yield from thing.__defaults__ or ()
        yield from (thing.__kwdefaults__ or {}).values()
    elif isinstance(thing, types.MethodType):
        yield thing.__self__
    elif isinstance(thing, functools.partial):
        yield from (thing.func, *thing.args, *thing.keywords.values())
    elif isinstance(content, dict):
        yield from content.values()
    else:
        yield from content or ()


class Unlearned(Exception):
    """Something changes that was not known to: states that differ in it were taken for the same. It is known from now on."""


class Living:
    """The objects behind a root, and those of them that change."""

    def __init__(self, root: object, ignored: tuple[type, ...]) -> None:
        """Objects of the `ignored` classes are not looked into: what they hold moves nothing."""
        self.root, self._atoms = root, _ATOMS + ignored
        self._atomic: dict[type, bool] = {}
        self._all: dict[int, Any] = {}
        self._first: dict[int, Any] = {}
        self._discover()
        self.changing: list[Any] = [root]
        self._numbers = {id(root): 0}
        self._varied: dict[int, set[str]] = {}
        """By object the attributes that were seen to change."""
        self._names: dict[int, tuple[int, list[tuple[str, str]]]] = {}
        """By object how many of them there were when it was told last, and those that are told, in order."""

    def is_atom(self, thing: Any) -> bool:
        """Whether `thing` is a value, not looked into."""
        kind = type(thing)
        found = self._atomic.get(kind)
        if found is None:
            found = self._atomic[kind] = issubclass(kind, self._atoms)
        return found

    def _discover(self) -> None:
        waiting = [self.root]
        while waiting:
            thing = waiting.pop()
            if self.is_atom(thing) or id(thing) in self._all:
                continue
            content = held(thing)
            self._all[id(thing)] = thing
            self._first[id(thing)] = content
            waiting.extend(parts(thing, content))

    def learn(self) -> bool:
        """Look at all objects: those that hold something else than at first change; True when new ones were found."""
        found = [
            thing
            for number, thing in self._all.items()
            if number not in self._numbers and not _same(self._first[number], held(thing))
        ]
        for thing in found:
            self._numbers[id(thing)] = len(self.changing)
            self.changing.append(thing)
        return self.notice() or bool(found)

    def notice(self) -> bool:
        """Look at what is known to change alone, for attributes of it that were not; True when new ones were found."""
        news = [self._vary(thing, held(thing)) for thing in self.changing]
        return any(news)

    def _vary(self, thing: Any, content: Any) -> bool:
        """Note which attributes of `thing` are not as at first; True when one of them was not known to change."""
        if isinstance(thing, dict) or not isinstance(content, dict):
            return False
        first = self._first[id(thing)]
        varied = self._varied.setdefault(id(thing), set())
        before = len(varied)
        for name, value in content.items():
            if name not in varied and value is not first.get(name) and not _equal(value, first.get(name)):
                varied.add(name)
        return len(varied) > before

    def save(self) -> Snapshot:
        """What all that changes holds now, and what was made since and may change as well."""
        seen, saved, waiting = set(self._all), [], list(self.changing)
        for thing in waiting:
            content = held(thing)
            if id(thing) in self._numbers and self._vary(thing, content):
                raise Unlearned(f"An attribute of {type(thing).__name__} changes that was not learned.")
            if content is not None:
                saved.append((thing, content))
            for part in parts(thing, content):
                if id(part) not in seen and not self.is_atom(part):
                    seen.add(id(part))
                    waiting.append(part)
        return saved

    @staticmethod
    def restore(saved: Snapshot) -> None:
        """Have everything as it was."""
        for thing, content in saved:
            _writer(type(thing))(thing, content)

    def digest(
        self,
        value: Callable[[Any, str], Any],
        left_out: Mapping[str, frozenset[str]],
        twins: tuple[type, ...],
    ) -> int:
        """A number that is the same for states that are.

        `value` tells an atom from others, by where it is. `left_out` are attributes by class that tell nothing, and of `twins`
        it does not matter which one it is but what it holds.
        """
        canonical = _Canonical(self, value, left_out, twins)
        return hash(
            tuple(canonical.content(thing) for thing in self.changing if not isinstance(thing, twins))
        )


def _same(before: Any, after: Any) -> bool:
    if isinstance(before, dict):
        return before.keys() == after.keys() and all(
            before[key] is after[key] or _equal(before[key], after[key]) for key in before
        )
    if before is None:
        return True
    return len(before) == len(after) and all(
        a is b or _equal(a, b) for a, b in zip(before, after, strict=True)
    )


def _equal(one: Any, other: Any) -> bool:
    plain = (str, int, float, bool)
    return (
        isinstance(one, plain)
        and isinstance(other, plain)
        and (one == other or (one != one and other != other))
    )


class _Canonical:
    def __init__(
        self,
        living: Living,
        value: Callable[[Any, str], Any],
        left_out: Mapping[str, frozenset[str]],
        twins: tuple[type, ...],
    ) -> None:
        self._numbers, self._known, self._is_atom = living._numbers, living._all, living.is_atom
        self._varied, self._names = living._varied, living._names
        self._value, self._left_out, self._twins = value, left_out, twins
        self._open: dict[int, int] = {}

    def content(self, thing: Any) -> Any:
        """What `thing` holds."""
        kind = type(thing).__name__
        out = self._left_out.get(kind, _NONE)
        if "*" in out:
            return NOTHING
        if isinstance(thing, dict):
            pairs = [(self.of(key), self.of(each, kind)) for key, each in thing.items()]
            # what is noted of a connection at a time that has passed is as good as gone; of anything else it is there
            there = [pair for pair in pairs if pair[1] != NOTHING or not isinstance(pair[0], str)]
            return ("dict", tuple(sorted(there, key=repr) if len(there) > 1 else there))
        if isinstance(thing, set | frozenset):
            return ("set", tuple(sorted((self._alone(each) for each in thing), key=repr)))
        if isinstance(thing, list | deque | tuple):
            return tuple([self.of(each) for each in thing])
        content = held(thing)
        if isinstance(content, dict):
            names = self._told(thing, content, out)
            return (kind, *[(name, self.of(content[name], where)) for name, where in names])
        return (kind, *[self.of(each) for each in parts(thing, content)])

    def _told(self, thing: Any, content: Mapping[str, Any], out: frozenset[str]) -> Sequence[tuple[str, str]]:
        """Which attributes of `thing` tell something, each with its place."""
        kind = type(thing).__name__
        own = None if isinstance(thing, self._twins) else self._varied.get(id(thing))
        if own is None:
            return [(name, f"{kind}.{name}") for name in sorted(content.keys() - out)]
        known = self._names.get(id(thing))
        if known is None or known[0] != len(own):  # more were seen to change since
            known = len(own), [(name, f"{kind}.{name}") for name in sorted(own - out)]
            self._names[id(thing)] = known
        return known[1]

    def _alone(self, thing: Any) -> Any:
        """What stands for `thing` whatever was looked at before: a set has no order."""
        before, self._open = self._open, {}
        try:
            return self.of(thing)
        finally:
            self._open = before

    def of(self, thing: Any, where: str = "") -> Any:
        """What stands for `thing` where something refers to it, as the attribute `where`."""
        if self._is_atom(thing):
            return self._value(thing, where)
        number = id(thing)
        if number in self._numbers and not isinstance(thing, self._twins):
            return ("#", self._numbers[number])
        if number in self._known:
            return "."
        if number in self._open:
            return ("^", self._open[number])
        self._open[number] = len(self._open)
        return self.content(thing)
