"""The pane of log and study: what was kept is drawn, a study runs through on it, and nothing of it runs when it is left."""

from __future__ import annotations

import threading
import time
from types import SimpleNamespace

import pytest

from app.core.command_origin import origins
from app.core.settings_store import Settings
from app.intents.intents import Intents
from app.intents.method_permits import MethodPermits
from app.screens.inputs.study.form_view import FormView
from app.screens.inputs.study.log_view import facts
from app.screens.inputs.study.setup_view import SetupView, commands_of
from app.screens.inputs.study.study_pane import StudyPane
from app.screens.inputs.study.trial_view import PRACTICE, TrialView
from app.study.response_log import Response, ResponseLog
from app.study.response_recording import ResponseRecording
from app.study.study import COMMANDS


class IntentActions:
    def why_not(self, intent):
        return "No robot is known that could be stopped." if intent == "stop" else ""

    def words(self, intent):
        return intent

    def do(self, intent):
        raise AssertionError(f"{intent} was done in the study")

    def answer(self, yes):
        return ""


class Ways:
    """The methods of the app: the log, and a shake that is off."""

    hearing = ("shake",)

    def __init__(self) -> None:
        self.all = {"shake": SimpleNamespace(on=False, meaning={"ud": "pause", "fb": "resume"}, set_to={})}

    def get(self, name):
        return self.all.get(name)


class Bench:
    """The pane on a stage, with an app that has nothing else."""

    def __init__(self, stage, folder) -> None:
        self.stage, self.time = stage, 100.0
        self.settings = Settings(folder)
        self.app = SimpleNamespace(
            settings=self.settings,
            now=lambda: self.time,
            session=None,
            methods=Ways(),
            corner=SimpleNamespace(on_pressed=[]),
        )
        self.app.intents = Intents(IntentActions(), MethodPermits(self.settings), self.app.now)
        self.log = self.app.methods.all["log"] = ResponseRecording(self.app, wall=lambda: 1.7e9)
        self.log.start()
        self.pane = StudyPane(app=self.app)
        stage.show(self.pane, (500, 800))
        self.pane.enter()

    def settle(self) -> None:
        """Wait for what the worker does, and for the glass."""
        end = time.monotonic() + 10
        worker = self.pane._worker
        while worker is not None and time.monotonic() < end:
            with worker._ready:
                idle = not worker._waiting
            if idle and self.pane._results:
                break
            time.sleep(0.005)
        self.tick()

    def tick(self) -> None:
        self.pane.tick()
        self.stage.frames(3)

    def prompt(self):
        while self.log.trials.prompt is None:
            self.time += 0.5
            self.log.update(self.time)
        self.tick()
        return self.log.trials.prompt

    def close(self) -> None:
        self.pane.leave()
        self.log.close()
        self.settings.close()


@pytest.fixture
def bench(stage, tmp_path):
    log = ResponseLog(tmp_path / "responses")
    for number, took in enumerate((0.5, 0.6, 0.9)):
        log.put(
            Response(
                id=str(number),
                session="s",
                method="voice",
                recognised="stop",
                t_input_start=1.0,
                t_sent=1 + took,
            )
        )
    log.close()
    origins.forget()  # of this process: another test may have left a key in it
    bench = Bench(stage, tmp_path)
    yield bench
    bench.close()


def test_what_was_kept_is_read_beside_the_glass_and_drawn(bench):
    bench.settle()
    view = bench.pane.view
    assert [rate[1:4] for rate in view.success.rates] == [("Voice", 3, 3)]
    assert view.chart.times[0][:4] == ("STOP", "mic", "Voice", pytest.approx(0.6))
    view.choice.choose("study")
    assert view.chart.times == []


def test_until_it_is_read_nothing_is_said_to_be_missing(bench):
    charts = bench.pane.view.success, bench.pane.view.chart
    assert [chart.nothing for chart in charts] == ["Reading …", "Reading …"]
    bench.settle()
    assert [chart.nothing for chart in charts] == [
        "No trials yet.",
        "No response times yet.",
    ]


def test_what_comes_while_the_log_is_looked_at_is_read_a_moment_later(bench):
    bench.settle()
    view = bench.pane.view
    bench.log._put(Response(id="new", session="s", method="shake", recognised="stop", t_sent=2.0))
    bench.time += 1.0
    view.tick()
    assert not view._busy
    bench.time += 1.5
    view.tick()
    bench.settle()
    assert [rate[1] for rate in view.success.rates] == ["Voice", "Shake"]


def test_nothing_is_read_in_the_place_of_a_zip_that_is_being_written(bench):
    bench.settle()
    view = bench.pane.view
    view.export.dispatch("on_release")
    bench.log.lines += 1
    bench.time += 10.0
    view.tick()
    bench.settle()
    assert view.said.text.startswith("Written: ")


def test_it_is_said_when_the_log_cannot_be_read(bench, monkeypatch):
    def fail():
        raise PermissionError(13, "Permission denied")

    bench.settle()
    monkeypatch.setattr(bench.log.archive, "read", fail)
    bench.pane.view.enter()
    bench.settle()
    assert bench.pane.view.said.text == "The log could not be read: Permission denied."


