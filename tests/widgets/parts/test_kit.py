from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from kivy.lang import Builder
from kivy.uix.boxlayout import BoxLayout

import widgets.parts.kit as kit
from widgets.core.base import text_texture
from widgets.core.theme import theme
from widgets.parts.choices import Segment
from widgets.parts.kit import (
    Banner,
    Chip,
    Fader,
    IconButton,
    NavButton,
    PrimaryButton,
    Progress,
    QuietButton,
    SectionLabel,
    Segmented,
    Sheet,
    Stepper,
    Text,
    TextField,
    Toast,
    Toggle,
    ValueUnit,
    spaced,
)
from widgets.parts.labels import Icon, wrapped
from widgets.parts.stepper import StepperEnd

MOTIONS = [("loop", "Loop"), ("random", "Random")]


@pytest.fixture
def gloves():
    theme.gloves = True
    yield
    theme.gloves = False


@pytest.mark.parametrize("name", kit.__all__[:-1])
def test_a_rule_can_name_every_part_of_the_kit(name):
    assert isinstance(Builder.load_string(f"{name}:\n"), getattr(kit, name))


def test_letters_of_a_label_stand_apart():
    assert spaced("Eta") == "E\u200aT\u200aA"
    assert SectionLabel(title="Eta").text == "E\u200aT\u200aA"


def test_a_sentence_is_as_tall_as_its_lines(stage):
    short = stage.show(Text(text="Short."), size=(200, 1))
    long = stage.show(
        Text(text="A sentence that is much too long for one line of two hundred."), size=(200, 1)
    )
    stage.frames(2)
    assert long.height > short.height > 10


@pytest.mark.parametrize("kind", [PrimaryButton, QuietButton, IconButton, TextField, Toggle])
def test_what_is_pressed_is_at_least_14_mm_high(stage, kind):
    widget = stage.show(kind())
    assert widget.height >= theme.target


@pytest.mark.parametrize("kind", [PrimaryButton, QuietButton, IconButton])
def test_gloves_widen_the_targets(stage, gloves, kind):
    widget = stage.show(kind())
    assert widget.height == theme.target > 70


@pytest.mark.parametrize("kind", [PrimaryButton, QuietButton, IconButton, NavButton])
def test_a_tap_presses_a_button_unless_it_is_disabled(stage, kind):
    button = stage.show(kind(), size=(120, 60))
    pressed = []
    button.bind(on_release=lambda _: pressed.append(True))
    stage.tap(60, 30)
    button.disabled = True
    stage.tap(60, 30)
    assert pressed == [True]


def test_a_chip_is_as_wide_as_its_words(stage):
    chip = stage.show(Chip(text="87 %", icon="bolt"))
    stage.frames(2)
    narrow = chip.width
    chip.text = "12 ms · 0 lost"
    stage.frames(2)
    assert chip.width > narrow > 50


def test_a_chip_stands_still_while_its_words_are_no_longer_than_usual(stage):
    chip = Chip(icon="bolt", text="9 ms", usual="288 ms")
    stage.show(chip)
    widths = set()
    for chip.text in ("9 ms", "28 ms", "288 ms"):
        stage.frames(3)
        widths.add(chip.width)
    assert len(widths) == 1
    chip.text = "no heartbeat"
    stage.frames(3)
    assert chip.width > max(widths)


def test_a_chip_takes_a_finger_only_where_it_may_be_pressed(stage):
    chip = stage.show(Chip(text="Sunlight"))
    stage.frames(2)
    chip.pos = 100, 100
    pressed = []
    chip.bind(on_release=lambda _: pressed.append(True))
    stage.tap(*chip.center)
    assert pressed == []
    chip.pressable = True
    stage.tap(*chip.center)
    stage.tap(chip.center_x, chip.y - (theme.target - chip.height) / 2 + 1)
    assert pressed == [True, True]


def test_a_value_keeps_its_unit_beside_it(stage):
    figure = stage.show(ValueUnit(value="0.62", unit="m/s"))
    stage.frames(2)
    unit, value = figure.children
    assert value.right <= unit.x
    assert unit.font_size < value.font_size


@pytest.fixture
def segmented(stage):
    row = stage.show(Segmented(options=MOTIONS, value="loop"), size=(300, 50))
    row.chosen = []
    row.bind(on_choose=lambda _, value: row.chosen.append(value))
    return row


def test_a_finger_chooses_one_of_several(stage, segmented):
    stage.tap(225, 25)
    stage.tap(225, 25)
    assert segmented.chosen == ["random"]
    assert [s.chosen for s in reversed(segmented.children)] == [False, True]


def test_a_value_set_by_the_program_is_shown_but_not_announced(segmented):
    segmented.value = "random"
    assert segmented.chosen == []
    assert [s.chosen for s in reversed(segmented.children)] == [False, True]


def test_plain_words_are_options_too():
    row = Segmented(options=["Satellite", "Street"], value="Street")
    assert [s.text for s in row.children] == ["Street", "Satellite"]
    assert all(isinstance(s, Segment) for s in row.children)


