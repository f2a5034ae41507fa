"""Pairing on the glass: by a robot's card, by a link, and what is kept of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from app.link.feeds import Post
from app.robot_trust import NO_ROBOT
from app.screens.parts.dialogs import AddressDialog
from app.screens.trust.pair_dialog import PairDialog
from app.trust.pairing_attempts import PAIRING, Attempt
from bridge.client.pairing import Paired
from bridge.core.identity import Role
from bridge.trust.pairing import PairLink
from bridge.trust.robot_link import RobotLink
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.bridge.certificates import served
from tests.bridge.fronts import front

KEY = served("patrol")[1]
LINK = PairLink("127.0.0.1", 9, KEY, "s" * 22, "Fake-1").text


class Attempts:
    """Attempts that a test ends."""

    def __init__(self) -> None:
        self.asked: list[tuple[Any, ...]] = []
        self.cancelled = 0

    def by_link(self, link: PairLink) -> int:
        self.asked.append((link.text,))
        return len(self.asked)

    def by_code(self, url: str, code: str) -> int:
        self.asked.append((url, code))
        return len(self.asked)

    def cancel(self) -> None:
        self.cancelled += 1


@contextmanager
def tls(robot: FakeRobot, name: str = "patrol") -> Iterator[int]:
    """The robot behind a certificate; its port."""
    around = front(name, robot.port)
    port = robot.network.start(around.__aenter__()).result(5)
    try:
        yield port
    finally:
        robot.network.start(around.__aexit__(None, None, None)).result(5)


@pytest.fixture
def attempts(glass: Glass) -> Attempts:
    made = Attempts()
    glass.app.robot_list.trust.attempts = made
    return made


def ends(glass: Glass, number: int, paired: Paired | None = None, problem: str = "") -> None:
    """An attempt ends."""
    glass.app._deliver(PAIRING, Post(Attempt(number, paired, problem), 0.0, 1))
    glass.stage.frames(2)


def paired(port: int = 9) -> Paired:
    return Paired(f"wss://127.0.0.1:{port}", KEY, "me.secret", "me", Role.DRIVE, math.nan, "Fake-1")


def dialog(glass: Glass) -> PairDialog | None:
    glass.stage.frames(2)
    return next((child for child in glass.app.root.children if isinstance(child, PairDialog)), None)


def type_code(glass: Glass, code: str) -> None:
    keys = {button.text: button for button in dialog(glass).ids.pad.children}
    for digit in code:
        glass.tap(keys[digit])


def test_a_robot_that_is_not_paired_asks_for_its_code_and_is_connected_to_by_its_key(
    glass: Glass, robot: FakeRobot, attempts: Attempts
) -> None:
    with tls(robot) as port:
        url = f"wss://127.0.0.1:{port}"
        glass.app.open(url)
        assert dialog(glass).title == f"Pair with 127.0.0.1:{port}"
        assert glass.app.session is None
        type_code(glass, "493017")
        assert dialog(glass).ids.field.text == "493 017"
        glass.tap(dialog(glass).ids.pair)
        assert attempts.asked == [(url, "493 017")]
        assert dialog(glass).busy
        ends(glass, 1, paired(port))
        assert dialog(glass) is None
        glass.until(lambda: glass.app.shell is not None, "no screens")
        assert glass.app.session.link._client.fingerprint == KEY
        assert glass.app.session.own_id == "me"
        glass.app.leave()


def test_a_paired_robot_is_not_asked_about_again(glass: Glass, robot: FakeRobot) -> None:
    with tls(robot) as port:
        glass.app.robot_list.trust.keys.add(paired(port))
        glass.app.open(f"ws://127.0.0.1:{port}")
        glass.until(lambda: glass.app.shell is not None, "no screens")
        assert glass.app.session.link._client.fingerprint == KEY, (
            "by TLS, though its address says nothing of it"
        )
        glass.app.leave()


def test_stop_all_reaches_a_paired_robot_by_its_key(glass: Glass, robot: FakeRobot) -> None:
    with tls(robot) as port:
        url = f"ws://127.0.0.1:{port}"
        glass.app.robot_list.trust.keys.add(paired(port))
        glass.app.robots.add(url)
        glass.app.fleet.press(glass.app.robots.entries())
        glass.until(lambda: any(name == "/stop" for name, _ in robot.asked), "no STOP")
        glass.app.fleet.let_go()


def test_another_robot_at_a_paired_robots_address_is_said_and_no_screens_come(
    glass: Glass, robot: FakeRobot
) -> None:
    with tls(robot, "another") as port:
        glass.app.robot_list.trust.keys.add(paired(port))
        glass.app.open(f"ws://127.0.0.1:{port}")
        said = "its key is not the one of Fake-1"
        glass.until(
            lambda: glass.app.connect._banner and said in glass.app.connect._banner.text, "nothing said"
        )
        assert glass.app.shell is None
        assert not robot.asked
        glass.app.leave()


def test_a_wrong_code_is_said_and_can_be_typed_again(glass: Glass, attempts: Attempts) -> None:
    glass.app.open("wss://127.0.0.1:9")
    dialog(glass).ids.field.text = "493018"
    glass.tap(dialog(glass).ids.pair)
    ends(glass, 1, problem="That is not the code.")
    assert dialog(glass).problem == "That is not the code."
    assert not dialog(glass).busy
    type_code(glass, "4")
    assert not dialog(glass).problem


@pytest.mark.parametrize(
    ("text", "said"), [("12345", "6 digits"), ("", "6 digits"), ("pilothouse://x", "no link of a robot")]
)
def test_what_is_neither_code_nor_link_reaches_no_robot(
    glass: Glass, attempts: Attempts, text: str, said: str
) -> None:
    glass.app.open("wss://127.0.0.1:9")
    dialog(glass).ids.field.text = text
    glass.tap(dialog(glass).ids.pair)
    assert said in dialog(glass).problem
    assert not attempts.asked


@pytest.mark.parametrize("size", [(412, 892), (892, 412), (1280, 800), (1920, 1200)])
def test_the_question_fits_every_glass_with_keys_for_a_thumb(
    glass: Glass, attempts: Attempts, size: tuple[int, int]
) -> None:
    window, root = glass.stage.window, glass.app.root
    before = tuple(window.size)
    window.size = root.size = size
    try:
        glass.app.open("wss://127.0.0.1:9")
        asks = dialog(glass)
        asks.problem = "That is not the code of this robot; after five wrong ones there is a pause."
        glass.stage.frames(6)
        card = asks.ids.card
        assert card.x >= 0
        assert card.y >= 0
        assert card.right <= size[0]
        assert card.top <= size[1]
        assert all(min(key.size) >= 48 for key in asks.ids.pad.children)
        assert len({key.pos[0] for key in asks.ids.pad.children}) == asks.ids.pad.cols
        asks.close()
    finally:
        window.size = root.size = before


def test_a_code_needs_a_robot(glass: Glass, attempts: Attempts) -> None:
    glass.app.robot_list.trust.ask()
    dialog(glass).ids.field.text = "493017"
    glass.tap(dialog(glass).ids.pair)
    assert dialog(glass).problem == NO_ROBOT
    assert not attempts.asked


def test_an_opened_link_is_not_followed_before_a_person_says_so(glass: Glass, attempts: Attempts) -> None:
    """Any web page can open one."""
    glass.app.open(LINK)
    assert dialog(glass).title == "Pair with Fake-1?"
    assert not attempts.asked
    glass.tap(dialog(glass).ids.pair)
    assert attempts.asked == [(LINK,)]


def test_an_opened_link_to_a_robot_connects_once_a_person_says_so(glass: Glass, robot: FakeRobot) -> None:
    """Any web page can open one."""
    link = RobotLink.of(robot.url, "Fake-1")
    glass.app.open(link.text)
    asks = next(each for each in glass.app.root.children if isinstance(each, AddressDialog))
    assert asks.ids.field.text == robot.url
    glass.stage.frames(6)
    assert glass.app.session is None
    asks.answer()
    glass.until(lambda: glass.app.shell is not None, "no screens")
    assert glass.app.session.robot.url == robot.url
    glass.app.leave()


@pytest.mark.parametrize("way", ["typed", "pasted"])
def test_a_robots_link_connects_where_an_address_is_typed_and_where_a_pairing_link_is_pasted(
    glass: Glass, robot: FakeRobot, way: str
) -> None:
    link = RobotLink.of(robot.url, "Fake-1").text
    if way == "typed":
        glass.app.robot_list.open_typed(f" {link} ")
    else:
        glass.app.robot_list.trust.ask()
        dialog(glass).ids.field.text = link
        glass.tap(dialog(glass).ids.pair)
        assert dialog(glass) is None
    glass.until(lambda: glass.app.shell is not None, "no screens")
    glass.app.leave()


def test_a_link_to_a_robot_that_is_reached_by_tls_asks_for_its_code(glass: Glass, attempts: Attempts) -> None:
    glass.app.robot_list.open_typed(RobotLink("127.0.0.1", 9, True, "Fake-1").text)
    assert dialog(glass).takes_code
    assert not attempts.asked


def test_a_damaged_link_is_one_sentence(glass: Glass) -> None:
    glass.app.open("pilothouse://nowhere?c=1")
    assert dialog(glass) is None
    assert "no pairing link" in glass.app.connect._banner.text


def test_a_closed_question_ends_the_attempt_and_its_answer_comes_too_late(
    glass: Glass, attempts: Attempts
) -> None:
    glass.app.open(LINK)
    glass.tap(dialog(glass).ids.pair)
    glass.tap(dialog(glass).ids.cancel)
    assert attempts.cancelled
    ends(glass, 1, paired())
    assert not list(glass.app.robot_list.trust.keys)
    assert glass.app.session is None


def test_a_robot_of_this_program_is_paired_without_a_question(
    glass: Glass, robot: FakeRobot, attempts: Attempts
) -> None:
    with tls(robot) as port:
        glass.app.robot_list.trust.pair_silently([LINK, "rubbish"], f"ws://127.0.0.1:{port}")
        assert attempts.asked == [(LINK,)]
        ends(glass, 1, paired(port))
        assert dialog(glass) is None
        glass.until(lambda: glass.app.shell is not None, "no screens")
        assert glass.app.session.link._client.fingerprint == KEY
        glass.app.leave()
    glass.app.robot_list.trust.pair_silently([LINK])
    assert len(attempts.asked) == 1, "it is paired already"


def test_where_silent_pairing_fails_the_robot_is_connected_to_all_the_same(
    glass: Glass, robot: FakeRobot, attempts: Attempts
) -> None:
    """It is on this machine, where no key is needed."""
    glass.app.robot_list.trust.pair_silently([LINK], robot.url)
    ends(glass, 1, problem="Pairing is closed.")
    glass.until(lambda: glass.app.shell is not None, "no screens")
    glass.app.leave()


def test_a_robot_that_forgot_this_handheld_asks_to_pair_again(
    glass: Glass, attempts: Attempts, refusing: Callable[[int], int]
) -> None:
    port = refusing(401)
    glass.app.robot_list.trust.keys.add(paired(port))
    glass.app.open(f"wss://127.0.0.1:{port}")
    glass.until(lambda: dialog(glass) is not None, "no question")
    assert dialog(glass).problem == "This robot does not know this handheld any more; pair again."
    assert glass.app.session is None


@pytest.fixture
def refusing(robot: FakeRobot) -> Iterator[Callable[[int], int]]:
    """Starts a TLS server that answers each handshake with a status; gives its port."""
    from websockets.asyncio.server import serve

    servers: list[Any] = []

    async def start(status: int) -> int:
        made = await serve(
            lambda ws: ws.wait_closed(),
            "127.0.0.1",
            0,
            ssl=served("patrol")[0],
            process_request=lambda made, _: made.respond(status, "No."),
        )
        servers.append(made)
        return int(made.sockets[0].getsockname()[1])

    async def stop() -> None:
        for made in servers:
            made.close()
            await made.wait_closed()

    yield lambda status: robot.network.start(start(status)).result(5)
    robot.network.start(stop()).result(5)


def test_undo_brings_back_the_key_and_the_card(glass: Glass) -> None:
    trust, url = glass.app.robot_list.trust, "wss://127.0.0.1:9"
    trust.keys.add(paired(9))
    glass.app.robots.add(url)
    glass.app.robot_list.forget(url)
    assert not [card for card in glass.app.connect.cards if card.entry.url == url]
    glass.tap(glass.app.connect._banner)
    assert [card.trust_text for card in glass.app.connect.cards if card.entry.url == url] == ["Paired"]
    assert trust.key_for(url) is not None


def test_after_a_wrong_code_the_next_digit_begins_anew(glass: Glass, attempts: Attempts) -> None:
    glass.app.open("wss://127.0.0.1:9")
    type_code(glass, "493018")
    glass.tap(dialog(glass).ids.pair)
    ends(glass, 1, problem="That is not the code.")
    type_code(glass, "49")
    assert dialog(glass).ids.field.text == "49"


def test_where_only_a_link_helps_no_digits_are_offered(glass: Glass) -> None:
    glass.app.robot_list.trust.ask()
    assert [key.text for key in dialog(glass).ids.pad.children] == ["Paste"]
    dialog(glass).close()


def test_a_link_of_another_robot_pasted_for_this_one_leads_to_the_one_that_it_names(
    glass: Glass, attempts: Attempts, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    glass.app.open("wss://127.0.0.1:8")
    monkeypatch.setattr(glass.app, "open", opened.append)
    dialog(glass).ids.field.text = LINK
    glass.tap(dialog(glass).ids.pair)
    ends(glass, 1, paired(9))
    assert opened == ["wss://127.0.0.1:9"]


def test_a_link_under_the_name_of_a_paired_robot_and_one_that_is_paired_are_said(
    glass: Glass, attempts: Attempts
) -> None:
    trust = glass.app.robot_list.trust
    trust.keys.add(paired(9))
    glass.app.open(LINK)
    assert "paired with it already" in dialog(glass).problem
    glass.app.open(PairLink("127.0.0.1", 9, "ab" * 32, "s" * 22, "FAKE-1").text)
    assert dialog(glass).problem == "This is not the Fake-1 that you paired: another robot uses its name."
    dialog(glass).close()


def test_a_question_that_another_page_took_away_ends_its_attempt(glass: Glass, attempts: Attempts) -> None:
    glass.app.open("wss://127.0.0.1:9")
    type_code(glass, "493017")
    glass.tap(dialog(glass).ids.pair)
    cancelled = attempts.cancelled
    glass.app.show_inputs()
    assert dialog(glass) is None
    assert attempts.cancelled == cancelled + 1
    ends(glass, 1, paired())
    assert not list(glass.app.robot_list.trust.keys)


def test_enter_hands_the_code_over_and_back_closes_the_question(glass: Glass, attempts: Attempts) -> None:
    glass.app.open("wss://127.0.0.1:9")
    field = dialog(glass).ids.field
    field.text = "493017"
    field.keyboard_on_key_down(None, (13, "enter"), "", [])
    assert attempts.asked == [("wss://127.0.0.1:9", "493 017")]
    assert glass.app.back()
    assert dialog(glass) is None


def test_the_name_of_a_robot_has_the_whole_width_of_its_card(glass: Glass) -> None:
    glass.app.robots.add("ws://192.168.100.141:9090")
    window, root = glass.stage.window, glass.app.root
    before = tuple(window.size)
    window.size = root.size = (412, 892)
    try:
        glass.stage.run_for(1.0)
        (card,) = glass.app.connect.cards
        assert card.trust_text == "Not protected"
        title = next(one for one in card.walk() if getattr(one, "text", "") == card.title)
        title.texture_update()
        assert title.width >= 180
        assert card.ids.trust.right <= card.right
    finally:
        window.size = root.size = before
