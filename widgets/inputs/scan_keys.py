"""Layout of the keyboard for switches: the frequent letters few steps away, and words that are likely.

A row and a key in it are stepped to: the key in row r and column c costs r + c steps and two presses.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

__all__ = ["COLUMNS", "completed", "guesses", "laid_out", "steps"]

COLUMNS = 6
LETTERS = " etaoinshrldcumwfgypbvkjxqz"
"""By how often they are in English text, the space first."""
DIGITS = "0192345678"
SIGNS = ".-:/,"
"""What names and addresses need besides."""
ADDRESS = "1.029:345678-/" + LETTERS.strip()
"""For addresses: digits and what stands between them first."""
MAX_WORDS = 3
"""Words offered at once."""


def laid_out(kind: str = "text", columns: int = COLUMNS) -> list[str]:
    """Rows of letters: the earlier in the alphabet of `kind` (`text`, `url`, `number`) the fewer steps away."""
    letters = {"url": ADDRESS, "number": DIGITS + ".-", "tel": DIGITS + "+-"}.get(
        kind, LETTERS + DIGITS + SIGNS
    )
    letters = "".join(dict.fromkeys(letters))
    count = -(-len(letters) // columns)
    cells = sorted(
        ((row, column) for row in range(count) for column in range(columns)), key=lambda at: (sum(at), at)
    )
    cells = [cell for cell in cells if cell[0] * columns + cell[1] < len(letters)]
    rows: list[dict[int, str]] = [{} for _ in range(count)]
    for letter, (row, column) in zip(letters, cells, strict=True):
        rows[row][column] = letter
    return ["".join(line[column] for column in sorted(line)) for line in rows]


def guesses(text: str, words: Iterable[str], most: int = MAX_WORDS) -> list[str]:
    """Of `words`, most wanted first, those that `text` or its last word begins; the shortest way to say each once."""
    known = list(dict.fromkeys(word.strip() for word in words if word.strip()))
    whole = [word for word in known if word.casefold().startswith(text.casefold()) and word != text]
    last = text.rpartition(" ")[2]
    later = [word for word in known if last and word.casefold().startswith(last.casefold()) and word != last]
    return list(dict.fromkeys([*whole, *later]))[:most]


def completed(text: str, word: str) -> str:
    """`text` with what `word` was offered for in its place."""
    if word.casefold().startswith(text.casefold()):
        return word
    return text[: len(text) - len(text.rpartition(" ")[2])] + word


def steps(rows: Sequence[str], text: str) -> int:
    """Steps and presses that a text takes on such rows: r + c + 2 for each letter; letters without a key cost nothing."""
    cost = {letter: row + column + 2 for row, line in enumerate(rows) for column, letter in enumerate(line)}
    return sum(cost.get(letter, 0) for letter in text.casefold())
