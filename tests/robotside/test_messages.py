"""The ROS text of pilothouse_msgs says the same as the classes."""

from __future__ import annotations

import re
from pathlib import Path
from typing import get_args, get_origin, get_type_hints

import pytest

from bridge.msgs import Msg, pilothouse_msgs
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    GetEventsRequest,
    GetEventsResponse,
    GetMissionRequest,
    GetMissionResponse,
    SetMissionRequest,
    StartTaskRequest,
)

FOLDER = Path(__file__).parents[2] / "pilothouse_msgs"
BASIC = {float: "float64", int: "int32", bool: "bool", str: "string"}
SERVICES: dict[str, tuple[type[Msg], type[Msg]]] = {
    "Command": (CommandRequest, CommandResponse),
    "StartTask": (StartTaskRequest, CommandResponse),
    "SetMission": (SetMissionRequest, CommandResponse),
    "GetMission": (GetMissionRequest, GetMissionResponse),
    "GetEvents": (GetEventsRequest, GetEventsResponse),
}
HALVES = {half for halves in SERVICES.values() for half in halves}
MESSAGES = [
    kind
    for kind in map(vars(pilothouse_msgs).get, pilothouse_msgs.__all__)
    if isinstance(kind, type) and kind not in HALVES
]


def ros(hint: object) -> str:
    if get_origin(hint) is list:
        return f"{ros(get_args(hint)[0])}[]"
    if hint in BASIC:
        return BASIC[hint]  # type: ignore[index]
    name = hint.MSGTYPE  # type: ignore[attr-defined]
    return str(name).removeprefix("pilothouse_msgs/")


def fields(cls: type[Msg]) -> list[tuple[str, str]]:
    hints = get_type_hints(cls)
    return [(ros(hints[name]), name) for name in cls.__struct_fields__]


def read(text: str) -> list[tuple[str, str]]:
    lines = (line.split("#")[0].split() for line in text.splitlines())
    return [(line[0], line[1]) for line in lines if line]


@pytest.mark.parametrize("cls", MESSAGES, ids=lambda cls: cls.__name__)
def test_a_message_has_the_same_fields_in_text_and_class(cls: type[Msg]) -> None:
    assert read((FOLDER / "msg" / f"{cls.__name__}.msg").read_text()) == fields(cls)


@pytest.mark.parametrize("name", SERVICES)
def test_a_service_has_the_same_fields_in_text_and_classes(name: str) -> None:
    request, response = (FOLDER / "srv" / f"{name}.srv").read_text().split("---")
    assert [read(request), read(response)] == [fields(half) for half in SERVICES[name]]


def test_there_is_no_text_without_a_class() -> None:
    assert {path.stem for path in FOLDER.glob("msg/*.msg")} == {cls.__name__ for cls in MESSAGES}
    assert {path.stem for path in FOLDER.glob("srv/*.srv")} == set(SERVICES)


def test_every_field_says_what_it_means() -> None:
    for path in FOLDER.glob("*/*.[ms][sr][gv]"):
        for line in path.read_text().splitlines():
            assert re.fullmatch(r"|---|# .+|\S+ \w+ +# .+", line), f"{path.name}: {line}"
