"""Shaders are found in the code and compiled."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.android import shaders
from scripts.android.failure import Failed

GOOD = 'FS = "$HEADER$ void main() { gl_FragColor = vec4(1.0); }"\n'


def test_they_are_found_in_the_code_and_get_kivys_header(tmp_path):
    (tmp_path / "main.py").write_text(GOOD)
    ((where, kind, text),) = shaders.shaders([Path("main.py")], tmp_path)
    assert (where, kind) == ("main.py:1", "frag")
    assert shaders.glsl_es(kind, text).startswith("#version 100\n")


def compiler(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stands for the reference compiler: takes what has no word that GLSL ES lacks."""
    program = folder / "glslangValidator"
    program.write_text('#!/bin/sh\n! grep -q "double" || { echo "ERROR: double"; exit 1; }\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}:/usr/bin:/bin")


def test_one_that_does_not_compile_is_told_with_its_place(tmp_path, monkeypatch):
    compiler(tmp_path, monkeypatch)
    (tmp_path / "main.py").write_text(GOOD)
    assert shaders.check_shaders([Path("main.py")], tmp_path) == "shaders: 1 compile as GLSL ES 1.00"
    (tmp_path / "main.py").write_text(GOOD.replace("vec4(1.0)", "vec4(double(1.0))"))
    with pytest.raises(Failed, match=r"shader at main\.py:1 is not GLSL ES 1\.00: ERROR: double"):
        shaders.check_shaders([Path("main.py")], tmp_path)


def test_nothing_is_said_to_hold_without_the_compiler(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(Failed, match="glslang-tools"):
        shaders.check_shaders([], tmp_path)
