"""A page in headless Chromium, driven as a finger would by the DevTools protocol."""

from __future__ import annotations

import base64
import contextlib
import itertools
import json
import os
import shutil
import subprocess
import time
import urllib.request
from pathlib import Path
from typing import Any, Self

from websockets.sync.client import connect

from tests.lacking import lacking

__all__ = ["Chromium"]

PATIENCE = 120.0
"""Nothing that a page shows takes longer on the busiest machine [s]."""
FLAGS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *("--disable-dev-shm-usage", "--hide-scrollbars", "--window-size=480,900", "--remote-debugging-port=0"),
)


class Chromium:
    """`with Chromium(folder) as page:` has a page of its own until the end of the block."""

    def __init__(self, folder: Path) -> None:
        """What it keeps is in `folder`; the test ends where there is no Chromium."""
        program = shutil.which("chromium")
        if program is None:
            lacking("chromium")
        self._errors = (folder / "chromium.log").open("wb")
        own = {**os.environ, "HOME": str(folder), "XDG_RUNTIME_DIR": str(folder)}
        self._process = subprocess.Popen(
            [program, *FLAGS, f"--user-data-dir={folder / 'profile'}", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=self._errors,
            env=own,
        )
        self._numbers = itertools.count(1)
        with contextlib.ExitStack() as undo:
            undo.callback(self._end)
            port = self._port(folder / "profile" / "DevToolsActivePort")
            pages = f"http://127.0.0.1:{port}/json/list"
            with urllib.request.urlopen(pages, timeout=PATIENCE) as told:
                page = next(each for each in json.load(told) if each["type"] == "page")
            link = connect(page["webSocketDebuggerUrl"], max_size=None, open_timeout=PATIENCE)
            self._socket = undo.enter_context(link)
            self._undo = undo.pop_all()

    def open(self, url: str) -> None:
        """Show the page at `url`."""
        self._ask("Page.navigate", url=url)
        self.until("document.readyState === 'complete'")

    def run(self, script: str) -> Any:
        """The value of an expression in the page; of a promise, what it comes to."""
        told = self._ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in told, told["exceptionDetails"]
        return told["result"].get("value")

    def until(self, condition: str) -> Any:
        """Wait until an expression is true in the page; its value."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            value = self.run(condition)
            if value:
                return value
            time.sleep(0.02)
        raise AssertionError(f"never {condition}; the page says: {self.run('document.body.innerText')}")

    def click(self, selector: str) -> None:
        """A press in the middle of what `selector` finds."""
        found = f"document.querySelector({json.dumps(selector)}).getBoundingClientRect()"
        x, y = self.run(f"(box => [box.x + box.width / 2, box.y + box.height / 2])({found})")
        for kind in ("mousePressed", "mouseReleased"):
            self._ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def resize(self, width: int, height: int) -> None:
        """Show the page on a glass of that size [px]."""
        self._ask(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=True,
        )

    def picture(self) -> bytes:
        """What is seen of the page, as a PNG."""
        return base64.b64decode(self._ask("Page.captureScreenshot")["data"])

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._undo.close()

    def _ask(self, method: str, **params: object) -> dict[str, Any]:
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while True:
            told = json.loads(self._socket.recv(timeout=PATIENCE))
            if told.get("id") == number:
                assert "error" not in told, (method, told["error"])
                answer: dict[str, Any] = told["result"]
                return answer

    def _port(self, file: Path) -> str:
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self._process.poll() is None:
            if file.exists() and (lines := file.read_text().splitlines()):
                return lines[0]
            time.sleep(0.02)
        raise RuntimeError(f"Chromium did not start: {Path(self._errors.name).read_text()[-2000:]}")

    def _end(self) -> None:
        self._process.terminate()
        try:
            self._process.wait(20)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._errors.close()