def test_no_thread_is_left_when_the_pane_is(bench):
    bench.settle()
    bench.pane.leave()
    assert not [thread for thread in threading.enumerate() if thread.name == "study files"]


def test_everything_is_erased_only_by_a_second_press_soon_after_the_first(bench):
    bench.settle()
    view = bench.pane.view
    view.erase.dispatch("on_release")
    assert view.erase.text == "Press again: erase"
    bench.time += 10
    view.tick()
    view.erase.dispatch("on_release")
    assert len(bench.log.archive.read()) == 3
    view.erase.dispatch("on_release")
    assert view.said.text == "Erasing …"
    bench.settle()
    assert bench.log.archive.read() == []
    assert view.said.text == "Everything was erased."


def test_it_is_said_when_nothing_could_be_erased(bench, monkeypatch):
    def fail() -> str:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(bench.log.archive, "erase", fail)
    bench.settle()
    for _ in range(2):
        bench.pane.view.erase.dispatch("on_release")
    bench.settle()
    assert bench.pane.view.said.text == "It is not erased: Permission denied."


def test_a_zip_is_written_and_told_where(bench):
    bench.settle()
    bench.pane.view.export.dispatch("on_release")
    bench.settle()
    assert bench.pane.view.said.text.startswith("Written: ")
    assert len(list(bench.log.archive.exports.glob("*.zip"))) == 1


def test_the_folder_of_what_was_exported_is_said_and_it_is_deleted_only_by_a_second_press(bench):
    bench.settle()
    view = bench.pane.view
    assert view.zips.children == []
    view.export.dispatch("on_release")
    bench.settle()
    assert view.zips.remark.text == f"1 zip lies in {bench.log.archive.exports}."
    assert view.zips.share.parent is None, "a file manager finds it"
    view.zips.away.dispatch("on_release")
    assert view.zips.away.text == "Press again: delete"
    bench.time += 10
    view.tick()
    assert view.zips.away.text == "Delete the zip"
    for _ in range(2):
        view.zips.away.dispatch("on_release")
    bench.settle()
    assert (bench.log.archive.zips(), view.said.text, view.zips.children) == ([], "The zip was deleted.", [])


class Out:
    """Another app, on a phone."""

    where = "Download/Pilothouse"

    def __init__(self) -> None:
        self.shared: list[str] = []
        self.forgot = False

    def share(self, path):
        if self.shared:
            raise OSError("Android does not share it: no room.")
        self.shared.append(path.name)

    def forget(self):
        self.forgot = True


def test_on_a_phone_the_newest_is_handed_to_another_app_and_its_copy_goes_with_it(bench, monkeypatch):
    out = Out()
    monkeypatch.setattr("app.screens.inputs.study.study_pane.sharing", lambda: out)
    bench.pane._views.clear()
    bench.log.archive.exports.mkdir(parents=True, exist_ok=True)
    for name in ("study_2.zip", "study_1.zip"):
        (bench.log.archive.exports / name).write_bytes(b"PK")
    bench.pane._show()
    bench.settle()
    view = bench.pane.view
    assert view.zips.remark.text.startswith("2 zips lie in the app's own folder")
    view.zips.share.dispatch("on_release")
    bench.settle()
    assert out.shared == ["study_2.zip"]
    assert view.said.text == "study_2.zip: its copy is in Download/Pilothouse."
    view.zips.share.dispatch("on_release")
    bench.settle()
    assert view.said.text == "It is not shared: Android does not share it: no room."
    for _ in range(2):
        view.zips.away.dispatch("on_release")
    bench.settle()
    assert (out.forgot, bench.log.archive.zips()) == (True, [])


def test_what_was_to_be_read_is_read_after_a_zip_was_written_in_its_place(bench):
    view = bench.pane.view
    view._busy = "read"
    view.export.dispatch("on_release")
    bench.settle()
    bench.time += 5.0
    view.tick()
    bench.settle()
    assert view.success.rates


def test_a_shake_is_asked_only_for_what_its_directions_mean(bench):
    assert commands_of("shake", bench.app) == ("stop", "pause", "resume")
    assert commands_of("voice", bench.app) == COMMANDS


def test_keys_are_asked_for_stop_only_where_there_is_a_robot(bench):
    assert "stop" not in commands_of("keyboard", bench.app)
    bench.app.session = SimpleNamespace()
    assert commands_of("keyboard", bench.app) == COMMANDS
    bench.app.session = None


def test_a_study_without_a_method_cannot_begin(bench):
    setup = SetupView(bench.app)
    for switch in setup.switches.values():
        switch.active = False
    setup.tick()
    assert setup.begin.disabled
    assert setup.remark.text == "Choose a method."


def test_a_method_that_is_not_listening_is_told_before_it_is_asked_for(bench):
    setup = SetupView(bench.app)
    setup.tick()
    assert setup._rows["shake"].detail.startswith("Off: ")
    assert setup._rows["shake"].role == setup.remark.role == "warn"
    assert setup.begin.disabled, "nobody could answer its prompts"
    setup.switches["shake"].active = False
    setup.tick()
    assert not setup.begin.disabled


