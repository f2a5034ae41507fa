"""Shaders of the code, compiled by the reference compiler as the phone's graphics would."""

from __future__ import annotations

import ast
import importlib.util
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

from scripts.android.failure import Failed

__all__ = ["check_shaders", "glsl_es", "shaders"]


def shaders(files: list[Path], root: Path) -> Iterator[tuple[str, str, str]]:
    """(where, `frag` or `vert`, GLSL text) of each shader that stands in the code as a string."""
    for path in files:
        if path.suffix != ".py":
            continue
        for node in ast.walk(ast.parse((root / path).read_text())):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and "void main" in node.value:
                kind = "vert" if "gl_Position" in node.value else "frag"
                yield f"{path}:{node.lineno}", kind, node.value


def glsl_es(kind: str, text: str) -> str:
    """The text with Kivy's header put in, as the phone's compiler gets it."""
    found = importlib.util.find_spec("kivy")  # importing it would print and write logs
    if found is None or found.origin is None:
        raise Failed("Kivy, whose header the shaders need, is not installed.")
    header = Path(found.origin).parent / "data" / "glsl" / f"header.{kind[0]}s"
    body = text.replace("$HEADER$", header.read_text())
    return "#version 100\n" + body


def check_shaders(files: list[Path], root: Path) -> str:
    """Compile the shaders; says what was done. Failed for one that does not compile, and without the compiler."""
    found = list(shaders(files, root))
    tool = shutil.which("glslangValidator")
    if not tool:
        raise Failed("glslangValidator, which compiles shaders, is not installed (Debian: glslang-tools).")
    for where, kind, text in found:
        command = [tool, "--stdin", "-S", kind]
        done = subprocess.run(command, input=glsl_es(kind, text), capture_output=True, text=True, check=False)
        if done.returncode:
            raise Failed(f"the shader at {where} is not GLSL ES 1.00: {done.stdout.strip()}")
    return f"shaders: {len(found)} compile as GLSL ES 1.00"
