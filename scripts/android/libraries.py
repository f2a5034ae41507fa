"""Compiled libraries in a package: each is of a phone's processor, and laid out for pages of 16 kB, which Google's shop wants.

No library is built here. A build's package is judged by `python -m scripts.android.libraries FILE`, as the workflow of the public forge does.
"""

from __future__ import annotations

import struct
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from scripts.android.failure import Failed

__all__ = ["MACHINES", "PAGE", "Library", "check_libraries", "libraries", "read_library"]

PAGE = 16_384
"""What parts of a library are aligned to, at least [bytes]; only 64 bit devices have such pages."""
MACHINES = {183: "aarch64", 40: "arm", 62: "x86-64", 3: "x86"}
"""Numbers of processors in a library's head, those that Android runs on."""
BUNDLE = "libpybundle.so"
"""The app's Python library: a tar by another name."""
LOAD = 1
"""A part that is loaded into memory."""


class Library(NamedTuple):
    """What the head of an ELF file says."""

    name: str
    machine: int
    wide: bool
    """It is of 64 bits."""
    alignment: int
    """The least of its loaded parts [bytes]."""


def read_library(name: str, data: bytes) -> Library:
    """Failed where it is no ELF file, or a broken one."""
    if data[:4] != b"\x7fELF":
        raise Failed(f"{name} is no library.")
    try:
        wide = data[4] == 2
        machine = struct.unpack_from("<H", data, 18)[0]
        at = struct.unpack_from("<Q" if wide else "<I", data, 32 if wide else 28)[0]
        size, count = struct.unpack_from("<HH", data, 54 if wide else 42)
        heads = [at + index * size for index in range(count)]
        loaded = [head for head in heads if struct.unpack_from("<I", data, head)[0] == LOAD]
        word, where = ("<Q", 48) if wide else ("<I", 28)
        alignment = min(struct.unpack_from(word, data, head + where)[0] for head in loaded)
    except (struct.error, IndexError, ValueError):
        raise Failed(f"{name} is a broken library.") from None
    return Library(name, machine, wide, alignment)


def libraries(package: Path) -> Iterator[Library]:
    """Those of an APK, a bundle or a wheel."""
    with zipfile.ZipFile(package) as archive:
        for name in archive.namelist():
            if name.endswith(".so") and not name.endswith(BUNDLE):
                yield read_library(name, archive.read(name))


def check_libraries(found: list[Library], machines: frozenset[int] = frozenset(MACHINES)) -> str:
    """Failed for the first that a phone cannot load; else how many there are."""
    if not found:
        raise Failed("the package has no library: it is none that would start.")
    for library in found:
        if library.machine not in machines:
            raise Failed(
                f"{library.name} is of processor {library.machine}, not of {', '.join(MACHINES[one] for one in sorted(machines))}."
            )
        if library.wide and library.alignment < PAGE:
            raise Failed(
                f"{library.name} is aligned to {library.alignment} bytes, not to {PAGE}: no device with large pages loads it."
            )
    return f"libraries: {len(found)}, of a phone's processor and laid out for pages of {PAGE} bytes"


def main() -> int:
    """Judge the packages named on the command line."""
    for name in sys.argv[1:]:
        try:
            print(check_libraries(list(libraries(Path(name))), frozenset({183, 40})))
        except (Failed, OSError, zipfile.BadZipFile) as failure:
            print(f"{name}: {failure}")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
