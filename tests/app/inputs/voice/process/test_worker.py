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

from app.inputs.voice.audio.sound_files import FileAudioSource, read
from app.inputs.voice.interfaces.speech_recognizer import Grammar, Level, State, VoiceTrouble
from app.inputs.voice.process import child
from app.inputs.voice.process.ending import wait_for_ends
from app.inputs.voice.process.wire import THERE, event_line, grammar_fields, read_event
from app.inputs.voice.process.worker import InProcess, InThread, recognizer
from app.inputs.voice.recognition.lexicon import COMMANDS

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
    assert events[1].sentence == "Voice recognition crashed and is started again: it ended with 3."
    assert "the second time within 10 min, and is off: it ended with 3." in events[3].sentence


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
    voice._process._process.kill()
    assert [event.word for event in words(told, 3)] == ["starting", "ready", '{"listen": true}']


def test_one_that_said_why_it_failed_has_not_crashed(told):
    failing = """
import json
print(json.dumps({"event": "State", "word": "failed", "sentence": "There is no hama."}), flush=True)
"""
    voice = InProcess("phonemes", command=[sys.executable, "-c", failing])
    voice.missing = lambda: ""
    voice.start(GRAMMAR, told.put)
    voice._life.join(10)
    assert [event.sentence for event in words(told, 1)] == ["There is no hama."]
    assert told.empty()
    voice.stop()


