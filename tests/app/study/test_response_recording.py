"""The log of the running app: what is understood, sent and answered is kept, and the study takes answers without acting."""

from __future__ import annotations

import csv
import io
import json
import os
import zipfile
from types import SimpleNamespace

import pytest

from app.core.command_origin import Origin, origins
from app.core.settings_store import Settings
from app.intents.intents import Heard, Intents
from app.intents.method_permits import MethodPermits
from app.link.channels import OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Post
from app.study.questionnaires import BASELINE
from app.study.response_log import Response, read
from app.study.response_recording import SAVE_EVERY, ResponseRecording
from app.study.response_statistics import rates
from app.study.study import Plan
from app.study.study_export import COLUMNS, MEANINGS, table

TLX = dict.fromkeys(("mental", "physical", "temporal", "performance", "effort", "frustration"), 20)


class IntentActions:
    def __init__(self) -> None:
        self.done, self.robots = [], 0

    def why_not(self, intent):
        if intent == "stop" and not self.robots:
            return "No robot is known that could be stopped."
        return "Nothing is asked just now." if intent in ("yes", "no") else ""

    def words(self, intent):
        return intent

    def do(self, intent):
        self.done.append(intent)

    def answer(self, yes):
        return ""


class Ways:
    """The methods of the app: of the log alone it is told that it is switched on or off."""

    hearing: tuple[str, ...] = ("voice",)

    def __init__(self, made) -> None:
        self.get = made.get
        self.log = None

    def turn(self, name, on) -> None:
        assert name == "log"
        self.log.on = on
        (self.log.start if on else self.log.stop)()


class Running:
    """The log in an app without a glass, with clocks that are moved by hand."""

    def __init__(self, folder) -> None:
        self.folder, self.time, self.made = folder, 100.0, {}
        self.open()

    def open(self) -> None:
        self.settings, self.acts = Settings(self.folder), IntentActions()
        self.app = SimpleNamespace(
            settings=self.settings,
            now=lambda: self.time,
            session=None,
            methods=Ways(self.made),
            corner=SimpleNamespace(on_pressed=[]),
            fleet=SimpleNamespace(active=False, total=0, stopped=0),
            intents=Intents(self.acts, MethodPermits(self.settings), lambda: self.time),
        )
        self.log = ResponseRecording(self.app, wall=lambda: 1_700_000_000.0 + self.time)
        self.app.methods.log = self.log
        self.log.start()

    def close(self) -> None:
        self.log.close()
        self.settings.close()

    def hear(self, intent, method="voice"):
        return self.app.intents.submit(
            Heard(intent, method, 0.9, self.time - 0.4, self.time - 0.1, said=intent)
        )

    def wait(self, seconds) -> None:
        for _ in range(round(seconds / 0.5)):
            self.time += 0.5
            self.log.update(self.time)

    def next(self):
        while self.log.trials.prompt is None:
            self.wait(0.5)
        return self.log.trials.prompt

    def kept(self, kind="command"):
        self.close()
        return [one for one in read(self.log.archive.folder)[0] if one.kind == kind]


@pytest.fixture
def running(tmp_path):
    running = Running(tmp_path)
    yield running
    running.close()


def test_what_is_understood_is_kept(running):
    running.hear("pause")
    (line,) = running.kept()
    assert (line.method, line.recognised, line.verdict, line.user) == ("voice", "pause", "acted", "")


def test_nothing_is_kept_while_the_log_is_off_and_that_is_remembered(running):
    running.log.turn(False)
    running.hear("pause")
    running.close()
    assert read(running.log.archive.folder) == ([], 0)
    running.open()
    assert (running.log.on, running.log.standing) == (False, "off")


def test_a_setting_that_means_nothing_is_as_if_it_were_not_there(running):
    running.settings.set("study", {"log": "perhaps", "snippets": 3, "plan": [1]})
    running.close()
    running.open()
    assert (running.log.on, running.log.snippets, running.log.trials) == (True, False, None)


