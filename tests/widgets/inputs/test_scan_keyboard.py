"""The keyboard for switches: frequent letters near its beginning, likely words, and what is typed is told."""

from __future__ import annotations

import pytest

from tests.headless import Stage
from widgets.inputs.scan_keyboard import ScanKeyboard
from widgets.inputs.scan_keys import completed, guesses, laid_out, steps

ALPHABET = ["abcdef", "ghijkl", "mnopqr", "stuvwx", "yz 012", "345678", "9"]


@pytest.mark.parametrize("kind", ["text", "url", "number", "tel"])
def test_every_letter_has_one_key(kind: str) -> None:
    rows = laid_out(kind)
    letters = "".join(rows)
    assert len(set(letters)) == len(letters)
    assert all(digit in letters for digit in "0123456789")
    assert max(map(len, rows)) <= 6


def test_english_takes_fewer_steps_than_by_the_alphabet() -> None:
    text = "bring the parcel to the office on the second floor"
    assert steps(laid_out("text"), text) < 0.8 * steps(ALPHABET, text)


def test_an_address_begins_with_its_digits() -> None:
    rows = laid_out("url")
    assert steps(rows, "192.168.1.7:9090") < steps(laid_out("text"), "192.168.1.7:9090")
    assert rows[0][0] == "1"


def test_words_are_offered_by_how_they_begin() -> None:
    known = ["Office 12", "Lab", "Office 9"]
    assert guesses("", known) == known
    assert guesses("of", known) == ["Office 12", "Office 9"]
    assert guesses("to the la", known) == ["Lab"]
    assert guesses("Lab", known) == [], "what is there already is not offered"
    assert completed("to the la", "Lab") == "to the Lab"


def test_what_is_typed_is_told_and_a_capital_is_for_one_letter(stage: Stage) -> None:
    typed: list[str] = []
    keyboard = stage.show(ScanKeyboard(title="Search", words=["Lab"]), (392, 500))
    keyboard.bind(on_type=lambda _, text: typed.append(text))
    for name in ("capital", "lettera", "letterb", "delete", "clear"):
        keyboard.dispatch("on_key", name)
    assert typed == ["A", "Ab", "A", ""]
    assert keyboard.keys["delete"].disabled, "there is nothing to delete"


def test_its_keys_stay_the_same_things_while_it_is_typed_on(stage: Stage) -> None:
    keyboard = stage.show(ScanKeyboard(title="Search"), (392, 500))
    before = keyboard.keys["lettere"]
    keyboard.dispatch("on_key", "lettere")
    assert keyboard.keys["lettere"] is before
