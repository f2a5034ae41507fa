"""The process that talks: lines of JSON come in on its standard input, and it tells when it began to say each and when it ended.

`python -m app.inputs.voice.speech.talker natural` is started by `app.inputs.voice.speech.tts` and ends with its standard input.
"""

from __future__ import annotations

import json
import queue
import shutil
import sys
import threading
from collections.abc import Callable, Generator
from typing import Any, Protocol, TextIO

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble
from app.inputs.voice.speech import espeak
from widgets.core.language import mark, tr

__all__ = ["main", "play"]

BLOCK_MS = 60
TAIL = 0.15
"""Silence after each, so that the device is not closed on its last sound [s]."""
NO_SPEAKER = mark("There is no loudspeaker to talk by.")


class Synthesizer(Protocol):
    """Says a text and returns when that is over, or soon after `hushed` is set."""

    def __call__(self, words: str, rate: float, hushed: threading.Event) -> None:
        """VoiceTrouble where nothing can be heard."""


def main(arguments: list[str], orders: TextIO, events: TextIO) -> int:
    """Serve until the orders end; `arguments` is the voice's name."""

    def tell(word: str, sentence: str = "") -> None:
        events.write(json.dumps([word, sentence]) + "\n")
        events.flush()

    try:
        speak = SYNTHESIZERS[arguments[0]]()
    except (ImportError, OSError, VoiceTrouble) as trouble:
        tell("failed", f"The voice cannot be started: {trouble}.")
        return 1
    return serve(speak, orders, tell)


def serve(speak: Synthesizer, orders: TextIO, tell: Callable[..., None]) -> int:
    """Say each order, the newest instead of the one before, until they end; 1 where nothing can be heard."""
    waiting = queue.SimpleQueue[tuple[dict[str, Any], threading.Event] | None]()

    def obey() -> None:
        newest = threading.Event()
        for line in orders:
            newest.set()
            newest = threading.Event()
            waiting.put((json.loads(line), newest))
        newest.set()
        waiting.put(None)

    threading.Thread(target=obey, name="talk orders", daemon=True).start()
    while (order := waiting.get()) is not None:
        fields, hushed = order
        if hushed.is_set() or "say" not in fields:
            continue
        words = str(fields["say"])
        tell("began", words)
        try:
            speak(words, float(fields.get("rate", 1.0)), hushed)
        except VoiceTrouble as trouble:
            tell("failed", str(trouble))
            return 1
        tell("ended", words)
    return 0


def play(sound: NDArray[np.float32], rate: int, hushed: threading.Event, audio: Any = None) -> None:
    """Play mono samples of `rate` [Hz] to their end, or until `hushed`; VoiceTrouble without a loudspeaker."""
    if audio is None:
        from app.inputs.voice.audio.microphone import audio_library

        audio = audio_library()
    rest = np.zeros(int(TAIL * rate), np.float32)
    data = (np.clip(np.concatenate((sound, rest)), -1.0, 1.0) * 32767).astype("<i2").tobytes()
    over = threading.Event()

    def feed() -> Generator[bytes, int, None]:
        at = 0
        wanted = yield b""
        while at < len(data) and not hushed.is_set():
            part = data[at : at + 2 * wanted]
            at += len(part)
            wanted = yield part
        over.set()

    try:
        device = audio.PlaybackDevice(
            output_format=audio.SampleFormat.SIGNED16, nchannels=1, sample_rate=rate, buffersize_msec=BLOCK_MS
        )
    except audio.MiniaudioError as problem:
        raise VoiceTrouble(f"{tr(NO_SPEAKER)[:-1]}: {problem.args[0]}.") from problem
    try:
        if str(device.backend).lower() == "null":
            raise VoiceTrouble(tr(NO_SPEAKER))
        source = feed()
        next(source)
        device.start(source)
        while not over.wait(0.05) and not hushed.is_set():
            pass
    finally:
        device.close()


def _natural() -> Synthesizer:
    import hibari

    voice = hibari.Hibari()

    def speak(words: str, rate: float, hushed: threading.Event) -> None:
        sound = np.asarray(voice(words, speed=rate), np.float32)
        if not hushed.is_set():
            play(sound, int(hibari.SAMPLE_RATE), hushed)

    return speak


def _clear() -> Synthesizer:
    if shutil.which(espeak.PROGRAM) is not None:
        return espeak.say_by_program
    library = espeak.EspeakLibrary()

    def speak(words: str, rate: float, hushed: threading.Event) -> None:
        sound = library.samples(words, rate)
        if not hushed.is_set():
            play(sound, library.sample_rate, hushed)

    return speak


SYNTHESIZERS: dict[str, Callable[[], Synthesizer]] = {"natural": _natural, "clear": _clear}
"""Each voice of `app.inputs.voice.speech.tts.VOICES` to what says something by it."""


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], sys.stdin, sys.stdout))
