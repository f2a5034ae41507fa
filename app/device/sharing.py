"""Hands a file to whatever app the operator chooses for it: Android's own share sheet.

An app's own folder cannot be looked into on a phone, and nothing of it may be handed on by its path. So a copy goes into
`Download/Pilothouse`, which file managers and computers see, and its address is what is shared. Before Android 10 that folder needs a
permission; there the copy goes into the app's folder on the shared storage.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any, Protocol

from app.device import is_android
from widgets.core.language import mark, tr

__all__ = ["AndroidSharing", "Sharing", "sharing"]

FOLDER = "Download/Pilothouse"
SEEN_SINCE = 29
"""Android's version that lets an app put files into Download without a permission (10)."""
ZIP = "application/zip"
KINDS = {".zip": ZIP, ".jpg": "image/jpeg"}
"""Ending of a file to what it is; others are bytes."""
BYTES = "application/octet-stream"
REFUSES = mark("Android does not share it: {}")


class Sharing(Protocol):
    """A way out of the app for files."""

    where: str
    """Where copies of them lie, in words."""

    def share(self, path: Path) -> None:
        """Ask the operator what shall be done with a copy of that file; OSError where that cannot be."""

    def forget(self) -> None:
        """Delete the copies of zips, which are of the study; OSError where that cannot be."""


class AndroidSharing:
    """By a worker's thread; made in that of the app, the only one that finds the app's own Java classes."""

    def __init__(self) -> None:
        from jnius import autoclass

        self._activity = autoclass("org.kivy.android.PythonActivity").mActivity
        self._seen = autoclass("android.os.Build$VERSION").SDK_INT >= SEEN_SINCE
        self.where = FOLDER if self._seen else tr("Android/data, in the app's folder")

    def share(self, path: Path) -> None:
        """OSError in words of Android's where it refuses, of the system's where the copy cannot be written."""
        from jnius import JavaException

        try:
            self._send(self._put(path) if self._seen else self._copy(path), path)
        except JavaException as problem:
            raise OSError(tr(REFUSES).format(problem)) from problem

    def forget(self) -> None:
        """Only what this app put there is found."""
        from jnius import JavaException, autoclass

        try:
            if self._seen:
                downloads = autoclass("android.provider.MediaStore$Downloads").EXTERNAL_CONTENT_URI
                # Android keeps the folder with a slash at its end
                self._activity.getContentResolver().delete(
                    downloads, "relative_path=? AND mime_type=?", [f"{FOLDER}/", ZIP]
                )
            else:
                for copy in self._outside().glob("*.zip"):
                    copy.unlink(missing_ok=True)
        except JavaException as problem:
            raise OSError(
                tr("Android does not delete the copies: {problem}").format(problem=problem)
            ) from problem

    def _put(self, path: Path) -> Any:
        """The address of a copy in Download."""
        from jnius import autoclass

        resolver, values = self._activity.getContentResolver(), autoclass("android.content.ContentValues")()
        for name, value in (
            ("_display_name", path.name),
            ("mime_type", _kind(path)),
            ("relative_path", FOLDER),
        ):
            values.put(name, value)
        address = resolver.insert(
            autoclass("android.provider.MediaStore$Downloads").EXTERNAL_CONTENT_URI, values
        )
        if address is None:
            raise OSError(tr(REFUSES).format(tr("its list of files takes no more.")))
        opened = resolver.openFileDescriptor(address, "w")
        with os.fdopen(opened.detachFd(), "wb") as copy, path.open("rb") as zip_:
            shutil.copyfileobj(zip_, copy)
        return address

    def _copy(self, path: Path) -> Any:
        """The address of a copy in the app's folder on the shared storage."""
        from jnius import autoclass

        copy = self._outside() / path.name
        shutil.copyfile(path, copy)
        # only a provider's address is let out otherwise, and that would have to be written in Java
        lax = autoclass("android.os.StrictMode$VmPolicy$Builder")().build()
        autoclass("android.os.StrictMode").setVmPolicy(lax)
        return autoclass("android.net.Uri").fromFile(autoclass("java.io.File")(str(copy)))

    def _outside(self) -> Path:
        folder = self._activity.getExternalFilesDir(None)
        if folder is None:
            raise OSError(tr(REFUSES).format(tr("its shared storage is not there.")))
        return Path(str(folder.getAbsolutePath()))

    def _send(self, address: Any, path: Path) -> None:
        from jnius import autoclass, cast

        intent, text = autoclass("android.content.Intent"), autoclass("java.lang.String")
        send = intent(intent.ACTION_SEND)
        send.setType(_kind(path))
        send.putExtra(intent.EXTRA_STREAM, cast("android.os.Parcelable", address))
        send.addFlags(intent.FLAG_GRANT_READ_URI_PERMISSION)
        self._activity.startActivity(
            intent.createChooser(send, cast("java.lang.CharSequence", text(path.name)))
        )


def _kind(path: Path) -> str:
    return KINDS.get(path.suffix, BYTES)


def sharing() -> Sharing | None:
    """That of the device that this runs on; None where the folder itself can be looked into."""
    return AndroidSharing() if is_android() else None
