from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseStamped,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
)
from bridge.msgs.nav_msgs import Path
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.controls.goals.goal_choice import BUTTONS, MAX_COORDINATE
from widgets.controls.goals.goal_pad import GoalPad
from widgets.core.theme import theme


@pytest.fixture
def pad(stage):
    pad = stage.show(GoalPad(), size=(176, 176))
    pad.goals = []
    pad.bind(on_command=lambda _, goal: pad.goals.append(goal))
    return pad


def pose(x: float, y: float, degrees: float = 0.0) -> PoseWithCovarianceStamped:
    at = Pose(Point(x, y), Quaternion.from_yaw(math.radians(degrees)))
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(at))


def middle(pad, name):
    left, low, width, height = pad.button(name)
    return left + width / 2, low + height / 2


def tap(stage, pad, *names):
    for name in names:
        stage.tap(*middle(pad, name))


def test_each_button_moves_the_goal_a_quarter_of_a_metre_or_turns_it_by_fifteen_degrees(stage, pad):
    pad.show(pose(1.0, 2.0, 30.0))
    tap(stage, pad, "east", "east", "north", "turn left")
    assert pad.wanted == [pytest.approx(1.5), pytest.approx(2.25), pytest.approx(math.radians(45))]
    tap(stage, pad, "west", "south", "turn right")
    assert pad.wanted == [pytest.approx(1.25), pytest.approx(2.0), pytest.approx(math.radians(30))]


def test_the_first_step_begins_where_the_robot_is_on_round_figures(stage, pad):
    pad.show(pose(1.06, -0.63, 62.0))
    tap(stage, pad, "east")
    assert pad.wanted == [pytest.approx(1.25), pytest.approx(-0.75), pytest.approx(math.radians(60))]


def test_nothing_is_sent_before_go(stage, pad):
    pad.show(pose(0.0, 0.0))
    tap(stage, pad, "east", "turn left")
    assert pad.goals == []
    tap(stage, pad, "go")
    (goal,) = pad.goals
    assert goal.header.frame_id == "map"
    assert (goal.pose.position.x, goal.pose.position.y) == (0.25, 0.0)
    assert goal.pose.orientation.yaw == pytest.approx(math.radians(15))
    assert pad.outcome == "sent"


def test_a_finger_that_slides_off_go_sends_nothing(stage, pad):
    pad.show(pose(0.0, 0.0))
    tap(stage, pad, "east")
    stage.drag([middle(pad, "go"), middle(pad, "south")])
    assert (pad.goals, pad.pressed) == ([], "")


def test_while_nobody_knows_where_the_robot_is_nothing_can_be_set(stage, pad):
    tap(stage, pad, "east", "go", "here")
    assert (pad.wanted, pad.goals) == ([], [])
    with pytest.raises(ValueError, match="There is no goal yet"):
        _ = pad.goal


def test_a_held_button_goes_on_moving_the_goal_until_it_is_let_go(stage, pad):
    pad.show(pose(0.0, 0.0))
    finger = stage.touch(*middle(pad, "east"))
    finger.touch_down()
    stage.run_for(1.0)
    moved = pad.wanted[0]
    assert moved >= 4 * pad.step
    finger.touch_up()
    stage.run_for(1.0)
    assert pad.wanted[0] == moved


@pytest.mark.parametrize("before", [0.1, 0.6])
def test_what_was_held_before_does_not_go_on_counting_with_the_next_press(stage, pad, before):
    pad.show(pose(0.0, 0.0))
    finger = stage.touch(*middle(pad, "east"))
    finger.touch_down()
    stage.run_for(before)
    finger.touch_up()
    stage.run_for(1.0)
    moved = pad.wanted[0]
    stage.touch(*middle(pad, "east")).touch_down()
    stage.run_for(0.4)
    assert pad.wanted[0] == moved + pad.step


@pytest.mark.parametrize("how", ["rest", "disabled"])
def test_at_rest_a_held_button_moves_nothing_more(stage, pad, how):
    pad.show(pose(0.0, 0.0))
    stage.touch(*middle(pad, "east")).touch_down()
    stage.run_for(0.6)
    if how == "rest":
        pad.rest()
    else:
        pad.state = "disabled"
    moved = pad.wanted[0]
    stage.run_for(1.0)
    assert (pad.wanted[0], pad.pressed) == (moved, "")


