"""MQTT 5: a broker that the robot has come to, with the robot's topics as path, `mqtt://HOST:1883/pilothouse/Patrol-1`."""

from __future__ import annotations

import json
import queue
import threading
import uuid
from urllib.parse import urlsplit

from paho.mqtt.client import Client, MQTTMessage, MQTTv5
from paho.mqtt.enums import CallbackAPIVersion
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties

from examples.protocols.ways import ANSWER_TIMEOUT, Answer, Way

__all__ = ["OWN_FAULTS", "open_way"]

OWN_FAULTS: tuple[type[Exception], ...] = ()
"""What its library raises, beside what all raise."""

EXPIRY = 5
"""A command that the broker could not pass on for so long is not carried out [s]."""


class _Mqtt:
    def __init__(self, url: str, client: str) -> None:
        place = urlsplit(url)
        self._state = f"{place.path.strip('/')}/state"
        self._own = f"{place.path.strip('/')}/clients/program-{client[:12]}"
        self._heard: queue.Queue[tuple[bytes, Answer]] = queue.Queue()
        self._ready = threading.Event()
        self._client = Client(CallbackAPIVersion.VERSION2, protocol=MQTTv5)
        if place.username:
            self._client.username_pw_set(place.username, place.password)
        self._client.on_message = self._hear
        self._client.will_set(f"{self._own}/bye", qos=1)
        self._client.connect(place.hostname or "127.0.0.1", place.port or 1883)
        self._client.loop_start()
        self._client.subscribe([(f"{self._own}/answer/#", 1), (self._state, 1)])
        if not self._ready.wait(ANSWER_TIMEOUT):
            self.close()
            raise TimeoutError(f"No robot is there at {url}.")

    def _hear(self, _: Client, __: object, message: MQTTMessage) -> None:
        told = json.loads(message.payload)
        if message.topic != self._state:
            self._heard.put((getattr(message.properties, "CorrelationData", b""), told))
        elif told["state"] == "online":  # kept by the broker; before, nobody hears a command
            self._ready.set()

    def call(self, service: str, request: Answer) -> Answer:
        """As of `Way`."""
        key = uuid.uuid4().bytes
        self._send(f"call{service}", request, key)
        while True:
            try:
                found, answer = self._heard.get(timeout=ANSWER_TIMEOUT)
            except queue.Empty:
                raise TimeoutError(f"{service} gave no answer within {ANSWER_TIMEOUT:g} s.") from None
            if found == key:
                return answer

    def publish(self, topic: str, message: Answer) -> None:
        """As of `Way`."""
        self._send(f"publish{topic}", message)

    def _send(self, what: str, message: Answer, key: bytes = b"") -> None:
        said = Properties(PacketTypes.PUBLISH)
        said.MessageExpiryInterval = EXPIRY
        if key:
            said.CorrelationData = key
        self._client.publish(f"{self._own}/{what}", json.dumps(message), qos=1, properties=said)

    def close(self) -> None:
        """Say goodbye, so that a robot that was driven from here rests, and end the connection."""
        self._client.publish(f"{self._own}/bye", qos=1).wait_for_publish(ANSWER_TIMEOUT)
        self._client.disconnect()
        self._client.loop_stop()


def open_way(url: str, client: str) -> Way:
    """A connection to the broker."""
    return _Mqtt(url, client)
