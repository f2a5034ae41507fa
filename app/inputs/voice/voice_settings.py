"""Settings of voice input, as the handheld remembers them under `voice`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from app.core.checked_settings import CheckedSettings, known, shown
from app.inputs.base.method_app import MethodApp
from app.inputs.base.toggleable_method import ToggleableMethod
from app.inputs.voice.recognition.phrases import PHRASES
from app.inputs.voice.recognizers import BEST, RECOGNIZERS
from widgets.core.language import mark

__all__ = ["VoiceOptions", "VoiceSettings", "read_settings"]

NO_LANGUAGE = "There are no commands in the language {}; they are English."


@dataclass(frozen=True, slots=True)
class VoiceSettings:
    """What the operator has chosen."""

    on: bool = False
    """The operator wants voice input."""
    hands_free: bool = False
    """It listens all the time, and not only while the button to talk is held."""
    language: str = "en"
    """ISO 639-1, of what may be said."""
    recognizer: str = BEST
    """What understands, of `app.inputs.voice.recognizers.RECOGNIZERS`; empty for the best that works here."""
    model: str = ""
    """Folder of the model of a recogniser that has none of its own; empty for none."""

    def save(self) -> dict[str, Any]:
        """As JSON; what understands only where it was chosen."""
        chosen = {"recognizer": self.recognizer, "model": self.model}
        kept = {"on": self.on, "hands_free": self.hands_free, "language": self.language}
        return kept | {name: value for name, value in chosen.items() if value}


def read_settings(value: object) -> tuple[VoiceSettings, str]:
    """The settings kept as `value`, and one sentence about what means nothing; empty when all is well."""
    kept = CheckedSettings(value, mark("voice", "settings"))
    on, hands_free = kept.flag("on", usual=False), kept.flag("hands_free", usual=False)
    recognizer = kept.word("recognizer", {BEST, *RECOGNIZERS}, BEST)
    model = kept.values.get("model", "")
    if not isinstance(model, str):
        kept.mistaken("model", "a folder")
        model = ""
    mistaken = kept.sentence
    language = kept.values.get("language", "en")
    if not known(language, PHRASES):
        language, mistaken = "en", NO_LANGUAGE.format(shown(language))
    return VoiceSettings(on, hands_free, language, recognizer, model), mistaken


class VoiceOptions(ToggleableMethod):
    """The settings as a pane changes them: what is assigned is kept at once, and voice input goes by it."""

    name = "voice"

    def __init__(self, app: MethodApp) -> None:
        """`app` is asked for its `settings`."""
        self._app = app
        self._settings, self.mistaken = read_settings(app.settings.get(self.name))
        """`mistaken` is one sentence about settings that mean nothing; empty when all is well."""

    def _fit(self) -> None:
        """Open the microphone, or close it, as is wanted now."""
        raise NotImplementedError

    def _restart(self) -> None:
        """Begin again with other settings; nothing where it has not begun."""
        raise NotImplementedError

    def _kept(self) -> dict[str, Any]:
        return self._settings.save()

    def _change(self, **values: Any) -> None:
        self._settings = replace(self._settings, **values)
        self._keep()

    @property
    def on(self) -> bool:
        """The operator wants it."""
        return self._settings.on

    @on.setter
    def on(self, on: bool) -> None:
        self._change(on=on)

    @property
    def hands_free(self) -> bool:
        """It listens all the time, and not only while the button to talk is held."""
        return self._settings.hands_free

    @hands_free.setter
    def hands_free(self, on: bool) -> None:
        self._change(hands_free=on)
        self._fit()

    @property
    def language(self) -> str:
        """ISO 639-1, of what may be said; ValueError for one without commands."""
        return self._settings.language

    @language.setter
    def language(self, language: str) -> None:
        if language not in PHRASES:
            raise ValueError(f"There are no commands in {language!r}; there are {', '.join(PHRASES)}.")
        self._change(language=language)
        self._restart()

    @property
    def recognizer(self) -> str:
        """What understands, of `RECOGNIZERS`, or `BEST`; ValueError for another."""
        return self._settings.recognizer

    @recognizer.setter
    def recognizer(self, name: str) -> None:
        if name not in (BEST, *RECOGNIZERS):
            raise ValueError(f"There is no recogniser {name!r}; there are {', '.join(RECOGNIZERS)}.")
        self._change(recognizer=name)
        self._restart()

    @property
    def model(self) -> str:
        """Folder of the model of a recogniser that has none of its own; empty for none."""
        return self._settings.model

    @model.setter
    def model(self, folder: str) -> None:
        self._change(model=folder.strip())
        self._restart()
