"""One process of voice: it holds nobody up, and what it said last is known."""

import os
import signal
import subprocess
import sys

import pytest

from app.inputs.voice.process.breakdown import MAX_REASON
from app.inputs.voice.process.running import MAX_NOTES, NOTE_PREFIX, Running

LONG = 1 << 20


@pytest.fixture
def run():
    made = []

    def start(program):
        made.append(Running([sys.executable, "-c", program], os.environ))
        return made[-1]

    yield start
    for process in made:
        process.end(hangs=True)
        assert process.returncode is not None
        assert not any(thread.is_alive() for thread in process._threads)


def told(process):
    """All that it says until it ends."""
    lines = []
    while (line := process.line(10.0)) is not None:
        lines.append(line)
    return lines


def test_orders_go_in_and_lines_come_out(run):
    process = run("print(input() + input())")
    process.order("a")
    process.order("b")
    assert told(process) == ["ab\n"]


def test_none_in_time_is_an_empty_line_and_it_can_be_woken(run):
    process = run("input()")
    assert process.line(0.0) == ""
    process.wake()
    assert process.line(60.0) == ""


def test_its_last_words_are_the_last_line_of_its_errors(run):
    process = run("import sys; print('first', file=sys.stderr); raise ValueError('no driver')")
    assert told(process) == []
    process.end()
    assert process.last_words == "ValueError: no driver"


def test_last_words_without_an_end_are_cut(run):
    process = run(f"import sys; sys.stderr.write('x' * {LONG}); sys.exit(3)")
    told(process)
    process.end()
    assert len(process.last_words) <= MAX_REASON


def test_one_that_says_nothing_is_known_by_what_it_ended_with(run):
    process = run("import sys; sys.exit(3)")
    told(process)
    process.end()
    assert process.last_words == "it ended with 3"


@pytest.mark.skipif(sys.platform == "win32", reason="there are no signals")
def test_what_killed_it_is_told(run):
    process = run("import os; os.kill(os.getpid(), 11)")
    told(process)
    process.end()
    assert process.last_words == "SIGSEGV"


def test_its_own_notes_go_to_the_log_and_are_no_last_words(run, caplog):
    process = run(f"import sys; [print('{NOTE_PREFIX}note', n, file=sys.stderr) for n in range(999)]")
    told(process)
    process.end()
    assert (process.last_words, len(caplog.messages)) == ("", MAX_NOTES)
    assert caplog.messages[0] == f"{NOTE_PREFIX}note 0"


@pytest.mark.skipif(sys.platform == "win32", reason="there are no signals")
def test_one_that_stands_still_takes_no_orders_and_holds_nobody_up(run):
    process = run("import os, signal; print('here', flush=True); os.kill(os.getpid(), signal.SIGSTOP)")
    assert process.line(10.0) == "here\n"
    for _ in range(4):
        process.order("x" * LONG)  # more than a pipe holds
    process.end(hangs=True)
    assert process.returncode == -signal.SIGKILL


def test_lines_that_nobody_takes_hold_up_no_end(run, monkeypatch):
    monkeypatch.setattr("app.inputs.voice.process.ending.END_TIMEOUT", 5.0)
    process = run("while True: print('more')")
    assert process.line(10.0) == "more\n"
    process.end(hangs=True)


def test_what_cannot_be_killed_is_left_and_noted(run, monkeypatch, caplog):
    process = run("input()")
    wait = process._process.wait

    def never(*_):
        raise subprocess.TimeoutExpired("voice", 0.0)

    with monkeypatch.context() as held:
        held.setattr(process._process, "wait", never)
        process.end()
    assert "cannot be ended and is left" in caplog.text
    wait(10)
