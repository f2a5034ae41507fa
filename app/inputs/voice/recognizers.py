"""The choice of a recogniser: the one that the operator wants, or the best of those that work here."""

from __future__ import annotations

from app.device import is_android
from app.inputs.voice.interfaces.speech_recognizer import SpeechRecognizer
from app.inputs.voice.process.worker import recognizer
from widgets.core.language import mark, tr

__all__ = ["BEST", "RECOGNIZERS", "choose"]

BEST = ""
"""The first of `RECOGNIZERS` that works here."""
RECOGNIZERS: dict[str, str] = {
    "phonemes": mark("By sounds"),
    "vosk": mark("Vosk"),
    "sphinx": mark("By words"),
}
"""Name of each, with its name for the operator; the best first. A phone has one of its own."""


def choose(wanted: str = BEST, model: str = "") -> tuple[SpeechRecognizer, str]:
    """The recogniser of that name in `RECOGNIZERS`, and an empty text; else another one, and one sentence why it is another.

    `model` is the folder of Vosk's model. Where none works, the one that is wanted, which says itself what it lacks.
    """
    if is_android():
        from app.inputs.voice.android.speech import AndroidRecognizer

        return AndroidRecognizer(), ""
    first = recognizer(wanted or next(iter(RECOGNIZERS)), model)
    missing = first.missing()
    if not missing:
        return first, ""
    for name, title in RECOGNIZERS.items():
        other = recognizer(name, model)
        if name != first.name and not other.missing():
            return other, tr("{missing} “{title}” listens instead.").format(missing=missing, title=title)
    return first, ""