@pytest.mark.parametrize(
    ("outcome", "words"),
    [("sent", "Sent"), ("accepted", "Going"), ("refused", "Refused"), ("no_reply", "No reply")],
)
def test_what_became_of_the_goal_is_said_on_the_button_until_it_is_moved(stage, pad, outcome, words):
    pad.show(pose(0.0, 0.0))
    tap(stage, pad, *["east"] * 8)
    pad.answer(outcome)
    stage.frames(2)
    assert words in pad.texts
    tap(stage, pad, "north")
    stage.frames(2)
    assert "Go" in pad.texts


def test_a_goal_that_is_under_way_is_not_sent_twice_but_one_that_was_taken_may_be(stage, pad):
    pad.show(pose(0.0, 0.0))
    tap(stage, pad, "east", "go", "go")
    assert len(pad.goals) == 1
    pad.answer("accepted")
    tap(stage, pad, "go")
    assert len(pad.goals) == 2


def test_a_robot_that_has_arrived_is_said_to_be_there(pad):
    pad.show(pose(0.0, 0.0))
    pad.press("east")
    pad.press("east")
    pad.answer("accepted")
    assert pad.says[0] == "Going"
    pad.show(pose(0.48, 0.02, 3.0))
    assert pad.says[0] == "There"
    pad.show(pose(0.48, 0.02, 90.0))
    assert pad.says[0] == "Going"


def test_here_puts_the_goal_where_the_robot_is(stage, pad):
    pad.show(pose(4.0, 3.0))
    tap(stage, pad, *["north"] * 3, "here")
    assert pad.wanted[:2] == [4.0, 3.0]


def way(x: float) -> Path:
    return Path(poses=[PoseStamped(pose=Pose(Point(at, 1.0), Quaternion.from_yaw(1.0))) for at in (0.0, x)])


def does(state: str = "RUNNING", run: int = 7, task: str = "go_to", phase: str = "") -> TaskStatus:
    return TaskStatus(task_id=run, task=task, state=state, phase=phase)


def test_where_the_robot_goes_by_somebody_elses_order_is_the_goal_while_nobody_sets_one_here(pad):
    pad.show(way(3.0))
    assert (pad.wanted, pad.says[0]) == ([], "Go"), "nobody said that it goes to a goal"
    pad.show(does())
    assert pad.wanted == [3.0, 1.0, pytest.approx(1.0)]
    assert (len(pad.way), pad.says[0]) == (2, "Going")
    pad.show(does(run=8))
    pad.show(way(5.0))
    assert pad.wanted[0] == 5.0
    pad.show(pose(0.0, 0.0))
    pad.press("east")
    pad.show(way(3.0))
    assert (pad.wanted[0], pad.says[0]) == (5.25, "Go"), "a goal that is being set"
    pad.show(Path())
    assert len(pad.way) == 0


def test_the_goal_that_is_followed_stays_in_sight_while_another_one_is_set(stage, pad):
    pad.size = 326, 228
    pad.show(pose(0.0, 0.0))
    tap(stage, pad, "east", "go")
    pad.answer("accepted")
    pad.show(does())
    assert pad.followed == []
    tap(stage, pad, *["north"] * 4)
    assert (pad.wanted[:2], pad.followed[:2]) == ([0.25, 1.0], [0.25, 0.0])
    stage.frames(2)
    assert {"NEW", "going to 0.25 / 0.00", "Go"} <= set(pad.texts)
    tap(stage, pad, "go")
    pad.answer("refused")
    assert pad.followed[:2] == [0.25, 0.0], "it still goes there"
    tap(stage, pad, "go")
    pad.answer("accepted")
    pad.show(does(run=8))
    assert pad.followed == []
    tap(stage, pad, "north")
    assert pad.followed[:2] == [0.25, 1.0]
    pad.show(does("SUCCEEDED", run=8))
    assert pad.followed == []


def test_where_somebody_else_sends_the_robot_is_in_sight_beside_the_goal_that_is_set_here(pad):
    pad.show(pose(0.0, 0.0))
    pad.press("east")
    pad.show(way(3.0))
    assert pad.followed == [], "nobody said that it goes to a goal"
    pad.show(does())
    assert pad.followed[:2] == [3.0, 1.0]
    pad.show(does("CANCELED"))
    assert pad.followed == []


@pytest.mark.parametrize("plan_first", [True, False])
def test_another_tasks_way_is_no_goal(pad, plan_first):
    messages = [way(3.0), does(task="patrol")]
    for message in messages if plan_first else reversed(messages):
        pad.show(message)
    assert (pad.wanted, pad.says[0]) == ([], "Go")


