"""The table of roles in docs/security.md, written from robotside/trust/permissions.py."""

from __future__ import annotations

from pathlib import Path

from bridge.core.identity import Role
from robotside.trust.permissions import ANY, PERMISSIONS

__all__ = ["DOCUMENT", "with_table"]

DOCUMENT = Path(__file__).parents[1] / "docs" / "security.md"
BEGIN, END = "<!-- roles: written by scripts/permission_table.py -->", "<!-- end of roles -->"


def table() -> str:
    """The table in Markdown: a line for each role and verb."""
    lines = ["| role | may | what |", "|---|---|---|"]
    for role in Role:
        verbs: dict[str, list[str]] = {}
        for operation, needed in PERMISSIONS.items():
            if needed is role:
                verb, _, name = operation.partition(" ")
                verbs.setdefault(verb, []).append(name)
        for verb, names in sorted(verbs.items()):
            lines.append(f"| {role.word} | {verb} | {', '.join(map(_shown, sorted(names)))} |")
    return "\n".join(lines)


def _shown(name: str) -> str:
    return "all others" if name == ANY else f"`{name}`"


def with_table(text: str) -> str:
    """`text` with what stands between the two marks replaced; ValueError when a mark is missing."""
    head, _, rest = text.partition(BEGIN)
    _, mark, tail = rest.partition(END)
    if not mark:
        raise ValueError(f"The document needs the marks {BEGIN} and {END} round the table.")
    return f"{head}{BEGIN}\n\n{table()}\n\n{END}{tail}"


if __name__ == "__main__":
    DOCUMENT.write_text(with_table(DOCUMENT.read_text()))
