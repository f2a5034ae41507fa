"""The mission editor: every edit can be undone, and nothing claims to be stored before the robot said so."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from app.missions.mission_editor import Draft, MissionEditor
from bridge.msgs.pilothouse_msgs import Mission, Waypoint

STORED = Mission(waypoints=[Waypoint(5.0, 6.0)], home=[Waypoint(0.0, 0.0)], motion="random", dwell=2.0)


@pytest.fixture
def editor() -> MissionEditor:
    editor = MissionEditor()
    for x in (1.0, 2.0, 3.0):
        editor.add(x, 0.0)
    return editor


def xs(editor: MissionEditor) -> list[float]:
    return [x for x, _ in editor.draft.points]


@pytest.mark.parametrize("change", [MissionEditor.undo, lambda editor: editor.remove(2)])
def test_what_was_refused_is_said_of_no_other_draft(
    editor: MissionEditor, change: Callable[[MissionEditor], None]
) -> None:
    editor.sending()
    editor.answered(editor.draft, False, "Point 3 is inside a wall.")
    assert (editor.failed, editor.outcome) == (True, "Point 3 is inside a wall.")
    change(editor)
    assert (editor.failed, editor.outcome) == (False, "")


@pytest.mark.parametrize("index", [-1, 3])
@pytest.mark.parametrize(
    "edit", [lambda e, i: e.move(i, 0, 0), lambda e, i: e.remove(i), lambda e, i: e.reorder(i, 0)]
)
def test_a_point_that_is_not_there_cannot_be_edited(
    editor: MissionEditor, index: int, edit: Callable[[MissionEditor, int], None]
) -> None:
    with pytest.raises(IndexError, match="there are 3"):
        edit(editor, index)
    assert xs(editor) == [1.0, 2.0, 3.0]


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_a_place_that_is_no_place_is_refused(editor: MissionEditor, bad: float) -> None:
    for edit in (editor.add, editor.set_home):
        with pytest.raises(ValueError, match="two numbers"):
            edit(bad, 0.0)


def test_an_unknown_motion_is_refused_with_what_is_allowed(editor: MissionEditor) -> None:
    with pytest.raises(ValueError, match="loop, random, intermittent, not 'zigzag'"):
        editor.set_motion(motion="zigzag")


def test_numbers_beyond_their_bounds_are_brought_to_them(editor: MissionEditor) -> None:
    editor.set_motion(dwell=-3.0, laps=100_000)
    assert (editor.draft.dwell, editor.draft.laps) == (0.0, 999)


def test_points_can_be_moved_reordered_and_removed(editor: MissionEditor) -> None:
    editor.move(1, 9.0, 4.0)
    editor.reorder(0, 2)
    editor.remove(1)
    assert editor.draft.points == ((9.0, 4.0), (1.0, 0.0))


def test_undo_takes_back_every_edit_and_redo_brings_it_again(editor: MissionEditor) -> None:
    states = [editor.draft]
    for edit in (
        lambda: editor.move(0, 7.0, 7.0),
        lambda: editor.reorder(0, 1),
        lambda: editor.remove(2),
        lambda: editor.set_home(1.0, 1.0),
        lambda: editor.set_motion(motion="random"),
        editor.clear,
    ):
        edit()
        states.append(editor.draft)
    for state in reversed(states[:-1]):
        editor.undo()
        assert editor.draft == state
    for state in states[1:]:
        editor.redo()
        assert editor.draft == state
    assert not editor.can_redo


def test_an_edit_after_undo_ends_what_could_be_redone(editor: MissionEditor) -> None:
    editor.undo()
    editor.add(8.0, 8.0)
    assert not editor.can_redo
    assert xs(editor) == [1.0, 2.0, 8.0]


def test_steps_of_one_number_are_undone_together(editor: MissionEditor) -> None:
    for dwell in (6.0, 7.0, 8.0):
        editor.set_motion(dwell=dwell)
    editor.undo()
    assert editor.draft.dwell == 5.0
    assert len(editor.draft.points) == 3


def test_an_edit_that_changes_nothing_is_no_step() -> None:
    editor = MissionEditor()
    editor.set_motion(motion="loop")
    assert not editor.can_undo


def test_a_draft_is_not_stored_before_the_robot_accepts_it(editor: MissionEditor) -> None:
    assert editor.state == "draft"
    message = editor.sending()
    assert editor.state == "sent"
    assert editor.dirty
    editor.answered(editor.draft, True, "Stored.")
    assert editor.state == "stored"
    assert [point.x for point in message.waypoints] == xs(editor)


def test_a_refused_draft_stays_a_draft_and_says_why(editor: MissionEditor) -> None:
    editor.sending()
    editor.answered(editor.draft, False, "Point 2 is inside a wall.")
    assert editor.state == "draft"
    assert editor.outcome == "Point 2 is inside a wall."


def test_an_edit_while_it_is_sent_is_not_stored_by_the_answer(editor: MissionEditor) -> None:
    editor.sending()
    sent = editor.draft
    editor.add(4.0, 0.0)
    editor.answered(sent, True, "Stored.")
    assert editor.state == "draft"
    editor.undo()
    assert editor.state == "stored"


def test_the_answer_to_an_earlier_sending_does_not_store_a_later_one(editor: MissionEditor) -> None:
    editor.sending()
    first = editor.draft
    editor.add(4.0, 0.0)
    editor.sending()
    editor.answered(first, True, "Stored.")
    assert editor.stored == first
    assert editor.state == "sent"
    editor.answered(editor.draft, False, "Point 4 is inside a wall.")
    assert (editor.state, editor.stored) == ("draft", first)


def test_what_the_robot_tells_counts_more_than_an_answer_that_comes_after_it(editor: MissionEditor) -> None:
    editor.sending()
    editor.robot_has(STORED)
    editor.answered(editor.draft, True, "Stored.")
    assert editor.state == "draft"
    assert editor.stored == Draft.of(STORED)


def test_a_draft_that_the_robot_tells_before_it_answers_is_stored(editor: MissionEditor) -> None:
    message = editor.sending()
    editor.robot_has(message)
    assert editor.state == "stored"
    editor.answered(editor.draft, False, "No reply.")
    assert (editor.state, editor.outcome) == ("stored", "")


def test_the_robots_mission_fills_an_untouched_editor() -> None:
    editor = MissionEditor()
    assert editor.state == "empty"
    editor.robot_has(STORED)
    assert editor.draft == Draft(((5.0, 6.0),), (0.0, 0.0), "random", 2.0)
    assert editor.state == "stored"


def test_the_robots_mission_never_replaces_what_was_entered(editor: MissionEditor) -> None:
    editor.robot_has(STORED)
    assert xs(editor) == [1.0, 2.0, 3.0]
    assert editor.state == "draft"


def test_another_handhelds_mission_replaces_an_unchanged_one_and_can_be_undone() -> None:
    editor = MissionEditor()
    editor.robot_has(STORED)
    editor.robot_has(Mission(waypoints=[Waypoint(1.0, 1.0)]))
    assert editor.draft.points == ((1.0, 1.0),)
    editor.undo()
    assert editor.draft.points == ((5.0, 6.0),)


def test_clearing_a_stored_mission_is_a_draft_that_can_be_sent() -> None:
    editor = MissionEditor()
    editor.robot_has(STORED)
    editor.clear()
    assert editor.state == "draft"


def test_the_robots_rounding_does_not_make_a_draft_of_a_stored_mission(editor: MissionEditor) -> None:
    editor.robot_has(Mission(waypoints=[Waypoint(x + 1e-9, 0.0) for x in xs(editor)]))
    assert editor.state == "stored"


def test_a_saved_draft_comes_back_whole(editor: MissionEditor) -> None:
    editor.set_home(1.5, 2.5)
    editor.set_motion(motion="intermittent", dwell=7.5, laps=3, on_intruder="circle")
    other = MissionEditor()
    assert other.load(editor.save())
    assert other.draft == editor.draft


@pytest.mark.parametrize("reaction", ["stop", "report", "circle"])
def test_what_an_intruder_brings_about_goes_to_the_robot_and_back(
    editor: MissionEditor, reaction: str
) -> None:
    editor.set_motion(on_intruder=reaction)
    told = editor.sending()
    assert (told.on_intruder, told.stop_on_intruder) == (reaction, reaction == "stop")
    editor.robot_has(told)
    assert editor.state == "stored"


def test_the_name_of_a_kept_mission_is_not_lost_by_an_edit() -> None:
    editor = MissionEditor()
    editor.robot_has(Mission(waypoints=[Waypoint(1.0, 1.0)], name="Night"))
    editor.add(2.0, 2.0)
    assert editor.sending().name == "Night"


@pytest.mark.parametrize(
    "saved",
    [
        None,
        [],
        {"points": "x"},
        {"points": [[1]]},
        {"points": [[math.nan, 1.0]]},
        {"motion": "zigzag"},
        {"on_intruder": "eat"},
    ],
)
def test_a_damaged_draft_is_not_loaded(editor: MissionEditor, saved: object) -> None:
    assert not editor.load(saved)
    assert xs(editor) == [1.0, 2.0, 3.0]


def test_every_change_is_told() -> None:
    told: list[None] = []
    editor = MissionEditor(on_change=lambda: told.append(None))
    editor.add(1.0, 1.0)
    editor.undo()
    editor.sending()
    editor.answered(editor.draft, True, "")
    assert len(told) == 4


def test_a_robots_mission_that_moves_in_a_way_nobody_knows_moves_as_usual() -> None:
    draft = Draft.of(Mission(motion="[b]sideways", on_intruder="dance"))
    assert (draft.motion, draft.on_intruder) == ("loop", "report")


def test_heights_stay_with_their_points_and_can_be_undone(editor: MissionEditor) -> None:
    editor.set_height(4.0, 1)
    assert editor.draft.levels == (None, 4.0, None)
    editor.reorder(1, 0)
    assert editor.draft.levels == (4.0, None, None)
    editor.move(0, 9.0, 9.0)
    editor.add(7.0, 0.0)
    assert editor.draft.levels == (4.0, None, None, None)
    editor.remove(1)
    assert editor.draft.levels == (4.0, None, None)
    editor.set_height(-1.5)
    assert editor.draft.levels == (-1.5, -1.5, -1.5)
    editor.undo()
    assert editor.draft.levels == (4.0, None, None)
    editor.set_height(None)
    assert editor.draft.heights == ()
    editor.clear()
    editor.add(1.0, 1.0)
    assert editor.draft.levels == (None,)


def test_heights_go_to_the_robot_and_come_back_and_a_mission_without_them_is_as_before(
    editor: MissionEditor,
) -> None:
    editor.set_height(4.0, 1)
    sent = editor.sending()
    assert [point.height for point in sent.waypoints][1] == 4.0
    assert math.isnan(sent.waypoints[0].height)
    assert Draft.of(sent).same_as(editor.draft)
    editor.robot_has(sent)
    assert editor.state == "stored"
    editor.set_height(4.5, 1)
    assert editor.state == "draft"
    assert Draft.of(Mission(waypoints=[Waypoint(1.0, 2.0, height=0.0)])).heights == ()
    other = MissionEditor()
    assert other.load(editor.save())
    assert other.draft == editor.draft
    old = {key: value for key, value in editor.save().items() if key != "heights"}
    assert other.load(old)
    assert other.draft.levels == (None, None, None)


@pytest.mark.parametrize("height", [math.nan, math.inf])
def test_a_height_that_is_no_number_is_refused(editor: MissionEditor, height: float) -> None:
    with pytest.raises(ValueError, match="A height needs a number"):
        editor.set_height(height, 0)
    with pytest.raises(IndexError):
        editor.set_height(1.0, 3)
    assert not editor.load({"points": [[0.0, 0.0]], "heights": [height]})
