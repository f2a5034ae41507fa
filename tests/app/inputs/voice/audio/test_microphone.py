"""A microphone that is there, is missing, is refused, is pulled out."""

import types

import pytest

from app.inputs.voice.audio.microphone import MAX_QUEUE, SILENCE_TIMEOUT, Microphone
from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble


class MiniaudioError(Exception):
    pass


class Device:
    """A capture device of miniaudio."""

    backend, refuses = "ALSA", False

    def __init__(self, **settings):
        if self.refuses:
            raise MiniaudioError("failed to init device")
        self.settings, self.closed = settings, False

    def start(self, pump):
        self.pump = pump

    def close(self):
        self.closed = True


def audio(*, captures=({"name": "mic"},), **kind):
    made = []

    class Made(Device):
        def __init__(self, **settings):
            super().__init__(**settings)
            made.append(self)

    for name, value in kind.items():
        setattr(Made, name, value)
    devices = lambda: types.SimpleNamespace(get_captures=lambda: list(captures))  # noqa: E731
    formats = types.SimpleNamespace(SIGNED16=2)
    return types.SimpleNamespace(
        CaptureDevice=Made, MiniaudioError=MiniaudioError, Devices=devices, SampleFormat=formats, made=made
    )


class Clock:
    now = 100.0

    def __call__(self):
        return self.now


def test_what_it_hears_comes_as_numbers_with_their_time():
    sound, clock = audio(), Clock()
    microphone = Microphone(clock, audio=sound)
    microphone.start()
    sound.made[0].pump.send(b"\x00\x40\x00\xc0")
    samples, at = microphone.read(1.0)
    assert (samples.tolist(), at) == ([0.5, -0.5], 100.0)
    assert sound.made[0].settings["sample_rate"] == 16000


def test_it_is_closed_when_nobody_listens_and_forgets_what_it_heard():
    sound = audio()
    microphone = Microphone(audio=sound)
    microphone.start()
    sound.made[0].pump.send(b"\x00\x40")
    microphone.stop()
    microphone.stop()
    assert sound.made[0].closed
    assert microphone.read(0.0) is None


def test_none_is_said():
    with pytest.raises(VoiceTrouble, match="There is no microphone"):
        Microphone(audio=audio(captures=(), refuses=True)).start()


def test_miniaudios_own_silence_is_no_microphone():
    sound = audio(backend="Null")
    with pytest.raises(VoiceTrouble, match="There is no microphone"):
        Microphone(audio=sound).start()
    assert sound.made[0].closed


def test_one_that_is_refused_is_said():
    with pytest.raises(
        VoiceTrouble, match=r"cannot be opened: failed to init device\. Another program may hold it"
    ):
        Microphone(audio=audio(refuses=True)).start()


def test_one_that_is_pulled_out_is_said_and_closed():
    sound, clock = audio(), Clock()
    microphone = Microphone(clock, audio=sound)
    microphone.start()
    assert microphone.read(0.0) is None
    clock.now += SILENCE_TIMEOUT + 0.1
    with pytest.raises(VoiceTrouble, match="gives nothing any more"):
        microphone.read(0.0)
    assert sound.made[0].closed


def test_what_nobody_has_time_for_is_dropped_the_oldest_first_and_told(caplog):
    sound = audio()
    microphone = Microphone(audio=sound)
    microphone.start()
    for number in range(MAX_QUEUE + 3):
        sound.made[0].pump.send(bytes((number, 0)))
    assert microphone.dropped == 3
    assert microphone.read(0.0)[0][0] == pytest.approx(3 / 32768)
    microphone.stop()
    assert "3 blocks of sound were lost" in caplog.text


def test_where_the_system_has_only_a_device_of_silence_there_is_no_microphone():
    silence = {"name": "Discard all samples (playback) or generate zero samples (capture)"}
    ears = Microphone(audio=audio(captures=(silence,), refuses=True))
    with pytest.raises(VoiceTrouble, match="There is no microphone"):
        ears.start()
