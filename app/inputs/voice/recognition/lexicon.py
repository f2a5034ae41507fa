"""Phrases for each intent, and how it sounds: pronunciations in IPA, written for this app's own vocabulary.

`COMMANDS` is what English speakers may say; `pronunciations("go home")` its sounds, one tuple for each way to say it. What
people say who give no command is in `background.txt`: common words and neighbours of our own, against which each command must win.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import product
from pathlib import Path

from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble

__all__ = ["COMMANDS", "PHONES", "WORDS", "background", "pronunciations", "spell"]

COMMANDS: dict[str, tuple[str, ...]] = {
    "stop": ("stop", "emergency stop"),
    "pause": ("pause",),
    "resume": ("resume", "continue"),
    "start": ("start", "start task", "go"),
    "patrol": ("patrol", "start patrol"),
    "go_home": ("go home", "return home"),
    "end_task": ("end task",),
    "hold": ("hold", "hold position"),
    "surface": ("surface",),
    "take_off": ("take off",),
    "land": ("land",),
    "faster": ("faster", "speed up"),
    "slower": ("slower", "slow down"),
    "lights": ("lights",),
    "snapshot": ("photo", "take a picture"),
    "record": ("record",),
    "camera": ("camera",),
    "take_control": ("take control",),
    "yes": ("yes", "confirm"),
    "no": ("no", "cancel"),
}
"""Phrases that differ in several sounds from each other; a phrase of two words is understood more surely than one of one."""

PHONES: dict[str, tuple[str, ...]] = {
    "ɑ": ("ɑ", "ɔ", "ɒ", "a"),
    "æ": ("æ", "a"),
    "ʌ": ("ʌ", "ə", "ɐ"),
    "ə": ("ə", "ʌ", "ɪ", "ɨ"),
    "ɔ": ("ɔ", "ɑ", "o", "ɒ"),
    "aʊ": ("aʊ",),
    "aɪ": ("aɪ",),
    "ɛ": ("ɛ", "e"),
    "ɝ": ("ɝ", "ɚ", "ɜ"),
    "eɪ": ("eɪ", "e"),
    "ɪ": ("ɪ", "ɨ", "i"),
    "i": ("i", "ɪ"),
    "oʊ": ("oʊ", "o"),
    "ɔɪ": ("ɔɪ",),
    "ʊ": ("ʊ", "ɯ"),
    "u": ("u", "ʉ"),
    "b": ("b",),
    "d": ("d", "ɾ"),
    "ð": ("ð",),
    "f": ("f",),
    "ɡ": ("ɡ", "g"),
    "h": ("h",),
    "j": ("j", "ʝ", "ɟ"),
    "k": ("k", "kʰ"),
    "l": ("l", "ɫ"),
    "m": ("m",),
    "n": ("n",),
    "ŋ": ("ŋ",),
    "p": ("p", "pʰ"),
    "ɹ": ("ɹ", "r", "ɾ"),
    "s": ("s",),
    "ʃ": ("ʃ",),
    "t": ("t", "tʰ", "ɾ"),
    "t͡ʃ": ("t͡ʃ", "t͡ɕ"),
    "d͡ʒ": ("d͡ʒ",),
    "θ": ("θ",),
    "v": ("v",),
    "w": ("w",),
    "z": ("z",),
    "ʒ": ("ʒ",),
    "ɟ": ("ɟ",),
    "͡": ("͡",),
    "ʝ": ("ʝ",),
}
"""Each sound of English with the signs that the model may write for it: accents differ in the vowels. The last three are
how it writes the first sound of "yes"."""

WORDS: dict[str, tuple[str, ...]] = {
    "a": ("ə",),
    "camera": ("k æ m ɹ ə", "k æ m ə ɹ ə"),
    "cancel": ("k æ n s ə l",),
    "confirm": ("k ə n f ɝ m",),
    "continue": ("k ə n t ɪ n j u",),
    "control": ("k ə n t ɹ oʊ l",),
    "down": ("d aʊ n",),
    "emergency": ("ɪ m ɝ d͡ʒ ə n s i",),
    "end": ("ɛ n d",),
    "faster": ("f æ s t ɝ", "f ɑ s t ə"),
    "go": ("ɡ oʊ",),
    "hold": ("h oʊ l d", "h oʊ d", "h oʊ l", "h ɔ l d"),
    "home": ("h oʊ m",),
    "land": ("l æ n d",),
    "lights": ("l aɪ t s",),
    "no": ("n oʊ",),
    "off": ("ɔ f",),
    "patrol": ("p ə t ɹ oʊ l", "p æ t ɹ ɔ l"),
    "pause": ("p ɔ z",),
    "photo": ("f oʊ t oʊ",),
    "picture": ("p ɪ k t͡ʃ ɝ", "p ɪ k t͡ʃ ə"),
    "position": ("p ə z ɪ ʃ ə n",),
    "record": ("ɹ ɪ k ɔ ɹ d", "ɹ ɛ k ɝ d", "ɹ ɪ k ɔ d"),
    "resume": ("ɹ ɪ z u m", "ɹ ɪ z j u m"),
    "return": ("ɹ i t ɝ n",),
    "slow": ("s l oʊ",),
    "slower": ("s l oʊ ɝ", "s l oʊ ə"),
    "speed": ("s p i d",),
    "start": ("s t ɑ ɹ t", "s t ɑ t"),
    "stop": ("s t ɑ p", "s t ʌ p"),
    "surface": ("s ɝ f ə s",),
    "take": ("t eɪ k",),
    "task": ("t æ s k", "t ɑ s k"),
    "up": ("ʌ p",),
    "yes": ("j ɛ s", "j æ s", "j ɪ s", "ɟ ͡ ʝ ɛ s"),
}
"""Every word of `COMMANDS` in American and, where it differs by more than a vowel's shade, British English."""

Sounds = tuple[str, ...]


def spell(ipa: str) -> Sounds:
    """The sounds of IPA with spaces between them; `VoiceTrouble` for one that is not in `PHONES`."""
    sounds = tuple(ipa.split())
    strange = [sound for sound in sounds if sound not in PHONES]
    if strange:
        raise VoiceTrouble(f"{strange[0]!r} is no sound of this grammar; there are {' '.join(PHONES)}.")
    return sounds


def pronunciations(phrase: str) -> list[Sounds]:
    """Each way to say the phrase; `VoiceTrouble` for a word that nobody has written down."""
    words = phrase.lower().split()
    unknown = [word for word in words if word not in WORDS]
    if unknown or not words:
        raise VoiceTrouble(
            f"How {(unknown or [phrase])[0]!r} sounds is not known; say it in {', '.join(WORDS)}."
        )
    ways = product(*(WORDS[word] for word in words))
    return [spell(" ".join(way)) for way in ways]


@lru_cache(maxsize=1)
def background() -> tuple[tuple[str, Sounds], ...]:
    """Common words that are no command, with their sounds."""
    lines = Path(__file__).with_name("background.txt").read_text(encoding="utf-8").splitlines()
    split = (line.split() for line in lines if line and not line.startswith("#"))
    return tuple((word, tuple(sounds)) for word, *sounds in split)