@pytest.fixture
def stepper(stage):
    stepper = stage.show(Stepper(value=5, minimum=1, maximum=8, unit="s"))
    stage.frames(2)
    stepper.heard = []
    stepper.bind(on_change=lambda _, value: stepper.heard.append(value))
    stepper.more, stepper.fewer = (w for w in stepper.children if isinstance(w, StepperEnd))
    return stepper


def test_plus_and_minus_count(stage, stepper):
    stage.tap(*stepper.more.center)
    stage.tap(*stepper.fewer.center)
    assert stepper.heard == [6, 5]
    assert stepper.figures == "5 s"


def test_the_ends_of_a_stepper_are_hit_within_a_whole_target(stage, stepper):
    stepper.pos = 200, 200
    stage.frames(2)
    assert stepper.more.height < theme.target
    stage.tap(stepper.more.center_x, stepper.more.center_y + theme.target / 2 - 1)
    stage.tap(stepper.fewer.center_x - theme.target / 2 + 1, stepper.fewer.center_y)
    assert stepper.heard == [6, 5]


def test_a_held_plus_counts_on_to_the_end_and_no_further(stage, stepper):
    finger = stage.touch(*stepper.more.center)
    finger.touch_down()
    stage.run_for(5.0)
    assert stepper.heard == [6, 7, 8]
    finger.touch_up()
    stage.run_for(1.0)
    assert stepper.value == 8


def test_a_plus_let_go_counts_no_more(stage, stepper):
    stage.tap(*stepper.more.center)
    stage.run_for(2.0)
    assert stepper.heard == [6]


def test_zero_may_have_a_word():
    assert Stepper(value=0, zero="until stopped").figures == "until stopped"
    assert Stepper(value=0, unit="laps").figures == "0 laps"


def test_a_toggle_changes_over_within_150_ms(stage):
    toggle = stage.show(Toggle())
    heard = []
    toggle.bind(on_change=lambda _, active: heard.append(active))
    stage.tap(*toggle.center)
    assert heard == [True]
    stage.run_for(0.15)
    assert toggle.travel == 1.0


@given(st.floats(allow_nan=True, allow_infinity=True))
def test_progress_is_never_drawn_outside_its_bar(value):
    bar = Progress(value=value, width=200)
    assert 0.0 <= bar.filled <= 200.0
    assert not (math.isnan(value) and bar.filled)


def test_the_fader_follows_its_finger(stage):
    fader = stage.show(Fader(minimum=0.1, maximum=1.1, step=0.1), size=(88, 240))
    heard = []
    fader.bind(on_change=lambda _, value: heard.append(round(value, 3)))
    finger = stage.touch(44, fader.low)
    finger.touch_down()
    finger.touch_move(44, (fader.low + fader.high) / 2)
    finger.touch_move(44, 900)
    other = stage.touch(44, fader.low)
    other.touch_down()
    finger.touch_up()
    assert heard == [0.1, 0.6, 1.1]
    assert fader.knob_y == fader.high


def test_a_fader_without_a_range_stands_still():
    fader = Fader(minimum=1.0, maximum=1.0, value=1.0)
    assert fader.value_normalized == 0.0


@pytest.mark.parametrize(
    ("level", "role"), [("info", "accent"), ("ok", "ok"), ("warn", "warn"), ("danger", "danger")]
)
def test_a_banner_looks_like_its_level(level, role):
    banner = Banner(text="x", level=level)
    assert banner.role == role
    assert banner.icon


def test_a_toast_leaves_by_itself(stage):
    holder = stage.show(BoxLayout(), size=(400, 60))
    toast = Toast(text="Stored.", stay=3.0)
    closed = []
    toast.bind(on_close=lambda _: closed.append(True))
    holder.add_widget(toast)
    stage.run_for(2.9)
    assert toast.parent is holder
    stage.run_for(0.3)
    assert toast.parent is None
    assert closed == [True]


def test_a_tap_takes_a_toast_away_at_once(stage):
    holder = stage.show(BoxLayout(), size=(400, 60))
    toast = Toast(text="Stored.")
    holder.add_widget(toast)
    stage.frames(2)
    stage.tap(*toast.center)
    assert toast.parent is None
    stage.run_for(6.0)
    assert holder.children == []


@pytest.fixture
def sheet(stage):
    sheet = Sheet(detents=[100.0, 200.0, 400.0], size_hint=(None, None), width=400)
    stage.show(sheet)
    return sheet


def test_a_sheet_rests_at_the_nearest_height(stage, sheet):
    stage.drag([(200, 95), (200, 150), (200, 270)])
    stage.run_for(0.2)
    assert (sheet.detent, sheet.height) == (1, 200.0)


def test_a_sheet_cannot_be_pulled_over_its_ends(stage, sheet):
    finger = stage.touch(200, 95)
    finger.touch_down()
    finger.touch_move(200, 900)
    assert sheet.height == 400.0
    finger.touch_move(200, -500)
    assert sheet.height == 100.0


