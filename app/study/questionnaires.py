"""Questionnaires on workload and usability: raw NASA-TLX and SUS, scored as published and kept.

store = Workloads(folder / "responses")
store.put(Workload(form="tlx", answers={"mental": 35, …}, …))
"""

from __future__ import annotations

import logging
import os
from collections.abc import Mapping
from pathlib import Path

import msgspec

__all__ = ["BASELINE", "FILE", "SUS_ABOVE", "Workload", "Workloads", "raw_tlx", "sus"]

log = logging.getLogger(__name__)

FILE = "workload.jsonl"
BASELINE = 34.2
"""Raw TLX of ten people with the patrol robot, three runs each, in the paper; 0 to 100, less is better."""
SUS_ABOVE = 68.0
"""What is above is above the average of published studies."""
TLX = ("mental", "physical", "temporal", "performance", "effort", "frustration")
"""Scales of the NASA task load index, in the order of its form."""
TLX_STEP, TLX_MOST = 5, 100
SUS_ITEMS, SUS_MOST = 10, 5
MAX_KEPT = 2000
"""At most so many, the newest, are kept."""


class Workload(msgspec.Struct, kw_only=True):
    """One form that was filled in. None where something is not known."""

    form: str
    """`tlx` or `sus`."""
    answers: dict[str, int]
    """Of TLX: scale to 0 … 100. Of SUS: number of the item, "1" to "10", to 1 … 5."""
    order: list[str] = msgspec.field(default_factory=list)
    """In which they were answered first."""
    seconds: dict[str, float] = msgspec.field(default_factory=dict)
    """Until each had its last answer, from when the form was shown [s]."""
    at: float = 0.0
    """When it was handed in, since 1970 [s]."""
    session: str = ""
    user: str = ""
    method: str = ""
    """What was used before it; empty for no one method."""
    posture: str = ""
    task: str = ""
    """What was done before it, as in `patrol`."""

    @property
    def score(self) -> float:
        """0 to 100: of TLX the load, of SUS the usability. ValueError where an answer lacks or is out of range."""
        return raw_tlx(self.answers) if self.form == "tlx" else sus(self.answers)


def raw_tlx(answers: Mapping[str, int]) -> float:
    """Mean of the six scales, 0 to 100, without weighing them in pairs (Byers, Bittner and Hill 1989).

    `performance` runs from perfect, 0, to failure, 100. ValueError for a scale that lacks, is unknown, or has no step of 5.
    """
    _whole(answers, TLX)
    for name, value in answers.items():
        if not (0 <= value <= TLX_MOST and value % TLX_STEP == 0):
            raise ValueError(f"{name} is {value}: 0 to {TLX_MOST} in steps of {TLX_STEP} is allowed")
    return sum(answers.values()) / len(TLX)


def sus(answers: Mapping[str, int]) -> float:
    """Score of the system usability scale, 0 to 100 (Brooke 1996): odd items count x - 1, even ones 5 - x; times 2.5.

    ValueError for an item that lacks or is unknown, or an answer that is not 1 to 5.
    """
    _whole(answers, tuple(str(number) for number in range(1, SUS_ITEMS + 1)))
    total = 0
    for name, value in answers.items():
        if not 1 <= value <= SUS_MOST:
            raise ValueError(f"Item {name} is {value}: 1 to {SUS_MOST} is allowed")
        total += value - 1 if int(name) % 2 else SUS_MOST - value
    return total * 2.5


def _whole(answers: Mapping[str, int], names: tuple[str, ...]) -> None:
    lacking = [name for name in names if name not in answers]
    unknown = [name for name in answers if name not in names]
    if lacking or unknown:
        what = f"{', '.join(lacking)} has no answer" if lacking else f"{', '.join(unknown)} is no part of it"
        raise ValueError(f"The form cannot be scored: {what}")


class Workloads:
    """The forms that were filled in, in a file beside the response log. Rare and small: written at once."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / FILE
        self.problem = ""
        """One sentence when the disk failed; empty when all is well."""
        self._kept: list[Workload] | None = None

    @property
    def kept(self) -> list[Workload]:
        """All there are, the oldest first; what cannot be read or scored is left out. Read once."""
        if self._kept is None:
            self._kept = self._read()
        return self._kept

    def put(self, workload: Workload) -> None:
        """Keep one; ValueError where it cannot be scored."""
        _ = workload.score
        self._kept = [*self.kept, workload][-MAX_KEPT:]
        self._write()

    def erase(self) -> None:
        """Forget all."""
        self._kept = []
        self._write()

    def scores(self, form: str) -> list[tuple[float, float]]:
        """When [s since 1970] and score of each of one form, the oldest first."""
        return [(one.at, one.score) for one in self.kept if one.form == form]

    def _read(self) -> list[Workload]:
        try:
            found = self.path.read_bytes().splitlines()
        except FileNotFoundError:
            return []
        except OSError as error:
            self.problem = f"The forms could not be read: {error.strerror or error}."
            return []
        kept, decode = [], msgspec.json.Decoder(Workload).decode
        for line in found:
            try:
                one = decode(line)
                _ = one.score
            except (msgspec.DecodeError, UnicodeDecodeError, ValueError):
                log.warning("a line of %s was left out", self.path.name)
            else:
                kept.append(one)
        return kept[-MAX_KEPT:]

    def _write(self) -> None:
        fresh = self.path.with_suffix(".new")
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with fresh.open("wb") as file:
                file.write(b"".join(msgspec.json.encode(one) + b"\n" for one in self.kept))
                file.flush()
                os.fsync(file.fileno())
            fresh.replace(self.path)
        except OSError as error:
            self.problem = f"The form could not be saved: {error.strerror or error}."
            log.warning("%s", self.problem)
        else:
            self.problem = ""
