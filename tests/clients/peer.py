"""A program on roslibpy that does what it is told: one JSON command a line on stdin, one answer or event a line on stdout.

python peer.py TRANSPORT

It is one client after the other: `begin` connects a new one, `finish` closes its connection, and nothing of it is told then.
"""

from __future__ import annotations

import json
import logging
import sys
import threading
from typing import Any

import roslibpy
from roslibpy.comm import select_factory

TIMEOUT = 60.0
"""Of everything that must come [s]."""


def tell(**line: Any) -> None:
    """One line to whoever started this."""
    sys.stdout.write(json.dumps(line, default=dict) + "\n")
    sys.stdout.flush()


class Trouble(logging.Handler):
    """Tells what the library complains of."""

    def emit(self, record: logging.LogRecord) -> None:
        tell(event="trouble", name=record.levelname, msg=record.getMessage())


class Peer:
    """One client; its commands are given what the library calls it."""

    def __init__(self, ros: roslibpy.Ros) -> None:
        self.ros = ros
        self.kept: dict[tuple[Any, str], Any] = {}
        self._finished = False
        self._telling = threading.Lock()

    def tell(self, **line: Any) -> None:
        """As the function, until the client is finished."""
        with self._telling:
            if not self._finished:
                tell(**line)

    def finish(self) -> None:
        """Close the connection, and wait until that is so."""
        closed = threading.Event()
        self.ros.on("close", lambda _: closed.set())
        self.ros.close()
        if not closed.wait(TIMEOUT):
            raise TimeoutError("the connection does not close")
        with self._telling:
            self._finished = True

    def _of(self, kind: Any, name: str, type: str, **options: Any) -> Any:
        key = (kind, name)
        if key not in self.kept:
            self.kept[key] = kind(self.ros, name, type, **options)
        return self.kept[key]

    def subscribe(self, **wanted: Any) -> None:
        topic = self._of(roslibpy.Topic, **wanted)
        topic.subscribe(lambda msg: self.tell(event="message", name=wanted["name"], msg=msg))

    def unsubscribe(self, **wanted: Any) -> None:
        self._of(roslibpy.Topic, **wanted).unsubscribe()

    def advertise(self, **wanted: Any) -> None:
        self._of(roslibpy.Topic, **wanted).advertise()

    def unadvertise(self, **wanted: Any) -> None:
        self._of(roslibpy.Topic, **wanted).unadvertise()

    def publish(self, msg: dict[str, Any], **wanted: Any) -> None:
        self._of(roslibpy.Topic, **wanted).publish(roslibpy.Message(msg))

    def call(self, args: dict[str, Any] | None = None, **wanted: Any) -> dict[str, Any]:
        try:
            answer = roslibpy.Service(self.ros, wanted["name"], wanted["type"]).call(
                roslibpy.ServiceRequest(args or {}), timeout=5
            )
        except roslibpy.core.ServiceException as error:
            return {"failed": error.args[0]}
        return {"values": dict(answer)}

    def serve(self, values: dict[str, Any], result: bool = True, **wanted: Any) -> None:
        def answer(request: Any, response: Any) -> bool:
            self.tell(event="request", name=wanted["name"], msg=request)
            response.update(values)
            return result

        self._of(roslibpy.Service, **wanted).advertise(answer)

    def unserve(self, **wanted: Any) -> None:
        self._of(roslibpy.Service, **wanted).unadvertise()

    def goal(self, args: dict[str, Any], **wanted: Any) -> dict[str, Any]:
        def event(kind: str, told: Any) -> None:
            msg = (
                {"status": told["status"].value, "values": told["values"]} if "status" in told else dict(told)
            )
            self.tell(event=kind, name=wanted["name"], msg=msg)

        client = self._of(roslibpy.ActionClient, **wanted)
        kinds = ("result", "feedback", "failed")
        return {
            "id": client.send_goal(
                roslibpy.Goal(args), *(lambda told, kind=kind: event(kind, told) for kind in kinds)
            )
        }

    def cancel(self, id: str, **wanted: Any) -> None:
        self._of(roslibpy.ActionClient, **wanted).cancel_goal(id)

    def ask(self, method: str, args: tuple[Any, ...] = ()) -> dict[str, Any]:
        try:
            return {"values": getattr(self.ros, method)(*args)}
        except roslibpy.core.ServiceException as error:
            return {"failed": error.args[0]}

    def get_action_servers(self) -> None:
        self.ros.get_action_servers(lambda found: self.tell(event="action_servers", name="", msg=found))

    def get_param(self, name: str) -> dict[str, Any]:
        return {"values": roslibpy.Param(self.ros, name).get(timeout=60)}

    def set_param(self, name: str, value: Any) -> None:
        roslibpy.Param(self.ros, name).set(value, timeout=60)

    def delete_param(self, name: str) -> None:
        roslibpy.Param(self.ros, name).delete(timeout=60)

    def say(self, op: dict[str, Any]) -> None:
        self.ros.send_on_ready(roslibpy.Message(op))


def begun(port: int, transport: str) -> Peer:
    """A client that is connected."""
    ros = roslibpy.Ros("127.0.0.1", port, transport=transport)
    peer = Peer(ros)
    ros.run(timeout=TIMEOUT)
    peer.tell(event="connection")
    ros.on("close", lambda _: peer.tell(event="close"))
    ros.factory.on("ready", lambda _: peer.tell(event="connection"))
    return peer


def main(transport: str) -> None:
    """Do what comes until stdin ends."""
    logging.getLogger("roslibpy").addHandler(Trouble(logging.ERROR))
    factory = select_factory(transport)
    factory.set_initial_delay(0.1)
    factory.set_max_delay(0.2)
    roslibpy.ros.set_rosapi_timeout(TIMEOUT)
    peer: Peer | None = None
    for line in sys.stdin:
        wanted = json.loads(line)
        number, command = wanted.pop("number"), wanted.pop("command")
        answer = None
        if command == "begin":
            peer = begun(wanted["port"], transport)
        else:
            answer = getattr(peer, command)(**wanted)
        tell(number=number, answer=answer)
    if peer is not None:
        peer.ros.terminate()


if __name__ == "__main__":
    main(sys.argv[1])
