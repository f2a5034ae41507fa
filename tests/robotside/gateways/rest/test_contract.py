"""The gateway against its own OpenAPI description: schemathesis asks for all that it says, and for what it says is wrong.

What is left out is that valid requests are all taken: a place without a name, or a task that is none, is refused for its
meaning, which no schema says.
"""

from __future__ import annotations

import asyncio
import os
import sys
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import ArmState
from robotside.gateways.plain import callers
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.gateways.rest.served import serving
from tests.robotside.scene import Scene

pytestmark = pytest.mark.slow

TIMEOUT = 1200.0
ALWAYS = (
    *("--exclude-checks", "positive_data_acceptance", "--exclude-path-regex", "stream$"),
    *("--seed", "1", "--generation-deterministic", "--no-shrink"),
    *("--request-timeout", "60", "--no-color", "--warnings", "off", "--workers", "1"),
)
RUNS = {
    "some of everything": ("--phases", "examples,fuzzing", "--max-examples", "4"),
    "every bound of some": (
        *("--phases", "coverage", "--max-examples", "1"),
        *("--include-path-regex", "^/(places|webhooks|stop|mode|events)"),
    ),
}


@pytest.mark.parametrize("how", RUNS)
async def test_it_answers_as_it_says(tmp_path: Path, how: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for most in ("MAX_OF_HOST", "MAX_VISITORS"):  # each of its requests names another client
        monkeypatch.setattr(callers, most, 1_000_000)
    scene = Scene(EquippedRobot(), tmp_path / "state")
    scene.run(1.0)
    scene.station.bus.publish("/arm", ArmState())
    async with serving(scene) as served:
        command = [Path(sys.executable).with_name("schemathesis"), "run", f"{served.url}/openapi.json"]
        run = await asyncio.create_subprocess_exec(
            *command,
            *("--url", served.url, *ALWAYS, *RUNS[how]),
            cwd=tmp_path,
            env=os.environ | {"HOME": str(tmp_path)},
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.STDOUT,
        )
        try:
            async with asyncio.timeout(TIMEOUT):
                said, _ = await run.communicate()
        except TimeoutError:
            run.kill()
            raise
    text = said.decode()
    assert run.returncode == 0, text[-8000:]
    assert " passed" in text
    assert " 0 generated" not in text  # as 230 are
