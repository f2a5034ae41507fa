"""What an English sentence means: from words that a recogniser wrote down to an intent, or to none.

understood = understand("could you go home please")   # Meaning("go_home", "go home")
understood = understand("don't go home")              # Meaning("go_home", "go home", negated=True)
understood = understand("go home Dave, you are tired")  # Meaning("go_home", "go home", partly=True)
understood = understand("what time is lunch")         # None

A sentence counts only as a whole: what says nothing (politeness, "robot", "now") may stand before and after, and every other
word must be of the grammar. So no word of a longer sentence is taken for a shorter command that means something else. STOP alone is
found amid anything, because a false one costs little.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from functools import lru_cache

__all__ = ["MAX_WORDS", "SENTENCES", "STOPS", "Meaning", "denies", "understand"]

ANSWERS = ("yes", "no")
"""These are said alone: amid other words they mean something else."""
MAX_WORDS = 24
"""A longer sentence is talk: only STOP is looked for in it."""
STOPS = ("stop", "halt", "freeze", "abort")
"""Each of these is STOP wherever it is said, and in front of it no "don't" counts."""

SENTENCES: dict[str, tuple[str, ...]] = {
    "stop": ("do not move", "stand still", "emergency"),
    "pause": (
        "pause [TASK]",
        "(wait|hold on) [there|here]",
        "hold it [there|here]",
        "take a break",
        "(suspend|interrupt) TASK",
    ),
    "resume": (
        "(resume|continue|restart) [TASK]",
        "(carry|go|move) on [with TASK]",
        "keep (going|on|moving) [with TASK]",
        "(proceed|unpause) [with TASK]",
        "(pick up|continue|resume|carry on|go on) where you (left off|were)",
    ),
    "start": ("(start|begin) [THE (task|job|mission)]", "go", "get (going|started)"),
    "patrol": (
        "[go on|do|make|run|start|begin|launch|commence] [THE] (patrol|patrolling|patrol round|round|rounds)",
        "go (patrolling|and patrol)",
    ),
    "go_home": (
        "(go|come|get|head|drive|fly|return|move) [back] (home|to HOME|to the start)",
        "back to the start",
        "come back [here|to me]",
        "return [to HOME]",
        "(go|head) back to HOME",
    ),
    "end_task": (
        "(cancel|end|drop|terminate|quit|give up|finish) TASK",
        "call (it|TASK) off",
        "call off TASK",
    ),
    "hold": ("hold [THE] [position]", "(stay|remain|hold) (there|here|still|put|where you are)", "stay"),
    "surface": ("surface", "(come|go|swim) (up|back up|up to THE surface|to THE surface)"),
    "take_off": ("(take|lift) off", "(start|begin) flying", "launch", "fly up"),
    "land": ("(land|touch down) [here|there]", "(come|go) down and land", "set down"),
    "faster": (
        "[go|drive|move|fly|swim|be] [LITTLE] (faster|quicker)",
        "(speed up|hurry up|hurry|accelerate) [LITTLE]",
        "increase [THE] speed [LITTLE]",
        "[drive|go|move] more quickly",
    ),
    "slower": (
        "[go|drive|move|fly|swim|be] [LITTLE] (slower|slowly|more slowly)",
        "slow (down|it down) [LITTLE]",
        "(reduce|decrease|lower) [THE] speed [LITTLE]",
        "not so (fast|quick)",
        "[you are] [going] too fast",
    ),
    "lights": ("(toggle|switch|change) [THE] LIGHTS", "LIGHTS"),
    "lights_on": ("LIGHTS on", "(turn|switch|put) on [THE] LIGHTS", "(turn|switch|put) [THE] LIGHTS on"),
    "lights_off": ("LIGHTS (off|out)", "(turn|switch) off [THE] LIGHTS", "(turn|switch) [THE] LIGHTS off"),
    "dock": (
        "dock",
        "(go|drive|move|head|return|come|fly) [back] to THE DOCK",
        "(go|go and|go to) (charge|recharge|dock)",
        "(recharge|charge|dock) [yourself]",
    ),
    "tell_battery": (
        "[THE] battery [status|level|charge]",
        "how much (battery|charge|power|energy) (is left|do you have [left]|have you got [left]|is there)",
        "(how is|what is|tell me|give me|say|report|check) THE battery [status|level|charge]",
        "is THE battery (low|full|empty|ok|charged)",
    ),
    "tell_task": (
        "(what are you|what is the robot) doing",
        "[(what is|give me|tell me) THE] status [report]",
        "what is (happening|going on)",
        "report [status]",
        "how are you doing",
    ),
    "snapshot": (
        "(take|snap|get|get me|capture|shoot|save|make|grab|keep) [THE] (photo|picture|snapshot|image|photograph) [of (this|that|it)]",
        "(photo|picture|snapshot)",
    ),
    "record": (
        "(record|start recording|begin recording|film) [this|that|it|THE video|video]",
        "(start|begin) [THE] recording",
        "(end|finish) [THE] recording",
    ),
    "camera": (
        "[switch|change|show|show me|use|select|go] [to] [THE] (next|other|another) (camera|view)",
        "(switch|change) [THE] (camera|cameras|view)",
        "camera",
    ),
    "take_control": (
        "(take|request|assume|get|want|give me) [THE] control",
        "take over [THE] [control]",
        "i (want|would like|need) [to (take|have)] [THE] control",
        "i (will take|take) ([THE] control|over)",
        "(let me|i want to|i would like to|i will) (drive|steer|take over|take control|have control)",
        "(can|could|may) i (have|take|get) [THE] control",
        "manual [control]",
    ),
    "yes": (
        "(yes|yeah|yep|confirm|confirmed|affirmative|correct|do it|go ahead)",
        "yes (do it|go ahead|confirm)",
    ),
    "no": ("(no|nope|cancel|negative|never mind|forget it|cancel that|cancel it)", "no (cancel|never mind)"),
}
"""What may be said for each intent: `[x]` may be left out, `(x|y)` is one of them, a word in capitals is one of `PARTS`."""

PARTS = {
    "THE": "the|a|an|your|my|this|that|our|one|full",
    "LITTLE": "a little|a bit|slightly|much|even|a little bit|a little more|a bit more|some more",
    "TASK": "[THE] [current|running] (task|job|mission|patrol|round|tour|delivery|run)",
    "HOME": "[THE] (home|base|home base|home position|home point|starting point|start position)",
    "DOCK": "(dock|docking station|charger|charging station|charging dock|charging point)",
    "LIGHTS": "(light|lights|headlight|headlights|lamp|lamps)",
}
"""Parts of sentences."""
BEFORE = (
    "please|okay|ok|alright|all right|right|hey|hello|robot|now|just|then|so|kindly|well",
    "(can|could|would|will) you",
    "you (can|could|may|should|must)",
    "i (want|need|would like) you to",
    "let us|go and|go ahead and|it is time to|time to",
)
"""What says nothing in front of a command, however often."""
AFTER = (
    "please|now|robot|again|then|thanks|thank you|okay|ok|will you|would you|could you",
    "(right|straight) (now|away)|immediately|at once|for now|at the moment|today",
    "for (a|one) (moment|second|minute|bit|while|sec)|(a|one) (moment|second|minute|sec)|for me",
    "(LITTLE)",
)
"""What says nothing after it."""
NOT = (
    "do not|never|not|no|must not|should not|can not|will not|would not|could not|need not|may not|is not|are not|without",
    "no need to|instead of|rather than|anything but|anywhere but|stop short of|refrain from|avoid",
)
"""In a sentence with one of these nothing is commanded but what has it as one of its own words."""
SHORT = {
    "don't": "do not", "dont": "do not", "won't": "will not", "can't": "can not", "cannot": "can not", "i'm": "i am",
    "i'd": "i would", "i'll": "i will", "let's": "let us", "lets": "let us", "you're": "you are", "it's": "it is", "what's": "what is", "how's": "how is",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Meaning:
    """What was meant; a command only where it is neither `negated` nor `partly`."""

    command: str
    """The intent's name."""
    phrase: str
    """Its words, without those that say nothing."""
    negated: bool = False
    """It was said that this shall not be done."""
    partly: bool = False
    """The sentence has this command in it, and words beside it that the grammar does not know."""

    @property
    def counts(self) -> bool:
        """It may be done."""
        return not (self.negated or self.partly)


