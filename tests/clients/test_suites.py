"""What the suites of roslibpy and roslib do with a ROS system, on a served robot with the nodes of `examples.ros_nodes`."""

from __future__ import annotations

import asyncio
import json
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

from examples.demo.robot import RobotProcess
from tests.clients.peers import HERE, START, command

pytestmark = pytest.mark.slow

ROOT = HERE.parents[1]
SUITE_TIMEOUT = 240.0
"""Longest time for all scenarios of one library [s]."""


@asynccontextmanager
async def ros_system(state: Path) -> AsyncIterator[int]:
    """A robot and the nodes, each in a process of its own; gives the port of the robot's bridge."""
    options = ("--robot", "sim:patrol", "--state", str(state / "robot"))
    with RobotProcess(*options, log=state / "robot.log") as robot:
        port = int(robot.url.rsplit(":", 1)[1])
        nodes = await asyncio.create_subprocess_exec(
            sys.executable,
            *("-m", "examples.ros_nodes", "--connect", f"ws://127.0.0.1:{port}"),
            stdout=asyncio.subprocess.PIPE,
            cwd=ROOT,
        )
        try:
            async with asyncio.timeout(START):
                while not (await nodes.stdout.readline()).startswith(b"Connected"):
                    pass
            yield port
        finally:
            nodes.terminate()
            await nodes.wait()


def suite(library: str, port: int, transport: str) -> list[str]:
    """How the scenarios of a library are run."""
    program, *_ = command(library, transport)
    if library == "roslib":
        return [program, str(HERE / "suite.mjs"), f"ws://127.0.0.1:{port}"]
    return [program, str(HERE / "suite.py"), str(port), transport]


async def went(library: str, port: int, transport: str = "") -> dict[str, str]:
    """What came of each scenario; empty where it went well."""
    process = await asyncio.create_subprocess_exec(
        *suite(library, port, transport), stdout=asyncio.subprocess.PIPE, cwd=ROOT
    )
    try:
        async with asyncio.timeout(SUITE_TIMEOUT):
            told, _ = await process.communicate()
    finally:
        if process.returncode is None:
            process.kill()
            await process.wait()
    return json.loads(told.decode().strip().splitlines()[-1])


@pytest.mark.parametrize(
    ("library", "transports", "scenarios"),
    [("roslibpy", ("twisted", "asyncio"), 13), ("roslib", ("",), 12)],
)
async def test_every_scenario_of_a_library_goes_well(library, transports, scenarios, tmp_path):
    async with ros_system(tmp_path) as port:
        for transport in transports:
            found = await went(library, port, transport)
            wrong = {name: reason for name, reason in found.items() if reason}
            assert wrong == {}, transport
            assert len(found) == scenarios
