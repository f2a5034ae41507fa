"""The names that `bridge.client` offers to other programs, imported only when they are used."""

from __future__ import annotations

import subprocess
import sys

import pytest

import bridge.client
from bridge.client.client import BridgeClient
from bridge.client.remote_robot import RemoteGoal, RemoteRobot


def test_public_classes_are_those_of_their_modules():
    from bridge.client import BridgeClient as client
    from bridge.client import RemoteGoal as goal
    from bridge.client import RemoteRobot as robot

    assert (client, goal, robot) == (BridgeClient, RemoteGoal, RemoteRobot)
    assert {each: getattr(bridge.client, each) for each in bridge.client.__all__}.keys() == {
        "BridgeClient",
        "RemoteGoal",
        "RemoteRobot",
    }


def test_a_name_that_is_not_there_is_an_attribute_error():
    with pytest.raises(AttributeError, match="'bridge.client' has no attribute 'Robot'"):
        bridge.client.Robot  # noqa: B018


def test_a_module_of_the_room_does_not_import_the_others():
    code = "import sys, bridge.client.ping_statistics; print([m for m in sys.modules if m.startswith('websockets')])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
