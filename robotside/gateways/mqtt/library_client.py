"""aiomqtt's client, with the loop told of its socket for as long as there is one.

The library has the loop look at a socket in the loop's next step, by the number that it had before. A broker that is killed
meanwhile leaves a number of no file, at which asyncio prints a traceback, or of another file, which would be written to.
"""

from __future__ import annotations

from typing import Any

import aiomqtt
from paho.mqtt import client as paho

__all__ = ["LibraryClient"]


class LibraryClient(aiomqtt.Client):
    """Overrides what the library calls when something is to be written; pyproject.toml caps its version."""

    _registered: Any = None

    def _on_socket_register_write(self, client: paho.Client, userdata: Any, sock: Any) -> None:
        """There is something to write; called in any thread."""

        def write() -> None:
            try:
                client.loop_write()
            except Exception as error:  # noqa: BLE001 - as the library has it: whatever it is, the connection is lost
                if not self._disconnected.done():
                    self._disconnected.set_exception(error)

        def begin() -> None:
            if self._registered is sock and sock.fileno() >= 0:
                self._loop.add_writer(sock.fileno(), write)

        self._registered = sock
        self._loop.call_soon_threadsafe(begin)

    def _on_socket_unregister_write(self, client: paho.Client, userdata: Any, sock: Any) -> None:
        """All is written, or the socket is about to be closed."""
        self._registered = None
        super()._on_socket_unregister_write(client, userdata, sock)
