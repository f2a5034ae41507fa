"""Profiles of the operator's own on the disk: one layout file each, replaced as a whole, with the one before kept beside it."""

from __future__ import annotations

import contextlib
import errno
import os
import re
import stat
from collections.abc import Callable, Iterable
from pathlib import Path

from app.layout.layout import Layout, LayoutError, LayoutFault, parse
from app.layout.layout_text import text_of
from widgets.core.language import tr

__all__ = ["MAX_BYTES", "ProfileStore", "file_name", "write_whole"]

MAX_BYTES = 200_000
"""Of a profile's file; a longer one is not read [bytes]."""
BACKUP = ".bak"


def file_name(title: str) -> str:
    """A file's name of letters, digits and dashes for a profile with that title; never empty."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")[:40] or "profile"


def write_whole(path: Path, text: str, first: Callable[[], object] = lambda: None) -> None:
    """Put a text into the place of a file, or leave that as it is; `first` is done before. OSError where it cannot be written.

    It is written beside the file at first; what could not be written to its end is not left there.
    """
    fresh = path.with_name(f"{path.name}.new")
    path.parent.mkdir(parents=True, exist_ok=True)
    try:
        with fresh.open("w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        first()
        fresh.replace(path)
    except OSError:
        with contextlib.suppress(OSError):
            fresh.unlink()
        raise


def _read(path: Path) -> bytes:
    """At most one byte more than a profile may have; OSError where it cannot be read, or is a pipe, a device or a folder.

    Whoever opens a pipe that nobody writes to would wait for ever.
    """
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    with os.fdopen(os.open(path, flags), "rb") as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError(errno.EINVAL, tr("it is no ordinary file"))
        return file.read(MAX_BYTES + 1)


class ProfileStore:
    """The folder with the operator's profiles. Reading and writing is in the calling thread: the files are small."""

    def __init__(self, folder: Path, widgets: Iterable[str]) -> None:
        """`widgets` are the names of the catalogue."""
        self.folder, self._widgets = folder, tuple(widgets)

    def names(self) -> list[str]:
        """Names of the profiles there are, faulty ones too."""
        return sorted(path.stem for path in self.folder.glob("*.toml"))

    def path(self, name: str) -> Path:
        """The file of a profile."""
        return self.folder / f"{name}.toml"

    def load(self, name: str) -> Layout:
        """The profile; LayoutError with all that is wrong with its file."""
        return self.read(name, self.text(self.path(name)))

    def read(self, name: str, text: str) -> Layout:
        """The profile in a text of any origin; LayoutError with all that is wrong with it."""
        if len(text.encode(errors="replace")) > MAX_BYTES:
            raise LayoutError(
                tr("Layout {name} has more than {max_bytes} kB.").format(
                    name=name, max_bytes=MAX_BYTES // 1000
                )
            )
        return parse(name, text, self._widgets)

    @staticmethod
    def text(path: Path) -> str:
        """Text of a file of any origin; LayoutError where it cannot be read."""
        try:
            content = _read(path)
            if len(content) > MAX_BYTES:
                raise LayoutError(
                    tr("Layout {stem} has more than {max_bytes} kB.").format(
                        stem=path.stem, max_bytes=MAX_BYTES // 1000
                    )
                )
            return content.decode("utf-8")
        except OSError as error:
            raise LayoutError(
                tr("Layout {stem} cannot be read: {strerror}.").format(
                    stem=path.stem, strerror=error.strerror
                )
            ) from error
        except UnicodeDecodeError as error:
            line = content[: error.start].count(b"\n") + 1
            sentence = tr("Layout {stem}: is no UTF-8 text.").format(stem=path.stem)
            raise LayoutError(sentence, [LayoutFault(sentence, line)]) from error

    def save(self, layout: Layout) -> None:
        """Replace the profile's file as a whole; the one before is kept beside it, a faulty one for good. OSError where that fails."""
        path = self.path(layout.name)
        write_whole(path, text_of(layout), lambda: self._set_aside(path) if path.exists() else None)

    def _set_aside(self, path: Path) -> None:
        try:
            self.load(path.stem)
            aside = path.with_suffix(BACKUP)
        except LayoutError:
            numbers = (path.with_suffix(f".faulty{number or ''}") for number in range(1000))
            aside = next((one for one in numbers if not one.exists()), path.with_suffix(BACKUP))
        aside.write_bytes(path.read_bytes())

    def unused(self, title: str) -> str:
        """A name for a new profile with that title."""
        name, taken = file_name(title), set(self.names())
        return next(one for one in (name, *(f"{name}-{n}" for n in range(2, 1000))) if one not in taken)
