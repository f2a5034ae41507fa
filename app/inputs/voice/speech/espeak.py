"""espeak-ng as a synthesizer: the program where it is installed, else the library of the package espeakng-loader."""

from __future__ import annotations

import ctypes
import importlib.util
import os
import shutil
import subprocess
import threading
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble
from widgets.core.language import tr

__all__ = ["PROGRAM", "EspeakLibrary", "is_installed", "say_by_program"]

PROGRAM, PACKAGE = "espeak-ng", "espeakng_loader"
WORDS_A_MINUTE = 170
"""What espeak-ng calls its usual speed, to the nearest ten."""
VOICE = "en-us"
SYNCHRONOUS, RATE_PARAMETER, CHARACTERS, UTF8 = 2, 1, 1, 1
"""As in espeak-ng's speak_lib.h: AUDIO_OUTPUT_SYNCHRONOUS, espeakRATE, POS_CHARACTER, espeakCHARS_UTF8."""


def is_installed() -> bool:
    """The program or the package is there."""
    return shutil.which(PROGRAM) is not None or importlib.util.find_spec(PACKAGE) is not None


def say_by_program(words: str, rate: float, hushed: threading.Event) -> None:
    """Have the program say it, until its end or until `hushed`."""
    command = [PROGRAM, "-s", str(round(WORDS_A_MINUTE * rate)), "--", words]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        while process.poll() is None and not hushed.wait(0.05):
            pass
    finally:
        process.kill()
        process.wait()


class EspeakLibrary:
    """Makes samples of words. One for each process: the library has one state."""

    def __init__(self, voice: str = VOICE) -> None:
        """`voice` is a name of espeak-ng's, as in `en-us` or `ko`; VoiceTrouble where the library does not start, or has no such voice."""
        import espeakng_loader

        self._library: Any = ctypes.CDLL(espeakng_loader.get_library_path())
        data = os.fsencode(espeakng_loader.get_data_path())
        self.sample_rate = int(self._library.espeak_Initialize(SYNCHRONOUS, 0, data, 0))
        """Of the samples [Hz]."""
        self._voice = voice.encode()
        if self.sample_rate <= 0 or self._library.espeak_SetVoiceByName(self._voice) != 0:
            raise VoiceTrouble(
                tr("espeak-ng does not start: its voice {voice!r} is missing.").format(voice=voice)
            )
        self._parts: list[NDArray[np.float32]] = []
        kind = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.c_void_p)
        self._callback = kind(self._take)  # the library keeps no reference

    def samples(self, words: str, rate: float) -> NDArray[np.float32]:
        """The words, `rate` times as fast as usual: mono at `sample_rate`, -1 to 1."""
        self._parts.clear()
        self._library.espeak_SetSynthCallback(self._callback)
        self._library.espeak_SetVoiceByName(self._voice)
        self._library.espeak_SetParameter(RATE_PARAMETER, round(WORDS_A_MINUTE * rate), 0)
        text = words.encode() + b"\0"
        self._library.espeak_Synth(text, ctypes.c_size_t(len(text)), 0, CHARACTERS, 0, UTF8, None, None)
        self._library.espeak_Synchronize()
        return np.concatenate(self._parts) if self._parts else np.zeros(0, np.float32)

    def _take(self, samples: Any, count: int, _: object) -> int:
        if samples and count > 0:
            self._parts.append(np.ctypeslib.as_array(samples, (count,)).astype(np.float32) / 32768.0)
        return 0
