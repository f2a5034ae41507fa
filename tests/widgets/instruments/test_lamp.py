"""A lamp says a bool by its shape and a word."""

from __future__ import annotations

import pytest

from bridge.client.type_learning import learn
from bridge.msgs.std_msgs import Bool
from widgets.fitting import best
from widgets.instruments.lamp import Lamp


@pytest.fixture
def lamp(stage):
    return stage.show(Lamp(title="Door", true_word="open", false_word="shut", state="live"), size=(170, 72))


@pytest.mark.parametrize(("value", "word"), [(True, "open"), (False, "shut")])
def test_it_says_what_came(stage, lamp, value, word):
    lamp.show(Bool(value))
    stage.frames(2)
    assert lamp.texts == [word, "Door"]


def test_before_the_first_message_it_says_nothing_of_it(stage, lamp):
    stage.frames(2)
    assert lamp.texts == ["—", "Door"]


def test_it_finds_its_bool_in_any_message(lamp):
    kind = learn(
        [
            {
                "type": "acme_msgs/Arm",
                "fieldnames": ["homed", "load"],
                "fieldtypes": ["bool", "float64"],
                "fieldarraylen": [-1, -1],
            }
        ]
    )
    lamp.path = "homed"
    lamp.show(kind(homed=True))
    assert lamp.value is True


def test_a_field_that_there_is_not_is_an_error(lamp):
    lamp.path = "shut"
    with pytest.raises(AttributeError):
        lamp.show(Bool(True))


def test_a_topic_of_a_bool_offers_it_first():
    assert best(Bool, "/door/open").widget == "Lamp"
