"""Questions over everything else: STOP is seen through their shade, is left free by their card and takes its finger."""

from __future__ import annotations

import pytest

from app.discovery.simulator_options import SimulationChoice
from app.layout.rects import Rect
from app.screens.connect.simulator_dialog import SimulatorDialog
from app.screens.parts.dialogs import AddressDialog, Question, free_room
from app.screens.parts.leave_dialog import LeaveDialog
from app.screens.shell.key_help import HelpCard
from app.screens.trust.pair_dialog import PairDialog
from bridge.trust.pairing import PairLink
from tests.app.glass import Glass
from tests.headless import Stage

SIZES = [(412, 892), (892, 412), (1280, 800)]
WHOLE = Rect(0, 0, 800, 600)


def questions() -> list[Question]:
    many = [([str(number)], "What it does, in words") for number in range(60)]
    help_ = HelpCard()
    help_.show([("STOP", [(["Esc"], "STOP")]), ("Robot", many)])
    link = PairLink("10.0.0.12", 9090, "ab" * 32, "s" * 22, "Patrol-1")
    return [
        help_,
        AddressDialog(lambda _: None),
        LeaveDialog(lambda: None, robot="Patrol-1"),
        SimulatorDialog(SimulationChoice(), lambda _: None),
        PairDialog(lambda _: None, robot="Patrol-1"),
        PairDialog(lambda _: None, link=link),
    ]


def test_a_card_may_be_anywhere_where_there_is_no_stop() -> None:
    assert free_room(WHOLE, [], 8) == WHOLE


@pytest.mark.parametrize(
    ("stop", "room"),
    [
        (Rect(600, 10, 190, 90), Rect(0, 108, 800, 492)),
        (Rect(600, 10, 190, 580), Rect(0, 0, 592, 600)),
        (Rect(0, 500, 800, 100), Rect(0, 0, 800, 492)),
    ],
)
def test_its_room_is_the_largest_beside_stop(stop: Rect, room: Rect) -> None:
    assert free_room(WHOLE, [stop], 8) == room


@pytest.mark.parametrize(
    ("wanted", "room"),
    [
        ((468, 300), Rect(0, 408, 412, 484)),
        ((0, 0), Rect(0, 0, 232, 892)),
        ((468, 600), Rect(0, 0, 232, 892)),
    ],
)
def test_a_phones_card_lies_above_a_tall_stop_where_that_holds_it(
    wanted: tuple[float, float], room: Rect
) -> None:
    assert free_room(Rect(0, 0, 412, 892), [Rect(240, 200, 160, 200)], 8, wanted) == room


def test_the_address_has_room_for_all_its_figures_on_a_phone(driving: Glass, stage: Stage) -> None:
    app, before = driving.app, tuple(stage.window.size)
    stage.window.size = app.root.size = (412, 892)
    try:
        app.show("drive")
        dialog = AddressDialog(lambda _: None)
        app.root.add_widget(dialog)
        stage.frames(6)
        assert dialog.ids.card.width >= 380
    finally:
        dialog.close()
        stage.window.size = app.root.size = before
        stage.frames(3)


def test_stop_acts_under_every_question_at_every_shape_of_the_glass(driving: Glass, stage: Stage) -> None:
    app, before = driving.app, tuple(stage.window.size)
    stop, pressed = app.shell.stop, []
    stop.bind(pressed=lambda _, fingers: pressed.append(fingers))
    try:
        for size in SIZES:
            stage.window.size = app.root.size = size
            for screen in ("drive", "mission"):
                app.show(screen)
                for question in questions():
                    app.root.add_widget(question)
                    stage.frames(6)
                    case = (size, screen, type(question).__name__)
                    card = question.ids.card
                    place = Rect(*stop.pos, *stop.size)
                    assert not Rect(*card.pos, *card.size).overlaps(place), case
                    assert Rect(0, 0, *size).holds(Rect(*card.pos, *card.size)), case
                    assert tuple(question.hole) == (*stop.pos, *stop.size), case
                    for at in (stop.center, (stop.x + 4, stop.y + 4), (stop.right - 4, stop.top - 4)):
                        pressed.clear()
                        stage.tap(*at)
                        assert pressed == [1, 0], case
                    assert question.parent is app.root, "and what was asked is still asked"
                    question.close()
    finally:
        stage.window.size = app.root.size = before
    assert app.session.robot_stop.latched


def test_a_finger_beside_the_card_still_closes_it_and_reaches_nothing_else(driving: Glass) -> None:
    app, (question, *_) = driving.app, questions()
    app.root.add_widget(question)
    driving.stage.frames(4)
    driving.stage.tap(3, 3)
    assert question.parent is None
    assert not app.session.robot_stop.latched
