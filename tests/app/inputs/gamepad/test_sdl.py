"""SDL itself is asked: which gamepads are plugged in, what they measure, which fingers are on the glass."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator

import pytest

from app.inputs.gamepad.sdl import Sdl
from bench.support.virtual_pad import EAST, VirtualPad, kivys_sdl


@pytest.fixture
def library() -> ctypes.CDLL:
    return kivys_sdl()


@pytest.fixture
def sdl(library: ctypes.CDLL) -> Iterator[Sdl]:
    sdl = Sdl(library)
    yield sdl
    sdl.close()


@pytest.fixture
def pad(library: ctypes.CDLL, sdl: Sdl) -> Iterator[VirtualPad]:
    pad = VirtualPad(library)
    yield pad
    pad.unplug()


def test_without_a_gamepad_there_is_none(sdl: Sdl) -> None:
    assert sdl.pads() == []


def test_a_gamepad_that_is_plugged_in_later_is_there_with_its_stick_and_its_button(
    sdl: Sdl, pad: VirtualPad
) -> None:
    pad.push(0.5, 1.0)
    (state,) = sdl.pads()
    assert (state.forward, state.left) == (pytest.approx(0.5, abs=1e-4), pytest.approx(1.0, abs=1e-4))
    assert (state.name, state.stop, state.stop_button) == ("Virtual Controller", False, EAST)
    assert state.right == (0.0, 0.0)
    pad.push_right(-0.5, 1.0)
    assert sdl.pads()[0].right == (pytest.approx(-0.5, abs=1e-4), pytest.approx(1.0, abs=1e-4))
    pad.button(EAST, down=True)
    assert sdl.pads()[0].stop
    assert sdl.pads()[0].raw != state.raw


def test_an_unplugged_gamepad_is_gone_at_once_though_its_stick_was_pushed(sdl: Sdl, pad: VirtualPad) -> None:
    pad.push(1.0)
    assert sdl.pads()[0].forward > 0.99
    pad.unplug()
    assert sdl.pads() == []


def test_plugged_in_again_it_is_another_one(library: ctypes.CDLL, sdl: Sdl, pad: VirtualPad) -> None:
    (first,) = sdl.pads()
    pad.unplug()
    again = VirtualPad(library)
    (second,) = sdl.pads()
    again.unplug()
    assert first.number != second.number


def test_a_touch_whose_finger_is_not_on_the_glass_is_over_and_others_are_not_judged(sdl: Sdl) -> None:
    assert sdl.lifted("sdl", 3)
    assert sdl.lifted("mouse", "mouse1")
    assert not sdl.lifted("mtdev", 3)


def test_an_sdl_that_is_too_old_is_refused_in_one_sentence() -> None:
    class Old:
        pass

    with pytest.raises(OSError, match="This SDL has no .*SDL_JoystickOpen"):
        Sdl(Old())  # type: ignore[arg-type]
