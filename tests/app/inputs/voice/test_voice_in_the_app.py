"""Voice through the whole app: somebody speaks, the real recogniser hears, and a robot is stopped."""

from __future__ import annotations

import wave
from pathlib import Path

import numpy as np
import pytest

from app.core.command_origin import origins
from app.inputs.voice.process.worker import InProcess
from app.inputs.voice.voice_input import VoiceInput
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.lacking import package

hibari = package("hibari")
package("hama")


@pytest.fixture
def spoken(tmp_path: Path) -> Path:
    """A natural voice that says `go home`, and a second later `stop`."""
    voice, rest = hibari.Hibari(), np.zeros(24000, np.float32)
    said = [np.asarray(voice(words, seed=1), np.float32) for words in ("go home", "stop")]
    sound = np.concatenate((rest, said[0], rest, rest, said[1], rest))
    sound += np.random.default_rng(1).normal(0.0, 1e-3, len(sound)).astype(np.float32)
    path = tmp_path / "spoken.wav"
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(24000)
        file.writeframes((np.clip(sound, -1, 1) * 32767).astype("<i2").tobytes())
    return path


def test_a_spoken_stop_reaches_the_robot_and_what_is_risky_is_asked(
    driving: Glass, robot: FakeRobot, spoken: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    app, speaking = driving.app, driving.app.methods.get("voice")
    taken, stops = [], []
    app.intents.on_taken.append(lambda heard, verdict: taken.append((heard.intent, verdict.what)))
    stop = app.session.stop
    monkeypatch.setattr(app.session, "stop", lambda *given: (stops.append(origins.current()), stop(*given)))
    assert isinstance(speaking, VoiceInput)
    monkeypatch.setattr(speaking, "_make", lambda: InProcess("phonemes", [spoken]))
    app.methods.turn("voice", on=True)
    driving.until(lambda: speaking.ready, "the recogniser does not start")
    driving.until(lambda: app.shell.nav.voice == "ready", "no button to talk")
    finger = driving.hold(app.shell.nav.ids.talk)
    driving.until(lambda: any(name == "/stop" for name, _ in robot.asked), "STOP was not heard")
    finger.touch_up()
    assert ("go_home", "asks") in taken
    assert taken[-1] == ("stop", "acted")
    assert {(one.method, one.said) for one in stops} == {("voice", "stop")}
    assert not any(name == "/task/go_home" for name, _ in robot.asked), "nobody said yes"
    app.methods.turn("voice", on=False)
    driving.until(lambda: not app.shell.nav.voice, "the button stays")
