"""The fallback recogniser, on a synthesised voice."""

import pytest

from app.inputs.voice.interfaces.speech_recognizer import Grammar, VoiceTrouble
from app.inputs.voice.recognition.lexicon import COMMANDS
from tests.lacking import package

package("pocketsphinx")
hibari = package("hibari")

from app.inputs.voice.audio.sound_files import resampled  # noqa: E402
from app.inputs.voice.recognition.sphinx import Sphinx  # noqa: E402


@pytest.fixture(scope="module")
def said():
    voice = hibari.Hibari()
    return lambda text: resampled(voice(text, seed=1), 24000)


@pytest.fixture(scope="module")
def judge():
    return Sphinx(Grammar(COMMANDS))


@pytest.mark.parametrize(("phrase", "command"), [("stop", "stop"), ("go home", "go_home")])
def test_it_understands_a_clear_voice(judge, said, phrase, command):
    found = judge.judge(said(phrase), frozenset(COMMANDS))
    assert (found.command, found.accepted) == (command, True)


def test_a_word_that_it_does_not_know_is_said():
    with pytest.raises(VoiceTrouble, match="does not know the word 'zzyzx'"):
        Sphinx(Grammar({"stop": ("zzyzx",)}))