def test_how_long_a_method_listened_is_put_down_now_and_then(running):
    running.wait(SAVE_EVERY + 1)
    assert sum(one.seconds for one in running.kept("armed")) == pytest.approx(SAVE_EVERY + 1, abs=1)


def test_while_the_app_sleeps_nobody_listens(running):
    running.time += 3600
    running.log.update(running.time)
    assert running.kept("armed") == []


def test_that_a_task_is_over_takes_the_place_of_what_the_log_said_before(running):
    said, statuses = [], {}
    running.settings.set("study", {"remind": True})
    running.close()
    running.open()
    running.app.shell = SimpleNamespace(say=lambda sentence, level, about: said.append((level, about)))
    feeds = SimpleNamespace(latest=statuses.get)
    running.app.session = SimpleNamespace(
        listeners=[], robot=SimpleNamespace(name="R2"), link=None, feeds=feeds, control="mine"
    )
    for state in ("RUNNING", "DONE"):
        statuses["/task/status"] = SimpleNamespace(task="patrol", state=state)
        running.wait(0.5)
        for hear in running.app.session.listeners:
            hear("/task/status", Post(None, running.time, running.time))
    assert said == [("info", "log")]


def test_driving_is_one_line_from_its_begin_to_its_end(running):
    link = SimpleNamespace(driving=True, driven_by=Origin("gamepad"))
    running.app.session = SimpleNamespace(listeners=[], robot=SimpleNamespace(name="R2"), link=link)
    running.wait(3)
    link.driving = False
    running.wait(0.5)
    link.driving = True
    running.wait(1)
    link.driving = False
    running.wait(2)
    ((method, seconds),) = [(one.method, one.seconds) for one in running.kept("drive")]
    assert (method, seconds) == ("gamepad", pytest.approx(4.0, abs=0.5))


def test_another_method_that_drives_begins_another_line(running):
    link = SimpleNamespace(driving=True, driven_by=Origin("tilt"))
    running.app.session = SimpleNamespace(listeners=[], robot=SimpleNamespace(name="R2"), link=link)
    running.wait(2)
    link.driven_by = Origin("button")
    running.wait(2)
    assert [one.method for one in running.kept("drive")] == ["tilt", "button"]


def plan(**more):
    return Plan(**{"user": "P1", "methods": ("voice",), "triggers": 1, **more})


def test_in_the_study_answers_are_counted_and_nothing_is_done(running):
    running.log.lead(plan())
    running.log.trials.begin()
    answers = 0
    while running.log.trials.stage != "tlx":
        prompt = running.next()
        said = "pause" if prompt.intent == "resume" else prompt.intent
        verdict = running.hear(said)
        assert verdict.what == "practised"
        assert verdict.sentence.startswith("Understood: ")
        assert verdict.sentence.endswith(". Nothing is done.")
        answers += 1
    assert (answers, running.acts.done) == (5, [])
    found = rates(running.kept())["voice", ""]
    assert (found.hits, found.trials) == (4, 5)


def test_what_comes_between_two_prompts_is_a_false_activation(running):
    running.log.lead(plan())
    running.log.trials.begin()
    running.hear("pause")
    (line,) = running.kept()
    assert (line.user, line.posture, line.prompt_id, line.intended) == ("P1", "standing", "", "")


def test_a_prompt_without_an_answer_is_kept_as_missed(running):
    running.log.lead(plan())
    running.log.trials.begin()
    prompt = running.next()
    running.wait(8)
    assert [(one.intended, one.recognised) for one in running.kept()] == [(prompt.intent, "")]


def test_stop_reaches_whatever_can_be_stopped_whatever_is_practised(running):
    running.acts.robots = 1  # known, and none is connected
    running.log.lead(plan())
    running.log.trials.begin()
    assert running.hear("stop").what == "acted"
    assert running.acts.done == ["stop"]


