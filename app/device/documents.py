"""Where a person finds the files of this app, and how one is opened: by the desktop's file manager or Android's apps."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import threading
from pathlib import Path

from app.device import is_android

__all__ = ["documents", "open_file"]

NAME = "Pilothouse"


def documents(own: Path) -> Path:
    """The folder for what an operator keeps: `Documents/Pilothouse`, on Android the app's folder on the shared storage.

    `own`, the app's own folder, where there is neither.
    """
    if is_android():
        from jnius import autoclass

        folder = autoclass("org.kivy.android.PythonActivity").mActivity.getExternalFilesDir(None)
        return Path(str(folder.getAbsolutePath())) if folder is not None else own
    home = Path.home()
    place = _named(home) or home / "Documents"
    return place / NAME if place.is_dir() else own


def _named(home: Path) -> Path | None:
    """What the desktop calls the folder of documents, which it does in the user's language; None where it does not say."""
    config = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config")
    try:
        text = (config / "user-dirs.dirs").read_text(encoding="utf-8")
    except (OSError, ValueError):
        return None
    found = re.search(r'^XDG_DOCUMENTS_DIR="(\$HOME/)?([^"\n]+)"', text, re.MULTILINE)
    if found is None:
        return None
    place = home / found[2] if found[1] else Path(found[2])
    return place if place.is_absolute() and place != home else None


def open_file(path: Path) -> None:
    """Have the desktop open a file or a folder by what it uses for it; OSError where it has nothing.

    On a phone a file is opened by being shared, as `app.device.sharing` does it.
    """
    if sys.platform == "win32":
        os.startfile(path)  # noqa: S606 - of what the operator chose
        return
    opener = "open" if sys.platform == "darwin" else "xdg-open"
    nothing = subprocess.DEVNULL
    opened = subprocess.Popen(
        [opener, str(path)], stdin=nothing, stdout=nothing, stderr=nothing, start_new_session=True
    )
    # it ends by itself, and outlives the app if need be: what is opened is the operator's
    threading.Thread(target=opened.wait, name="opener", daemon=True).start()
