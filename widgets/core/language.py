"""The language of the glass: sentences from gettext catalogues, plurals, and figures as the language writes them.

`tr("Start")` gives the words of the chosen language where they are needed; `mark("Start")` says of a constant that it is
translated where it is shown. `scripts/languages.py` finds both in the sources. English is what stands in the sources, so
that it needs no catalogue, and what a catalogue lacks stays English.

    label.text = tr("{age} s old").format(age=3)
    label.text = trn("{count} robot", "{count} robots", count)
"""

from __future__ import annotations

import gettext
import logging
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Self

__all__ = [
    "FOLDER",
    "LANGUAGES",
    "PSEUDO",
    "VARIABLE",
    "Language",
    "Tongue",
    "brief_figure",
    "figure",
    "language",
    "mark",
    "tr",
    "trn",
    "within",
]

log = logging.getLogger(__name__)

FOLDER = Path(__file__).parents[1] / "languages"
"""One `NAME.mo` for each language but English, made of `scripts/catalogues/NAME.po`."""
VARIABLE = "PILOTHOUSE_LANGUAGE"
"""Environment variable by which a process of the app is told the language."""
PSEUDO = "en_XA"
"""No language of people: English with accents, 40 % longer and in brackets, by which one sees what is not translated or cut."""
DASH = "—"
"""What is shown in the place of a figure that there is not."""
LONGER = 0.4
"""How much longer a pseudo-translation is than its English."""


@dataclass(frozen=True)
class Tongue:
    """What is particular about a language."""

    own_name: str
    """What those who speak it call it."""
    point: str = "."
    """Between the whole of a figure and its decimals."""
    font: str = "B612"
    """The typeface that has its letters."""


LANGUAGES: dict[str, Tongue] = {
    "en": Tongue("English"),
    "fr": Tongue("français", ","),
    "de": Tongue("Deutsch", ","),
    "es": Tongue("español", ","),
    "zh_CN": Tongue("简体中文", ".", "Noto Sans SC"),
    PSEUDO: Tongue("[!! Pseudo !!]", ","),
}
"""Name of each, as in POSIX, in the order in which it is offered; `PSEUDO` is for the makers of the app."""
_ACCENTS = str.maketrans("AaCcEeIiNnOoSsUuYy", "ÅåÇçÈèÍíÑñÖöŠšÛûÝý")
_KEPT = re.compile(r"(\{[^}]*\}|\[/?[a-z]+(?:=[^\]]*)?\])")
"""Places for values and marks of type, which no translation changes."""


class Language:
    """The language that is chosen; what is on the glass already follows when it is made anew.

    It needs nothing of Kivy, so that a process without a window can speak too.
    """

    def __init__(self) -> None:
        self._name = "en"
        self._words = gettext.NullTranslations()
        self._on_change: list[Callable[[], object]] = []

    @property
    def name(self) -> str:
        """One of `LANGUAGES`; ValueError where it is set to another."""
        return self._name

    @name.setter
    def name(self, name: str) -> None:
        if name not in LANGUAGES:
            raise ValueError(f"A language is one of {', '.join(LANGUAGES)}, not {name!r}.")
        if name != self._name:
            self._name, self._words = name, _catalogue(name)
            for follow in self._on_change:
                follow()

    def follow(self, on_change: Callable[[], object]) -> None:
        """Call `on_change` whenever another language was chosen, for as long as this process lives."""
        self._on_change.append(on_change)

    @property
    def tongue(self) -> Tongue:
        """What is particular about it."""
        return LANGUAGES[self.name]

    def words(self, text: str, context: str = "") -> str:
        """`text` in this language; `context` tells two meanings of one English word apart. English where it is not translated."""
        if not text:
            return ""  # of which gettext would give the head of the catalogue
        if self.name == PSEUDO:
            return _pseudo(text)
        return self._words.pgettext(context, text) if context else self._words.gettext(text)

    def counted(self, one: str, many: str, count: int) -> str:
        """The form of `one` or `many` that goes with `count`, which is written at `{count}`."""
        if self.name == PSEUDO:
            text = _pseudo(one if count == 1 else many)
        else:
            text = self._words.ngettext(one, many, count)
        return text.replace("{count}", f"{count:d}")


def _catalogue(name: str) -> gettext.NullTranslations:
    """The catalogue of a language; an empty one for English, and where there is none yet, or a damaged one."""
    try:
        with (FOLDER / f"{name}.mo").open("rb") as file:
            return gettext.GNUTranslations(file)
    except FileNotFoundError:
        pass
    except Exception:  # gettext raises what it likes at a damaged file; an app in English is better than none
        log.exception("the catalogue of %s cannot be read", name)
    return gettext.NullTranslations()


def _pseudo(text: str) -> str:
    """A sentence that is seen to be translated: accents, brackets, and as much longer as German and French may be."""
    parts = _KEPT.split(text)
    dressed = "".join(part if at % 2 else part.translate(_ACCENTS) for at, part in enumerate(parts))
    letters = sum(len(part) for part in parts[::2])
    return f"[{dressed}{'~' * math.ceil(LONGER * letters)}]" if letters else text


language = Language()
"""The one language of this process."""


class _InContext(str):
    """A marked word that has two meanings in English, and which of them is meant."""

    __slots__ = ("context",)

    context: str

    def __new__(cls, text: str, context: str = "") -> Self:
        """`text` with its context."""
        made = super().__new__(cls, text)
        made.context = context
        return made


def tr(text: str, context: str = "") -> str:
    """`text`, a sentence or word in English, in the language of the glass; `context` tells two meanings of one word apart.

    What `mark` was given a context for has its own.
    """
    return str(language.words(text, context or getattr(text, "context", "")))


def trn(one: str, many: str, count: int) -> str:
    """What is said of `count` things, which is written at `{count}`: `one` or `many`, or as many forms as the language has."""
    return language.counted(one, many, count)


def mark(text: str, context: str = "") -> str:
    """`text` as it is: a constant that `tr` translates where it is shown, for which the catalogues are told of it here.

    `context` is for a word of two meanings, `mark("Home", "place")` and `mark("Home", "key")`; `tr` finds it by itself
    in the object that this returns, which is equal to `text`.
    """
    return _InContext(text, context) if context else text


def within(text: str) -> str:
    """`text`, words in the language of the glass, as they stand within a sentence.

    English begins them small, `start patrol`, but for what is written in capitals; other languages keep what the catalogue
    says: German has a capital for every noun.
    """
    small = language.name == "en" and not text[1:2].isupper()
    return text[:1].lower() + text[1:] if small else text


def figure(value: float, digits: int = 0, *, signed: bool = False) -> str:
    """`value` with so many decimals as the language writes it, with a true minus, `signed` with a plus too; a dash for NaN and infinity."""
    if not math.isfinite(value):
        return DASH
    text = f"{value:+.{digits}f}" if signed else f"{value:.{digits}f}"
    if float(text) == 0.0:
        text = text.lstrip("+-")
    return text.replace("-", "−").replace(".", language.tongue.point)


def brief_figure(value: float) -> str:
    """`value` as the language writes it, with as many decimals as it has, as in `0.25` or `5`; a dash for NaN and infinity."""
    if not math.isfinite(value):
        return DASH
    return f"{value:g}".replace("-", "−").replace(".", language.tongue.point)
