"""Layout files: a mistake is one sentence that says where it is and what is allowed."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.layout.layout import ACTIONS, LayoutError, load, names, owners, parse
from app.session import layout_actions as actions
from widgets import CATALOGUE

WIDGETS = [
    *("Compass", "LaserScanView", "HeadingTape", "LineSensorView", "Readout", "StopButton"),
    *("Joystick", "GoalPad", "SlideToConfirm", "TiltCircle"),
]


def one(**changes: object) -> str:
    entry: dict[str, object] = {"slot": "top", "widget": "Compass", "topic": "/pose", **changes}
    return "[[instrument]]\n" + "\n".join(
        f"{key} = {value!r}" for key, value in entry.items() if value is not None
    )


def control(**changes: str) -> str:
    entry = {"slot": "stick", "widget": "Joystick", **changes}
    return "[[control]]\n" + "\n".join(f"{key} = {value!r}" for key, value in entry.items()) + "\n"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("title = ", "Layout x, line 1: is not TOML"),
        ("instrument = 3", r"\[\[instrument\]\] tables"),
        (
            one(slot="middle"),
            "instrument 1: slot is one of top_left, top, top_right, readouts, senses, not 'middle'",
        ),
        (one(slot=None), "instrument 1: slot is missing"),
        (one(widget="Compas"), "widget is one of Compass, .*, not 'Compas'"),
        (one(topic="/cmd_vel"), "topic is one of .*/scan.*, not '/cmd_vel'"),
        (one(colour="red"), "key is one of .*, not 'colour'"),
        (one(title=3), "title must be a text in quotes, not 3"),
        (one(widget="Readout", digits="two"), "digits must be a whole number, not 'two'"),
        (
            one(slot="readouts", widget="Readout", topic="/odom", field="twist.speed"),
            "nav_msgs/Odometry has no number 'twist.speed'",
        ),
        (
            one(slot="readouts", widget="Readout", topic="/odom", field="twist.twist"),
            "has no number 'twist.twist'",
        ),
        (one(widget="Readout", topic="/odom"), "has no number ''"),
        (one() + "\n" + one(), "2 instruments into top, where 1 fit"),
        (one(also="/odom"), "also must be a list of texts in quotes, not '/odom'"),
        ("robots = []", "Layout x: key is one of title, for, arrangement, .*, not 'robots'"),
        ("arrangement = 'rows'", "arrangement is one of float, two_sticks, columns, not 'rows'"),
        ("for = 'patrol'", "for must be a list of texts in quotes, not 'patrol'"),
        ("arrangement = 'columns'\n" + one(), "instrument 1: slot is one of left, .*, not 'top'"),
        ("[control]", r"control must be a list of \[\[control\]\] tables"),
        (control(slot="top"), "control 1: slot is one of stick, slider, top_right, not 'top'"),
        (control(widget="Lever"), "widget is one of Compass, .*, SpeedCard, not 'Lever'"),
        (control(forward="up"), "forward is one of ahead, aside, climb, .*, not 'up'"),
        (control(pad="middle"), "pad is one of , left, right, not 'middle'"),
        (control(action="fly"), "action is one of task.surface, .*, not 'fly'"),
        (control(colour="red"), "key is one of .*, not 'colour'"),
        (control() * 3, "3 controls into stick, where 2 fit"),
        (control() * 2, "two controls called 'Stick' in stick; each has a title"),
        (control() + control(widget="GoalPad"), "two controls called 'Stick' in stick"),
        (control(forward="turn"), "two controls for turn"),
        (
            "arrangement = 'two_sticks'\n" + control() + control(slot="right_stick"),
            "Layout x has two controls for ahead",
        ),
        (control(slot="slider"), "control 1: SpeedCard goes into slider, and nothing else"),
        (control(widget="SpeedCard"), "control 1: SpeedCard goes into slider"),
        (control(widget="Compass"), "a control is one of GoalPad, Joystick, .*, not Compass"),
        (control(widget="StopButton"), "a control is one of .*, not StopButton"),
        (
            control(topic="/odom"),
            "control 1: Joystick shows no topic, not /odom, which is nav_msgs/Odometry",
        ),
        (
            "arrangement = 'two_sticks'\n" + control(slot="confirm", widget="SlideToConfirm"),
            "action is one of .*, not None",
        ),
        (control(action="pause"), "Joystick confirms nothing, so it has no action"),
        (control(icon="nonsense"), "icon is a name in widgets/core/icons.py.*, not 'nonsense'"),
        (
            "[[action]]\nwhat = 'pause'\nicon = 'puase'",
            "action 1: icon is a name .*, as pause, .*, not 'puase'",
        ),
        (
            one(topic="/battery_state"),
            "instrument 1: Compass shows sensor_msgs/Imu, .*, not /battery_state, which is sensor_msgs/BatteryState",
        ),
        (one(also=["/scan"]), "instrument 1: Compass shows .*, not /scan"),
        (one(also=[3]), r"instrument 1: also\[0\] must be a text in quotes, not 3"),
        (one(widget="Joystick"), "an instrument in top is one of Compass, .*, not Joystick"),
        (one(widget="StopButton"), "an instrument in top is one of .*, not StopButton"),
        (one(slot="readouts", widget="HeadingTape"), "an instrument in readouts is one of Readout, not Head"),
        (
            one(widget="Readout", topic="/odom", field="twist.twist.linear.x"),
            "in top is one of .*, not Readout",
        ),
        (one(slot="senses"), "in senses is one of HeadingTape, LaserScanView, LineSensorView, not Compass"),
        (one(digits=-3), "digits must be a whole number at least 0, not -3"),
        (one(digits=1.5), "digits must be a whole number, not 1.5"),
        (one() + "\nfactor = nan", r"factor must be a number from -1e\+09 to 1e\+09, not nan"),
        (
            one() + "\nfactor = 1" + "0" * 400,
            r"factor must be a number that can be reckoned with, not 1000.*\.\.\.",
        ),
        (one() + "\nfactor = 1" + "0" * 5000, "Layout x: is not TOML: .*digits"),
        (one() + "\ndigits = 0x" + "f" * 5000, "digits must be .*, not a number of thousands of digits"),
        ("for = " + "[" * 2000 + "]" * 2000, "Layout x: is nested deeper than 32 levels"),
        ("arrangement = ['float']", r"arrangement must be a text in quotes, not \['float'\]"),
        ("title = 3", "Layout x: title must be a text in quotes, not 3"),
        ("[[action]]\nwhat = 'jump'", "action 1: what is one of task.surface, .*, not 'jump'"),
        ("[[action]]\nwhat = 'pause'\n" * 5, "5 actions into the buttons, where 4 fit"),
    ],
)
def test_a_mistake_is_one_sentence(text: str, sentence: str) -> None:
    with pytest.raises(LayoutError, match=sentence):
        parse("x", text, WIDGETS)


def test_an_unknown_layout_names_those_there_are(tmp_path: Path) -> None:
    (tmp_path / "patrol.toml").write_text("")
    (tmp_path / "boat.toml").write_text("")
    with pytest.raises(LayoutError, match="There is no layout 'car'; there are: boat, patrol."):
        load("car", WIDGETS, tmp_path)


@pytest.mark.parametrize("name", names())
def test_every_layout_that_is_shipped_can_be_loaded(name: str) -> None:
    assert load(name, CATALOGUE).instruments


def test_the_actions_that_a_layout_may_name_are_those_that_the_app_knows() -> None:
    assert set(ACTIONS) == set(actions.ACTIONS)


def test_two_layouts_for_one_robot_are_a_mistake(tmp_path: Path) -> None:
    for name in ("boat", "minnow"):
        (tmp_path / f"{name}.toml").write_text("for = ['minnow', 'boat']")
    with pytest.raises(LayoutError, match="Layouts boat and minnow are both for minnow."):
        owners(tmp_path)


def test_a_layout_says_how_it_is_driven() -> None:
    text = "arrangement = 'two_sticks'\n" + control(slot="right_stick", forward="climb", left="")
    assert parse("x", text, WIDGETS).controls[0].says == ("climb",)
    actions = parse("x", "[[action]]\nwhat = 'lights'\ntext = 'Lamp'", WIDGETS).actions
    assert [(one.what, one.text, one.icon) for one in actions] == [("lights", "Lamp", "")]


def test_a_layout_of_ones_own_is_a_file(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text("title = 'Mine'\n" + one())
    assert load(str(own), WIDGETS).title == "Mine"
    own.write_text(one(slot="middle"))
    with pytest.raises(LayoutError, match=r"own.toml, instrument 1: slot is one of"):
        load(str(own), WIDGETS)
    with pytest.raises(LayoutError, match=r"none.toml cannot be read: .*No such file"):
        load(str(tmp_path / "none.toml"), WIDGETS)


@pytest.mark.parametrize("model", ["ardrone", "minnow"])
def test_what_air_and_water_carry_is_told_its_speed_over_ground_whichever_way_it_goes(model: str) -> None:
    (speed,) = (line for line in load(model, CATALOGUE).instruments if line.title == "Speed")
    assert speed.field == "twist.twist.linear.xy"
