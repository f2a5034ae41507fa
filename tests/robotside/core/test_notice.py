"""Sentences with their codes: what of them travels, and what is lost when they are joined."""

from __future__ import annotations

from bridge.codec import to_json
from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Event
from robotside.core.notice import MAX_KEY, MAX_PARAMETERS, MAX_VALUE, Notice, coded
from robotside.core.refusal import Refusal

PRESSED = Notice(Code.STOP_PRESSED, "STOP pressed by Anna.", actor_id="a1", name="Anna")


def test_a_notice_is_its_sentence() -> None:
    assert PRESSED == "STOP pressed by Anna."
    assert f"{PRESSED} Twice." == "STOP pressed by Anna. Twice."


def test_its_fields_are_plain_and_travel() -> None:
    fields = coded(PRESSED)
    assert fields == {
        "code": "stop_pressed",
        "actor_id": "a1",
        "parameters": [KeyValue("name", "Anna")],
    }
    assert type(fields["code"]) is str
    assert b'"code":"stop_pressed"' in to_json(Event(text=str(PRESSED), **fields)).replace(b" ", b"")


def test_numbers_are_short_whatever_they_are() -> None:
    late = Notice(Code.DRIVE_LATE, "Late.", age=1 / 3, allowed=float("nan"))
    assert dict(late.parameters) == {"age": "0.333333", "allowed": "nan"}


def test_a_plain_sentence_has_no_code_and_neither_has_what_is_joined() -> None:
    nothing = {"code": "", "actor_id": "", "parameters": []}
    assert coded("Somebody says so.") == coded(f"{PRESSED} Twice.") == nothing


def test_in_other_words_it_keeps_its_code() -> None:
    again = PRESSED.reworded("Somebody pressed STOP.")
    assert again == "Somebody pressed STOP."
    assert coded(again) == coded(PRESSED)


def test_what_another_program_told_keeps_the_code_that_it_gave() -> None:
    event = Event(text="It has sunk.", code="robot_sunk", parameters=[KeyValue("robot", "Minnow")])
    assert coded(Notice.of(event.text, event)) == coded(
        Notice(Code.ROBOT_SUNK, "It has sunk.", robot="Minnow")
    )
    assert coded(Notice.of("It has sunk.")) == coded("It has sunk.")


def test_a_refusal_tells_its_notice() -> None:
    refusal = Refusal(PRESSED)
    assert (str(refusal), refusal.notice.code) == ("STOP pressed by Anna.", "stop_pressed")


def test_what_clients_and_other_programs_send_is_cut_and_made_fit_to_be_shown() -> None:
    unknown = Notice(Code.SETTING_UNKNOWN, "There is no such setting.", setting="a\n\u202eb" * 900_000)
    (pair,) = coded(unknown)["parameters"]
    assert pair.value.startswith("a b")
    assert len(pair.value) <= MAX_VALUE
    many = [KeyValue(f"key {number}" * 50, "1") for number in range(1000)]
    event = Event(text="It sank.", code="x" * 900, actor_id="y" * 900, parameters=many)
    fields = coded(Notice.of(event.text, event))
    assert len(fields["parameters"]) <= MAX_PARAMETERS
    assert len(fields["code"]) == len(fields["actor_id"]) == MAX_KEY
