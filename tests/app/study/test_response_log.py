"""The response log: every line is kept as far as the bounds allow, and nothing waits for the disk."""

from __future__ import annotations

import threading
import time

import msgspec
import pytest

from app.study.response_log import FILE, Response, ResponseLog, files, read


def kept(folder, responses, **bounds):
    log = ResponseLog(folder, **bounds)
    for response in responses:
        log.put(response)
    log.close()
    return log


def test_what_was_put_is_read_back_with_everything_it_said(tmp_path):
    response = Response(
        id="a1", method="voice", intended="stop", recognised="stop", confidence=0.93, t_input_start=10.25,
        t_ack=10.75, noise_db=-38.5, snippet=[0.1, 0.2], presses=3,
    )  # fmt: skip
    kept(tmp_path, [response])
    assert read(tmp_path) == ([response], 0)


def test_a_line_is_json_that_says_null_for_what_is_not_known(tmp_path):
    kept(tmp_path, [Response(id="a1", method="button")])
    line = msgspec.json.decode((tmp_path / FILE).read_bytes())
    assert line["method"] == "button"
    assert line["t_effect"] is None
    assert line["kind"] == "command"


def test_no_thread_runs_and_no_folder_is_made_before_the_first_line(tmp_path):
    log = ResponseLog(tmp_path / "responses")
    assert log.flush()
    log.close()
    assert not (tmp_path / "responses").exists()
    assert not [thread for thread in threading.enumerate() if thread.name == "responses"]


def test_it_goes_on_after_what_an_earlier_run_wrote(tmp_path):
    kept(tmp_path, [Response(id="1")])
    kept(tmp_path, [Response(id="2")])
    assert [one.id for one in read(tmp_path)[0]] == ["1", "2"]


def test_the_oldest_go_when_there_is_too_much(tmp_path):
    kept(tmp_path, [Response(id=str(number)) for number in range(100)], size=2000, count=3)
    assert len(files(tmp_path)) == 3
    assert all(path.stat().st_size <= 2000 for path in files(tmp_path))
    numbers = [int(one.id) for one in read(tmp_path)[0]]
    assert numbers == list(range(numbers[0], 100))
    assert numbers[0] > 80


def test_one_file_alone_may_be_kept(tmp_path):
    kept(tmp_path, [Response(id=str(number)) for number in range(20)], size=2000, count=1)
    assert [path.name for path in files(tmp_path)] == [FILE]


def test_only_the_newest_are_read_into_memory(tmp_path):
    kept(tmp_path, [Response(id=str(number)) for number in range(10)])
    assert [one.id for one in read(tmp_path, most=2)[0]] == ["8", "9"]


def test_half_a_line_is_left_out_and_counted(tmp_path):
    kept(tmp_path, [Response(id="1")])
    with (tmp_path / FILE).open("ab") as file:
        file.write(b'{"id": "2", "meth\n\xff\xfe\n[1]\n\n')
    kept(tmp_path, [Response(id="3")])
    found, wrong = read(tmp_path)
    assert [one.id for one in found] == ["1", "3"]
    assert wrong == 3


def test_a_disk_that_fails_is_said_and_said_no_more_when_it_takes_lines_again(tmp_path):
    (tmp_path / "here").write_text("a file where the folder should be")
    log = ResponseLog(tmp_path / "here")
    log.put(Response(id="1"))
    assert log.flush()
    assert log.problem.startswith("The response log could not be written: ")
    assert log.dropped == 1
    (tmp_path / "here").unlink()
    log.put(Response(id="2"))
    log.flush()
    assert log.problem == ""
    log.close()


def test_a_snippet_that_is_too_long_is_left_out_and_the_rest_is_kept(tmp_path):
    kept(tmp_path, [Response(id="1", snippet=[0.123456] * 5000)])
    (found,), _ = read(tmp_path)
    assert (found.id, found.snippet) == ("1", None)


def test_all_can_be_erased(tmp_path):
    log = ResponseLog(tmp_path, size=300, count=3)
    for number in range(9):
        log.put(Response(id=str(number)))
    log.erase()
    log.put(Response(id="after"))
    log.close()
    assert [one.id for one in read(tmp_path)[0]] == ["after"]


def held(monkeypatch, log):
    """A disk that hangs until it is let go."""
    gate, hangs, write = threading.Event(), threading.Event(), log._write
    monkeypatch.setattr(log, "_write", lambda line: (hangs.set(), gate.wait(5), write(line)))
    return gate, hangs


def test_all_can_be_erased_though_more_lines_wait_than_may(tmp_path, monkeypatch):
    monkeypatch.setattr("app.study.response_log.MAX_WAITING", 3)
    log = ResponseLog(tmp_path)
    gate, _ = held(monkeypatch, log)
    for number in range(20):
        log.put(Response(id=str(number)))
    threading.Timer(0.05, gate.set).start()
    log.erase()
    assert read(tmp_path) == ([], 0)
    log.close()


def test_what_cannot_be_erased_is_said(tmp_path, monkeypatch):
    log = ResponseLog(tmp_path)
    log.put(Response(id="1"))
    log.flush()
    gate, hangs = held(monkeypatch, log)
    log.put(Response(id="2"))
    hangs.wait(5)
    with pytest.raises(TimeoutError, match="does not answer"):
        log.erase(timeout=0.05)
    gate.set()

    def fail() -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(log, "_erase", fail)
    with pytest.raises(PermissionError):
        log.erase()
    log.close()


def test_all_can_be_erased_after_the_end(tmp_path):
    log = kept(tmp_path, [Response(id="1")])
    log.erase()
    assert read(tmp_path) == ([], 0)


def test_after_the_end_nobody_waits_for_what_is_written(tmp_path):
    log = kept(tmp_path, [Response(id="1")])
    began = time.monotonic()
    assert log.flush(timeout=30.0)
    assert time.monotonic() - began < 10


def test_what_comes_after_the_end_is_ignored(tmp_path):
    log = kept(tmp_path, [Response(id="1")])
    log.put(Response(id="2"))
    assert [one.id for one in read(tmp_path)[0]] == ["1"]


def test_a_disk_that_hangs_holds_nobody_up(tmp_path, monkeypatch):
    monkeypatch.setattr("app.study.response_log.MAX_WAITING", 3)
    gate = threading.Event()
    log = ResponseLog(tmp_path)
    monkeypatch.setattr(log, "_write", lambda _: gate.wait(5))
    for number in range(20):
        log.put(Response(id=str(number)))
    assert log.dropped >= 16
    gate.set()
    log.close()


def test_what_follows_half_a_line_is_read_as_well(tmp_path):
    kept(tmp_path, [Response(id="a")])
    with (tmp_path / FILE).open("ab") as file:
        file.write(b'{"id":"half","sess')
    kept(tmp_path, [Response(id="b"), Response(id="c")])
    found, wrong = read(tmp_path)
    assert [one.id for one in found] == ["a", "b", "c"]
    assert wrong == 1
