"""Small parts of behaviour trees."""

from __future__ import annotations

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import Decorator

__all__ = ["Action", "Rounds"]


class Action(Behaviour):
    """One thing done at once; its result is whether it succeeded."""

    def __init__(self, name: str, act: Callable[[], bool]) -> None:
        super().__init__(name)
        self._act = act

    def update(self) -> Status:
        """Do it."""
        return Status.SUCCESS if self._act() else Status.FAILURE


class Rounds(Decorator):
    """Does its child again and again until there is nothing left to do; fails with it."""

    def __init__(self, name: str, child: Behaviour, finished: Callable[[], bool]) -> None:
        super().__init__(name, child)
        self._finished = finished

    def update(self) -> Status:
        """Look whether that was the last time."""
        if self.decorated.status is not Status.SUCCESS:
            return self.decorated.status
        return Status.SUCCESS if self._finished() else Status.RUNNING
