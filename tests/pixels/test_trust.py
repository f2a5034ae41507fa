"""Pairing and the people as they are seen: nothing is cut, all is on the glass, and a QR code is its rows."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.label import Label
from kivy.utils import get_color_from_hex

from app.discovery.known_robots import Entry
from app.link.channels import ANSWER, Answer
from app.link.feeds import Post
from app.screens.connect.robot_card import RobotCard
from app.screens.trust.pair_dialog import PairDialog
from app.screens.trust.people_dialog import PeopleDialog
from bridge.msgs.pilothouse_msgs import GetPeopleResponse, InvitePersonResponse, Person
from robotside.trust.qr import as_rows
from widgets.core.theme import PALETTES, theme
from widgets.parts.labels import Icon
from widgets.parts.qr_code import QUIET_ZONE, QrCode

LINK = "pilothouse://192.168.1.7:9090?c=" + "ab" * 32 + "&s=" + "s" * 43 + "&n=Patrol-1"
ROWS = as_rows(LINK)
SIZES = [(412, 892), (892, 412), (1280, 800), (1920, 1200)]


@pytest.fixture(params=["dark", "sunlight"])
def palette(request):
    theme.name = request.param
    yield request.param
    theme.name = "dark"


@pytest.fixture(params=SIZES, ids=lambda size: f"{size[0]}x{size[1]}")
def page(request, stage):
    before = tuple(stage.window.size)
    stage.window.size = request.param
    made = FloatLayout(size_hint=(None, None), size=request.param)
    stage.window.add_widget(made)
    yield made
    stage.window.size = before


def session() -> Any:
    """A robot that answers as it is told, and knows no time."""
    link = SimpleNamespace(ask=lambda *_: None, robot_time=lambda: math.nan)
    robot = SimpleNamespace(name="Patrol-1")
    return SimpleNamespace(
        link=link, robot=robot, listeners=[], protected=True, own_id="me", now=lambda: 0.0, key=None
    )


def tell(dialog: PeopleDialog, service: str, message: Any) -> None:
    dialog._hear(ANSWER, Post(Answer(service, message, ""), 0.0, 1))


def pairing() -> PairDialog:
    return PairDialog(lambda _: None, robot="Patrol-1", problem="That is not the code that the robot shows.")


def people() -> PeopleDialog:
    dialog = PeopleDialog(session())
    known = [Person(id="me", name="tablet-A", role="manage", kind="handheld", connected=True)]
    known += [Person(id=f"{one}", name=f"tablet-{one}", role="drive", kind="guest") for one in range(3)]
    tell(dialog, "/people/list", GetPeopleResponse(people=known))
    return dialog


def inviting() -> PeopleDialog:
    dialog = people()
    tell(dialog, "/people/invite", InvitePersonResponse(code="493017", qr_rows=ROWS))
    return dialog


def texts(widget: Any) -> list[Label]:
    shown = (one for one in widget.walk(restrict=True) if isinstance(one, Label))
    return [
        one for one in shown if one.text and one.opacity and one.parent.opacity and not isinstance(one, Icon)
    ]


@pytest.mark.parametrize("build", [pairing, people, inviting])
def test_a_question_is_whole_on_every_glass_with_its_card_on_a_shade(
    stage, page, palette, build: Callable[[], Any]
) -> None:
    dialog = build()
    page.add_widget(dialog)
    stage.frames(8)
    card = dialog.ids.card
    assert min(card.x, card.y) >= 0
    assert card.right <= page.width
    assert card.top <= page.height
    for label in texts(card):
        assert label.texture_size[0] <= label.width + 1, f"{label.text!r} is cut"
        assert label.texture_size[1] <= label.height + 1, f"{label.text!r} is cut"
    if build is inviting:
        assert dialog.ids.qr.width >= 190, "large enough for a camera"
    picture = stage.pixels(page)[..., :3].astype(int)
    surface = np.array(get_color_from_hex(PALETTES[palette]["surface"])[:3]) * 255
    inside = picture[int(page.height - card.top) + 3, int(card.center_x)]
    assert np.abs(inside - surface).max() < 12, "the card has the colour of a card"
    within = picture[int(page.height - card.top) : int(page.height - card.y), int(card.x) : int(card.right)]
    assert (np.abs(within - surface) > 60).any(-1).mean() > 0.01, "and something is written on it"
    dialog.close()


def test_a_paired_card_says_it_in_a_word_beside_a_lock_and_its_name_is_whole(stage, page, palette) -> None:
    card = RobotCard(width=min(page.width - 28, 400))
    page.add_widget(card)
    card.show_entry(
        Entry("wss://192.168.100.141:9090", "", "", saved=True, kept=True, trust="paired"), "tablet-A"
    )
    stage.frames(6)
    title = next(one for one in texts(card) if one.text == card.title)
    assert not title.is_shortened, "the address is read whole"
    assert card.ids.trust.text == "Paired"
    for label in texts(card):
        assert label.texture_size[0] <= label.width + 1, f"{label.text!r} is cut"
        assert label.texture_size[1] <= label.height + 1, f"{label.text!r} is cut"
    picture = stage.pixels(page)[..., :3].astype(int)
    said = np.array(theme.ok[:3]) * 255
    for shown in (card.ids.lock, card.ids.trust):
        x, y = shown.to_window(*shown.pos)
        part = picture[
            int(page.height - y - shown.height) : int(page.height - y), int(x) : int(x + shown.width)
        ]
        assert (np.abs(part - said).max(-1) < 60).any(), "in its colour"


def test_the_picture_of_a_qr_code_is_its_rows_on_white(stage, palette) -> None:
    code = stage.show(QrCode(rows=ROWS), size=(330, 330))
    stage.frames(2)
    count = len(ROWS)
    across = count + 2 * QUIET_ZONE
    module = 330 // across
    picture = stage.pixels(code)[..., 0]
    edge = round(165 - module * across / 2)
    field = picture[edge : edge + module * across, edge : edge + module * across]
    seen = field[module // 2 :: module, module // 2 :: module] < 128
    inner = slice(QUIET_ZONE, QUIET_ZONE + count)
    assert ["".join("01"[int(dark)] for dark in row) for row in seen[inner, inner]] == ROWS
    seen[inner, inner] = False
    assert not seen.any(), "the quiet zone is white"
    assert module >= 4, "large enough for a camera"


@pytest.mark.parametrize("rows", [["10", "1"], ["1x", "01"], ["1" * 200] * 200, []])
def test_what_is_no_code_is_not_drawn(rows) -> None:
    assert QrCode(rows=rows).modules == 0
