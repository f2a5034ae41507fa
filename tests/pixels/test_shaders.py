"""Phones speak GLSL ES 1.00, which refuses what a desktop forgives: every shader is compiled as that."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import kivy
import pytest

from widgets.core import canvas_ink as ink
from widgets.instruments import horizon
from widgets.map import grid_picture
from widgets.plots import trace_ink
from widgets.sensors import sweep_ink, video

GLSL = Path(kivy.__file__).parent / "data/glsl"
COMPILE = """
import sys, moderngl
vertex, fragment = sys.stdin.read().split("=====")
context = moderngl.create_standalone_context(backend="egl")
try:
    context.program(vertex_shader=vertex.strip(), fragment_shader=fragment.strip())
except moderngl.Error as refused:
    sys.exit(str(refused))
"""


def compiled(vertex: str, fragment: str) -> str:
    """What the compiler says against the pair; empty when it takes them. In a process of its own, away from Kivy's GL."""
    parts = []
    for text, kind in ((vertex, "vs"), (fragment, "fs")):
        header = (GLSL / f"header.{kind}").read_text()
        parts.append("#version 100\n" + text.replace("$HEADER$", header))
    done = subprocess.run(
        [sys.executable, "-c", COMPILE],
        input="=====".join(parts),
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stderr


KIVYS = (GLSL / "default.vs").read_text()
PAIRS = {
    "ink": (ink.VERTEX, ink.FRAGMENT),
    "grid": (KIVYS, grid_picture.FRAGMENT),
    "horizon": (KIVYS, horizon.FRAGMENT),
    "sweep": (sweep_ink.VERTEX, sweep_ink.FRAGMENT),
    "traces": (trace_ink.VERTEX, trace_ink.FRAGMENT),
    "video": (KIVYS, video.FRAGMENT),
}


@pytest.mark.parametrize("name", PAIRS)
def test_a_shader_compiles_as_gles(name):
    assert compiled(*PAIRS[name]) == ""


def test_the_compiler_is_as_strict_as_a_phone():
    assert (
        "error" in compiled(KIVYS, "$HEADER$\nvoid main() { float a = 1; gl_FragColor = vec4(a); }").lower()
    )
