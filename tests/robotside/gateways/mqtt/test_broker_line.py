"""The line to a broker by itself: its end comes through whatever the library does with a cancellation."""

from __future__ import annotations

import asyncio

import aiomqtt
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
    line, library = BrokerLine(URL, (), lambda heard: None, probe="p"), _Library()
    line._client = library  # type: ignore[assignment]
    line._came_up()
    sending = asyncio.create_task(line._send_replies(library))  # type: ignore[arg-type]
    for topic in ("first", "x" * (MAX_TOPIC + 1), "next"):
        line.reply(Reply(topic, b"{}", None))
    async with asyncio.timeout(60):
        while library.sent != ["first", "next"]:  # noqa: ASYNC110 - what is waited for is no event
            await asyncio.sleep(0)
        sending.cancel()
        await asyncio.gather(sending, return_exceptions=True)


def test_a_refused_login_says_what_to_check_and_another_fault_says_what_it_is() -> None:
    refused = aiomqtt.MqttCodeError(ReasonCode(PacketTypes.CONNACK, identifier=0x87))
    assert _reason(refused) == "Not authorized; check the user and password in the gateway's URL"
    assert _reason(aiomqtt.MqttError("Operation timed out.")) == "Operation timed out"
    assert _reason(aiomqtt.MqttError("")) == "it does not answer"
    assert _reason(aiomqtt.MqttError("[Errno 111] Connection refused")) == "Connection refused"
    assert _reason(aiomqtt.MqttError("[Errno -2] Name or service not known")) == "Name or service not known"
