"""What is said for training: the word where it counts, and nowhere else."""

from __future__ import annotations

from pathlib import Path

from scripts.stop_word.phrases import LIKE_STOP, NEIGHBOURS, phrases, prose


def test_no_neighbour_of_the_word_has_it() -> None:
    lines = NEIGHBOURS.read_text(encoding="utf-8").splitlines()
    assert len(set(lines)) == len(lines) > 200
    assert [line for line in lines if LIKE_STOP.search(line) or line != line.strip()] == []


def test_the_word_is_in_what_is_called_so_alone() -> None:
    said = list(phrases(["We came back from the garden."]))
    assert {phrase.kind for phrase in said} == {"prose", "near", "alone", "amid"}
    assert all("stop" in phrase.text.lower() for phrase in said if phrase.kind in ("alone", "amid"))
    assert not any("stop" in phrase.text.lower() for phrase in said if phrase.kind in ("prose", "near"))


def test_a_book_gives_its_sentences_of_words_without_the_word(tmp_path: Path) -> None:
    book = tmp_path / "book.txt"
    book.write_text(
        "The door was open when\nwe came. Yes. It stopped raining at the end of the day. He paid 12 of them at noon. Was she there, too?",
        encoding="utf-8",
    )
    assert prose(book) == ["The door was open when we came.", "Was she there, too?"]
