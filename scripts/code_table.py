"""The table of codes in docs/bridge.md, written from bridge/core/codes.py."""

from __future__ import annotations

from pathlib import Path

from bridge.core.codes import Code
from bridge.core.units import UNITS, quantity_of

__all__ = ["DOCUMENT", "with_table"]

DOCUMENT = Path(__file__).parents[1] / "docs" / "bridge.md"
BEGIN, END = "<!-- codes: written by scripts/code_table.py -->", "<!-- end of codes -->"


def table() -> str:
    """The table in Markdown."""
    lines = ["| code | meaning | parameters |", "|---|---|---|"]
    for code in Code:
        names = ", ".join(_parameter(code, name) for name in code.parameters)
        lines.append(f"| `{code.value}` | {code.meaning} | {names} |")
    return "\n".join(lines)


def _parameter(code: Code, name: str) -> str:
    """Its name, and its unit where it is a quantity."""
    kind = quantity_of(code, name, {})
    return f"`{name}` [{UNITS[kind]}]" if kind else f"`{name}`"


def with_table(text: str) -> str:
    """`text` with what stands between the two marks replaced; ValueError when a mark is missing."""
    head, _, rest = text.partition(BEGIN)
    _, mark, tail = rest.partition(END)
    if not mark:
        raise ValueError(f"The document needs the marks {BEGIN} and {END} round the table.")
    return f"{head}{BEGIN}\n\n{table()}\n\n{END}{tail}"


if __name__ == "__main__":
    DOCUMENT.write_text(with_table(DOCUMENT.read_text()))
