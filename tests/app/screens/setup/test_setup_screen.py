"""The setup screen: it shows what the robot said, asks for what a finger wants, and says what the robot has against it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from kivy.core.window import Window

from app.screens.parts.guide_text import LINES, pieces
from app.screens.setup.screen import SetupScreen
from app.screens.setup.setup_row import broken
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    BringDownGatewayRequest,
    BringUpGatewayRequest,
    Gateway,
    GatewayArray,
    Payload,
    PayloadArray,
    SetPayloadRequest,
)
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.core.base import text_texture
from widgets.core.theme import theme
from widgets.parts.kit import Roll

MQTT, ARM = ("/gateways", "mqtt"), ("/payloads", "arm")
ROS = Gateway("rosbridge", "the app", fixed=True, state="up", endpoint="ws://192.0.2.7:9090")
DOWN = Gateway(
    "mqtt",
    "topics at a broker",
    state="down",
    usual="own://127.0.0.1:1883",
    schemes=["mqtt:1883", "mqtts:8883", "own:1883"],
    listens=["own"],
)
UP = Gateway(
    "mqtt",
    "topics at a broker",
    state="up",
    endpoint="mqtt://192.0.2.7:1883/x",
    options=["rate=5"],
    qr_rows=["1"],
    guide="\n".join(f"line {number}" for number in range(50)),
    usual=DOWN.usual,
    schemes=DOWN.schemes,
)


class Setup:
    """The screen on the glass, and the robot that tells it."""

    def __init__(self, glass: Glass, robot: FakeRobot) -> None:
        self.glass, self.robot = glass, robot
        glass.app.show("setup")
        self.screen: SetupScreen = glass.app.screens["setup"]

    def tell(self, *gateways: Gateway, payloads: tuple[Payload, ...] = ()) -> None:
        """The robot tells, over its link, what the screen listens to."""
        told: list[tuple[str, Msg]] = [
            ("/gateways", GatewayArray(gateways=[ROS, *gateways])),
            ("/payloads", PayloadArray(payloads=list(payloads))),
        ]

        def heard() -> bool:
            for topic, message in told:
                self.robot.publish(topic, message)
            setup = self.screen.robot.setup
            return setup.gateways == [ROS, *gateways] and setup.payloads == list(payloads)

        self.glass.until(heard, "the robot is not heard")
        self.glass.stage.run_for(0.3, 1 / 10)

    def tap_in_list(self, widget: Any) -> None:
        """Roll the list to a row or to what is in it, and tap it."""
        roll = next(one for one in widget.walk_reverse() if isinstance(one, Roll))
        roll.scroll_to(widget, animate=False)
        self.glass.stage.run_for(0.3, 1 / 10)
        self.glass.tap(widget)

    def asked(self, kind: type[Msg]) -> list[Any]:
        return [request for _, request in self.robot.asked if isinstance(request, kind)]

    def pane(self) -> Any:
        shown = self.screen._shown()
        assert shown is not None
        return self.screen.robot.panes[shown]


@pytest.fixture
def setup(driving: Glass, robot: FakeRobot) -> Iterator[Setup]:
    made = Setup(driving, robot)
    yield made
    made.screen.leave()


def test_a_switch_asks_and_shows_what_the_robot_says(setup: Setup) -> None:
    setup.tell(DOWN)
    row = setup.screen.rows[MQTT]
    assert (row.switch.active, row.switch.disabled) == (False, False)
    setup.tap_in_list(row.switch)
    setup.glass.until(lambda: setup.asked(BringUpGatewayRequest), "not asked")
    (request,) = setup.asked(BringUpGatewayRequest)
    assert (request.name, request.url) == ("mqtt", "own://127.0.0.1:1883")
    assert not row.switch.active, "the robot has not said that it is up"
    setup.tell(Gateway("mqtt", state="coming_up", schemes=DOWN.schemes))
    assert row.detail.startswith("Coming up …")
    assert not row.switch.active
    setup.tell(UP)
    assert row.switch.active
    assert row.detail == "mqtt://192.0.2.7:1883/x"
    setup.tap_in_list(row.switch)
    setup.glass.until(lambda: setup.asked(BringDownGatewayRequest), "not asked")
    assert row.switch.active
    setup.tell(DOWN)
    assert not row.switch.active


def test_what_is_typed_is_asked_for_and_what_is_wrong_stays_here(setup: Setup) -> None:
    setup.tell(DOWN)
    setup.screen.chosen = MQTT
    setup.glass.stage.frames(3)
    pane, form = setup.pane(), setup.pane().form
    form.scheme.choose("mqtt")
    fields = form.fields
    fields["host"].text, fields["user"].text, fields["password"].text = "broker", "anna", "a/b"
    fields["port"].text = "70000"
    setup.glass.tap(pane.up)
    setup.glass.stage.frames(5)
    assert form.problem.text == "A port is 0 to 65535, not '70000'."
    assert fields["port"].wrong
    assert not setup.asked(BringUpGatewayRequest)
    fields["port"].text = ""
    form.role.choose("drive")
    setup.glass.tap(pane.up)
    setup.glass.until(lambda: setup.asked(BringUpGatewayRequest), "not asked")
    (request,) = setup.asked(BringUpGatewayRequest)
    assert request.url == "mqtt://anna:a%2Fb@broker:1883?role=drive"
    assert form.problem.text == ""


def test_a_scheme_shows_the_fields_it_has_a_use_for_and_its_usual_port(setup: Setup) -> None:
    setup.tell(DOWN)
    setup.screen.chosen = MQTT
    form = setup.pane().form
    assert form.fields["password"].parent is None, "a broker of the robot's own knows no users"
    form.scheme.choose("mqtts")
    assert form.fields["password"].parent is not None
    assert form.fields["port"].text == "8883"
    assert form.fields["password"].password


def test_a_port_of_five_digits_is_read_whole_beside_the_sign_that_it_is_wrong(
    setup: Setup, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = Window.size
    monkeypatch.setattr(Window, "create_window", lambda *_: None)
    Window.size = setup.glass.app.root.size = (412, 892)
    try:
        setup.tell(DOWN)
        setup.screen.chosen = MQTT
        setup.glass.stage.run_for(0.3, 1 / 10)
        form = setup.pane().form
        port = form.fields["port"]
        port.text, port.wrong = "70000", True
        setup.glass.stage.frames(3)
        room = port.width - port.padding[0] - port.padding[2]
        assert text_texture("70000", port.font_size, theme.font).width <= room
        assert form.role.height >= theme.target
    finally:
        Window.size = before
        setup.glass.app.root.size = before


def test_a_refusal_is_said_where_it_was_asked(setup: Setup) -> None:
    setup.robot.refusals["/gateways/bring_up"] = "Port 1883 on 127.0.0.1 is taken."
    setup.tell(DOWN)
    setup.screen.chosen = MQTT
    setup.glass.stage.frames(3)
    setup.glass.tap(setup.pane().up)
    row = setup.screen.rows[MQTT]
    setup.glass.until(lambda: row.role == "danger", "no refusal")
    assert row.detail == setup.pane().refusal.text == "Port 1883 on 127.0.0.1 is taken."
    assert not row.switch.active


def test_what_is_up_has_its_code_and_a_guide_in_pieces_that_can_be_drawn(setup: Setup) -> None:
    setup.tell(UP)
    setup.screen.chosen = MQTT
    setup.glass.stage.frames(3)
    pane = setup.pane()
    assert (pane.state.text, pane.qr.rows, pane.form.parent) == ("mqtt://192.0.2.7:1883/x", ["1"], None)
    assert not pane.guide.children
    setup.glass.tap(pane.more)
    setup.glass.stage.frames(5)
    shown = [label.text for label in reversed(pane.guide.children)]
    assert "\n".join(shown) == UP.guide
    assert all(text.count("\n") < LINES for text in shown)
    assert list(pieces("")) == []


def test_an_address_of_the_robots_own_machine_is_no_code_for_others(setup: Setup) -> None:
    setup.tell(Gateway("mqtt", state="up", endpoint="mqtt://127.0.0.1:1883/x", qr_rows=["1"]))
    setup.screen.chosen = MQTT
    setup.glass.stage.frames(3)
    pane = setup.pane()
    assert (pane.qr.parent, pane.own.parent) == (None, pane.column)
    assert pane.own.text == "Only the robot's own machine reaches it."
    setup.tell(UP)
    assert (pane.qr.parent, pane.own.parent) == (pane.column, None)


def test_what_comes_in_place_of_a_long_guide_begins_at_the_top(setup: Setup) -> None:
    setup.tell(UP)
    setup.screen.chosen = MQTT
    setup.glass.stage.frames(3)
    pane = setup.pane()
    setup.glass.tap(pane.more)
    setup.glass.stage.frames(5)
    shown = list(reversed(pane.column.children))
    assert shown.index(pane.down) < shown.index(pane.guide), "it is reached without the whole guide"
    pane.scroll_y = 0
    setup.tell(DOWN)
    assert pane.scroll_y == 1
    setup.glass.stage.frames(3)
    assert abs(pane.column.to_window(0, pane.column.top)[1] - pane.to_window(0, pane.top)[1]) < 1


def test_an_option_has_its_unit(setup: Setup) -> None:
    setup.tell(UP)
    setup.screen.chosen = MQTT
    setup.glass.stage.frames(3)
    assert setup.pane().options.text == "5 Hz per topic"


def test_the_usual_role_is_said(setup: Setup) -> None:
    setup.tell(DOWN)
    setup.screen.chosen = MQTT
    form = setup.pane().form

    def usual() -> str:
        return next(child.text for child in form.children if getattr(child, "text", "").startswith("Without"))

    assert usual() == "Without a token everybody there may; usual: as over rosbridge"
    form.scheme.choose("mqtt")
    assert usual() == "Without a token everybody there may; usual: watch"


def test_an_address_breaks_at_a_slash_and_not_in_a_word(setup: Setup) -> None:
    address = "kafka://127.0.0.1:38717/pilothouse/Patrol-1 · x"
    assert broken(address, 900, 13) == address
    lines = broken(address, 200, 13).split("\n")
    assert len(lines) > 1
    assert "".join(lines) == address
    assert all(line.startswith("/") for line in lines[1:])
    assert broken("one word", 200, 13) == "one word"


def test_payloads_are_switched_and_what_is_fixed_has_no_switch_but_a_reason(setup: Setup) -> None:
    laser = Payload("laser", "a laser scanner", on=True, fixed=True, why="It keeps the robot off obstacles.")
    arm = Payload("arm", "an arm", on=True, topics=["/arm"], services=["/arm/move"])
    setup.tell(payloads=(laser, arm))
    fixed, row = setup.screen.rows["/payloads", "laser"], setup.screen.rows[ARM]
    assert fixed.switch.parent is None
    assert fixed.detail == "It keeps the robot off obstacles."
    setup.tap_in_list(row.switch)
    setup.glass.until(lambda: setup.asked(SetPayloadRequest), "not asked")
    (request,) = setup.asked(SetPayloadRequest)
    assert (request.key, request.on) == ("arm", False)
    assert row.switch.active, "the robot has not said that it is off"
    setup.tell(payloads=(laser, Payload("arm", "an arm", why="Anna switched arm off.")))
    assert not row.switch.active
    assert row.detail == "Anna switched arm off."
    setup.screen.chosen = ARM
    setup.glass.stage.frames(3)
    setup.glass.tap(setup.pane().switch)
    setup.glass.until(lambda: len(setup.asked(SetPayloadRequest)) == 2, "not asked")
    assert setup.asked(SetPayloadRequest)[1].on


def test_without_a_link_nothing_can_be_switched(setup: Setup) -> None:
    setup.tell(DOWN)
    setup.robot.stop()
    setup.glass.until(lambda: not setup.glass.app.session.connected, "still connected")
    setup.glass.stage.run_for(0.3, 1 / 10)
    assert setup.screen.rows[MQTT].switch.disabled
    assert setup.screen.about.text.startswith("There is no link; what can be seen was so before.")
    setup.robot.start()


def test_the_robot_need_not_tell_who_does_not_look(setup: Setup) -> None:
    setup.tell(DOWN)
    setup.glass.app.show("drive")
    assert setup.screen.robot.setup.gateways == []
    sources = setup.glass.app.session.link._sources
    setup.glass.until(lambda: "/gateways" not in sources._ends, "still listens")


def test_who_comes_back_sees_what_the_robot_says_then_and_what_was_typed(setup: Setup) -> None:
    setup.tell(DOWN)
    setup.screen.chosen = MQTT
    setup.pane().form.fields["host"].text = "broker"
    setup.glass.app.show("drive")
    setup.glass.app.show("setup")
    setup.tell(UP)
    assert setup.screen.rows[MQTT].switch.active
    setup.tell(DOWN)
    assert setup.pane().form.fields["host"].text == "broker"


def test_on_a_phone_a_pane_takes_the_place_of_the_list_and_back_leads_to_it(
    setup: Setup, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = Window.size
    monkeypatch.setattr(Window, "create_window", lambda *_: None)
    Window.size = setup.glass.app.root.size = (412, 892)
    try:
        setup.tell(DOWN)
        listed, detail = setup.screen.ids.listed, setup.screen.ids.detail
        assert (listed.parent, detail.parent) == (setup.screen, None)
        setup.tap_in_list(setup.screen.rows[MQTT])
        setup.glass.stage.frames(3)
        assert (listed.parent, detail.parent) == (None, setup.screen)
        assert setup.screen.back_head.sentence == ""
        setup.robot.stop()
        setup.glass.until(lambda: not setup.glass.app.session.connected, "still connected")
        setup.glass.stage.run_for(0.3, 1 / 10)
        assert setup.screen.back_head.sentence.startswith("There is no link; what can be seen was so before.")
        setup.robot.start()
        assert setup.glass.app.shell.back()
        setup.glass.stage.frames(3)
        assert (listed.parent, detail.parent) == (setup.screen, None)
        assert not setup.glass.app.shell.back()
    finally:
        Window.size = before
        setup.glass.app.root.size = before
