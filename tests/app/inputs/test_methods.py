"""The ways in as a whole: one that cannot be made stops no other, and nothing listens or waits while the glass is away."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

import app.inputs.methods as methods_of
from app.core.command_origin import NOBODY, origins
from app.inputs.methods import ON_DEMAND, Methods
from app.inputs.voice.process.ending import end_aside
from app.intents.intents import CONFIRM_TIME, Heard, Intents
from app.intents.method_permits import MethodPermits
from tests.app.inputs.pushing import Settings
from tests.headless import Stage


class Made:
    """A method that works."""

    on, standing, problem = True, "listening", ""

    def __init__(self, app: Any) -> None:
        self.life: list[str] = []

    def start(self) -> None:
        self.life.append("start")

    def stop(self) -> None:
        self.life.append("stop")

    def close(self) -> None:
        self.life.append("close")


class Unmakeable(Made):
    def __init__(self, app: Any) -> None:
        raise TypeError("no plan can be read from 3")


class Unstartable(Made):
    ends: list[str] = []

    def start(self) -> None:
        raise OSError("no such device")

    def close(self) -> None:
        self.ends.append("close")
        raise OSError("never began")


class IntentActions:
    """A task can be begun, and nothing is asked."""

    def __init__(self) -> None:
        self.done: list[str] = []

    def why_not(self, intent: str) -> str:
        return "Nothing is asked just now." if intent in ("yes", "no") else ""

    def words(self, intent: str) -> str:
        return intent

    def do(self, intent: str) -> None:
        self.done.append(intent)

    def answer(self, yes: bool) -> str:
        return ""


class App:
    """As much of the app as they ask for."""

    def __init__(self, made: dict[str, type], monkeypatch: pytest.MonkeyPatch) -> None:
        module: Any = ModuleType("made_here")
        for name, kind in made.items():
            setattr(module, name, kind)
        monkeypatch.setitem(sys.modules, "made_here", module)
        monkeypatch.setattr(methods_of, "MADE_BY", {name: f"made_here:{name}" for name in made})
        self.time, self.said, self.acts = 100.0, [], IntentActions()
        self.shell = None
        self.settings = Settings()
        self.connect = SimpleNamespace(say=lambda text, level: self.said.append(text))
        self.intents = Intents(self.acts, MethodPermits(Settings()), self.now)
        self.methods = Methods(self)

    def now(self) -> float:
        return self.time


@pytest.fixture
def make(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    opened: list[Methods] = []

    def make(**made: type) -> App:
        on = {name: {"on": True} for name, kind in made.items() if name in ON_DEMAND and kind.on}
        kept = made.pop("kept", on)  # whoever switched one on finds that in the settings
        app = App(made, monkeypatch)
        for name, value in kept.items():
            app.settings.set(name, value)
        app.methods.open()
        opened.append(app.methods)
        return app

    yield make
    for methods in opened:
        methods.close()


def test_one_that_cannot_be_made_or_begun_is_said_and_the_others_go_on(make: Any) -> None:
    app = make(log=Unmakeable, shake=Unstartable, voice=Made)
    app.methods.open_rest()
    assert app.methods.get("voice").life == ["start"]
    assert (app.methods.get("log"), app.methods.get("shake")) == (None, None)
    assert Unstartable.ends == ["close"]
    shake = "Shake cannot be used: no such device."
    assert app.said == [shake, f"Log cannot be used: no plan can be read from 3. {shake}"], "the last is read"
    assert set(app.methods.faults) == {"log", "shake"}
    app.methods.update(100.0)
    app.methods.turn("log", on=True)


class Counted(Made):
    """Off, and counts how many of it are made."""

    on, made = False, 0
    mistaken = "In the settings of voice rate is 'fast': reset to default."

    def __init__(self, app: Any) -> None:
        super().__init__(app)
        type(self).made += 1

    def update(self, now: float) -> None:
        self.life.append("update")


@pytest.fixture
def counted() -> Any:
    return type("Counted", (Counted,), {})


def test_what_was_never_switched_on_is_made_when_it_is_first_asked_for(make: Any, counted: Any) -> None:
    app = make(voice=counted, gamepad=Made)
    assert counted.made == 0, "nobody needs it"
    assert app.methods.armed == ["gamepad"]
    assert app.methods.made("voice") is None
    assert app.methods.get("voice") is app.methods.get("voice") is app.methods.made("voice")
    assert counted.made == 1
    assert app.said == [counted.mistaken]


def test_what_has_settings_is_made_at_once_and_says_what_is_wrong_with_them(make: Any, counted: Any) -> None:
    app = make(voice=counted, kept={"voice": {"on": False}})
    assert counted.made == 1
    assert app.said == [counted.mistaken]


def test_switching_on_what_was_never_made_makes_and_starts_it(make: Any, counted: Any) -> None:
    app = make(voice=counted, log=Made)
    app.methods.turn("voice", True)
    assert app.methods.get("voice").life == ["start"]
    app.methods.update(1.0)
    assert app.methods.get("voice").life == ["start", "update"]
    assert app.methods.armed == ["voice"]


def test_what_is_made_late_and_cannot_be_made_is_said_once_and_is_none(make: Any) -> None:
    app = make(voice=Unmakeable, gamepad=Made, kept={})
    assert app.said == []
    assert app.methods.get("voice") is None
    assert app.methods.get("voice") is None
    assert app.said == ["Voice cannot be used: no plan can be read from 3."]
    assert app.methods.faults == {"voice": app.said[0]}


def test_the_log_is_made_after_the_first_frame_and_before_those_of_its_name_are_asked(make: Any) -> None:
    app = make(log=Made, gamepad=Made)
    assert app.methods.made("log") is None
    app.methods.open_rest()
    log = app.methods.made("log")
    assert log.life == ["start"]
    app.methods.open_rest()
    assert app.methods.get("log") is log


def test_what_is_asked_for_while_the_glass_is_away_begins_when_it_is_back(make: Any) -> None:
    app = make(log=Made)
    app.methods.pause()
    assert app.methods.get("log").life == []
    app.methods.resume()
    assert app.methods.get("log").life == ["start"]


def test_nothing_is_made_before_they_are_opened_nor_after_they_are_closed(make: Any, counted: Any) -> None:
    app = make(voice=counted)
    app.methods.close()
    assert app.methods.get("voice") is None
    assert counted.made == 0


def test_while_the_glass_is_away_nothing_listens_and_no_question_waits(make: Any) -> None:
    app = make(voice=Made)
    assert app.intents.submit(Heard("patrol", "voice")).what == "asks"
    app.methods.pause()
    assert app.methods.get("voice").life == ["start", "stop"]
    assert app.intents.pending is None
    app.methods.resume()
    app.intents.answer(yes=True, method="voice")
    assert app.acts.done == []
    assert app.methods.get("voice").life == ["start", "stop", "start"]


class Speaks(Made):
    said = ""


def test_what_came_of_a_question_is_said_where_the_question_was(make: Any) -> None:
    app = make(voice=Speaks, shake=Speaks)
    voice, shake = app.methods.get("voice"), app.methods.get("shake")
    voice.said = app.intents.submit(Heard("go_home", "voice")).sentence
    assert voice.said == "go_home?"
    app.time += CONFIRM_TIME + 1.0
    app.intents.update(app.time)
    assert voice.said == "Not done, no yes came: go_home."
    assert shake.said == "", "it asked nothing"


def test_a_finger_that_was_on_the_glass_when_it_was_taken_away_does_nothing_later(make: Any) -> None:
    app = make(voice=Made)
    origins.touched(99.0)
    app.methods.pause()
    assert origins.current() is NOBODY


def test_what_was_touched_is_forgotten_by_the_heartbeat(make: Any) -> None:
    app = make(voice=Made)
    origins.touched(99.0)
    origins.lifted(99.1)
    app.methods.update(99.5)
    assert origins.current().method == "button"
    app.methods.update(105.0)
    assert origins.current() is NOBODY


class Deaf(Made):
    problem = "There is no microphone."


def test_what_is_on_and_does_not_work_is_said_with_the_next_heartbeat(make: Any) -> None:
    app = make(voice=Deaf)
    app.methods.update(100.0)
    assert app.said == ["Voice: There is no microphone."]


class Unplugged(Made):
    idle = True


def test_a_command_could_come_from_what_is_on_and_well_and_has_something_to_work_with(make: Any) -> None:
    app = make(voice=Made, shake=Deaf, gamepad=Unplugged)
    assert app.methods.armed == ["voice", "shake", "gamepad"]
    assert app.methods.hearing == ["voice"]


def test_settings_that_mean_nothing_are_said_of_each_that_reads_them(monkeypatch: pytest.MonkeyPatch) -> None:
    class Mistaken(Made):
        mistaken = "In the settings of talking rate is from 0.5 to 2, not 9: reset to default."

    app = App({"Mistaken": Mistaken, "Made": Made}, monkeypatch)
    app.methods.open()
    assert app.said == [Mistaken.mistaken]
    app.methods.close()


def test_what_still_ends_beside_the_glass_has_ended_when_they_are_closed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    app = App({"Made": Made}, monkeypatch)
    app.methods.open()
    gone = threading.Event()
    reader = threading.Thread(target=gone.wait, args=(0.2,), name="slow")
    reader.start()
    end_aside(None, reader)
    app.methods.close()
    assert not reader.is_alive()
