"""The line to a broker by itself: its end comes through whatever the library does with a cancellation."""

from __future__ import annotations

import asyncio

import aiomqtt
import pytest
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.reasoncodes import ReasonCode

from robotside.gateways.gateway_url import read_url
from robotside.gateways.mqtt.broker_line import BrokerLine, Reply, _reason, uncut

URL = read_url("mqtt://127.0.0.1", {"mqtt": 1883})
MAX_TOPIC = 65535
"""Bytes of a topic, by MQTT."""


async def test_a_cancellation_that_comes_with_a_result_is_not_lost() -> None:
    found: asyncio.Future[int] = asyncio.get_running_loop().create_future()
    went_on = []

    async def work() -> None:
        went_on.append(await uncut(asyncio.wait_for(found, 60)))

    task = asyncio.create_task(work())
    await asyncio.sleep(0)
    found.set_result(1)
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)
    assert task.cancelled()
    assert not went_on


async def test_what_is_not_cancelled_gives_its_result() -> None:
    assert await uncut(asyncio.sleep(0, 7)) == 7


class _Library:
    """A connection of which the library takes no topic that MQTT cannot have."""

    def __init__(self) -> None:
        self.sent: list[str] = []

    async def publish(self, topic: str, payload: bytes, **said: object) -> None:
        if len(topic) > MAX_TOPIC:
            raise ValueError("Invalid topic.")
        self.sent.append(topic)


async def test_an_answer_that_cannot_be_sent_holds_up_no_other() -> None:
    line, library = BrokerLine(URL, (), lambda heard: None), _Library()
    line._client = library  # type: ignore[assignment]
    sending = asyncio.create_task(line._send_replies(library))  # type: ignore[arg-type]
    for topic in ("first", "x" * (MAX_TOPIC + 1), "next"):
        line.reply(Reply(topic, b"{}", None))
    async with asyncio.timeout(60):
        while library.sent != ["first", "next"]:  # noqa: ASYNC110 - what is waited for is no event
            await asyncio.sleep(0)
        sending.cancel()
        await asyncio.gather(sending, return_exceptions=True)


async def test_a_line_that_is_lost_at_once_each_time_is_tried_ever_less_often(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    waits: list[float] = []
    sleep = asyncio.sleep

    async def note(seconds: float) -> None:
        waits.append(seconds)
        await sleep(0)

    class Flapping(BrokerLine):
        async def _connect(self) -> None:
            self._client = _Library()  # type: ignore[assignment]
            # from the fifth time on it has stood for long
            self._up_since = asyncio.get_running_loop().time() - (60 if len(waits) > 4 else 0)
            raise aiomqtt.MqttError("cut")

    with monkeypatch.context() as patch:
        patch.setattr(asyncio, "sleep", note)
        running = asyncio.create_task(Flapping(URL, (), lambda heard: None).run())
        while len(waits) < 6:
            await sleep(0)
        running.cancel()
        await asyncio.gather(running, return_exceptions=True)
    assert waits[:6] == [0.5, 1.0, 2.0, 4.0, 5.0, 0.25]


def test_a_refused_login_says_what_to_check_and_another_fault_says_what_it_is() -> None:
    refused = aiomqtt.MqttCodeError(ReasonCode(PacketTypes.CONNACK, identifier=0x87))
    assert _reason(refused) == "Not authorized; check the user and password in the gateway's URL"
    assert _reason(aiomqtt.MqttError("Operation timed out.")) == "Operation timed out"
    assert _reason(aiomqtt.MqttError("")) == "it does not answer"
