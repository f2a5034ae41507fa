from __future__ import annotations

import moderngl
import numpy as np
import pytest

from sim.rendering import mipmaps
from sim.rendering.mipmaps import add_mipmaps, halved


def test_half_a_picture_is_the_mean_of_each_four_pixels() -> None:
    picture = np.array([[[0], [4], [9]], [[8], [12], [9]], [[9], [9], [9]]], dtype=np.uint8)
    assert halved(picture).tolist() == [[[6]]]


@pytest.mark.parametrize("shape", [(1, 4, 2), (4, 1, 2)])
def test_a_picture_of_one_row_or_column_is_halved_along_the_other(shape: tuple[int, int, int]) -> None:
    assert halved(np.full(shape, 7, dtype=np.uint8)).shape == (
        max(shape[0] // 2, 1),
        max(shape[1] // 2, 1),
        2,
    )


@pytest.mark.parametrize("found", [True, False])
def test_a_texture_gets_all_its_smaller_copies(monkeypatch: pytest.MonkeyPatch, *, found: bool) -> None:
    if not found:
        monkeypatch.setattr(mipmaps, "_calls", lambda: None)
    data = bytes([200, 100] * (37 * 20))
    context = moderngl.create_context(standalone=True, backend="egl")  # type: ignore[arg-type]
    texture = context.texture((37, 20), 2, data, alignment=1)
    add_mipmaps(texture, data, 0)
    target = context.framebuffer([context.renderbuffer((1, 1), 4)])
    program = context.program(
        vertex_shader="#version 330\nvoid main() { gl_PointSize = 9.0; gl_Position = vec4(0.0, 0.0, 0.0, 1.0); }",
        fragment_shader="#version 330\nuniform sampler2D t; out vec4 c; void main() { c = textureLod(t, vec2(0.5), 5.0); }",
    )
    texture.filter = (moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR)
    target.use()
    context.enable_only(moderngl.PROGRAM_POINT_SIZE)
    context.vertex_array(program, []).render(moderngl.POINTS, vertices=1)
    assert tuple(target.read(components=2, alignment=1)) == (200, 100)
    context.release()