@pytest.fixture
def sent(pad):
    """A goal three metres ahead was sent while the run before it still stands on the glass."""
    pad.show(pose(0.0, 0.0))
    pad.show(does("SUCCEEDED", run=6))
    for _ in range(12):
        pad.press("east")
    pad.press("go")
    return pad


@pytest.mark.parametrize(
    ("status", "words"),
    [
        (does(), "Going"),
        (does(phase="waiting"), "Waiting"),
        (does("PAUSED"), "Paused"),
        (does("SUCCEEDED"), "There"),
        (does("CANCELED"), "Canceled"),
        (does("FAILED"), "Failed"),
        (does("INTERRUPTED"), "Cut off"),
        (does(run=8, task="patrol"), "Go"),
    ],
)
def test_the_button_says_what_the_robot_does_with_the_goal(stage, sent, status, words):
    sent.answer("accepted")
    sent.show(does())
    sent.show(status)
    stage.frames(2)
    assert words in sent.texts
    sent.press("north")
    sent.show(does("CANCELED"))
    assert sent.says[0] == "Go", "another goal than the one that ended"


def test_what_the_robot_does_may_be_heard_before_its_answer(sent):
    sent.show(does("FAILED", run=6))
    assert sent.says[0] == "Sent", "the run before it"
    sent.show(does("PAUSED"))
    sent.answer("accepted")
    assert sent.says[0] == "Paused"


def test_a_goal_that_was_refused_is_not_the_run_that_comes_next(sent):
    sent.answer("refused")
    sent.show(does())
    assert sent.says[0] == "Refused"


def test_a_robot_that_tells_no_tasks_has_ended_when_its_way_is_gone(pad):
    pad.show(pose(0.0, 0.0))
    pad.press("east")
    pad.press("north")
    pad.press("go")
    pad.answer("accepted")
    pad.show(way(3.0))
    assert pad.says[0] == "Going"
    pad.show(Path())
    assert pad.says[0] == "Go"


def test_a_pose_that_is_no_number_is_not_known(stage, pad):
    pad.show(pose(1.0, 1.0))
    pad.show(pose(math.nan, 1.0))
    stage.frames(2)
    assert pad.actual == []
    assert pad.texts.count("–") == 3
    assert {"STEP", "15°"} <= set(pad.texts), "while there is no goal it says what a press does"


def test_no_goal_is_farther_than_a_map_can_be(pad):
    pad.show(pose(MAX_COORDINATE, 0.0))
    pad.press("east")
    assert pad.wanted[0] == MAX_COORDINATE


@pytest.fixture
def handheld():
    """A glass on which 14 mm are 88 dp, as they are where a dp is a 160th of an inch."""
    before = theme.target
    theme.target = 88
    yield
    theme.target = before


@pytest.mark.usefixtures("handheld")
@pytest.mark.parametrize(("size", "pictured"), [((326, 228), True), ((480, 320), True), ((176, 176), False)])
def test_on_a_handhelds_glass_the_buttons_leave_room_for_the_picture_and_are_no_smaller_than_needed(
    stage, size, pictured
):
    pad = stage.show(GoalPad(), size=size)
    stage.frames(2)
    assert (pad.layout[1] is not None) == pictured
    sides = [side for name in BUTTONS for side in pad.button(name)[2:]]
    assert min(sides) >= (88 if size[0] > 400 else 53)


@pytest.mark.parametrize("size", [(176, 176), (242, 242), (326, 228), (420, 470), (420, 190)])
def test_every_button_is_as_large_as_a_finger_and_inside_at_every_size(stage, size):
    pad = stage.show(GoalPad(), size=size)
    pad.show(pose(-123.4, 5.0))
    pad.press("east")
    stage.frames(2)
    for name in BUTTONS:
        left, low, width, height = pad.button(name)
        assert min(width, height) >= theme.target - 0.1
        assert left >= 0 <= low
        assert left + width <= size[0] >= low + height - max(0, size[1] - size[0])
    assert {"ROBOT", "GOAL", "x", "y"} <= set(pad.texts)


def test_low_buttons_have_their_icon_only(stage):
    pad = stage.show(GoalPad(), size=(128, 128))
    pad.show(pose(1.0, 2.0))
    stage.frames(2)
    assert not {"Go", "ROBOT", "x+"} & set(pad.texts)


def test_figures_in_the_corners_of_a_phones_pad_have_a_unit_and_one_size(stage, pad):
    pad.size = 260, 260
    pad.show(pose(-12.54, -2.0))
    stage.frames(2)
    assert {"−12.54 m", "−2.00 m", "0.25 m", "STEP"} <= set(pad.texts)
