"""A recogniser in a process of its own."""

import io
import json
import queue
import subprocess
import sys
import threading
import time
import wave

import pytest

from app.voice import child
from app.voice.ending import wait_for_ends
from app.voice.files import read
from app.voice.lexicon import COMMANDS
from app.voice.recognizer import Grammar, Level, Partial, Rejected, Result, State, VoiceTrouble
from app.voice.wire import event_line, grammar_fields, read_event, read_grammar
from app.voice.worker import AGAIN, OVER, InProcess, InThread, recognizer

GRAMMAR = Grammar(COMMANDS)
PROGRAM = """
import json, sys
grammar = json.loads(sys.stdin.readline())
say = lambda word, sentence="": print(json.dumps({"event": "State", "word": word, "sentence": sentence}), flush=True)
say("ready", grammar["language"])
print("a foreign library prints something", flush=True)
sys.stdout.buffer.write(b"\\xff and what is no text\\n")
sys.stdout.flush()
for line in sys.stdin:
    order = json.loads(line)
    if order.get("heed") == ["crash"]:
        sys.exit(3)
    say(json.dumps(order))
"""


@pytest.fixture
def voice():
    made = InProcess("phonemes", command=[sys.executable, "-c", PROGRAM])
    made.missing = lambda: ""
    yield made
    made.stop()
    wait_for_ends()


@pytest.fixture
def told():
    return queue.Queue()


def words(told, count):
    return [told.get(timeout=10) for _ in range(count)]


def test_orders_go_in_and_events_come_out(voice, told):
    voice.start(GRAMMAR, told.put)
    voice.listen(on=True)
    voice.heed({"yes", "no"})
    assert [event.word for event in words(told, 3)] == [
        "ready",
        '{"listen": true}',
        '{"heed": ["no", "yes"]}',
    ]


def test_a_crash_is_said_and_it_is_started_again_once_with_what_it_was_told(voice, told):
    voice.start(GRAMMAR, told.put)
    voice.heed({"crash"})
    events = words(told, 4)
    assert [event.word for event in events] == ["ready", "starting", "ready", "failed"]
    assert (events[1].sentence, events[3].sentence) == (AGAIN, OVER)


def test_no_order_overtakes_the_grammar_when_it_is_started_again(voice, told, monkeypatch):
    spawned, send = [], voice._send

    def late(process, fields):
        if "heed" not in fields and "listen" not in fields:
            spawned.append(process)
            if len(spawned) == 2:
                # somebody presses the button to talk just now
                threading.Thread(target=voice.listen, kwargs={"on": True}, name="button").start()
                time.sleep(0.1)
        send(process, fields)

    monkeypatch.setattr(voice, "_send", late)
    voice.start(GRAMMAR, told.put)
    words(told, 1)
    voice._process.kill()
    assert [event.word for event in words(told, 3)] == ["starting", "ready", '{"listen": true}']


def test_one_that_said_why_it_failed_has_not_crashed(told):
    failing = """
import json
print(json.dumps({"event": "State", "word": "failed", "sentence": "There is no hama."}), flush=True)
"""
    voice = InProcess("phonemes", command=[sys.executable, "-c", failing])
    voice.missing = lambda: ""
    voice.start(GRAMMAR, told.put)
    voice._reader.join(10)
    assert [event.sentence for event in words(told, 1)] == ["There is no hama."]
    assert told.empty()
    voice.stop()


