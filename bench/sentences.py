"""What the app makes of sentences in operators' own words, taken as text: as if a recogniser had written every word down rightly.

`bench/support/sentences.txt` has them and says where they are from. A sentence is understood if its command would be submitted; asked
again if the app says that there was more in it, or that no question is open; refused if it is taken for no command; wrong if
another command would be submitted, or any for a sentence that means nothing. It moves the robot where the command can.
The peer is what was there before: the command whose sounds are nearest.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TypeAlias

from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.matching import Match, interpret, match
from app.inputs.voice.recognition.phrases import PHRASES
from app.inputs.voice.recognition.sentences import Meaning
from bench.support.figures import Figure
from bench.support.harness import Context, Sides

PEER = "the nearest sounds"
FIGURES = (
    Figure("understood", "", "of sentences that mean a command", 0.85, "more", PEER),
    Figure("asked_again", "", "of them: the app asks for other words", against=PEER),
    Figure("refused", "", "of them: taken for no command", against=PEER),
    Figure("wrong", "", "of all sentences: another command, or one where none was meant", against=PEER),
    Figure(
        "wrong_moving",
        "",
        "of all sentences: a command that moves the robot and was not meant",
        0,
        against=PEER,
    ),
)
REPEATS = 1
SENTENCES = Path(__file__).with_name("support") / "sentences.txt"
NOTHING = "-"
MOVES = frozenset(
    {"start", "patrol", "go_home", "resume", "surface", "take_off", "land", "faster", "hold", "dock", "go_to"}
)
"""Commands after which a robot may move that stood, or move otherwise."""
Understands: TypeAlias = Callable[[Sequence[str], Grammar], "list[Match] | Meaning"]


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """Nothing to make ready."""
    del context
    yield Sides(lambda: shares(interpret), lambda: shares(match))


def sentences() -> list[tuple[str, str]]:
    """Each intent that is meant, with the words."""
    lines = SENTENCES.read_text(encoding="utf-8").splitlines()
    pairs = (line.split("\t") for line in lines if line and not line.startswith("#"))
    return [(intent, words) for intent, words in pairs]


def shares(understands: Understands) -> dict[str, float]:
    """Every figure."""
    counted = Counter[str]()
    said = sentences()
    for intent, words in said:
        outcome, command = judge(understands, words)
        if outcome == "command" and command != intent:
            counted["wrong"] += 1
            counted["wrong_moving"] += command.partition(":")[0] in MOVES
        elif intent != NOTHING:
            counted["understood" if outcome == "command" else outcome] += 1
    meant = sum(intent != NOTHING for intent, _ in said)
    parts = {name: counted[name] / meant for name in ("understood", "asked_again", "refused")}
    return parts | {name: counted[name] / len(said) for name in ("wrong", "wrong_moving")}


def judge(understands: Understands, words: str) -> tuple[str, str]:
    """`command` with its intent, `asked_again` or `refused`; no question is open."""
    grammar = Grammar(PHRASES["en"])
    found = understands([words], grammar)
    if isinstance(found, Meaning):
        return ("refused" if found.negated else "asked_again"), ""
    if not found:
        return "refused", ""
    return ("asked_again", "") if found[0].command in grammar.asked else ("command", found[0].command)
