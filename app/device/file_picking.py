"""Lets the operator choose files by what the system has for it: Android's documents, or a desktop's dialogue.

An app of Android may not read what others keep by its path. So what is chosen there is copied into the app's own folder; on a
desktop it stays where it is.
"""

from __future__ import annotations

import logging
import os
import re
import shutil
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

from kivy.clock import mainthread

from app.device import is_android
from widgets.core.language import tr

__all__ = ["AndroidPicking", "DesktopPicking", "FilePicking", "Picked", "file_picking"]

log = logging.getLogger(__name__)

REQUEST = 0x4D41
"""By which the answer to this app's question is told from others."""
MAX_FILES = 8

Picked = Callable[[list[Path], str], None]
"""Told in the UI thread what was chosen, nothing where the operator chose nothing, and why that failed, in one sentence."""


class FilePicking(Protocol):
    """A way to files of the operator's."""

    takes_paths: bool
    """A path that is typed can be read as well."""

    def pick(self, into: Path, done: Picked) -> None:
        """Ask for files; what cannot be read where it is, is copied `into` that folder."""


class DesktopPicking:
    """plyer's dialogue, in a thread: it waits for a program that the desktop has for it."""

    takes_paths = True

    def __init__(self) -> None:
        self._thread: threading.Thread | None = None

    def pick(self, into: Path, done: Picked) -> None:
        """Ask for files; one question at a time."""
        if self._thread is not None and self._thread.is_alive():
            return
        self._thread = threading.Thread(
            target=self._ask, args=(mainthread(done),), name="file dialogue", daemon=True
        )
        self._thread.start()

    @staticmethod
    def _ask(done: Picked) -> None:
        try:
            from plyer import filechooser

            chosen = filechooser.open_file(multiple=True) or []
        except Exception as fault:  # noqa: BLE001 - plyer raises what it likes where a desktop has no dialogue
            log.info("no file dialogue: %s", fault)
            done([], tr("This desktop has no file dialogue; type the file's path."))
        else:
            done([Path(str(path)) for path in chosen[:MAX_FILES]], "")


class AndroidPicking:
    """Android's documents, from wherever its apps offer them."""

    takes_paths = False

    def __init__(self) -> None:
        from jnius import autoclass

        self._activity = autoclass("org.kivy.android.PythonActivity").mActivity
        self._into = Path()
        self._done: Picked | None = None

    def pick(self, into: Path, done: Picked) -> None:
        """Ask for files, which are copied into that folder."""
        from android import activity
        from jnius import autoclass

        if self._done is None:
            activity.bind(on_activity_result=self._answered)
        self._into, self._done = into, mainthread(done)
        intent = autoclass("android.content.Intent")
        ask = intent(intent.ACTION_OPEN_DOCUMENT)
        ask.addCategory(intent.CATEGORY_OPENABLE)
        ask.setType("*/*")
        ask.putExtra(intent.EXTRA_ALLOW_MULTIPLE, True)
        self._activity.startActivityForResult(ask, REQUEST)

    def _answered(self, request: int, result: int, intent: Any) -> None:
        """Android's answer, in a thread of its own."""
        if request != REQUEST or self._done is None:
            return
        from android import activity

        done, self._done = self._done, None
        activity.unbind(on_activity_result=self._answered)
        if intent is None:
            done([], "")
            return
        threading.Thread(
            target=self._copy_all, args=(_addresses(intent), done), name="file copies", daemon=True
        ).start()

    def _copy_all(self, addresses: list[Any], done: Picked) -> None:
        from jnius import JavaException

        try:
            done([self._copy(address) for address in addresses[:MAX_FILES]], "")
        except (OSError, JavaException) as fault:
            done([], tr("The file cannot be read: {fault}.").format(fault=fault))

    def _copy(self, address: Any) -> Path:
        resolver = self._activity.getContentResolver()
        self._into.mkdir(parents=True, exist_ok=True)
        to = self._into / _plain(_name(resolver, address))
        opened = resolver.openFileDescriptor(address, "r")
        with os.fdopen(opened.detachFd(), "rb") as source, to.open("wb") as copy:
            shutil.copyfileobj(source, copy)
        return to


def _addresses(intent: Any) -> list[Any]:
    several, one = intent.getClipData(), intent.getData()
    if several is not None:
        return [several.getItemAt(index).getUri() for index in range(several.getItemCount())]
    return [one] if one is not None else []


def _name(resolver: Any, address: Any) -> str:
    row = resolver.query(address, ["_display_name"], None, None, None)
    if row is None:
        return "file"
    try:
        return str(row.getString(0)) if row.moveToFirst() else "file"
    finally:
        row.close()


def _plain(name: str) -> str:
    """A name that is no way out of the folder."""
    return re.sub(r"[^\w.\- ]", "_", Path(name).name).lstrip(".")[:100] or "file"


def file_picking() -> FilePicking | None:
    """That of the device that this runs on."""
    return AndroidPicking() if is_android() else DesktopPicking()