def test_what_a_foreign_library_prints_breaks_no_event():
    program = """
import os
from app.voice.child import own_line
events = own_line()
os.write(1, b"ALSA lib pcm.c: no newline at the end")
print("stop", file=events, flush=True)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert (done.stdout, "ALSA" in done.stderr) == ("stop\n", True)


def test_to_stop_is_no_crash_and_ends_the_process(voice, told):
    voice.start(GRAMMAR, told.put)
    words(told, 1)
    process = voice._process
    voice.stop()
    voice.stop()
    wait_for_ends()
    assert process.returncode is not None
    assert told.empty()


def test_orders_to_one_that_was_not_started_are_nothing(voice):
    voice.listen(on=True)
    voice.heed(None)


def test_a_language_that_it_has_not_is_said(voice, told):
    with pytest.raises(VoiceTrouble, match="has no 'de'; it understands en"):
        voice.start(Grammar({"stop": ("halt",)}, "de"), told.put)


def test_a_package_that_is_missing_is_said(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert "needs the package hama" in InProcess("phonemes").missing()
    with pytest.raises(VoiceTrouble, match="needs the package pocketsphinx"):
        InThread("sphinx").start(GRAMMAR, print)


def test_a_phone_has_no_processes_to_start():
    assert isinstance(recognizer(alone=False), InThread)
    assert isinstance(recognizer(alone=True), InProcess)
    with pytest.raises(VoiceTrouble, match="no recogniser 'ears'; there are phonemes, sphinx"):
        recognizer("ears")


def test_a_fault_in_the_thread_is_said_and_it_is_started_again_once(monkeypatch, told):
    monkeypatch.setattr("app.voice.worker.judge_of", lambda name, grammar: 1 / 0)
    monkeypatch.setattr("app.voice.worker._missing", lambda name: "")
    voice = InThread("phonemes")
    voice.start(GRAMMAR, told.put)
    events = words(told, 4)
    voice.stop()
    assert [event.sentence for event in events] == ["", AGAIN, "", OVER]


@pytest.mark.parametrize(
    "event",
    [
        Partial("sto", 0.3),
        Result("stop", "stop", 0.9, 1.0, 2.0, (("start", 0.2),), 21.0, True, {"fit": -0.1}),
        Rejected("That was no command.", "pause", 0.3, 2.0),
        Level(-30.0, -60.0, 30.0, True, False),
        State("ready", "“stop”"),
    ],
    ids=lambda event: type(event).__name__,
)
def test_what_is_told_survives_the_way(event):
    assert read_event(event_line(event)) == event


def test_a_grammar_survives_the_way():
    assert read_grammar(grammar_fields(GRAMMAR)) == GRAMMAR


@pytest.mark.parametrize("line", ["", "null", "{}", '{"event": "Nothing"}', '{"event": "State"}'])
def test_a_line_that_is_no_event_is_refused(line):
    with pytest.raises(ValueError, match="No event|Expecting"):
        read_event(line)


def test_a_recording_that_is_not_there_or_is_none_is_said(tmp_path):
    with pytest.raises(VoiceTrouble, match="There is no recording"):
        read(tmp_path / "none.wav")
    (tmp_path / "text.wav").write_text("no sound")
    with pytest.raises(VoiceTrouble, match="cannot be read as a recording"):
        read(tmp_path / "text.wav")


def test_one_that_hangs_holds_nobody_up_and_is_ended_all_the_same(told, monkeypatch):
    monkeypatch.setattr("app.voice.ending.ENDS", 0.3)
    deaf = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print(flush=True); time.sleep(60)"
    voice = InProcess("phonemes", command=[sys.executable, "-c", deaf])
    voice.missing = lambda: ""
    voice.start(GRAMMAR, told.put)
    process, waited = voice._process, []
    monkeypatch.setattr(
        process, "wait", lambda *limit: waited.append(threading.current_thread()) or stock(*limit)
    )
    stock = type(process).wait.__get__(process)
    voice.stop()
    wait_for_ends()
    assert process.returncode is not None
    assert waited
    assert threading.current_thread() not in waited


def test_what_ends_beside_the_glass_is_heard_no_more(monkeypatch, told):
    monkeypatch.setattr("app.voice.worker._missing", lambda name: "")
    goes_on, told_late = threading.Event(), threading.Event()

    class Late:
        def __init__(self, grammar, ears, make, hear):
            self.hear = hear

        def run(self):
            goes_on.wait(10)
            self.hear(State("ready", "late"))
            told_late.set()

        def stop(self):
            pass

    monkeypatch.setattr("app.voice.worker.Service", Late)
    voice = InThread("phonemes", ears=lambda: None)
    voice.start(GRAMMAR, told.put)
    voice.stop()
    goes_on.set()
    assert told_late.wait(10)
    wait_for_ends()
    assert told.empty()


@pytest.mark.parametrize(
    "line",
    [
        '{"event": "State", "word": 5, "sentence": ""}',
        '{"event": "State", "word": "ready", "sentence": null}',
        '{"event": "Level", "level": "a", "noise": null, "snr": 1}',
        '{"event": "Level", "level": true, "noise": 0, "snr": 1}',
        '{"event": "Result", "command": [], "said": "", "confidence": 1, "alternatives": []}',
        '{"event": "Result", "command": "stop", "said": "", "confidence": 1, "alternatives": [["go", 1]], "strong": 1}',
    ],
)
def test_a_value_of_another_kind_is_no_event(line):
    with pytest.raises(ValueError, match="No event"):
        read_event(line)


def test_a_command_that_nobody_asked_for_is_left_out(told):
    strange = """
import json
for command in ("zzz", "stop"):
    fields = {"command": command, "said": command, "confidence": 1.0, "alternatives": []}
    print(json.dumps({"event": "Result", **fields}), flush=True)
print(json.dumps({"event": "State", "word": "failed", "sentence": "over"}), flush=True)
"""
    voice = InProcess("phonemes", command=[sys.executable, "-c", strange])
    voice.missing = lambda: ""
    voice.start(GRAMMAR, told.put)
    voice._reader.join(10)
    assert [getattr(event, "command", event) for event in words(told, 2)] == ["stop", State("failed", "over")]
    voice.stop()
    wait_for_ends()


@pytest.mark.parametrize("rate", [0, 1, 4_000_000_000])
def test_a_recording_at_a_rate_that_cannot_be_is_said(tmp_path, rate):
    path = tmp_path / "stop.wav"
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(16000)
        file.writeframes(bytes(64))
    made = bytearray(path.read_bytes())
    made[24:28] = rate.to_bytes(4, "little")
    path.write_bytes(made)
    with pytest.raises(VoiceTrouble, match="cannot be read as a recording"):
        read(path)
    events = io.StringIO()
    assert (
        child.main(["phonemes", str(path)], io.StringIO(json.dumps(grammar_fields(GRAMMAR)) + "\n"), events)
        == 0
    )
    event = read_event(events.getvalue())
    assert event.word == "failed"
    assert "cannot be read as a recording" in event.sentence
