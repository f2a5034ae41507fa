"""Export of a study as one zip: lines of JSON, the same as a table, forms, settings, and a description of each."""

from __future__ import annotations

import csv
import io
import json
import time
import zipfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import msgspec

from app.study.questionnaires import FILE as FORMS
from app.study.questionnaires import Workloads
from app.study.response_log import Response, files, read

__all__ = ["COLUMNS", "SETTINGS", "export", "table"]

COLUMNS = tuple(name for name in Response.__struct_fields__ if name != "snippet")
"""Of the table: every field but the snippets, which are only in the lines of JSON."""
SETTINGS = ("theme", "shake", "voice", "tilt", "switches", "gamepads", "keys", "intents", "study")
"""Settings that go along; names of robots, addresses and keys do not."""

FIRST_YEAR, LAST_YEAR = 1980, 2107
"""That a zip can say."""

README = """Pilothouse: what a study gathered, {when}

responses*.jsonl   one line of JSON for each command, the oldest file has the highest number
responses.csv      the same as a table, without snippets
workload.jsonl     the forms: NASA-TLX (raw) and SUS, every answer with order and time
scores.csv         the forms' scores
settings.json      how the methods were set up when this was written, what nobody changed included; null: as usual

Times are seconds since 1970; an empty field means not known, or did not happen. Differences are exact: the clock that counts
them is not set during a session. Fields of a response:

{fields}

A response time is t_sent - t_input_start (or t_ack, t_effect, for longer ways). Where nothing was sent, in a study without a
robot, take t_decided. In a study the first line with a prompt_id answers it; recognised = intended is a success, an empty
recognised a miss, a line with a user and without a prompt_id a false activation. Lines of kind "armed" say for how long a
method was listening.

NASA-TLX, raw: mean of six scales of 0 to 100 in steps of 5, performance from perfect (0) to failure (100). Paper: {baseline}.
SUS: (odd items x - 1, even items 5 - x) summed, times 2.5; 0 to 100.
"""
MEANINGS = {
    "kind": "command, drive, selection or armed",
    "id": "of the line",
    "session": "from the app's start to its end",
    "user": "as entered in the study; empty outside of it",
    "robot": "its name",
    "method": "button, voice, shake, tilt, switches, gamepad, keyboard or map",
    "posture": "standing or walking",
    "prompt_id": "of the prompt that it answers",
    "intended": "the command that was prompted",
    "recognised": "the command that was understood",
    "said": "what was understood, in words",
    "confidence": "0 to 1",
    "verdict": "acted, waits, asks, not allowed, not now, cancelled, lapsed, practised",
    "rejected": "why nothing was done",
    "t_prompt": "the prompt was shown",
    "t_input_start": "gesture, word or touch began",
    "t_input_end": "it ended",
    "t_decided": "the app knew what was meant",
    "t_sent": "the command left for the robot",
    "t_ack": "the robot answered",
    "t_effect": "the robot's state had changed as asked",
    "outcome": "accepted, refused or no_reply",
    "undo": "cancelled at the bar, or taken back by the opposite command within 5 s",
    "presses": "of switches for this selection",
    "seconds": "of driving, or of listening",
    "noise_db": "noise round about [dB]",
}


def table(responses: Iterable[Response]) -> str:
    """The responses as comma-separated values, with a line of names; what is not known is empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for one in responses:
        values = (getattr(one, name) for name in COLUMNS)
        writer.writerow("" if value is None else _plain(value) for value in values)
    return text.getvalue()


def _plain(value: object) -> object:
    """A text that a spreadsheet would take for a formula is made one that it does not."""
    return f"'{value}" if isinstance(value, str) and value[:1] in tuple("=+-@") else value


def export(folder: Path, to: Path, settings: Mapping[str, Any], wall: float) -> Path:
    """Write a zip of what is in `folder` below `to`, named by the time of day `wall` [s]; OSError when it cannot be written.

    An earlier one is never written over, and half a file is never left.
    """
    to.mkdir(parents=True, exist_ok=True)
    path = _free(to, time.strftime("study_%Y-%m-%d_%H-%M-%S", time.localtime(wall)))
    fresh = path.with_suffix(".new")
    try:
        with zipfile.ZipFile(fresh, "w", zipfile.ZIP_DEFLATED, strict_timestamps=False) as archive:
            _fill(archive, folder, settings, wall)
        fresh.replace(path)
    except BaseException:
        fresh.unlink(missing_ok=True)
        raise
    return path


def _free(folder: Path, name: str) -> Path:
    number, path = 2, folder / f"{name}.zip"
    while path.exists():
        path, number = folder / f"{name}_{number}.zip", number + 1
    return path


def _dated(wall: float) -> tuple[int, int, int, int, int, int]:
    """As a zip writes it: a clock that was lost stands before 1980, where its years begin."""
    there = time.localtime(wall)
    if not FIRST_YEAR <= there.tm_year <= LAST_YEAR:
        return (FIRST_YEAR, 1, 1, 0, 0, 0)
    return (there.tm_year, there.tm_mon, there.tm_mday, there.tm_hour, there.tm_min, there.tm_sec)


def _fill(archive: zipfile.ZipFile, folder: Path, settings: Mapping[str, Any], wall: float) -> None:
    from app.study.questionnaires import BASELINE

    def put(name: str, data: str | bytes) -> None:
        info = zipfile.ZipInfo(name, _dated(wall))
        info.external_attr = 0o600 << 16
        archive.writestr(info, data, zipfile.ZIP_DEFLATED)

    for path in files(folder):
        archive.write(path, path.name)
    put("responses.csv", table(read(folder)[0]))
    forms = Workloads(folder).kept
    put(FORMS, b"".join(msgspec.json.encode(one) + b"\n" for one in forms))
    rows = [["at", "form", "score", "user", "method", "posture", "task"]]
    rows += [
        [str(one.at), one.form, f"{one.score:.2f}", one.user, one.method, one.posture, one.task]
        for one in forms
    ]
    scores = io.StringIO()
    csv.writer(scores, lineterminator="\n").writerows(rows)
    put("scores.csv", scores.getvalue())
    put("settings.json", json.dumps(dict(settings), indent=1))
    when = time.strftime("%Y-%m-%d %H:%M", time.localtime(wall))
    fields = "\n".join(f"{name:14} {meaning}" for name, meaning in MEANINGS.items())
    put("README.txt", README.format(when=when, fields=fields, baseline=BASELINE))
