"""docs/bridge.md tells of the protocol what the code does."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path

import msgspec
import pytest

from bridge.core.compat import Compat
from bridge.protocol import (
    MAX_ARGUMENT_BYTES,
    MAX_CLIENT_FRAME,
    MAX_FILTERED_BYTES,
    MAX_SERVER_FRAME,
    OPS,
    Op,
    Reduction,
)
from bridge.server import callback_connection as server_connection
from bridge.server import rosbridge_session as serving
from bridge.server.rosapi.parameters import Parameters
from bridge.server.rosapi.services import Graph, RosApi

TEXT = (Path(__file__).parents[3] / "docs" / "bridge.md").read_text()
TABLE = TEXT.split("<!-- operations:")[1].split("<!-- end of operations -->")[0]
ROWS = {
    cells[1].strip(" `"): cells[3]
    for line in TABLE.splitlines()
    if (cells := line.split("|"))[1:2] and "`" in cells[1]
}
COMMON = {field.name for field in msgspec.structs.fields(Op)}


def test_every_operation_is_told_of():
    assert set(ROWS) == {tag(op) for op in OPS}


def tag(op):
    return op.__struct_config__.tag


@pytest.mark.parametrize("op", OPS, ids=tag)
def test_its_fields_are_told_and_which_of_them_may_be_left_out(op):
    told = {name: bracket == "(" for bracket, name in re.findall(r"(\(?)`(\w+)`", ROWS[tag(op)])}
    fields = {f.name: not f.required for f in msgspec.structs.fields(op) if f.name not in COMMON}
    assert told == fields


@pytest.mark.parametrize(
    "name",
    [field.name for field in dataclasses.fields(Compat)]
    + [f.name for f in msgspec.structs.fields(Reduction)],
)
def test_every_switch_and_every_reduction_has_its_row(name):
    assert re.search(rf"^\| [^|]*`{name}`", TEXT, re.MULTILINE)


def test_every_service_of_rosapi_is_told_of():
    rosapi = RosApi(Graph(dict, dict, dict, dict), Parameters(), float)
    (row,) = re.findall(r"^\| `/rosapi/…` \| rosapi \| (.*) \|$", TEXT, re.MULTILINE)
    assert {f"/rosapi/{name}" for name in re.findall(r"`(\w+)`", row)} == set(rosapi.types)


@pytest.mark.parametrize(
    ("words", "bound"),
    [
        ("frames and unfinished fragments of {} MiB", MAX_SERVER_FRAME >> 20),
        ("a frame to a client may have {}", MAX_CLIENT_FRAME >> 20),
        ("{} kB of filtered rows", MAX_FILTERED_BYTES >> 10),
        ("{} MiB of arguments", MAX_ARGUMENT_BYTES >> 20),
        ("takes longer than {} ms", int(server_connection.TURN_TIME * 1000)),
        ("takes longer than {} ms", int(serving.TURN_TIME * 1000)),
    ],
)
def test_bounds_are_those_of_the_code(words, bound):
    assert words.format(bound) in " ".join(TEXT.split())
