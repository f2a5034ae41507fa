"""A person's name leaves what happened; what happened stays."""

from __future__ import annotations

import asyncio
from pathlib import Path

from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Event, TaskOrder, TaskRun
from bridge.msgs.std_msgs import Time
from robotside.records import Records
from robotside.records.audit import Entry
from robotside.records.database.rows import Answered
from robotside.records.opening import open_records

NOW = Time(1_795_279_047, 0)


def opened(state: Path) -> Records:
    return open_records(state, None, asyncio.get_running_loop().call_soon_threadsafe, patience=0.2)


async def fill(records: Records) -> None:
    with records.together() as job:
        records.events.add(
            Event(
                stamp=NOW,
                text="STOP pressed by Ben (2).",
                acknowledged_by="Ben (2)",
                parameters=[KeyValue("name", "Ben (2)"), KeyValue("task", "patrol")],
            ),
            lambda _: None,
        )
        records.events.add(Event(stamp=NOW, text="Ben (2)e and Bendix are others."), lambda _: None)
        records.runs.begin(
            TaskRun(order=TaskOrder(task="hold"), started=NOW, by="Ben (2)", reason="Ben (2) ended it.")
        )
        records.answers.keep(Answered("id-8", "/stop", "1", '{"message": "Stopped by Ben (2)."}'))
        records.note_stop("Ben (2)")
        records.audit.record(Entry("call /stop", "done", "id-8", "Ben (2)", address="192.0.2.9"), 1000.0)
    assert await job.kept(10.0) == ""


async def test_an_erased_name_is_in_no_file_and_what_happened_is_still_told(tmp_path: Path) -> None:
    records = opened(tmp_path)
    await fill(records)
    assert await records.erase("Ben (2)").kept(10.0) == ""
    records.close()
    content = (tmp_path / "records.sqlite3").read_bytes()
    assert content.count(b"Ben (2)") == content.count(b"Ben (2)e"), "of another it is only a part"
    assert b"192.0.2.9" not in content
    records = opened(tmp_path)
    event, other = records.events.since(0, "")
    assert (event.text, event.acknowledged_by) == ("STOP pressed by erased.", "erased")
    assert [pair.value for pair in event.parameters] == ["erased", "patrol"]
    assert other.text == "Ben (2)e and Bendix are others."
    (run,) = records.runs.before()
    assert (run.by, run.reason) == ("erased", "erased ended it.")
    assert records.stopped_by == "erased", "it stays pressed"
    assert records.answers.all() == []
    assert records.audit.verify() is None
    records.close()


async def test_nobody_has_no_name_to_erase(tmp_path: Path) -> None:
    records = opened(tmp_path)
    await fill(records)
    assert await records.erase("").kept(10.0) == ""
    assert records.events.since(0, "")[0].text == "STOP pressed by Ben (2)."
    records.close()
