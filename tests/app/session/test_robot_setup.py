"""What the setup screen goes by: only what the robot said counts, and why nothing can be switched is said."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from app.link.capabilities import Capabilities
from app.link.channels import ANSWER, LINK, OUTCOME, Answer
from app.link.commands import Outcome
from app.link.feeds import Post
from app.session.robot_setup import GATEWAYS, MAX_WAIT, PAYLOADS, RobotSetup
from bridge.msgs.pilothouse_msgs import Gateway, GatewayArray, GetMeResponse, Payload, PayloadArray

MQTT = Gateway("mqtt", "topics at a broker", state="down", usual="own://127.0.0.1:1883")
SERVICES = frozenset({"/gateways/bring_up", "/payloads/set", "/people/me"})


class Session:
    """As much of a session as is needed, with what was asked of the robot."""

    def __init__(self, services: frozenset[str] = SERVICES) -> None:
        self.connected, self.clock = True, 100.0
        self.asked: list[Any] = []
        offer = Capabilities({}, services)
        self.robot = SimpleNamespace(capabilities=offer, offers=offer.serves)
        self.link = SimpleNamespace(
            silence=0.0,
            want=lambda topic, wanted: self.asked.append((topic, wanted)),
            ask=lambda service, *_: self.asked.append(service),
        )

    def now(self) -> float:
        return self.clock

    def command(self, what: str, /, **fields: Any) -> None:
        self.asked.append((what, fields))


class Run:
    """A setup that somebody looks at."""

    def __init__(self, role: str = "manage", services: frozenset[str] = SERVICES) -> None:
        self.session = Session(services)
        self.setup = RobotSetup(self.session)  # type: ignore[arg-type]
        self.setup.enter()
        if role:
            self.hear(ANSWER, Answer("/people/me", GetMeResponse(role=role)))

    def hear(self, channel: str, value: Any) -> bool:
        return self.setup.on_post(channel, Post(value, self.session.clock, 1))

    def tell(self, gateway: Gateway) -> None:
        self.hear(GATEWAYS, GatewayArray(gateways=[gateway]))

    def outcome(self, what: str, phase: str, reason: str = "", **fields: Any) -> None:
        self.hear(OUTCOME, Outcome(what, "1", phase, reason, math.nan, fields, sent=self.session.clock))

    def lose(self, silence: float) -> None:
        """The link is lost, of which nothing was heard for so long [s] by then."""
        self.session.link.silence, self.session.connected = silence, False
        self.hear(LINK, object())

    def state(self) -> tuple[str, str]:
        return self.setup.gateway_state(self.setup.gateways[0])


def test_the_robot_tells_while_somebody_looks_and_what_it_told_is_forgotten_afterwards() -> None:
    run = Run()
    assert run.session.asked == [(GATEWAYS, True), (PAYLOADS, True), "/people/me"]
    run.tell(MQTT)
    run.hear(PAYLOADS, PayloadArray(payloads=[Payload("arm", on=True)]))
    assert (len(run.setup.gateways), len(run.setup.payloads)) == (1, 1)
    run.setup.leave()
    assert run.session.asked[-2:] == [(GATEWAYS, False), (PAYLOADS, False)]
    assert (run.setup.gateways, run.setup.payloads) == ([], [])
    assert run.setup.sentence[0] == "Asking the robot …"


def test_nothing_is_up_before_the_robot_says_so() -> None:
    run = Run()
    run.tell(MQTT)
    assert run.state() == ("topics at a broker", "muted")
    run.setup.bring_up("mqtt", "own://127.0.0.1:1")
    assert run.session.asked[-1] == ("gateway_up", {"name": "mqtt", "url": "own://127.0.0.1:1"})
    run.outcome("gateway_up", "sent", name="mqtt")
    run.session.clock += 3.0
    assert run.state() == ("Coming up … 3 s", "accent")
    assert not run.setup.may(GATEWAYS, "mqtt"), "it is asked for already"
    run.outcome("gateway_up", "accepted", "mqtt is up.", name="mqtt")
    assert run.state() == ("topics at a broker", "muted"), "an answer alone is not the robot's state"
    run.tell(Gateway("mqtt", state="up", endpoint="mqtt://127.0.0.1:1/x"))
    assert run.state() == ("mqtt://127.0.0.1:1/x", "ok")


@pytest.mark.parametrize(
    ("gateway", "said"),
    [
        (
            Gateway("mqtt", state="lost", fault="The broker is not reached."),
            ("The broker is not reached.", "warn"),
        ),
        (Gateway("mqtt", state="going_down"), ("Going down …", "accent")),
        (Gateway("mqtt", state="coming_up"), ("Coming up …", "accent")),
        (Gateway("mqtt", state="down", package="aiomqtt"), ("Needs aiomqtt, which the robot lacks.", "warn")),
        (Gateway("mqtt", state="down", fault="Port 1 is taken."), ("Port 1 is taken.", "warn")),
    ],
)
def test_each_state_has_its_words(gateway: Gateway, said: tuple[str, str]) -> None:
    run = Run()
    run.tell(gateway)
    assert run.state() == said


def test_a_refusal_stands_at_what_was_asked_until_it_is_asked_again() -> None:
    run = Run()
    run.tell(MQTT)
    run.outcome("gateway_up", "refused", "Port 1883 is taken.", name="mqtt")
    assert run.setup.refusal(GATEWAYS, "mqtt") == "Port 1883 is taken."
    assert run.setup.refusal(GATEWAYS, "kafka") == run.setup.refusal(PAYLOADS, "mqtt") == ""
    run.outcome("gateway_up", "sent", name="mqtt")
    assert run.setup.refusal(GATEWAYS, "mqtt") == ""
    run.outcome("payload", "no_reply", "It was silent.", key="arm")
    assert run.setup.refusal(PAYLOADS, "arm") == "The robot did not answer. It was silent."


def test_only_who_manages_the_robot_may_and_others_see_why_not() -> None:
    for role, words in (
        ("watch", "Only who manages the robot switches these; this handheld has the role watch."),
        ("drive", "Only who manages the robot switches these; this handheld has the role drive."),
        ("manage", ""),
        ("", "Asking the robot what may be switched from here …"),
        ("emperor", "Asking the robot what may be switched from here …"),
    ):
        run = Run(role)
        assert run.setup.why_not == words, role
        assert run.setup.may(GATEWAYS, "mqtt") == (role == "manage")


def test_a_robot_that_knows_nobody_lets_everybody() -> None:
    run = Run("", SERVICES - {"/people/me"})
    assert run.setup.why_not == ""
    assert "/people/me" not in run.session.asked


def test_a_robot_that_cannot_be_switched_says_so() -> None:
    run = Run("manage", frozenset({"/people/me"}))
    assert run.setup.why_not == "This robot's protocols and payloads cannot be switched from here."


def test_without_a_link_nothing_can_be_switched_and_the_age_of_what_is_seen_is_said() -> None:
    run = Run()
    run.tell(MQTT)
    run.session.clock += 5.0
    run.lose(5.0)
    run.session.clock += 7.4
    assert run.setup.sentence == (
        "There is no link; what can be seen was so before. It is 12 s old.",
        "warn",
    )
    run.session.link.silence = math.inf  # a new link has heard nothing yet
    run.hear(LINK, object())
    assert run.setup.age == pytest.approx(12.4)
    assert not run.setup.may(GATEWAYS, "mqtt")
    run.session.connected, run.session.asked = True, []
    run.hear(LINK, object())
    assert run.session.asked == ["/people/me"], "over a new link it may be somebody else"
    assert not run.setup.may(GATEWAYS, "mqtt")


def test_a_silent_robot_is_told_before_its_link_is_lost() -> None:
    run = Run()
    run.tell(Gateway("mqtt", state="up", endpoint="mqtt://127.0.0.1:1/x"))
    run.session.link.silence = 1.9
    assert run.setup.age == 0.0
    assert run.state()[1] == "ok"
    run.session.link.silence = 3.0
    assert run.setup.sentence == ("The robot is silent; what can be seen is 3 s old.", "warn")
    assert run.state() == ("mqtt://127.0.0.1:1/x", "muted"), "nobody knows that it is still up"


def test_what_was_asked_for_stays_asked_for_until_the_robot_says_how_it_is() -> None:
    run = Run()
    run.tell(MQTT)
    run.session.clock += 1.0
    run.outcome("gateway_up", "sent", name="mqtt")
    run.session.clock += 5.0
    run.session.link.silence = 5.0
    asked = "Asked to come up; not answered for {} s"
    assert run.state() == (asked.format(5), "warn")
    run.lose(5.0)
    run.session.clock += 3.0
    assert run.state() == (asked.format(8), "warn")
    sent = run.setup._outcomes[GATEWAYS, "mqtt"].sent
    run.session.clock += 32.0
    given_up = Outcome("gateway_up", "1", "no_reply", "No link.", math.nan, {"name": "mqtt"}, sent=sent)
    run.hear(OUTCOME, given_up)
    run.session.clock += 1.0
    assert run.state() == (asked.format(41), "warn"), "that it was given up here says nothing of the robot"
    run.session.connected, run.session.link.silence = True, 0.0
    run.hear(LINK, object())
    assert run.state() == (asked.format(41), "warn"), "a link says nothing of the protocol"
    run.tell(MQTT)
    assert run.state() == ("topics at a broker", "muted")


def test_what_turned_when_it_was_last_heard_of_is_said_with_its_age() -> None:
    run = Run()
    run.tell(Gateway("mqtt", state="coming_up"))
    run.outcome("gateway_up", "sent", name="mqtt")
    run.lose(0.0)
    run.session.clock += 4.0
    assert run.state() == ("Coming up 4 s ago", "warn")


def test_what_is_brought_down_is_going_down_until_the_robot_says_that_it_is() -> None:
    run = Run()
    run.tell(Gateway("mqtt", state="up", endpoint="mqtt://127.0.0.1:1/x"))
    run.outcome("gateway_down", "sent", name="mqtt")
    assert run.state() == ("Going down … 0 s", "accent")
    run.lose(0.0)
    run.session.clock += 6.0
    assert run.state() == ("Asked to go down; not answered for 6 s", "warn")
    run.tell(MQTT)
    assert run.state() == ("topics at a broker", "muted")


def test_a_payload_keeps_what_was_asked_of_it_and_the_age_of_what_it_was() -> None:
    run = Run()
    arm = Payload("arm", "an arm", on=True)
    run.hear(PAYLOADS, PayloadArray(payloads=[arm]))
    assert run.setup.on_or_off(arm) == ("On", "ok")
    run.outcome("payload", "sent", key="arm", on=False)
    assert run.setup.on_or_off(arm) == run.setup.payload_state(arm) == ("Asked for …", "accent")
    run.lose(0.0)
    run.session.clock += 6.0
    waits = ("Asked for off; not answered for 6 s", "warn")
    assert run.setup.on_or_off(arm) == run.setup.payload_state(arm) == waits
    run.outcome("payload", "accepted", key="arm", on=False)
    assert run.setup.on_or_off(arm) == ("On 6 s ago", "muted")


def test_what_never_gets_an_answer_may_be_asked_for_again() -> None:
    run = Run()
    run.tell(MQTT)
    run.outcome("gateway_up", "sent", name="mqtt")
    run.session.clock += MAX_WAIT
    assert not run.setup.may(GATEWAYS, "mqtt")
    run.session.clock += 1.0
    assert run.setup.may(GATEWAYS, "mqtt")


def test_what_is_always_up_says_so_in_words() -> None:
    run = Run()
    run.tell(Gateway("rosbridge", fixed=True, state="up", endpoint="ws://192.0.2.7:9090"))
    assert run.state() == ("ws://192.0.2.7:9090 · always up", "ok")
