"""Sounds of what happens: which events make one, and how loud. Off until they are switched on, as others may listen along."""

from __future__ import annotations

from typing import Any, Protocol

from app.core.checked_settings import CheckedSettings
from app.core.optional_parts import bring
from app.core.settings_store import Settings
from app.link.channels import EVENT, OUTCOME
from widgets.core.language import mark

__all__ = ["SOUNDS", "Sounds"]

SOUNDS = {
    "alarm": mark("The robot raises an alarm"),
    "warning": mark("The robot warns"),
    "refused": mark("A command was refused or not answered"),
}
"""Name of each to when it is heard."""
TONES = {"alarm": (880.0, 0.5), "warning": (620.0, 0.25), "refused": (300.0, 0.3)}
"""Name of each to its frequency [Hz] and how long it lasts [s]."""
USUAL_VOLUME = 0.7


class Player(Protocol):
    """What plays tones, such as `app.inputs.switch_access.tones.Tones`."""

    silent: bool
    volume: float

    def play(self, name: str) -> None:
        """Begin one, from its beginning."""

    def close(self) -> None:
        """Let go of every sound."""


class Sounds:
    """Everything in the UI thread; nothing is loaded before the first is heard."""

    def __init__(self, settings: Settings, tones: Player | None = None) -> None:
        """`tones` play them; None for those of this device."""
        self._settings, self._tones = settings, tones
        kept = CheckedSettings(settings.get(mark("sounds", "settings")), mark("sounds", "settings"))
        self.on = {name: kept.flag(name, usual=False) for name in SOUNDS}
        """Name of each to whether it is to be heard."""
        self.volume = kept.number("volume", 0.0, 1.0, usual=USUAL_VOLUME)
        """0 to 1."""
        self.sentence = kept.sentence
        """What was no good in the settings, as one sentence; empty when all is well."""

    @property
    def silent(self) -> bool:
        """This device makes no sound; known once one was tried."""
        return self._tones is not None and self._tones.silent

    def choose(self, name: str, on: bool) -> None:
        """Have that one heard from now on, or not; KeyError for one that there is not."""
        if name not in self.on:
            raise KeyError(name)
        self.on[name] = on
        self._save()

    def set_volume(self, volume: float) -> None:
        """0 to 1; what is beyond is cut off."""
        self.volume = min(max(volume, 0.0), 1.0)
        self._save()

    def play(self, name: str) -> None:
        """Let it be heard, whether it is on or not."""
        if self._tones is None:
            self._tones = bring("app.inputs.switch_access.tones:Tones")(TONES)
        self._tones.volume = self.volume
        self._tones.play(name)

    def hear(self, channel: str, value: Any) -> None:
        """Something came from the robot or its link: heard where its sound is on."""
        name = ""
        if channel == EVENT:
            name = {"alarm": "alarm", "warn": "warning"}.get(value.level, "")
        elif channel == OUTCOME and value.phase in ("refused", "no_reply"):
            name = "refused"
        if name and self.on[name]:
            self.play(name)

    def close(self) -> None:
        """Let go of every sound."""
        if self._tones is not None:
            self._tones.close()

    def _save(self) -> None:
        self._settings.set("sounds", {**self.on, "volume": self.volume})
