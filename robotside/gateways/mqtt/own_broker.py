"""A broker of the robot's own, for this machine alone: Mosquitto where it is installed, else the one that iotcore brings.

It runs as a child, is started again when it dies, and ends with this process however that ends.
"""

from __future__ import annotations

import asyncio
import logging
import os
import shutil
import socket
import sys
from asyncio.subprocess import DEVNULL, PIPE, Process
from collections.abc import Awaitable, Callable
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from bridge.core.async_tasks import cancel_all
from bridge.core.errors import BridgeError
from robotside.gateways.addresses import is_here, listening_socket

__all__ = ["OwnBroker", "mosquitto"]

log = logging.getLogger(__name__)

START_TIMEOUT = 15.0
"""For it to listen [s]."""
STOP_TIMEOUT = 2.0
"""For it to end by itself [s]."""
RESTART_PAUSE, MAX_RESTART_PAUSE = 0.5, 30.0
"""Between its death and the next start [s]; while it does not come up the pause doubles from one try to the next."""
_POLL_PERIOD = 0.02
"""Between two looks whether it listens [s]."""
_PLACES = os.pathsep.join((os.environ.get("PATH", os.defpath), "/usr/sbin", "/usr/local/sbin"))
_MOSQUITTO = "listener {port} {host}\nallow_anonymous true\npersistence false\nlog_type error\n"
_IOTCORE = """
id = 0
[router]
id = 0
max_connections = 200
max_outgoing_packet_count = 200
max_segment_size = 1048576
max_segment_count = 10
[v5.1]
name = "v5-1"
listen = "{host}:{port}"
next_connection_delay_ms = 1
[v5.1.connections]
connection_timeout_ms = 60000
max_payload_size = 262144
max_inflight_count = 100
dynamic_filters = true
"""
_FOLLOW = 'exec 3<&0; "$0" -c "$1" & broker=$!; (cat <&3 >/dev/null; kill $broker) & exec 3<&-; wait $broker'
"""Ends Mosquitto when the standard input ends, as it does with this process, and ends itself with Mosquitto."""
_SERVE = "from iotcore._serve import main; main()"


def mosquitto() -> str:
    """The program of Mosquitto; empty where it is not installed."""
    return shutil.which("mosquitto", path=_PLACES) or ""


class OwnBroker:
    """A broker on one port of this machine; owns its process."""

    def __init__(
        self,
        host: str,
        port: int,
        *,
        program: str | None = None,
        pause: Callable[[float], Awaitable[object]] = asyncio.sleep,
    ) -> None:
        """Port 0 takes a free one. `program` is that of Mosquitto, empty for iotcore's broker, None for what is installed.
        `pause` waits so long [s].

        Raises BridgeError for an address that others reach, since it knows no keys, and for a port that is taken.
        """
        if not is_here(host):
            raise BridgeError(
                f"A broker of the robot's own listens on this machine only, not on {host}; give the URL of one."
            )
        self._host = "127.0.0.1" if host == "localhost" else host
        self._program = mosquitto() if program is None else program
        try:
            with listening_socket(self._host, port) as probe:
                self.port = int(probe.getsockname()[1])
                """Where it listens."""
        except OSError as error:
            said = f"Port {port} on {self._host} is taken, perhaps by a broker"
            raise BridgeError(f"{said}: mqtt=mqtt://{self._host}:{port} goes to that one.") from error
        self._folder: TemporaryDirectory[str] | None = None
        self._pause = pause
        self._words: list[str] = []
        self._process: Process | None = None
        self._watching: asyncio.Task[None] | None = None

    async def start(self) -> None:
        """Begin to listen. BridgeError with one sentence when that is not possible."""
        if not self._program and find_spec("iotcore") is None:
            raise BridgeError(
                "There is no broker on this machine: install Mosquitto or iotcore, or give the URL of one."
            )
        self._folder = TemporaryDirectory(prefix="pilothouse-broker-")
        self._words = self._command(Path(self._folder.name))
        self._process = await self._begin()
        self._watching = asyncio.create_task(self._watch())

    async def stop(self) -> None:
        """End it; its port is free afterwards. Allowed before `start` too."""
        if self._watching is not None:
            await cancel_all([self._watching])
        if self._process is not None:
            await _end(self._process)
        if self._folder is not None:
            self._folder.cleanup()
        self._watching = self._process = self._folder = None

    async def _watch(self) -> None:
        """Start it again whenever it dies."""
        while self._process is not None:
            code = await self._process.wait()
            await _end(self._process)  # what is left of it
            log.warning("The robot's own MQTT broker ended with %s and is started again", code)
            self._process = await self._begun_again()

    async def _begun_again(self) -> Process:
        """A process that listens, however long that takes; what keeps it from that is logged when it is something new."""
        pause, logged = RESTART_PAUSE, ""
        while True:
            await self._pause(pause)
            try:
                return await self._begin()
            except (BridgeError, OSError) as error:
                said = str(error)
            if said != logged:
                log.warning("The robot's own MQTT broker does not come up and is tried again: %s", said)
            pause, logged = min(2 * pause, MAX_RESTART_PAUSE), said

    async def _begin(self) -> Process:
        """A process that listens. BridgeError when it does not."""
        # in a group of its own: Ctrl-C ends the robot, and that ends the broker when it has said goodbye
        process = await asyncio.create_subprocess_exec(
            *self._words, stdin=PIPE, stdout=DEVNULL, stderr=DEVNULL, process_group=0
        )
        try:
            async with asyncio.timeout(START_TIMEOUT):
                while not self._listens():
                    if process.returncode is not None:
                        break
                    await asyncio.sleep(_POLL_PERIOD)
        except BaseException as error:
            await _end(process)
            if isinstance(error, TimeoutError):
                raise BridgeError(
                    f"The robot's own broker does not listen after {START_TIMEOUT:g} s."
                ) from error
            raise
        if process.returncode is not None:
            raise BridgeError(f"The robot's own broker cannot listen on {self._host}:{self.port}.")
        return process

    def _command(self, folder: Path) -> list[str]:
        """What starts it, by the settings that this writes to `folder`."""
        values = {
            "host": f"[{self._host}]" if ":" in self._host and not self._program else self._host,
            "port": self.port,
        }
        if not self._program:
            file = folder / "broker.toml"
            file.write_text(_IOTCORE.format(**values))
            options = f'{{"config_path": "{file}"}}'
            return [sys.executable, "-P", "-c", _SERVE, options]  # it ends when its standard input does
        file = folder / "mosquitto.conf"
        file.write_text(_MOSQUITTO.format(**values))
        return ["/bin/sh", "-c", _FOLLOW, self._program, str(file)]

    def _listens(self) -> bool:
        with socket.socket(socket.AF_INET6 if ":" in self._host else socket.AF_INET) as probe:
            return probe.connect_ex((self._host, self.port)) == 0


async def _end(process: Process) -> None:
    """End a broker by the end of its standard input, or by force."""
    if process.stdin is not None:
        process.stdin.close()
    try:
        async with asyncio.timeout(STOP_TIMEOUT):
            await process.wait()
    except TimeoutError:
        with suppress(ProcessLookupError):
            process.kill()
        await process.wait()