def test_a_tap_on_its_edge_goes_to_the_next_height_and_round(stage, sheet):
    heights = []
    for _ in range(3):
        stage.tap(200, sheet.top - 5)
        stage.run_for(0.2)
        heights.append(sheet.height)
    assert heights == [200.0, 400.0, 100.0]


def test_nothing_under_a_sheet_is_touched(stage, sheet):
    assert stage.touch(200, 20).touch_down() is None
    stage.touch(200, 20)
    assert sheet.on_touch_down(stage.touch(200, 20))


def row_of(button):
    return button.children[0]


@pytest.mark.parametrize(("flow", "width"), [("horizontal", 112), ("horizontal", 200), ("vertical", 84)])
@pytest.mark.parametrize("words", ["Resume", "Snapshot", "Go home"])
def test_words_keep_8_dp_clear_of_the_borders_of_their_button(stage, flow, words, width):
    button = stage.show(QuietButton(text=words, icon="home", flow=flow), size=(width, 64))
    stage.frames(3)
    row = row_of(button)
    assert row.x - button.x >= 8
    assert button.right - row.right >= 8
    assert row.center_x == pytest.approx(button.center_x, abs=1)


def test_words_that_have_room_are_as_large_as_all_others(stage):
    button = stage.show(QuietButton(text="Resume", icon="home"), size=(200, 64))
    assert button.words_size == theme.size_body


@pytest.mark.parametrize("width", [240, 280, 330, 420])
def test_words_keep_8_dp_clear_of_the_lines_of_their_segment(stage, width):
    row = stage.show(Segmented(options=["Loop", "Random", "Intermittent"], value="Intermittent"), (width, 46))
    stage.frames(3)
    widest = text_texture("Intermittent", row.children[0].font_size, "B612", bold=True).width
    assert row.children[0].width - widest >= 16
    assert len({segment.font_size for segment in row.children}) == 1


def test_a_value_with_its_unit_stays_within_its_room(stage):
    value = stage.show(ValueUnit(value="0.42", unit="m/s", room=54.0))
    stage.frames(3)
    assert 40 < value.width <= 56


def test_a_wrong_field_has_a_sign_beside_its_text(stage):
    field = stage.show(TextField(text="10.0.0.300"), size=(300, 60))
    before = field.padding[2]
    field.wrong = True
    stage.frames(2)
    drawn = [one.texture for one in field.canvas.after.children if getattr(one, "texture", None)]
    assert field.sign in drawn
    assert field.padding[2] >= before + field.sign.width


def test_a_long_name_is_broken_between_its_parts_and_shown_whole():
    name = "/left_arm_controller/follow_joint_trajectory/feedback"
    for room in (80.0, 160.0, 240.0):
        lines = wrapped(name, room, 18).split("\n")
        assert "".join(lines) == name
        assert all(line[-1] in "/_" for line in lines[:-1])
        assert all(line.strip("/") for line in lines), "no stroke stands alone"
    assert wrapped(name, 2000.0, 18) == name
    assert wrapped("", 100.0, 18) == ""


def test_a_filled_field_goes_on_saying_what_it_is_for(stage):
    field = stage.show(
        TextField(hint_text="Tag of the recipient", label="Tag of the recipient"), size=(330, 54)
    )
    assert field.drop == 0
    field.text = "04 A2"
    field.label = "Tag of the person here and of nobody else"
    stage.frames(1)
    assert field.label_size == tuple(field.label_texture.size)
    label_low = field.top - 5 - field.label_size[1]
    text_top = field.top - field.padding[1]
    assert field.drop > 0
    assert text_top <= label_low + 2
    assert field.padding[3] >= 4


@pytest.mark.parametrize("height", [18, 22, 34])
def test_the_words_of_a_chip_are_no_higher_than_it(stage, height):
    chip = stage.show(Chip(text="42 %", icon="bolt", usual="288 ms", height=height))
    stage.frames(3)
    words, sign = chip.ids.words, next(part for part in chip.children if isinstance(part, Icon))
    assert words.texture_size[1] <= height
    assert sign.font_size <= height


@pytest.mark.parametrize("kind", [Toggle, Segmented, Stepper])
def test_in_gloves_a_choice_is_as_high_as_a_target(stage, kind):
    theme.gloves = True
    try:
        made = stage.show(kind(options=["On", "Off"]) if kind is Segmented else kind())
        stage.frames(2)
        assert made.height >= theme.target
        assert made.width >= theme.target
    finally:
        theme.gloves = False


@pytest.mark.parametrize(("width", "drawn"), [(200, 1), (84, 0)])
def test_an_icon_gives_way_to_words_that_have_no_room_beside_it(stage, width, drawn):
    button = stage.show(QuietButton(text="Continuer", icon="home"), size=(width, 64))
    stage.frames(3)
    sign, words = button.ids.sign, button.ids.words
    assert (sign.opacity, sign.width > 0) == (drawn, bool(drawn))
    assert not words.shorten
    assert words.x >= button.x
    assert words.right <= button.right