def test_what_a_foreign_library_prints_breaks_no_event():
    program = """
import os
from app.inputs.voice.process.child import own_line
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


def test_orders_to_one_that_was_not_started_are_nothing(voice, told):
    voice.listen(on=True)
    voice.heed(None)
    assert told.empty()


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
    monkeypatch.setattr("app.inputs.voice.process.worker.judge_of", lambda name, grammar: 1 / 0)
    monkeypatch.setattr("app.inputs.voice.process.worker._missing", lambda *_: "")
    voice = InThread("phonemes")
    voice.start(GRAMMAR, told.put)
    events = words(told, 4)
    voice.stop()
    assert [event.word for event in events] == ["starting", "starting", "starting", "failed"]
    assert events[1].sentence.endswith("started again: ZeroDivisionError: division by zero.")
    assert "and is off: ZeroDivisionError: division by zero." in events[3].sentence


def test_faults_in_the_thread_that_are_hours_apart_never_end_it(monkeypatch, told):
    monkeypatch.setattr("app.inputs.voice.process.worker._missing", lambda *_: "")
    hours = iter(range(100))

    class Faulty:
        def __init__(self, grammar, ears, make, hear):
            self.left = 4

        def run(self):
            self.left -= 1
            if self.left:
                raise OSError("no driver")

        def stop(self):
            pass

    monkeypatch.setattr("app.inputs.voice.process.worker.Service", Faulty)
    voice = InThread("phonemes", ears=lambda: None, now=lambda: 3600.0 * next(hours))
    voice.start(GRAMMAR, told.put)
    voice._thread.join(10)
    assert [event.word for event in words(told, 3)] == ["starting"] * 3
    assert told.empty()
    voice.stop()


def test_a_recording_that_is_not_there_or_is_none_is_said(tmp_path):
    with pytest.raises(VoiceTrouble, match="There is no recording"):
        read(tmp_path / "none.wav")
    (tmp_path / "text.wav").write_text("no sound")
    with pytest.raises(VoiceTrouble, match="cannot be read as a recording"):
        read(tmp_path / "text.wav")


def test_one_that_hangs_holds_nobody_up_and_is_ended_all_the_same(told, monkeypatch):
    monkeypatch.setattr("app.inputs.voice.process.ending.END_TIMEOUT", 0.3)
    deaf = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print(flush=True); time.sleep(60)"
    voice = InProcess("phonemes", command=[sys.executable, "-c", deaf])
    voice.missing = lambda: ""
    voice.start(GRAMMAR, told.put)
    process, waited = voice._process._process, []
    stock = process.wait
    monkeypatch.setattr(
        process, "wait", lambda *limit: waited.append(threading.current_thread()) or stock(*limit)
    )
    voice.stop()
    wait_for_ends()
    assert process.returncode is not None
    assert waited
    assert threading.current_thread() not in waited


def test_what_ends_beside_the_glass_is_heard_no_more(monkeypatch, told):
    monkeypatch.setattr("app.inputs.voice.process.worker._missing", lambda *_: "")
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

    monkeypatch.setattr("app.inputs.voice.process.worker.Service", Late)
    voice = InThread("phonemes", ears=lambda: None)
    voice.start(GRAMMAR, told.put)
    voice.stop()
    goes_on.set()
    assert told_late.wait(10)
    wait_for_ends()
    assert told.empty()


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
    voice._life.join(10)
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


class Scripted:
    """A process in virtual time: each wait for a line takes as long as it may, and `gives` says what comes."""

    def __init__(self, world, gives):
        self.world, self.gives, self.orders, self.ended, self.last_words = world, gives, [], [], "no driver"
        self.asked = -1.0

    def order(self, line):
        self.orders.append(line)
        if line == THERE:
            self.asked = self.world.t

    def wake(self):
        pass

    def line(self, timeout):
        self.world.t += timeout
        return self.gives(self)

    def end(self, *, hangs=False):
        self.ended.append((hangs, threading.current_thread().name))


class World:
    """Processes that are started one after the other, on a clock that only goes on where somebody waits."""

    def __init__(self, monkeypatch, *gives):
        self.t, self.processes, self.told = 0.0, [], []
        left = list(gives)

        def start(command, environment):
            self.processes.append(Scripted(self, left.pop(0)))
            return self.processes[-1]

        monkeypatch.setattr("app.inputs.voice.process.worker.Running", start)
        monkeypatch.setattr("app.inputs.voice.process.worker._missing", lambda *_: "")
        self.voice = InProcess("phonemes", now=lambda: self.t)

    def run(self):
        self.voice.start(GRAMMAR, lambda event: self.told.append((round(self.t), event)))
        self.voice._life.join(10)
        assert not self.voice._life.is_alive()
        self.voice.stop()
        wait_for_ends()

    @property
    def states(self):
        return [(at, event.word) for at, event in self.told if isinstance(event, State)]


def says(word, sentence=""):
    return event_line(State(word, sentence))


def lines(*given, then):
    left = list(given)
    return lambda process: left.pop(0) if left else then(process)


def silent(process):
    return ""


def over(process):
    """It says that it fails, and ends."""
    process.gives = lambda _: None
    return says("failed", "over")


@pytest.mark.parametrize("word", ["ready", "listening", "too loud"])
def test_one_that_gives_no_sign_is_killed_and_started_again_once(monkeypatch, word):
    world = World(
        monkeypatch, lines(says("starting"), says(word), then=silent), lines(says(word), then=silent)
    )
    world.run()
    assert [state[1] for state in world.states] == ["starting", word, "starting", word, "failed"]
    again, off = (event for _, event in world.told if isinstance(event, State) and event.sentence)
    assert again.sentence == "Voice recognition hung and is started again: it gave no sign for 12 s."
    assert off.sentence.startswith("Voice recognition hung, the second time within 10 min, and is off")
    assert 12 <= world.states[2][0] - world.states[1][0] <= 13
    assert all(process.ended == [(True, "voice")] for process in world.processes), (
        "not in the thread of its own"
    )


def test_one_that_is_asked_and_answers_late_goes_on(monkeypatch):
    def answers_late(process):
        if process.world.t > 600.0:
            return over(process)
        return THERE if 0.0 <= process.asked <= process.world.t - 8.0 and not clear(process) else ""

    def clear(process):
        process.asked = -1.0

    world = World(monkeypatch, lines(says("ready"), then=answers_late))
    world.run()
    assert [state[1] for state in world.states] == ["ready", "failed"]
    assert world.told[-1][1].sentence == "over"


def test_one_that_tells_its_level_is_not_asked(monkeypatch):
    def listens(process):
        return event_line(Level(-30.0, -60.0, 30.0)) if process.world.t < 60.0 else over(process)

    world = World(monkeypatch, lines(says("listening"), then=listens))
    world.run()
    assert THERE not in world.processes[0].orders


def test_a_slow_load_is_no_hang(monkeypatch):
    def loads(process):
        """Twenty seconds for the interpreter, then a minute for the model, which answers."""
        t = process.world.t
        if t < 20.0:
            return ""
        if t < 80.0:
            return says("starting") if t < 22.0 else THERE if process.asked >= t - 2.0 else ""
        return over(process)

    world = World(monkeypatch, loads)
    world.run()
    assert [event.sentence for _, event in world.told if event.word == "failed"] == ["over"]
    assert len(world.processes) == 1


def test_crashes_hours_apart_never_end_it(monkeypatch):
    def crashes_in_an_hour(process):
        return THERE if process.world.t < 3600.0 * len(process.world.processes) else None

    world = World(monkeypatch, *(lines(says("ready"), then=crashes_in_an_hour) for _ in range(4)), over)
    world.run()
    assert len(world.processes) == 5
    said = [event.sentence for _, event in world.told if event.word == "starting"]
    assert said == ["Voice recognition crashed and is started again: no driver."] * 4


def test_the_reason_is_in_the_log(monkeypatch, caplog):
    world = World(monkeypatch, lambda process: None, over)
    world.run()
    assert caplog.messages == ["Voice recognition crashed and is started again: no driver."]


@pytest.mark.skipif(sys.platform == "win32", reason="there are no signals")
def test_one_that_the_system_stopped_is_found_and_replaced(told, monkeypatch):
    monkeypatch.setattr("app.inputs.voice.process.worker.CHECK_PERIOD", 0.01)
    program = """
