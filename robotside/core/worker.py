"""Long work beside the loop that drives the robot: handed in as steps, polled for its result, dropped at any moment.

job = worker.submit(planner.search(start, goal, "Point 1"))
...
if job.poll():  # in each step of the loop
    path = job.result()  # raises what the work raised
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Generic, Protocol, TypeAlias, TypeVar

__all__ = ["STEPS_PER_POLL", "InLoopWorker", "Job", "Work", "Worker", "completed"]

T = TypeVar("T")
R_co = TypeVar("R_co", covariant=True)

Work: TypeAlias = Generator[None, None, T]
"""Work that ends with its result; between two of its steps it can be dropped. It must not touch what the loop changes."""

STEPS_PER_POLL = 40
"""Steps of a search that are a few milliseconds, so that a STOP is handled in time."""


class Job(Protocol[R_co]):
    """Work that was handed in. All calls come from the loop's thread."""

    def poll(self) -> bool:
        """True once it is done; call it in each step of the loop."""

    def result(self) -> R_co:
        """What it has found, or it raises what the work raised; only once it is done."""

    def cancel(self) -> None:
        """Its result is not wanted any more; it is never done then."""


class Worker(Protocol):
    """Does work, one piece after the other."""

    def submit(self, work: Work[T]) -> Job[T]:
        """Begin with `work` when its turn comes."""


def completed(work: Work[T]) -> T:
    """What `work` finds, all of it done here and now; raises what it raises."""
    while True:
        try:
            next(work)
        except StopIteration as end:
            found: T = end.value
            return found


class InLoopWorker:
    """Does work in the loop's own thread, a bounded number of steps in each poll: the same each time, for virtual time."""

    def __init__(self, steps: int = STEPS_PER_POLL) -> None:
        """`steps` of each poll; with enough of them all work is done in the first one."""
        self._steps = steps

    def submit(self, work: Work[T]) -> Job[T]:
        """Begin with `work` in the job's first poll."""
        return _InLoopJob(work, self._steps)


class _InLoopJob(Generic[T]):
    def __init__(self, work: Work[T], steps: int) -> None:
        self._work, self._steps = work, steps
        self._found: list[T] = []
        self._fault: Exception | None = None
        self._cancelled = False

    def poll(self) -> bool:
        """Do its share of the work."""
        if self._cancelled:
            return False
        try:
            for _ in range(0 if self._done else self._steps):
                next(self._work)
        except StopIteration as end:
            self._found.append(end.value)
        except Exception as fault:  # noqa: BLE001 - who asks for the result gets the fault, of any kind
            self._fault = fault
        return self._done

    def result(self) -> T:
        """What it has found."""
        if self._fault is not None:
            raise self._fault
        return self._found[0]

    def cancel(self) -> None:
        """Do no more of it."""
        self._cancelled = True
        self._work.close()

    @property
    def _done(self) -> bool:
        return bool(self._found) or self._fault is not None
