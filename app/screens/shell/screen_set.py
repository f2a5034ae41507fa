"""The screens of a robot by name, each made when it is first asked for, with what it would have heard until then."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable, Iterator, Mapping

from app.link.channels import EVENT, OUTCOME
from app.link.feeds import Post
from app.screens.parts.robot_screen import RobotScreen

__all__ = ["MAX_MISSED", "OUTCOME_AGE", "ScreenSet"]

MAX_MISSED = {EVENT: 500, OUTCOME: 100, "/pose": 2000}
"""Posts of a channel that are kept for screens that are not made yet; of any other channel the newest alone."""
OUTCOME_AGE = 5.0
"""What became of a command is told to a new screen for so long [s]; that it is under way for as long as it is."""


class ScreenSet(Mapping[str, RobotScreen]):
    """A name that is looked up is a screen that is made. Iterating makes none, nor does asking for those that are `made`."""

    def __init__(self, makers: Mapping[str, Callable[[], RobotScreen]], now: Callable[[], float]) -> None:
        """`makers` make the screens by name, in the order of the navigation; `now` is our clock [s]."""
        self._makers, self._now = dict(makers), now
        self._made: dict[str, RobotScreen] = {}
        self._missed: dict[str, deque[tuple[int, Post]]] = {}
        """What came, numbered in its order: the newest of each channel, and of some more."""
        self._count = itertools.count()

    def take_over(self, other: ScreenSet) -> None:
        """Know what `other` was told, so that screens made here begin where those there ended."""
        self._missed, self._count = other._missed, other._count

    def __getitem__(self, name: str) -> RobotScreen:
        """Make it where it is not made yet; KeyError where there is none of that name."""
        if name not in self._made:
            screen = self._made[name] = self._makers[name]()
            self._tell(screen)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)

    def __contains__(self, name: object) -> bool:
        return name in self._makers

    @property
    def made(self) -> Mapping[str, RobotScreen]:
        """Those that are made, by name."""
        return self._made

    def make_anew(self, name: str) -> RobotScreen:
        """Another screen in the place of a made one of that name; returns the one before."""
        old = self._made[name]
        self._made[name] = self._makers[name]()
        return old

    def on_post(self, channel: str, post: Post) -> None:
        """Something came from the robot or its link: told to each screen now, or when it is made."""
        # kept when all are made as well: they may be made anew in another language or size of text
        kept = self._missed.setdefault(channel, deque(maxlen=MAX_MISSED.get(channel, 1)))
        kept.append((next(self._count), post))
        for screen in list(self._made.values()):
            screen.on_post(channel, post)

    def close(self) -> None:
        """Every screen that is made leaves the glass, and lets go of all it has."""
        for screen in self._made.values():
            screen.leave()
            screen.end()

    def _tell(self, screen: RobotScreen) -> None:
        """What a new screen would have heard, in the order in which it came."""
        missed = [(number, channel, post) for channel, kept in self._missed.items() for number, post in kept]
        newest = {post.value.name: number for number, post in self._missed.get(OUTCOME, ())}
        for number, channel, post in sorted(missed, key=lambda one: one[0]):
            if channel != OUTCOME or (newest[post.value.name] == number and self._is_news(post)):
                screen.on_post(channel, post)

    def _is_news(self, post: Post) -> bool:
        return post.value.phase == "sent" or self._now() - post.received < OUTCOME_AGE
