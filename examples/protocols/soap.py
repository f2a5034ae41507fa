"""SOAP at the robot's web site, `soap=http://HOST:8080/soap`; the WSDL there says what there is."""

from __future__ import annotations

import json
from typing import Any

import zeep
from lxml import etree
from zeep.exceptions import Error
from zeep.transports import Transport

from examples.protocols.ways import ANSWER_TIMEOUT, Answer, Way

__all__ = ["OWN_FAULTS", "open_way"]

OWN_FAULTS = (Error,)
"""What its library raises, beside what all raise."""

NS = "urn:pilothouse:robot:1"
COMMAND = {"client_id": "clientId", "client_name": "clientName", "command_id": "commandId"}
"""Field of a command to that of the header that says who calls."""


class _Soap:
    def __init__(self, url: str, client: str) -> None:
        self._client = zeep.Client(f"{url}?wsdl", transport=Transport(operation_timeout=ANSWER_TIMEOUT))
        self._caller = {"clientId": client}

    def call(self, service: str, request: Answer) -> Answer:
        """As of `Way`; a fault is an answer like any other."""
        self._caller = {name: request[field] for field, name in COMMAND.items()}
        message = json.dumps({key: value for key, value in request.items() if key not in COMMAND})
        try:
            if service == "/stop":  # known by its SOAPAction, whatever else the robot has to read
                said = self._ask("Stop")
                return {"success": True, "message": str(said), "code": ""}
            answer: Answer = json.loads(self._ask("CallService", service=service, message=message))
        except zeep.exceptions.Fault as fault:
            return {"success": False, "message": fault.message, "code": _code(fault)}
        return answer

    def publish(self, topic: str, message: Answer) -> None:
        """As of `Way`."""
        self._ask("PublishMessage", topic=topic, message=json.dumps(message))

    def _ask(self, operation: str, **fields: str) -> Any:
        header = etree.Element(f"{{{NS}}}Caller")
        for name, value in self._caller.items():
            etree.SubElement(header, f"{{{NS}}}{name}").text = value
        return self._client.service[operation](**fields, _soapheaders=[header])

    def close(self) -> None:
        """Say goodbye, so that control is free, and end the connection."""
        self._ask("Leave")
        self._client.transport.session.close()


def _code(fault: zeep.exceptions.Fault) -> str:
    """The robot's code of a refusal."""
    found = None if fault.detail is None else fault.detail.find(f".//{{{NS}}}code")
    return "" if found is None else found.text or ""


def open_way(url: str, client: str) -> Way:
    """The robot's web service."""
    return _Soap(url, client)