def understand(sentence: str) -> Meaning | None:
    """What `sentence` means; None where no command is in it."""
    words = _plain(sentence)
    if stop := next((word for word in words.split() if word in STOPS), ""):
        return Meaning("stop", stop)
    if not 0 < len(words.split()) <= MAX_WORDS:
        return None
    if found := _whole(words):
        return found
    within = _within(words)
    if within is None:
        return None
    denied = denies(sentence)
    return Meaning(within.command, within.phrase, negated=denied, partly=not denied)


def denies(sentence: str) -> bool:
    """There is a "not" in it, or another word that turns a command round."""
    return _pattern("|".join(NOT)).search(f" {_plain(sentence)} ") is not None


def _whole(words: str) -> Meaning | None:
    """The command that the words are, with nothing but empty words around it."""
    for command, pattern in _commands().items():
        if found := pattern.fullmatch(f" {words} "):
            return Meaning(command, found["core"].strip())
    return None


def _within(words: str) -> Meaning | None:
    """The longest command that is said word by word in the words."""
    split = words.split()
    for length in range(len(split), 0, -1):
        for start in range(len(split) - length + 1):
            found = _whole(" ".join(split[start : start + length]))
            if found is not None and found.command not in ANSWERS:
                return found
    return None


@lru_cache(maxsize=1)
def _commands() -> dict[str, re.Pattern[str]]:
    before, after = (_expression("|".join(part)) for part in (BEFORE, AFTER))
    return {
        command: re.compile(f" (?:{before})*(?P<core>{_expression('|'.join(sentences))})(?:{after})*")
        for command, sentences in SENTENCES.items()
    }


@lru_cache(maxsize=8)
def _pattern(grammar: str) -> re.Pattern[str]:
    return re.compile(f" (?:{_expression(grammar)})")


def _expression(grammar: str) -> str:
    """The grammar as a regular expression over words with a space after each."""
    signs = {"[": "(?:", "]": ")?", "(": "(?:", ")": ")", "|": "|"}
    pieces = re.findall(r"[\[\]()|]|[^\s\[\]()|]+", grammar)
    return "".join(
        signs.get(piece) or (f"(?:{_expression(PARTS[piece])})" if piece in PARTS else f"{re.escape(piece)} ")
        for piece in pieces
    )


def _plain(sentence: str) -> str:
    """Words in lower case, in full, without signs."""
    spelled = unicodedata.normalize("NFKD", sentence.casefold().replace("’", "'"))
    letters = "".join(one if one.isalnum() or one == "'" else " " for one in spelled)
    return " ".join(SHORT.get(word, re.sub(r"n't$", " not", word)) for word in letters.split())
