"""A real broker that tests kill, freeze and start again: Mosquitto, or the one that iotcore brings where it is lacking."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

__all__ = ["MOSQUITTO", "Broker"]

START_TIMEOUT = 60.0
"""For a broker to have its old port again [s]."""
_PLACES = os.pathsep.join((os.environ.get("PATH", ""), "/usr/sbin", "/usr/local/sbin"))
MOSQUITTO = (
    "" if os.environ.get("TEST_BROKER") == "iotcore" else shutil.which("mosquitto", path=_PLACES) or ""
)
_IOTCORE = "import sys; from iotcore import Broker; Broker(config_path=sys.argv[1]).run_forever()"
_RUMQTTD = """
id = 0
[router]
id = 0
max_connections = 100
max_outgoing_packet_count = 200
max_segment_size = 1048576
max_segment_count = 10
[v5.1]
name = "v5-1"
listen = "127.0.0.1:{port}"
next_connection_delay_ms = 1
[v5.1.connections]
connection_timeout_ms = 60000
max_payload_size = 262144
max_inflight_count = 100
dynamic_filters = true
"""


class Broker:
    """A broker on a port of this machine, started at once."""

    def __init__(self, folder: Path, *, mosquitto: str = MOSQUITTO, access: str = "") -> None:
        """`mosquitto` is its program, empty for the broker of iotcore; `access` is an access list of Mosquitto."""
        self._folder, self._mosquitto, self._access = folder, mosquitto, access
        for _ in range(20):  # another program may take the port first
            self.port = _free_port()
            self._process = self._begin()
            if self._listens():
                return
            self.kill()
        raise RuntimeError("no broker starts")

    @property
    def url(self) -> str:
        return f"mqtt://127.0.0.1:{self.port}"

    def start(self) -> None:
        """Start again, on the same port, with nothing kept; where another program has it for a moment, once that is over."""
        end = time.monotonic() + START_TIMEOUT
        self._process = self._begin()
        while not self._listens():
            assert time.monotonic() < end, "the broker does not come back"
            time.sleep(0.1)
            self._process = self._begin()

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()

    def freeze(self) -> None:
        self._process.send_signal(signal.SIGSTOP)

    def thaw(self) -> None:
        self._process.send_signal(signal.SIGCONT)

    def _begin(self) -> subprocess.Popen[bytes]:
        file = self._folder / "mosquitto.conf"
        if self._mosquitto:
            access = self._folder / "access"
            access.write_text(self._access)
            access.chmod(0o700)
            file.write_text(
                f"listener {self.port} 127.0.0.1\nallow_anonymous true\npersistence false\nuser root\n"
                + (f"acl_file {access}\n" if self._access else "")
            )
            command = [self._mosquitto, "-c", str(file)]
        else:
            file = self._folder / "broker.toml"
            file.write_text(_RUMQTTD.format(port=self.port))
            command = [sys.executable, "-c", _IOTCORE, str(file)]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def _listens(self) -> bool:
        """It takes connections; False when it has ended."""
        while self._process.poll() is None:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", self.port)) == 0:
                    return True
            time.sleep(0.01)
        return False


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
