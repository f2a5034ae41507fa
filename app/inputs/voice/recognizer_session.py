"""One recogniser at work: started, given orders, and its events kept for the UI thread."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator

from app.inputs.voice.interfaces.speech_recognizer import (
    Event,
    Grammar,
    Level,
    Result,
    SpeechRecognizer,
    VoiceTrouble,
)
from app.inputs.voice.recognition.phrases import PHRASES
from widgets.core.language import tr

__all__ = ["RecognizerSession"]

MAX_EVENTS = 64
"""Events that wait for the UI thread; one second of them at the most."""


class RecognizerSession:
    """Everything in the UI thread but `on_event`."""

    def __init__(self, on_level: Callable[[Level], object], wake: Callable[[], object]) -> None:
        """`on_level` is given how loud it is, in any thread; `wake` has `drain` called soon, for a command must not wait."""
        self._on_level, self._wake = on_level, wake
        self.recognizer: SpeechRecognizer | None = None
        """What understands; None while nothing does."""
        self.listening = False
        """The microphone is open, or opening."""
        self._heeded: frozenset[str] | None = None
        self._events: deque[Event] = deque(maxlen=MAX_EVENTS)

    def start(self, recognizer: SpeechRecognizer, language: str) -> str:
        """Get ready to hear the commands of `language`; one sentence why that cannot be, empty when it can."""
        self._events.clear()
        self._heeded, self.listening = None, False
        if absent := recognizer.missing():
            return absent
        if language not in recognizer.languages:
            return tr("What understands here does not know the language {language}.").format(
                language=language
            )
        try:
            recognizer.start(Grammar(PHRASES[language], language), self.on_event)
        except VoiceTrouble as trouble:
            return str(trouble)
        self.recognizer = recognizer
        return ""

    def stop(self) -> None:
        """Let go of everything; what it has not told yet is void."""
        recognizer, self.recognizer, self.listening = self.recognizer, None, False
        if recognizer is not None:
            recognizer.stop()
        self._events.clear()

    def listen(self, *, on: bool) -> None:
        """Open the microphone, or close it."""
        self.listening = on
        if self.recognizer is not None:
            self.recognizer.listen(on=on)

    def heed(self, commands: frozenset[str] | None) -> None:
        """Count only these from now on; None for all that need no question."""
        if self.recognizer is not None and commands != self._heeded:
            self._heeded = commands
            self.recognizer.heed(commands)

    def on_event(self, event: Event) -> None:
        """From the recogniser, in any thread."""
        if isinstance(event, Level):
            self._on_level(event)
            return
        self._events.append(event)
        if isinstance(event, Result):
            self._wake()

    def drain(self) -> Iterator[Event]:
        """Everything but levels that came since, the oldest first."""
        while self._events:
            yield self._events.popleft()
