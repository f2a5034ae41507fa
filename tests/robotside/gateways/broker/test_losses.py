"""What is said of a broker that is lost: once for each loss, of the broker before all else, and when it is back to stay."""

from __future__ import annotations

from typing import Any, cast

from bridge.core.codes import Code
from bridge.core.identity import Role
from robotside.gateways.broker.line import Line
from robotside.gateways.broker.losses import Losses, say_open


class FakeLine:
    """As much of a line as is looked at."""

    def __init__(self) -> None:
        self.is_up = self.is_standing = True
        self.fault = ""


class Told:
    """Notes what is said."""

    def __init__(self) -> None:
        self.said: list[tuple[str, str]] = []
        self.losses = Losses("kafka", "Kafka broker", "192.0.2.7:9092", self.say)
        self.commands, self.stop = FakeLine(), FakeLine()

    def say(self, kind: str, notice: Any, level: str = "info", **_: Any) -> None:
        self.said.append((notice.code, str(notice)))

    def check(self) -> None:
        self.losses.check(cast(Line, self.commands), cast(Line, self.stop))

    @property
    def codes(self) -> list[str]:
        return [code for code, _ in self.said]


def test_a_broker_that_comes_and_goes_is_told_of_once_until_it_stands() -> None:
    told = Told()
    for _ in range(3):
        told.losses.lost("it does not answer")
    assert told.said == [
        (
            Code.GATEWAY_LOST,
            "The Kafka broker at 192.0.2.7:9092 is not reached: it does not answer. It is tried again.",
        )
    ]
    told.commands.is_standing = False
    told.check()
    assert told.codes == [Code.GATEWAY_LOST]
    told.commands.is_standing = True
    told.check()
    assert told.said[-1] == (Code.GATEWAY_UP, "The Kafka broker is reached again.")
    told.losses.lost("cut")
    assert told.codes[-1] == Code.GATEWAY_LOST


def test_the_line_of_stop_alone_is_told_of_and_a_broker_lost_later_too() -> None:
    told = Told()
    told.stop.fault, told.stop.is_standing = "refused", False
    for _ in range(2):
        told.check()
    assert len(told.said) == 1
    assert told.said[0][1].startswith(
        "STOP has no connection of its own to the Kafka broker at 192.0.2.7:9092: refused"
    )
    told.losses.lost("cut")
    assert told.codes == [Code.GATEWAY_LOST] * 2
    told.stop.fault, told.stop.is_standing = "", True
    told.check()
    assert told.codes[-1] == Code.GATEWAY_UP


def test_a_gateway_that_lets_everybody_drive_says_so() -> None:
    told = Told()
    for role in (None, Role.NONE, Role.WATCH):
        say_open(told.say, "kafka", "reaches the Kafka broker", role)
    assert not told.said
    say_open(told.say, "kafka", "reaches the Kafka broker", Role.DRIVE)
    assert told.said == [
        (Code.GATEWAY_OPEN, "Everybody who reaches the Kafka broker may drive without a key.")
    ]
