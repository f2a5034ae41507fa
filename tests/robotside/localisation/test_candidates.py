"""The question at which place the robot is."""

from __future__ import annotations

import pytest

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import PlaceCandidates
from robotside.core.pose2 import Pose2
from robotside.localisation.candidates import QUESTION_NUMBERS, Candidates
from tests.robotside.localisation.test_hypotheses import following


def test_two_places_are_a_question_with_their_shares_and_one_is_none() -> None:
    said: list[Msg] = []
    board = Candidates(lambda _, msg: said.append(msg))
    doubt = following(Pose2(0.0, 0.0, 0.0), Pose2(2.0, 0.0, 1.0))
    board.update(following(), 1.0)
    board.update(doubt, 1.0)
    assert len(said) == 1
    asked = said[0]
    assert isinstance(asked, PlaceCandidates)
    assert [(each.x, each.yaw, each.share) for each in asked.candidates] == [(0.0, 0.0, 0.5), (2.0, 1.0, 0.5)]
    assert asked.candidates[0].spread == pytest.approx(0.1)
    assert asked.header.frame_id == "map"
    assert asked.reason
    doubt.all.pop()
    board.update(doubt, 2.0)
    last = said[-1]
    assert isinstance(last, PlaceCandidates)
    assert (last.candidates, last.reason, board.all) == ([], "", ())


def test_what_hardly_changes_is_not_said_again_and_what_does_not_too_often() -> None:
    said: list[Msg] = []
    board = Candidates(lambda _, msg: said.append(msg))
    doubt = following(Pose2(0.0, 0.0, 0.0), Pose2(2.0, 0.0, 1.0))
    board.update(doubt, 1.0)
    board.update(doubt, 5.0)
    assert len(said) == 1
    for each in doubt.all:
        each.localiser.pose = each.pose.then(Pose2(0.3, 0.0, 0.0))
    board.update(doubt, 1.2)
    assert len(said) == 1
    board.update(doubt, 1.6)
    assert len(said) == 2


def test_a_place_that_is_hardly_believed_is_not_asked_about() -> None:
    board = Candidates(lambda *_: None)
    doubt = following(Pose2(0.0, 0.0, 0.0), Pose2(2.0, 0.0, 1.0))
    doubt.all[1].weight = -4.5
    board.update(doubt, 1.0)
    assert board.all == ()


def test_each_question_begins_with_the_first_letter_and_no_number_comes_twice() -> None:
    board = Candidates(lambda *_: None)
    doubt = following(*(Pose2(2.0 * n, 0.0, 0.0) for n in range(3)))
    for number, each in enumerate(doubt.all, start=19):
        each.number = number
    board.update(doubt, 1.0)
    assert [each.id for each in board.all] == [1, 2, 3]
    doubt.all.pop(1)
    doubt.all.reverse()
    board.update(doubt, 2.0)
    assert [(each.id, each.x) for each in board.all] == [(3, 4.0), (1, 0.0)], "they keep their letters"
    board.update(following(), 3.0)
    board.update(doubt, 4.0)
    assert [each.id % QUESTION_NUMBERS for each in board.all] == [1, 2], "another question begins anew"
    assert min(each.id for each in board.all) > 3, "a late answer means no other place"


def test_the_scatter_is_of_all_places_that_are_asked_about() -> None:
    board = Candidates(lambda *_: None)
    assert not board.scatter(Pose2(0.0, 0.0, 0.0)).any(), "nothing is asked"
    board.update(following(Pose2(0.0, 0.0, 0.0), Pose2(2.0, 0.0, 1.0)), 1.0)
    from_the_first = board.scatter(Pose2(0.0, 0.0, 0.0))
    assert from_the_first[0] == pytest.approx([2.0, 0.0, 1.0])
    assert from_the_first[1] == pytest.approx([0.0, 0.0, 0.0])
    assert from_the_first[2, 2] == pytest.approx(0.5)
