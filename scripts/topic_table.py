"""The table of topics in docs/bridge.md, written from bridge/core/topics.py."""

from __future__ import annotations

from pathlib import Path

from bridge.core.topics import NAMED, SERVER_TOPICS, TOPICS, Topic

ROOT = Path(__file__).parents[1]
DOCUMENTS = (ROOT / "docs" / "bridge.md",)
BEGIN, END = "<!-- topics: written by scripts/topic_table.py -->", "<!-- end of topics -->"

ALL = (
    *(entry for entry in TOPICS if entry.to == "handheld"),
    *NAMED,
    *SERVER_TOPICS,
    *(entry for entry in TOPICS if entry.to != "handheld"),
)


def when(topic: Topic) -> str:
    """How often a topic comes, in words."""
    if topic.latched:
        return "on change, latched" if topic.to == "handheld" else "on request"
    if topic.once:
        return "each once"
    return f"{topic.rate:g} Hz, on demand" if topic.on_demand else f"{topic.rate:g} Hz"


def table() -> str:
    """The table in Markdown."""
    lines = ["| topic | type | to | rate | content |", "|---|---|---|---|---|"]
    lines += [f"| `{t.name}` | {t.type.MSGTYPE} | {t.to} | {when(t)} | {t.doc} |" for t in ALL]
    return "\n".join(lines)


def with_table(text: str) -> str:
    """`text` with what stands between the two marks replaced; ValueError when a mark is missing."""
    head, _, rest = text.partition(BEGIN)
    _, mark, tail = rest.partition(END)
    if not mark:
        raise ValueError(f"A document needs the marks {BEGIN} and {END} round the table.")
    return f"{head}{BEGIN}\n\n{table()}\n\n{END}{tail}"


if __name__ == "__main__":
    for document in DOCUMENTS:
        document.write_text(with_table(document.read_text()))