import json, os, signal, sys
sys.stdin.readline()
print(json.dumps({"event": "State", "word": "ready", "sentence": ""}), flush=True)
for line in sys.stdin:
    if "stop" in line:
        print(json.dumps({"event": "State", "word": "listening", "sentence": ""}), flush=True)
        os.kill(os.getpid(), signal.SIGSTOP)
"""
    stopped, seconds = threading.Event(), iter(range(1000000))
    voice = InProcess(
        "phonemes",
        command=[sys.executable, "-c", program],
        now=lambda: float(next(seconds)) if stopped.is_set() else 0.0,
    )
    voice.missing = lambda: ""

    def hear(event):
        if event.word == "starting":
            stopped.clear()
        told.put(event)

    voice.start(GRAMMAR, hear)
    words(told, 1)
    process = voice._process
    voice.heed({"stop"})
    words(told, 1)
    voice.heed(None)
    stopped.set()
    events = words(told, 2)
    assert [event.word for event in events] == ["starting", "ready"]
    assert "Voice recognition hung and is started again: it gave no sign for" in events[0].sentence
    voice.stop()
    wait_for_ends()
    assert process.returncode is not None


def test_a_fault_in_the_real_process_gives_its_reason(told, monkeypatch):
    program = "from app.inputs.voice.process import child; child.judge_of = lambda *_: 1 / 0; child._alone()"
    voice = InProcess("phonemes", command=[sys.executable, "-c", program, "phonemes"])
    voice.missing = lambda: ""
    monkeypatch.setattr("app.inputs.voice.process.worker._missing", lambda *_: "")
    voice.start(GRAMMAR, told.put)
    events = words(told, 4)
    voice.stop()
    wait_for_ends()
    assert [event.word for event in events] == ["starting", "starting", "starting", "failed"]
    assert "is started again: ZeroDivisionError: division by zero." in events[1].sentence


def test_the_process_answers_when_it_is_asked_whether_it_is_there(monkeypatch):
    monkeypatch.setattr(child, "judge_of", lambda name, grammar: None)
    monkeypatch.setattr(child, "Microphone", lambda: FileAudioSource([]))
    orders = io.StringIO("\n".join((json.dumps(grammar_fields(GRAMMAR)), THERE, "")))
    events = io.StringIO()
    assert child.main(["phonemes"], orders, events) == 0
    assert THERE in events.getvalue().splitlines()
