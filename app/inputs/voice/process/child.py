"""The voice process: orders come in on its standard input and events go out on its standard output, a line of JSON each.

`python -m app.inputs.voice.process.child phonemes`, or `vosk=FOLDER`, is started by `app.inputs.voice.process.worker` and ends with its standard input.
"""

from __future__ import annotations

import json
import logging
import os
import sys
import threading
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

from app.inputs.voice.audio.microphone import AudioSource, Microphone
from app.inputs.voice.audio.sound_files import FileAudioSource, read
from app.inputs.voice.interfaces.speech_recognizer import Event, State, VoiceTrouble
from app.inputs.voice.process.running import NOTE_PREFIX
from app.inputs.voice.process.service import Service, judge_of
from app.inputs.voice.process.wire import THERE, event_line, read_grammar
from widgets.core.language import VARIABLE, language

__all__ = ["main", "own_line"]


def main(arguments: list[str], orders: TextIO, events: TextIO) -> int:
    """Serve until the orders end; `arguments` are the engine, as in `judge_of`, and, in place of the microphone, recordings."""
    language.name = os.environ.get(VARIABLE, language.name)
    name, *recordings = arguments
    first = orders.readline()
    if not first:
        return 0

    lock = threading.Lock()

    def say(line: str) -> None:
        with lock:  # an answer may come from the thread that takes the orders
            events.write(line + "\n")
            events.flush()

    def tell(event: Event) -> None:
        say(event_line(event))

    try:
        ears: AudioSource = (
            FileAudioSource([read(Path(one)) for one in recordings]) if recordings else Microphone()
        )
    except VoiceTrouble as trouble:
        tell(State("failed", str(trouble)))
        return 0
    service = Service(read_grammar(json.loads(first)), ears, lambda grammar: judge_of(name, grammar), tell)
    threading.Thread(
        target=_obey, args=(service, orders, lambda: say(THERE)), name="voice orders", daemon=True
    ).start()
    service.run()
    return 0


def _obey(service: Service, orders: TextIO, there: Callable[[], object]) -> None:
    for line in orders:
        order = json.loads(line)
        if "listen" in order:
            service.listen(on=bool(order["listen"]))
        elif "there" in order:
            service.ask(there)
        elif "heed" in order:
            heeded = order["heed"]
            service.heed(None if heeded is None else frozenset(heeded))
    service.stop()


def own_line() -> TextIO:
    """Where standard output goes, for events alone: what a foreign library prints there goes with the errors from now on, and breaks no event."""
    events = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    return events


def _alone() -> None:
    """End without the interpreter's own end: that waits for the thread which reads the orders, or breaks over it and hides why."""
    code = 1
    logging.basicConfig(format=f"{NOTE_PREFIX}%(message)s")
    try:
        code = main(sys.argv[1:], sys.stdin, own_line())
    except BaseException:  # noqa: BLE001 - the last line of it is what the app tells as the reason
        traceback.print_exc()
    finally:
        logging.shutdown()
        sys.stderr.flush()
        os._exit(code)


if __name__ == "__main__":
    _alone()
