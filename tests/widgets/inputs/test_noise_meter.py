"""What the noise meter says, and that nothing it says is cut off."""

from __future__ import annotations

import math

import pytest

from tests.headless import Stage
from widgets.inputs.noise_meter import NoiseMeter

QUIET = {"level": -48.0, "noise": -54.0, "snr": 28.0}


def shown(stage: Stage, width: float = 420, state: str = "live", **told: object) -> NoiseMeter:
    meter = stage.show(NoiseMeter(state=state), (width, 96))
    meter.update(**{**QUIET, **told})
    stage.frames(2)
    return meter


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ({}, "Listens · 28 dB over the noise"),
        ({"speaking": True}, "Voice detected · 28 dB over the noise"),
        ({"clipped": True}, "Overdriven: speak further away"),
        ({"state": "alarm", "snr": 3.0}, "Too loud: 3 dB over the noise, 6 are needed"),
        ({"state": "disabled"}, "The microphone is closed"),
        ({"level": -math.inf, "noise": math.nan, "snr": math.nan}, "Listens"),
    ],
)
def test_it_says_how_it_hears(stage: Stage, told: dict[str, object], words: str) -> None:
    assert words in shown(stage, **told).texts


def test_what_was_heard_last_stands_below_with_how_sure_it_is(stage: Stage) -> None:
    meter = shown(stage)
    meter.answer("go home", 0.91, understood=True)
    stage.frames(2)
    assert "go home · 91 % sure" in meter.texts
    meter.answer("That was no command.", understood=False)
    stage.frames(2)
    assert "That was no command." in meter.texts


def test_words_that_do_not_fit_give_way_to_shorter_ones(stage: Stage) -> None:
    meter = shown(stage, 190)
    meter.answer("It is much too loud here to be sure of anything.", understood=False)
    stage.frames(2)
    assert "Listens · 28 dB" in meter.texts
    assert any(text.endswith("…") for text in meter.texts)
