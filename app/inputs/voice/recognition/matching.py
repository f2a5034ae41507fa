"""Commands matched to words of a recogniser that knows no grammar, by the distance of their sounds.

found = match(["go hum", "go home"], grammar)     # the n-best list of Android's recogniser, best first
"""

from __future__ import annotations

import unicodedata
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import lru_cache

from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.lexicon import PHONES, WORDS, background
from app.inputs.voice.recognition.sentences import Meaning, denies, understand

__all__ = ["Match", "interpret", "match", "said_within", "sounds"]

MIN_LIKENESS = 0.75
"""So alike, 0 to 1, must the sounds be."""
MIN_ONE_WORD_LIKENESS = 0.9
"""The same for a phrase of one word, of which none may be another sound: `star` is no `start`, and `shop` no `stop`."""
SAME_KIND = 0.3
"""What it costs to take a sound for one that is written alike in some accent; 1 is a sound too many, too few or another."""
LATER = 0.01
"""Each place further down the list of what may have been said counts so much less."""
MAX_GUESSES = 20
"""Of the list so many are looked at."""
MAX_LETTERS = 80
"""Letters of one of them."""
PAIRS = {
    "th": "θ", "sh": "ʃ", "ch": "t͡ʃ", "ph": "f", "ck": "k", "ng": "ŋ", "ee": "i", "ea": "i", "oo": "u", "ou": "aʊ",
    "ow": "oʊ", "ay": "eɪ", "ai": "eɪ", "oa": "oʊ", "aw": "ɔ", "au": "ɔ", "er": "ɝ", "ir": "ɝ", "ur": "ɝ", "qu": "k w",
}  # fmt: skip
LETTERS = {
    "a": "æ", "b": "b", "c": "k", "d": "d", "e": "ɛ", "f": "f", "g": "ɡ", "h": "h", "i": "ɪ", "j": "d͡ʒ", "k": "k",
    "l": "l", "m": "m", "n": "n", "o": "ɑ", "p": "p", "q": "k", "r": "ɹ", "s": "s", "t": "t", "u": "ʌ", "v": "v",
    "w": "w", "x": "k s", "y": "i", "z": "z",
}  # fmt: skip
"""How an English word that nobody has written down may sound, roughly."""


@dataclass(frozen=True, slots=True)
class Match:
    """A command that may have been said."""

    command: str
    phrase: str
    alike: float
    """0 to 1, 1 sounds the same."""
    heard: str
    """What the recogniser wrote."""


def interpret(heard: Sequence[str], grammar: Grammar) -> list[Match] | Meaning:
    """Commands that were said, the likeliest first; a `Meaning` that does not count where the words forbid one or say more than one.

    English goes by the grammar of sentences first, and by its sounds only where no guess has a command in it and none denies anything.
    """
    guesses = list(heard)[:MAX_GUESSES]
    if grammar.language != "en":
        return match(guesses, grammar)
    meanings = [(place, words, understand(words)) for place, words in enumerate(guesses)]
    known = [(place, words, each) for place, words, each in meanings if each is not None]
    if not known:
        return match([words for words in guesses if not denies(words)], grammar)
    if meanings[0][2] is None and denies(guesses[0]):
        return []  # what is forbidden was not understood: a worse guess without its "not" says nothing
    first = known[0][2]
    forbidden = next((each for _, _, each in known if each.negated), None)
    if first.command not in grammar.urgent and forbidden is not None:
        return forbidden
    if not first.counts:
        return match([words for words in guesses if not denies(words)], grammar) or first
    best: dict[str, Match] = {}
    for place, words, each in known:
        if each.counts:
            best.setdefault(each.command, Match(each.command, each.phrase, 1.0 - place * LATER, words))
    return list(best.values())


def match(heard: Sequence[str], grammar: Grammar, heeded: Collection[str] | None = None) -> list[Match]:
    """Commands that one of `heard` sounds like, the likeliest first, each once; of `heeded` alone where that is given."""
    best: dict[str, Match] = {}
    for place, words in enumerate(list(heard)[:MAX_GUESSES]):
        said = sounds(words[:MAX_LETTERS], grammar.language)
        for command, phrases in grammar.phrases.items():
            if heeded is not None and command not in heeded:
                continue
            for phrase in phrases:
                wanted = sounds(phrase, grammar.language)
                alike = 1.0 - _distance(said, wanted) / max(1, len(wanted))
                enough = MIN_LIKENESS if " " in phrase else MIN_ONE_WORD_LIKENESS
                found = Match(command, phrase, alike - place * LATER, words)
                if alike >= enough and (command not in best or best[command].alike < found.alike):
                    best[command] = found
    return sorted(best.values(), key=lambda one: -one.alike)


def said_within(words: str, grammar: Grammar, command: str) -> str:
    """The phrase for `command` that is said word by word somewhere in `words`; empty for none."""
    meaning = understand(words[-MAX_LETTERS:]) if grammar.language == "en" else None
    if meaning is not None and meaning.counts and meaning.command == command:
        return meaning.phrase
    spoken = f" {' '.join(_plain(words[-MAX_LETTERS:]).split())} "
    return next((one for one in grammar.phrases.get(command, ()) if f" {_plain(one)} " in spoken), "")


def sounds(words: str, language: str = "en") -> tuple[str, ...]:
    """How the words sound: English by the dictionaries, else roughly; of other languages letters without accents."""
    plain = _plain(words)
    if language != "en":
        return tuple(plain.replace(" ", ""))
    return tuple(sound for word in plain.split() for sound in _word(word))


@lru_cache(maxsize=1)
def _known() -> dict[str, tuple[str, ...]]:
    return dict(background()) | {word: tuple(ways[0].split()) for word, ways in WORDS.items()}


@lru_cache(maxsize=2048)
def _word(word: str) -> tuple[str, ...]:
    known = _known().get(word)
    if known is not None:
        return known
    found: list[str] = []
    at, end = 0, len(word) - 1 if len(word) > 3 and word.endswith("e") else len(word)
    while at < end:
        pair = word[at : at + 2]
        if pair in PAIRS:
            found += PAIRS[pair].split()
            at += 2
        elif at and word[at] == word[at - 1]:
            at += 1
        else:
            found += LETTERS.get(word[at], "").split()
            at += 1
    return tuple(found)


def _plain(words: str) -> str:
    spelled = unicodedata.normalize("NFKD", words.casefold())
    letters = (one if one.isalnum() else " " for one in spelled if not unicodedata.combining(one))
    return " ".join("".join(letters).split())


def _distance(one: Sequence[str], other: Sequence[str]) -> float:
    """Levenshtein's, where sounds of one kind are nearer to each other."""
    row = [float(n) for n in range(len(other) + 1)]
    for n, sound in enumerate(one, 1):
        last, row[0] = row[0], float(n)
        for m, wanted in enumerate(other, 1):
            change = last + _cost(sound, wanted)
            last, row[m] = row[m], min(change, row[m] + 1, row[m - 1] + 1)
    return row[-1]


def _cost(sound: str, wanted: str) -> float:
    if sound == wanted:
        return 0.0
    return SAME_KIND if sound in PHONES.get(wanted, ()) or wanted in PHONES.get(sound, ()) else 1.0
