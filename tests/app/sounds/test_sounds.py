"""Sounds of what happens: only what was switched on is heard, as loud as was chosen."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from app.core.settings_store import Settings
from app.link.channels import EVENT, OUTCOME
from app.link.commands import Outcome
from app.sounds.sounds import SOUNDS, TONES, Sounds
from bridge.msgs.pilothouse_msgs import Event


class Played:
    """Tones that are noted."""

    silent, volume = False, 1.0

    def __init__(self) -> None:
        self.heard: list[tuple[str, float]] = []

    def play(self, name: str) -> None:
        self.heard.append((name, self.volume))

    def close(self) -> None:
        self.heard.clear()


@pytest.fixture
def settings(tmp_path: Path) -> Any:
    made = Settings(tmp_path)
    yield made
    made.close()


def happen(sounds: Sounds) -> None:
    for level in ("info", "warn", "alarm"):
        sounds.hear(EVENT, Event(level=level, text="It is so."))
    for phase in ("sent", "accepted", "refused"):
        sounds.hear(OUTCOME, Outcome("start", "1", phase))
    sounds.hear("/battery_state", None)


def test_every_sound_has_a_tone() -> None:
    assert set(SOUNDS) == set(TONES)


def test_nothing_is_heard_until_it_is_switched_on(settings: Settings) -> None:
    tones = Played()
    happen(Sounds(settings, tones))  # type: ignore[arg-type]
    assert tones.heard == []


@pytest.mark.parametrize("name", SOUNDS)
def test_what_is_switched_on_is_heard_once_and_remembered(settings: Settings, name: str) -> None:
    tones = Played()
    sounds = Sounds(settings, tones)  # type: ignore[arg-type]
    sounds.choose(name, True)
    sounds.set_volume(0.4)
    happen(sounds)
    assert tones.heard == [(name, 0.4)]
    again = Sounds(settings, tones)  # type: ignore[arg-type]
    assert ([one for one, on in again.on.items() if on], again.volume) == ([name], 0.4)


def test_bad_settings_say_so_and_nothing_is_heard(settings: Settings) -> None:
    settings.set("sounds", {"alarm": "loud", "volume": 11})
    sounds = Sounds(settings, Played())  # type: ignore[arg-type]
    assert sounds.sentence.startswith(
        "In the settings of sounds alarm is true or false, not 'loud', volume is from 0 to 1"
    )
    assert not any(sounds.on.values())
    assert sounds.volume == 0.7


def test_there_is_no_other_sound_and_no_other_volume(settings: Settings) -> None:
    sounds = Sounds(settings, Played())  # type: ignore[arg-type]
    with pytest.raises(KeyError):
        sounds.choose("music", True)
    sounds.set_volume(7.0)
    assert sounds.volume == 1.0
