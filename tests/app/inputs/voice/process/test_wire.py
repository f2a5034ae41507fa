"""Orders and events as lines."""

import pytest

from app.inputs.voice.interfaces.speech_recognizer import Grammar, Level, Partial, Rejected, Result, State
from app.inputs.voice.process.wire import event_line, grammar_fields, read_event, read_grammar
from app.inputs.voice.recognition.lexicon import COMMANDS

GRAMMAR = Grammar(COMMANDS)


@pytest.mark.parametrize(
    "event",
    [
        Partial("sto", 0.3),
        Result("stop", "stop", 0.9, 1.0, 2.0, (("start", 0.2),), 21.0, True, {"fit": -0.1}),
        Rejected("That was no command.", "pause", 0.3, 2.0),
        Level(-30.0, -60.0, 30.0, True, False),
        State("ready", "“stop”"),
    ],
    ids=lambda event: type(event).__name__,
)
def test_what_is_told_survives_the_way(event):
    assert read_event(event_line(event)) == event


def test_a_grammar_survives_the_way():
    assert read_grammar(grammar_fields(GRAMMAR)) == GRAMMAR


@pytest.mark.parametrize("line", ["", "null", "{}", '{"event": "Nothing"}', '{"event": "State"}'])
def test_a_line_that_is_no_event_is_refused(line):
    with pytest.raises(ValueError, match="No event|Expecting"):
        read_event(line)


@pytest.mark.parametrize(
    "line",
    [
        '{"event": "State", "word": 5, "sentence": ""}',
        '{"event": "State", "word": "ready", "sentence": null}',
        '{"event": "Level", "level": "a", "noise": null, "snr": 1}',
        '{"event": "Level", "level": true, "noise": 0, "snr": 1}',
        '{"event": "Result", "command": [], "said": "", "confidence": 1, "alternatives": []}',
        '{"event": "Result", "command": "stop", "said": "", "confidence": 1, "alternatives": [["go", 1]], "strong": 1}',
    ],
)
def test_a_value_of_another_kind_is_no_event(line):
    with pytest.raises(ValueError, match="No event"):
        read_event(line)
