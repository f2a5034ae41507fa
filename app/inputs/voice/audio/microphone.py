"""The microphone, by miniaudio: mono samples at 16 kHz in a bounded queue, and one sentence for whatever is wrong with it."""

from __future__ import annotations

import contextlib
import logging
import queue
import time
from collections.abc import Callable, Generator
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble
from widgets.core.language import mark, tr

__all__ = ["AudioSource", "Microphone", "audio_library"]

log = logging.getLogger(__name__)

BLOCK_MS = 50
MAX_QUEUE = 100
"""Blocks kept for a recogniser that does not keep up: 5 s; older ones are dropped."""
SILENCE_TIMEOUT = 2.0
"""A microphone that gives nothing for so long was pulled out [s]."""
SILENT_DEVICES = ("Discard all samples", "NULL Capture")
"""How devices that make nothing but silence begin to be called."""
NONE = mark("There is no microphone. Plug one in, or command by touch, switches or keys.")
REFUSED = mark(
    "The microphone cannot be opened: {}. Another program may hold it, or the system forbids it: the next press to talk tries again."
)
GONE = mark("The microphone gives nothing any more. Plug it in again: the next press to talk opens it.")


class AudioSource(Protocol):
    """Where samples come from."""

    def start(self) -> None:
        """Begin to hear; `VoiceTrouble` with one sentence when that is impossible."""
        ...

    def read(self, timeout: float) -> tuple[NDArray[np.float32], float] | None:
        """The next samples, -1 to 1, and when the last of them was heard [s]; None when none came in `timeout` s.

        `VoiceTrouble` when none will come any more."""
        ...

    def stop(self) -> None:
        """Hear nothing more and let go of the device."""
        ...


class Microphone:
    """The system's chosen microphone; open only between `start` and `stop`."""

    def __init__(self, now: Callable[[], float] = time.monotonic, *, audio: Any = None) -> None:
        """`audio` takes the place of the module miniaudio."""
        self._now, self._audio = now, audio
        self._device: Any = None
        self._blocks: queue.Queue[tuple[bytes, float]] = queue.Queue(MAX_QUEUE)
        self._heard = 0.0
        self.dropped = 0
        """Blocks that nobody had time for."""

    def start(self) -> None:
        """Open it."""
        if self._device is not None:
            return
        audio = self._audio or audio_library()
        self._heard = self._now()
        try:
            self._device = audio.CaptureDevice(
                input_format=audio.SampleFormat.SIGNED16,
                nchannels=1,
                sample_rate=RATE,
                buffersize_msec=BLOCK_MS,
            )
            if (
                str(self._device.backend).lower() == "null"
            ):  # miniaudio's own silence where there is no device
                self.stop()
                raise VoiceTrouble(tr(NONE))
            pump = self._pump()
            next(pump)
            self._device.start(pump)
        except audio.MiniaudioError as problem:
            self.stop()
            raise VoiceTrouble(
                tr(NONE) if _nothing_there(audio) else tr(REFUSED).format(problem.args[0])
            ) from problem

    def read(self, timeout: float) -> tuple[NDArray[np.float32], float] | None:
        """The next block; `VoiceTrouble` where none came for 2 s: it was pulled out."""
        try:
            raw, at = self._blocks.get(timeout=timeout)
        except queue.Empty:
            if self._device is not None and self._now() - self._heard > SILENCE_TIMEOUT:
                self.stop()
                raise VoiceTrouble(tr(GONE)) from None
            return None
        self._heard = self._now()
        return np.frombuffer(raw, "<i2").astype(np.float32) / 32768.0, at

    def stop(self) -> None:
        """Close it, and forget what was not yet read."""
        device, self._device = self._device, None
        if device is not None:
            device.close()
        if self.dropped:
            log.warning("%d blocks of sound were lost: the recogniser did not keep up", self.dropped)
            self.dropped = 0
        with contextlib.suppress(queue.Empty):
            while True:
                self._blocks.get_nowait()

    def _pump(self) -> Generator[None, bytes, None]:
        """Runs in the audio thread, which must never wait."""
        while True:
            raw = bytes((yield))
            at = self._now()
            while True:
                try:
                    self._blocks.put_nowait((raw, at))
                    break
                except queue.Full:
                    self.dropped += 1
                    with contextlib.suppress(queue.Empty):
                        self._blocks.get_nowait()


def audio_library() -> Any:
    """The module miniaudio; `VoiceTrouble` where it cannot be had."""
    try:
        import miniaudio
    except (ImportError, OSError) as problem:
        raise VoiceTrouble(
            tr("Without the package miniaudio no microphone can be heard: {problem}.").format(problem=problem)
        ) from problem
    return miniaudio


def _nothing_there(audio: Any) -> bool:
    """No device but those that only make silence: ALSA names one where it has no other."""
    try:
        return all(
            str(one.get("name", "")).startswith(SILENT_DEVICES) for one in audio.Devices().get_captures()
        )
    except audio.MiniaudioError:
        return True
