"""Compiled libraries: of a phone's processor, and laid out for its pages."""

from __future__ import annotations

import struct
import sys
import zipfile
from pathlib import Path

import pytest

from scripts.android.failure import Failed
from scripts.android.libraries import PAGE, check_libraries, libraries, main, read_library

AARCH64, X86_64 = 183, 62


def elf(machine: int = AARCH64, alignment: int = PAGE) -> bytes:
    """The head of a library with one loaded part and one that is not."""
    head = bytearray(64)
    head[:5] = b"\x7fELF\x02"
    struct.pack_into("<H", head, 18, machine)
    struct.pack_into("<Q", head, 32, 64)
    struct.pack_into("<HH", head, 54, 56, 2)
    loaded, other = bytearray(56), bytearray(56)
    struct.pack_into("<I", loaded, 0, 1)
    struct.pack_into("<Q", loaded, 48, alignment)
    struct.pack_into("<I", other, 0, 4)
    return bytes(head + loaded + other)


@pytest.fixture
def package(tmp_path):
    path = tmp_path / "app.apk"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("lib/arm64-v8a/libmain.so", elf())
        archive.writestr("lib/arm64-v8a/libpybundle.so", b"a tar by another name")
        archive.writestr("assets/private.tar", b"")
    return path


def test_a_package_that_a_phone_loads(package):
    (found,) = libraries(package)
    assert (found.machine, found.wide, found.alignment) == (AARCH64, True, PAGE)
    assert check_libraries([found]).startswith("libraries: 1,")


def test_the_machines_own_libraries_are_read_too():
    read = read_library("python", Path(sys.executable).read_bytes())
    assert read.wide


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (elf(alignment=4096), "aligned to 4096 bytes, not to 16384"),
        (elf(machine=X86_64), "processor 62, not of arm, aarch64"),
        (b"MZ", "is no library"),
        (elf()[:80], "is a broken library"),
        (b"\x7fELF", "is a broken library"),
    ],
)
def test_a_planted_fault_is_told(data, why):
    with pytest.raises(Failed, match=why):
        check_libraries([read_library("libbad.so", data)], frozenset({AARCH64, 40}))


def test_a_package_without_any_would_not_start():
    with pytest.raises(Failed, match="no library"):
        check_libraries([])


def test_the_program_says_which_file_is_bad(package, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["libraries", str(package)])
    assert main() == 0
    (tmp_path / "torn.apk").write_bytes(b"PK")
    monkeypatch.setattr(sys, "argv", ["libraries", str(tmp_path / "torn.apk")])
    assert main() == 1
    assert "torn.apk: " in capsys.readouterr().out
