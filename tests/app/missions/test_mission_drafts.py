"""A mission that was not sent is there again on another day, for the robot that it was made for."""

from __future__ import annotations

from pathlib import Path

from app.core.settings_store import Settings
from app.link.feeds import Feeds, Post
from app.missions.mission_drafts import MissionDrafts
from app.session.robot_profile import RobotProfile
from bridge.msgs.pilothouse_msgs import Mission, RobotInfo


class Day:
    """One day with one robot."""

    def __init__(self, folder: Path) -> None:
        self.settings = Settings(folder / "settings.json")
        self.feeds = Feeds(lambda: 100.0)
        self.drafts = MissionDrafts(self.settings, RobotProfile(self.feeds, "ws://127.0.0.1:9090"))
        self.editor = self.drafts.editor

    def meet(self, name: str) -> None:
        self.feeds.put("/robot/info", Post(RobotInfo(name=name), 100.0, 1))
        self.drafts.on_introduced()

    def ends(self) -> None:
        self.settings.close()


def test_a_draft_comes_back_for_the_robot_that_it_was_made_for(tmp_path: Path) -> None:
    first = Day(tmp_path)
    first.meet("Scout-1")
    first.drafts.on_mission(Mission())
    first.editor.add(1.0, 2.0)
    first.ends()
    for name, points in (("Patrol-1", 0), ("Scout-1", 1)):
        day = Day(tmp_path)
        day.meet(name)
        assert len(day.editor.draft.points) == points
        day.ends()


def test_a_draft_that_was_sent_is_not_remembered(tmp_path: Path) -> None:
    day = Day(tmp_path)
    day.meet("Scout-1")
    day.drafts.on_mission(Mission())
    day.editor.add(1.0, 2.0)
    assert "Scout-1" in day.settings.get("drafts")
    sent = day.editor.sending()
    day.editor.answered(day.editor.sent, True, "")
    day.drafts.on_mission(sent)
    assert day.settings.get("drafts") == {}
    day.ends()


def test_the_robots_mission_waits_until_the_draft_is_back(tmp_path: Path) -> None:
    first = Day(tmp_path)
    first.meet("Scout-1")
    first.drafts.on_mission(Mission())
    first.editor.add(1.0, 2.0)
    first.ends()
    day = Day(tmp_path)
    day.drafts.on_mission(Mission())
    assert day.editor.stored is None, "nothing is compared before the draft is back"
    day.meet("Scout-1")
    assert day.editor.stored is not None
    assert day.editor.dirty
    day.ends()


def with_a_draft_of_yesterday(folder: Path) -> None:
    first = Day(folder)
    first.meet("Scout-1")
    first.drafts.on_mission(Mission())
    first.editor.add(1.0, 2.0)
    first.ends()


def test_what_is_entered_before_the_robots_name_is_known_is_nobodys_draft_yet(tmp_path: Path) -> None:
    with_a_draft_of_yesterday(tmp_path)
    day = Day(tmp_path)
    before = day.settings.get("drafts")
    day.editor.add(3.0, 4.0)
    assert day.settings.get("drafts") == before
    day.ends()


def test_what_is_entered_before_the_robots_name_is_known_is_kept_on_top_of_its_draft(tmp_path: Path) -> None:
    with_a_draft_of_yesterday(tmp_path)
    day = Day(tmp_path)
    day.editor.add(3.0, 4.0)
    day.meet("Scout-1")
    day.drafts.on_mission(Mission())
    assert day.editor.draft.points == ((3.0, 4.0),)
    day.editor.undo()
    assert day.editor.draft.points == ((1.0, 2.0),), "yesterday's is one step back"
    day.editor.redo()
    day.ends()
    again = Day(tmp_path)
    again.meet("Scout-1")
    assert again.editor.draft.points == ((3.0, 4.0),)
    again.ends()


def test_what_is_entered_before_the_name_of_a_robot_without_a_draft_is_remembered_for_it(
    tmp_path: Path,
) -> None:
    day = Day(tmp_path)
    day.editor.add(3.0, 4.0)
    day.meet("Patrol-1")
    assert list(day.settings.get("drafts")) == ["Patrol-1"]
    day.editor.undo()
    assert day.editor.draft.points == ()
    day.ends()
