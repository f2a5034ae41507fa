from __future__ import annotations

import math
from dataclasses import replace

import pytest
from kivy.uix.button import Button
from kivy.uix.floatlayout import FloatLayout

from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Check, Checklist
from robotside.autonomy.checklist import CheckInputs, checks
from tests.looped import looped
from widgets.core.language import PSEUDO, language
from widgets.status.check_list import GOOD, SENTENCES, UNTESTED, CheckList, samples, words_of

BAD = Check("battery", "bad", "The battery is below 20%; charge it first.")


@pytest.fixture
def card(stage):
    card = CheckList(state="live", open=True, wide=330)
    stage.show(card)
    card.asked = []
    card.bind(on_fold=lambda _, unfold: card.asked.append(unfold))
    return card


def told(stage, card, *checks):
    card.show(Checklist(checks=list(checks)))
    stage.frames(3)
    return [line.text for line in reversed(card.ids.lines.children)]


def test_before_the_first_list_there_is_nothing_to_see_or_to_touch(stage, card):
    stage.frames(2)
    assert (card.width, card.height) == (0, 0)


def test_what_is_not_good_is_said_the_worst_first_and_what_is_good_named(stage, card):
    lines = told(stage, card, GOOD[1], UNTESTED, BAD)
    assert lines == [BAD.text, UNTESTED.text, "Good: sensors."]
    assert (card.title, card.role) == ("Before it moves: 1 of 3 good", "danger")


def test_where_there_is_little_room_only_what_is_not_good_is_said(stage, card):
    card.brief = True
    assert told(stage, card, GOOD[1], UNTESTED) == [UNTESTED.text]
    card.brief = False
    assert len(card.ids.lines.children) == 2


def test_only_what_nobody_knows_is_a_warning(stage, card):
    told(stage, card, *GOOD[:3], UNTESTED)
    assert (card.role, card.icon) == ("warn", "help")


def test_a_state_of_another_day_is_not_taken_for_good(stage, card):
    assert told(stage, card, GOOD[0], Check("tilt", "odd", "")) == ["The tilt is not good.", "Good: battery."]
    assert not card.ready


def test_all_good_is_green_and_says_what_was_found(stage, card):
    assert told(stage, card, *GOOD) == [check.text for check in GOOD]
    assert (card.title, card.role, card.ready) == ("Checks good", "ok", True)


def test_folded_it_is_a_line_as_wide_as_its_words(stage, card):
    told(stage, card, *GOOD[:3], UNTESTED)
    high = card.height
    card.open = False
    stage.frames(2)
    assert card.title == "Checks: 3 of 4"
    assert card.ids.head.height == card.height < high
    assert card.ids.head.ids.words.right < card.right < card.x + 250


def test_a_finger_asks_for_folding_and_unfolding(stage, card):
    told(stage, card, UNTESTED)
    stage.tap(card.x + 20, card.top - 20)
    card.open = False
    stage.frames(2)
    stage.tap(card.x + 20, card.top - 20)
    assert card.asked == [False, True]


def test_a_finger_on_a_sentence_goes_no_farther(stage):
    below, card, reached = Button(), CheckList(state="live", open=True), []
    below.bind(on_press=reached.append)
    ground = FloatLayout()
    for widget in (below, card):
        ground.add_widget(widget)
    stage.show(ground, size=(600, 400))
    told(stage, card, UNTESTED, GOOD[0])
    stage.tap(card.center_x, card.y + 20)
    assert reached == []
    stage.tap(card.right + 20, card.y + 20)
    assert reached == [below]


def test_what_has_no_room_scrolls(stage, card):
    told(stage, card, BAD, UNTESTED, GOOD[0])
    card.room = 120
    stage.frames(2)
    assert card.height == 120
    assert card.ids.lines.height > card.ids.roll.height


@pytest.mark.parametrize("name", samples())
def test_every_sample_says_how_many_are_good(stage, name):
    assert stage.show(samples()[name]()).title.startswith(("Before it moves: ", "Checks"))


def told_by_a_robot() -> list[Check]:
    well = CheckInputs(0.9, 0.2, (), placed=True, sure=True, stop_tested=True, offset=0.0)
    others = [
        {"battery": math.nan, "silent": ("/scan", "/imu/data"), "placed": False, "stop_tested": False},
        {"battery": 0.1, "sure": False, "offset": math.nan},
        {"offset": 2.5},
        {"offset": -2.5},
    ]
    lists = [checks(well), *(checks(replace(well, **other)) for other in others)]
    return [check for one in lists for check in one]


@pytest.fixture
def spoken():
    yield lambda name: setattr(language, "name", name)
    language.name = "en"


def test_in_english_a_robot_speaks_for_itself():
    assert [words_of(check) for check in told_by_a_robot()] == [check.text for check in told_by_a_robot()]


def test_every_finding_of_a_robot_is_said_in_the_language_of_the_glass_by_its_code(spoken):
    spoken(PSEUDO)
    found = told_by_a_robot()
    assert {check.code for check in found} == set(SENTENCES)
    assert [check.text for check in found if not words_of(check).startswith("[")] == []


@looped(
    ("check", "told"),
    [
        (told_by_a_robot()[6], "Keine Daten von: /scan, /imu/data."),
        (told_by_a_robot()[10], "Der Akku ist unter 20\u00a0%; laden Sie ihn zuerst."),
        (Check("sensors", "bad", "No data from: /scan."), "No data from: /scan."),
        (Check("tilt", "bad", "It leans.", "check_tilt_steep"), "It leans."),
        (Check("sensors", "bad", "No data.", Code.CHECK_SENSORS_SILENT), "No data."),
        (Check("battery", "bad", "Low.", Code.CHECK_BATTERY_LOW, [KeyValue("needed", "much")]), "Low."),
    ],
)
def test_it_goes_by_the_code_alone_and_without_one_that_is_whole_the_robot_s_words_stand(spoken, check, told):
    spoken("de")
    assert words_of(check) == told
