"""Fences of OpenGL, by functions that stand where OpenGL's would."""

from __future__ import annotations

import ctypes

import pytest

from app.device.gl_fences import GlFences, has_fences

COMPLETE, FLUSH = 0x9117, 1
ALREADY, EXPIRED, FAILED = 0x911A, 0x911B, 0x911D


class Gl:
    """An OpenGL whose answers a test chooses."""

    def __init__(self, version: bytes | None = b"4.5 (Compatibility Profile) Mesa 22.3.6") -> None:
        self.version = None if version is None else ctypes.create_string_buffer(version)
        self.answer, self.room = EXPIRED, True
        self.asked: list[tuple[object, ...]] = []
        pointer, number = ctypes.c_void_p, ctypes.c_uint
        self.functions = {
            b"glGetString": ctypes.CFUNCTYPE(pointer, number)(lambda _: self._text()),
            b"glFenceSync": ctypes.CFUNCTYPE(pointer, number, number)(self._fence),
            b"glClientWaitSync": ctypes.CFUNCTYPE(number, pointer, number, ctypes.c_uint64)(self._wait),
            b"glDeleteSync": ctypes.CFUNCTYPE(None, pointer)(lambda fence: self.asked.append(("del", fence))),
        }

    def _text(self) -> int | None:
        return None if self.version is None else ctypes.addressof(self.version)

    def _fence(self, condition: int, flags: int) -> int | None:
        self.asked.append(("fence", condition, flags))
        return 77 if self.room else None

    def _wait(self, *asked: int) -> int:
        self.asked.append(("wait", *asked))
        return self.answer

    def function(self, name: bytes) -> int | None:
        found = self.functions.get(name)
        return ctypes.cast(found, ctypes.c_void_p).value if found is not None else None


def test_a_fence_has_what_was_drawn_begun_and_is_asked_without_waiting() -> None:
    gl = Gl()
    fences = GlFences(gl.function)
    fence = fences.insert()
    assert fence == 77
    assert gl.asked == [("fence", COMPLETE, 0), ("wait", 77, FLUSH, 0)], "what is only queued is begun"
    assert not fences.passed(fence)
    assert gl.asked[-1] == ("wait", 77, 0, 0), "for no time at all"
    gl.answer = ALREADY
    assert fences.passed(fence)
    fences.delete(fence)
    assert gl.asked[-1] == ("del", 77)


def test_a_fence_that_cannot_be_asked_holds_nothing_up() -> None:
    gl = Gl()
    gl.answer = FAILED
    assert GlFences(gl.function).passed(77)


def test_where_there_is_no_room_for_one_there_is_none() -> None:
    gl = Gl()
    gl.room = False
    assert GlFences(gl.function).insert() is None


@pytest.mark.parametrize("version", [b"2.1 Mesa 20", b"OpenGL ES 2.0 Mali", b"", None])
def test_an_old_opengl_has_none_whatever_its_library_offers(version: bytes | None) -> None:
    with pytest.raises(OSError, match="has no fences"):
        GlFences(Gl(version).function)


def test_one_that_lacks_a_function_has_none() -> None:
    gl = Gl()
    del gl.functions[b"glFenceSync"]
    with pytest.raises(OSError, match="no glFenceSync"):
        GlFences(gl.function)


def test_without_sdl_there_are_none() -> None:
    assert GlFences.of(None) is None


@pytest.mark.parametrize(
    ("version", "has"),
    [
        ("3.2", True),
        ("3.1 Mesa", False),
        ("4.6.0 NVIDIA 535", True),
        ("OpenGL ES 3.0 V@331", True),
        ("ES", False),
    ],
)
def test_versions(version: str, has: bool) -> None:
    assert has_fences(version) is has
