"""What clients keep on the robot for each other."""

from __future__ import annotations

import pytest

from bridge.core.errors import ProtocolError
from bridge.server.rosapi import parameters as module
from bridge.server.rosapi.parameters import Parameters


def test_a_value_is_kept_as_json_until_it_is_deleted():
    params = Parameters({"/speed": 0.5})
    params.set("speed", "[1, 2]")
    assert (params.get("/speed"), params.has("speed"), params.names) == ("[1, 2]", True, ["/speed"])
    assert params.delete("/speed")
    assert not params.delete("/speed")
    assert params.get("/speed") == "null"


@pytest.mark.parametrize("value", ["", "{", "nan", "[" * 100_000])
def test_what_is_no_json_is_refused(value):
    params = Parameters()
    with pytest.raises(ProtocolError, match="must be JSON"):
        params.set("/x", value)
    assert params.names == []


def test_there_is_an_end_to_their_number_and_an_old_one_may_still_change(monkeypatch):
    monkeypatch.setattr(module, "MAX_PARAMETERS", 2)
    params = Parameters({"a": 1, "b": 2})
    with pytest.raises(ProtocolError, match="room for 2 parameters"):
        params.set("c", "3")
    params.set("b", "4")
    params.delete("a")
    params.set("c", "3")
    assert params.names == ["/b", "/c"]


def test_there_is_an_end_to_their_bytes(monkeypatch):
    monkeypatch.setattr(module, "MAX_BYTES", 20)
    params = Parameters({"a": "x" * 10})
    with pytest.raises(ProtocolError, match="is too much"):
        params.set("b", '"xxxxxxxx"')
    params.set("a", "1")
    params.set("b", '"xxxxxxxx"')
