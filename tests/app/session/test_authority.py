"""Who has control and who asks for it, as one handheld knows it, in virtual time."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest

from app.core.settings_store import Settings
from app.link.channels import LINK
from app.link.feeds import Feeds, Post
from app.screens.shell import status_text
from app.session.authority import LAPSE_PERIOD
from app.session.session import Session
from bridge.client.client import LinkState, Phase
from bridge.core.identity import public_id
from bridge.msgs.pilothouse_msgs import ControlStatus
from bridge.msgs.std_msgs import Time
from tests.bridge.wires import Clock

DROPPED = LinkState(Phase.WAITING, "The robot does not answer.", 1, 2.0)
BACK = LinkState(Phase.CONNECTED, "", 0, 0.0)
FREE = ControlStatus()
MINE = ControlStatus(driver="tablet", driver_id=public_id("me"))
BOBS = ControlStatus(driver="Bob", driver_id="b")


class Watch:
    """A session and what its operator is told of control."""

    def __init__(self, folder: Path, *, wants_control: bool = False) -> None:
        self.clock = Clock()
        self.asked: list[str] = []
        self.link = SimpleNamespace(
            url="ws://127.0.0.1:9090",
            state=BACK,
            silent=False,
            silence=0.0,
            health=SimpleNamespace(rtt=0.01),
            robot_time=lambda: 1000.0 + self.clock.time,
            command=lambda name, **_: self.asked.append(name),
            drive=lambda twist: self.asked.append(f"drive {twist.linear.x:g}"),
        )
        self.session = Session(
            self.link,  # type: ignore[arg-type]
            Feeds(self.clock),
            Settings(folder / "settings.json"),
            now=self.clock,
            client_id="me",
            wants_control=wants_control,
        )
        self.authority = self.session.authority
        self.news: list[tuple[str, str]] = []
        self.past = 0
        self.authority.on_news = lambda text, level: self.news.append((text, level))
        self.authority.on_past = self._past

    def _past(self) -> None:
        self.past += 1

    def told(self, status: ControlStatus) -> None:
        self.session.deliver("/control/status", Post(status, self.clock.time, 1))

    def link_becomes(self, state: LinkState) -> None:
        self.session.deliver(LINK, Post(state, self.clock.time, 1))

    def asks(self, of: ControlStatus, name: str, client: str, *, within: float = 10.0) -> ControlStatus:
        """As the robot tells it when somebody asks who has control."""
        due = Time.at(self.link.robot_time() + within)
        return ControlStatus(
            driver=of.driver, driver_id=of.driver_id, requested_by=name, requested_by_id=client, handover=due
        )


@pytest.fixture
def watch(tmp_path: Path) -> Watch:
    return Watch(tmp_path)


@pytest.mark.parametrize(
    ("status", "asked"),
    [(FREE, ["acquire"]), (BOBS, ["request"]), (MINE, ["drive 0", "release"])],
    ids=["free", "other's", "ours"],
)
def test_what_a_tap_on_control_asks_for(watch: Watch, status: ControlStatus, asked: list[str]) -> None:
    watch.told(status)
    watch.authority.toggle()
    assert watch.asked == asked


def test_whoever_has_control_given_up_the_robot_rests_first_and_the_stick_lets_go(watch: Watch) -> None:
    watch.session.on_rest = lambda: watch.asked.append("let go")
    watch.told(MINE)
    watch.session.authority.release()
    assert watch.asked == ["drive 0", "let go", "release"]


def test_a_robot_that_cannot_be_asked_is_taken_as_before(watch: Watch) -> None:
    watch.session.robot.capabilities = SimpleNamespace(
        ours=True, serves=lambda name: name != "/control/request"
    )  # type: ignore[assignment]
    watch.told(BOBS)
    watch.authority.toggle()
    assert watch.asked == ["acquire"]


def test_who_asks_sees_how_long_still_and_can_take_it_back(watch: Watch) -> None:
    watch.told(watch.asks(BOBS, "tablet", public_id("me")))
    watch.clock.time += 2.5
    assert watch.authority.asking
    assert watch.authority.left == pytest.approx(7.5)
    assert status_text.control(watch.session, brief=False)[0] == "asked Bob · 8 s"
    assert status_text.control_nav(watch.session)[0] == "Ask · 8 s"
    watch.authority.toggle()
    assert watch.asked == ["release"]
    watch.told(BOBS)
    assert (watch.news, watch.session.authority.wanted) == ([], False)


def test_the_countdown_ends_at_zero_and_is_not_guessed_without_a_clock(watch: Watch) -> None:
    watch.told(watch.asks(MINE, "Anna", "a"))
    watch.clock.time += 12.0
    assert watch.authority.left == 0.0
    watch.link.robot_time = lambda: float("nan")
    assert status_text.control(watch.session, brief=False)[0] == "Anna asks"


def test_the_driver_is_told_who_asks_and_what_became_of_it(watch: Watch) -> None:
    watch.told(MINE)
    watch.told(watch.asks(MINE, "Anna", "a"))
    assert watch.authority.asked
    assert status_text.control(watch.session, brief=False)[0] == "Anna asks · 10 s"
    watch.told(MINE)
    assert watch.news == [("You keep control: Anna does not ask any more.", "info")]


def test_who_handed_control_over_does_not_take_it_again_by_itself(watch: Watch) -> None:
    watch.session.authority.wanted = True
    watch.told(MINE)
    watch.told(watch.asks(MINE, "Anna", "a"))
    watch.told(ControlStatus(driver="Anna", driver_id="a"))
    assert watch.news == [("Anna has control now.", "info")]
    watch.told(FREE)
    assert watch.asked == []


@pytest.mark.parametrize(
    ("end", "news"),
    [(MINE, ("You have control.", "ok")), (BOBS, ("Bob keeps control.", "info"))],
    ids=["granted", "objected"],
)
def test_who_asked_is_told_the_end_of_it(watch: Watch, end: ControlStatus, news: tuple[str, str]) -> None:
    watch.told(BOBS)
    watch.told(watch.asks(BOBS, "tablet", public_id("me")))
    watch.told(end)
    assert watch.news == [news]


def test_who_watches_sees_who_asks_whom(watch: Watch) -> None:
    watch.told(BOBS)
    watch.told(watch.asks(BOBS, "Anna", "a"))
    assert status_text.control(watch.session, brief=False)[0] == "driven by Bob · Anna asks"
    assert status_text.control_nav(watch.session) == ("Ask · 10 s", "hourglass_top", "warn")
    watch.told(ControlStatus(driver="Anna", driver_id="a"))
    assert watch.news == [("Anna asks Bob for control.", "info"), ("Anna has control.", "info")]


def test_control_that_lapsed_while_the_link_was_away_is_said(watch: Watch) -> None:
    watch.told(MINE)
    watch.link_becomes(DROPPED)
    watch.link_becomes(BACK)
    watch.told(BOBS)
    assert watch.news == [("Control lost while the link was away. Bob has it now.", "warn")]


def test_control_that_lapsed_is_said_and_asked_for_again(watch: Watch) -> None:
    watch.session.authority.wanted = True
    watch.told(MINE)
    watch.told(FREE)
    assert watch.asked == ["acquire"]
    assert watch.news == [("Control lost after 2\u00a0s without contact. Requesting it again…", "warn")]


def test_control_that_lapsed_and_came_back_is_said_in_its_place(watch: Watch) -> None:
    watch.session.authority.wanted = True
    watch.told(MINE)
    watch.link_becomes(DROPPED)
    watch.link_becomes(BACK)
    watch.told(FREE)
    watch.told(MINE)
    assert watch.news[1:] == [
        ("You have control again; it lapsed while the link was away.", "info"),
    ]
    watch.told(BOBS)
    watch.told(MINE)
    assert watch.news[-1][0].startswith("Control lost"), "had again is not said twice"


def test_control_that_lapses_again_and_again_is_said_once_with_how_often(watch: Watch) -> None:
    watch.session.authority.wanted = True
    for _ in range(3):
        watch.told(MINE)
        watch.told(FREE)
        watch.clock.time += 4.0
    watch.told(MINE)
    after = "after 2\u00a0s without contact"
    assert watch.news == [
        (f"Control lost {after}. Requesting it again…", "warn"),
        (f"You have control again; it lapsed {after}.", "info"),
        (f"Control lapsed 2 times, last {after}.", "warn"),
        (f"Control lapsed 3 times, last {after}.", "warn"),
    ]
    assert watch.past == 1, "nothing is taken back: it was heard at first, and what is counted stays true"
    watch.clock.time += LAPSE_PERIOD + 1.0
    watch.told(FREE)
    assert watch.news[-1] == watch.news[0], "long after that it is news again"
    watch.told(BOBS)
    watch.told(MINE)
    watch.told(BOBS)
    assert "Bob has it now." in watch.news[-1][0], "that somebody else has it is said however often it lapsed"


@pytest.mark.parametrize("then", ["FREE", "CAROL", "ASKED"])
def test_what_was_told_is_past_as_soon_as_control_changes_again(watch: Watch, then: str) -> None:
    watch.told(BOBS)
    watch.told(watch.asks(BOBS, "tablet", public_id("me")))
    watch.told(BOBS)
    watch.told(BOBS)
    assert (watch.news, watch.past) == ([("Bob keeps control.", "info")], 2), "heard, and asked for"
    later = {
        "FREE": FREE,
        "CAROL": ControlStatus(driver="Carol", driver_id="c"),
        "ASKED": watch.asks(BOBS, "tablet", public_id("me")),
    }
    watch.told(later[then])
    assert watch.past == 3


def test_control_that_was_given_back_did_not_lapse(watch: Watch) -> None:
    watch.told(MINE)
    watch.session.authority.release()
    watch.told(MINE)
    watch.told(FREE)
    assert watch.news == []


def test_nobody_claims_control_over_a_link_that_is_silent(watch: Watch) -> None:
    watch.told(MINE)
    watch.link.silence = 1.9
    assert watch.session.control == "mine"
    watch.link.silence = 2.1
    assert watch.session.control == "unknown"


def test_a_long_name_is_cut_in_the_bar(watch: Watch) -> None:
    watch.told(ControlStatus(driver="the tablet of the harbour master", driver_id="b"))
    assert status_text.control(watch.session, brief=True)[0] == "the tablet of…"


def test_a_phone_says_who_drives_by_name_and_sign(watch: Watch) -> None:
    watch.told(FREE)
    assert status_text.control_nav(watch.session) == ("Control", "lock_open", "")
    watch.told(MINE)
    assert status_text.control_nav(watch.session) == ("You", "person", "")
    watch.told(BOBS)
    assert status_text.control_nav(watch.session) == ("Bob", "lock", "warn")
    watch.told(ControlStatus(driver="Anna's tablet", driver_id="a"))
    assert status_text.control_nav(watch.session)[0] == "Anna's…"
    watch.link.silence = 2.1
    assert status_text.control_nav(watch.session) == ("Control", "help", "")


def test_control_that_is_free_is_asked_for_once_each_time_that_it_becomes_free(tmp_path: Path) -> None:
    watch = Watch(tmp_path, wants_control=True)
    for _ in range(3):
        watch.told(FREE)
    assert watch.asked == ["acquire"], "the robot tells it twice a second, and its answer is on its way"
    watch.told(BOBS)
    assert watch.asked == ["acquire"], "nobody takes it from Bob by himself"
    for _ in range(3):
        watch.told(FREE)
    assert watch.asked == ["acquire", "acquire"]
    watch.link_becomes(DROPPED)
    watch.link_becomes(BACK)
    watch.told(FREE)
    watch.told(FREE)
    assert watch.asked == ["acquire"] * 3
