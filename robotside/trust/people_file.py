"""The file of people, shared by the robot and the command line beside it."""

from __future__ import annotations

import fcntl
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from robotside.trust.people import MAX_PEOPLE, Person, read_people, written
from robotside.trust.private_file import PRIVATE, write_private

__all__ = ["PeopleFile", "Unkept"]

FILE_NAME = "people.json"
LOCK_TIMEOUT = 3.0
"""The longest wait for another program that changes the file [s]."""
LOCK_POLL_PERIOD = 0.02
MAX_BYTES = 2_000 * MAX_PEOPLE
"""A larger file is damaged."""

_Signature = tuple[int, int, int, int] | None


class Unkept(Exception):
    """The file cannot be read or written; the text is one sentence."""


class PeopleFile:
    """The people of one robot, in its state directory."""

    def __init__(self, state: Path, *, patience: float = LOCK_TIMEOUT) -> None:
        """`state` is the state directory, which need not be there; `patience` [s] is waited for another program."""
        self.path = state / FILE_NAME
        """The file, in JSON; it holds no key, only hashes."""
        self.problem = ""
        """Why the people are not those of before, as one sentence; empty when all is well."""
        self._patience = patience

    @property
    def signature(self) -> _Signature:
        """Another one after each change by whatever program; None without a file."""
        try:
            found = self.path.stat()
        except OSError:
            return None
        return found.st_ino, found.st_size, found.st_mtime_ns, found.st_ctime_ns

    def read(self) -> tuple[Person, ...]:
        """Everybody in it, oldest first; nobody without a file.

        A damaged file is moved aside, said in `problem`, and leaves nobody. Raises Unkept when it cannot be read.
        """
        try:
            with self.path.open("rb") as file:
                content = file.read(MAX_BYTES + 1)
        except FileNotFoundError:
            return ()
        except OSError as error:
            raise Unkept(_sentence("read", error)) from error
        try:
            if len(content) > MAX_BYTES:
                raise ValueError("It is too large.")
            return read_people(content)
        except (ValueError, RecursionError):
            self.problem = self._set_aside()
            return ()

    def change(self, how: Callable[[Sequence[Person]], Sequence[Person]]) -> tuple[Person, ...]:
        """Everybody after `how` has made others of them, on the disk; no other program changes them meanwhile.

        Waits for the disk. Raises Unkept when they cannot be kept, and what `how` raises; then all is as before.
        """
        with self._locked():
            people = tuple(how(self.read()))
            try:
                write_private(self.path, written(people))
            except OSError as error:
                raise Unkept(_sentence("written", error)) from error
            return people

    def _set_aside(self) -> str:
        aside = self.path.with_name(f"people-damaged-{time.time_ns()}.json")
        try:
            self.path.replace(aside)
        except OSError:
            aside = self.path
        return (
            f"The list of people was damaged and is at {aside}: this robot knows nobody any more; pair again."
        )

    @contextmanager
    def _locked(self) -> Iterator[None]:
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            lock = os.open(f"{self.path}.lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, PRIVATE)
        except OSError as error:
            raise Unkept(_sentence("written", error)) from error
        try:
            end = time.monotonic() + self._patience
            while True:
                try:
                    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    break
                except BlockingIOError as error:
                    if time.monotonic() > end:
                        raise Unkept("Another program changes the list of people; try again.") from error
                    time.sleep(LOCK_POLL_PERIOD)
            yield
        finally:
            os.close(lock)


def _sentence(what: str, error: OSError) -> str:
    return f"The list of people cannot be {what}: {(error.strerror or str(error)).lower()}."