def test_a_key_that_stops_at_once_answers_a_prompt_too(running):
    running.app.session = SimpleNamespace(
        listeners=[],
        robot=SimpleNamespace(name="R2"),
        link=SimpleNamespace(driving=False, driven_by=Origin()),
    )
    running.log.lead(plan(methods=("keyboard",), commands={"keyboard": ("stop",)}))
    running.log.trials.begin()
    running.next()
    origin = Origin("keyboard", began=running.time - 0.1, intent="stop")
    outcome = Outcome("stop", "c", "sent", origin=origin, sent=running.time)
    running.app.session.listeners[0](OUTCOME, Post(outcome, running.time, 1))
    assert running.log.trials.stage == "tlx"
    (line,) = running.kept()
    assert (line.intended, line.recognised, line.method) == ("stop", "stop", "keyboard")


def stop_all(running, total=2):
    running.app.fleet = SimpleNamespace(active=True, total=total, stopped=0)
    for hear in running.app.corner.on_pressed:
        hear()


def test_stop_to_robots_of_which_none_is_connected_is_a_line_with_its_method(running):
    with origins.during(Origin("keyboard", began=99.9, intent="stop")):
        stop_all(running)
    running.wait(1)
    running.app.fleet.stopped = 2
    running.wait(1)
    (line,) = running.kept()
    assert (line.method, line.recognised, line.outcome) == ("keyboard", "stop", "accepted")
    assert line.t_sent - line.t_input_start == pytest.approx(0.1)
    assert line.t_effect - line.t_sent == pytest.approx(1.5)


def test_stop_all_by_a_shake_is_the_line_of_that_shake(running):
    running.acts.robots = 2
    running.acts.do = lambda intent: stop_all(running)
    running.hear("stop", "shake")
    running.wait(1)
    (line,) = running.kept()
    assert (line.method, line.said, line.verdict) == ("shake", "stop", "acted")
    assert line.t_sent is not None


def test_stop_all_beside_a_robot_that_is_connected_is_told_by_its_link(running):
    running.app.session = SimpleNamespace(
        listeners=[],
        robot=SimpleNamespace(name="R2"),
        link=SimpleNamespace(driving=False, driven_by=Origin()),
    )
    with origins.during(Origin("keyboard", began=99.9, intent="stop")):
        stop_all(running)
    running.wait(1)
    assert running.kept() == []


def test_a_pause_of_the_study_lets_commands_act_again(running):
    running.log.lead(plan())
    running.log.trials.begin()
    running.log.trials.pause()
    assert running.hear("pause").what == "acted"
    assert running.kept()[0].user == ""


def test_the_study_goes_on_where_it_was_when_the_app_comes_back(running):
    running.log.lead(plan())
    running.log.trials.begin()
    running.hear(running.next().intent)
    running.close()
    running.open()
    assert (running.log.trials.stage, running.log.trials.trial) == ("ready", 1)
    running.log.end()
    running.close()
    running.open()
    assert running.log.trials is None


def test_a_study_switches_the_log_on(running):
    running.log.turn(False)
    running.log.lead(plan())
    assert running.log.on


def test_a_form_after_a_block_says_by_whom_and_which_method(running):
    running.log.lead(plan())
    running.log.trials.begin()
    while running.log.trials.stage != "tlx":
        running.hear(running.next().intent)
    assert running.log.fill("tlx", TLX, ["mental"], {"mental": 2.0}) == 20.0
    (form,) = running.log.archive.workloads.kept
    assert (form.user, form.method, form.posture, form.order) == ("P1", "voice", "standing", ["mental"])