def test_a_study_by_buttons_runs_through_to_its_forms(bench):
    pane = bench.pane
    pane.choice.choose("study")
    for method, switch in pane.view.switches.items():
        switch.active = method == "button"
    pane.view.often.dispatch("on_change", 1)
    pane.view.begin.dispatch("on_release")
    bench.tick()
    assert isinstance(pane.view, TrialView)
    pane.view.go.dispatch("on_release")
    bench.tick()
    assert pane.choice.parent is None
    for _ in COMMANDS:
        prompt = bench.prompt()
        assert pane.view.card.words.lower().replace(" ", "_") == prompt.intent
        assert pane.view.card.how == "Buttons: press it among these"
        assert [part.title for part in pane.view.pad.children if hasattr(part, "title")] == [PRACTICE]
        pane.view._press(prompt.intent)
    bench.tick()
    assert isinstance(pane.view, FormView)
    pane.view.hand_in.dispatch("on_release")
    assert pane.view.said.text.startswith("No answer yet: Mental demand")
    for scale in pane.view.sheet.rows.values():
        scale.answer(30)
    pane.view.hand_in.dispatch("on_release")
    bench.tick()
    assert (pane.view.form, bench.log.archive.workloads.scores("tlx")[-1][1]) == ("sus", 30.0)
    pane.view.skip.dispatch("on_release")
    bench.tick()
    assert bench.log.trials.stage == "done"
    pane.view.end.dispatch("on_release")
    bench.tick()
    assert isinstance(pane.view, SetupView)


def test_leaving_the_glass_lets_the_study_wait(bench):
    bench.log.lead(SetupView(bench.app).plan)
    bench.log.trials.begin()
    bench.prompt()
    bench.pane.leave()
    assert bench.log.trials.stage == "paused"
    bench.pane.enter()
    bench.tick()
    assert bench.pane.part == "study"
    assert bench.pane.view.go.text == "Go on"


def test_back_closes_a_form_and_then_leaves_the_rest_to_the_screen(bench):
    bench.pane.choice.choose("load")
    bench.pane.view.load.dispatch("on_release")
    assert bench.pane.view.form is not None
    assert bench.pane.back()
    assert bench.pane.view.form is None
    assert not bench.pane.back()


def test_a_form_that_is_left_by_back_keeps_its_answers_and_is_gone_on_with(bench):
    bench.log.due = "patrol"
    bench.pane.choice.choose("load")
    view = bench.pane.view
    assert view.load.text == "Fill in the workload (TLX)"
    view.form.sheet.rows["effort"].answer(35)
    bench.log.due = "go_home"  # the next task is over meanwhile
    assert bench.pane.back()
    bench.time += 60.0
    assert (view.load.text, view.use.text) == ("Go on with the workload (TLX)", "Fill in the usability (SUS)")
    view.load.dispatch("on_release")
    assert view.form.sheet.answers == {"effort": 35}
    bench.time += 2.0
    view.form.sheet.rows["effort"].answer(40)
    assert view.form.sheet.seconds == {"effort": 2.0}
    for scale in view.form.sheet.rows.values():
        scale.answer(30)
    view.form.hand_in.dispatch("on_release")
    assert [one.task for one in bench.log.archive.workloads.kept] == ["patrol"]
    assert bench.log.due == "go_home"
    assert view.load.text == "Fill in the workload (TLX)"


def test_answers_are_thrown_away_only_by_a_second_press_soon_after_the_first(bench):
    bench.pane.choice.choose("load")
    view = bench.pane.view
    view.load.dispatch("on_release")
    form = view.form
    form.sheet.rows["effort"].answer(35)
    form.skip.dispatch("on_release")
    assert (view.form, form.skip.text) == (form, "Press again: its answers go")
    bench.time += 10
    view.tick()
    assert form.skip.text == "Leave it out"
    for _ in range(2):
        form.skip.dispatch("on_release")
    assert (view.form, bench.log.archive.workloads.kept) == (None, [])
    view.load.dispatch("on_release")
    assert view.form.sheet.answers == {}
    view.form.skip.dispatch("on_release")
    assert view.form is None, "an empty one is left at once"


def test_figures_without_a_bar_are_sentences(bench):
    kept = [
        Response(kind="armed", method="shake", seconds=7200.0),
        Response(method="shake", recognised="stop", undo=True),
    ]
    assert facts(kept) == "Shake: 0.5 false activations an hour, in 2.0 h."
    assert facts([]) == ""


def test_on_a_phones_side_prompt_and_buttons_begin_beside_each_other(bench):
    pane = bench.pane
    pane.size = 468, 258
    pane.choice.choose("study")
    for method, switch in pane.view.switches.items():
        switch.active = method == "button"
    pane.view.begin.dispatch("on_release")
    bench.tick()
    pane.view.go.dispatch("on_release")
    for _ in range(3):
        bench.tick()
    view = pane.view
    assert view.low
    assert view.card.to_window(0, view.card.top)[1] == pytest.approx(view.pad.to_window(0, view.pad.top)[1])
    assert view.pad.height <= 258