def test_all_of_it_goes_into_one_zip(running):
    running.settings.set("robots", [{"url": "ws://10.0.0.7"}])
    running.hear("pause")
    running.log.fill("tlx", TLX, [], {})
    running.wait(12)
    path = running.log.export()
    again = running.log.export()
    assert path != again
    assert path.name.startswith("study_")
    with zipfile.ZipFile(path) as archive:
        names = set(archive.namelist())
        assert names == {
            "responses.jsonl",
            "responses.csv",
            "workload.jsonl",
            "scores.csv",
            "settings.json",
            "README.txt",
        }
        rows = list(csv.DictReader(io.StringIO(archive.read("responses.csv").decode())))
        assert [row["recognised"] for row in rows if row["kind"] == "command"] == ["pause"]
        settings = json.loads(archive.read("settings.json"))
        assert settings["study"] == {"log": True, "snippets": False, "remind": False}
        assert settings["intents"]["shake"]["start"] is False, "nobody has changed that"
        assert "robots" not in settings
        readme = archive.read("README.txt").decode()
    assert str(BASELINE) in readme
    assert all(name in readme for name in COLUMNS)


def test_a_zip_that_cannot_be_written_leaves_nothing_behind(running, monkeypatch):
    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("app.study.study_export._fill", fail)
    with pytest.raises(OSError, match="No space"):
        running.log.export()
    assert list(running.log.archive.exports.iterdir()) == []


def test_a_clock_that_was_lost_leaves_the_zip_whole(running, monkeypatch):
    running.hear("pause")
    running.wait(12)
    running.log.archive.log.flush()
    for path in running.log.archive.folder.glob("*.jsonl"):
        os.utime(path, (3600, 3600))
    running.log._wall = lambda: 3600.0
    monkeypatch.setattr("time.time", lambda: 3600.0)
    with zipfile.ZipFile(running.log.export()) as archive:
        assert archive.testzip() is None
        assert {one.date_time[0] for one in archive.infolist()} == {1980}


def test_half_a_zip_is_never_left_whatever_failed(running, monkeypatch):
    monkeypatch.setattr("app.study.study_export._fill", lambda *_: int("no"))
    with pytest.raises(ValueError, match="invalid literal"):
        running.log.export()
    assert list(running.log.archive.exports.iterdir()) == []


def test_the_table_has_every_field_and_no_formula():
    assert set(MEANINGS) == set(COLUMNS)
    rows = list(csv.DictReader(io.StringIO(table([Response(user="=1+1", confidence=0.5)]))))
    assert rows[0]["user"] == "'=1+1"
    assert (rows[0]["confidence"], rows[0]["t_ack"]) == ("0.5", "")


def test_all_can_be_erased_and_what_is_under_way_is_no_line_later(running):
    running.hear("pause")
    running.log.fill("tlx", TLX, [], {})
    running.wait(12)
    running.hear("resume")
    running.log.forget()
    assert running.log.archive.erase() == "Everything was erased."
    assert running.log.archive.workloads.kept == []
    assert running.log.usage() == {}
    running.wait(12)
    assert running.log.archive.read() == []


def test_of_what_was_exported_it_is_said_that_it_remains(running):
    running.log.export()
    assert running.log.archive.erase() == (
        f"Everything was erased. 1 zip that was exported remains in {running.log.archive.exports}."
    )


def test_forms_that_cannot_be_erased_are_said(running, monkeypatch):
    monkeypatch.setattr(
        running.log.archive.workloads,
        "_write",
        lambda: setattr(running.log.archive.workloads, "problem", "The disk is full."),
    )
    with pytest.raises(OSError, match="The disk is full"):
        running.log.archive.erase()


def test_lines_that_are_lost_are_said(running):
    assert running.log.problem == ""
    running.log.archive.log.dropped = 52
    assert running.log.problem == "52 lines of the log could not be written and are lost."


def test_switched_off_as_any_other_method_it_stays_off(running):
    running.log.on = False
    running.log.stop()
    running.close()
    running.open()
    assert not running.log.on


def test_commands_of_this_run_are_counted_for_whoever_learns_from_them(running):
    running.hear("pause")
    running.hear("lights")
    running.wait(12)
    assert running.log.usage() == {"pause": 1, "lights": 1}
