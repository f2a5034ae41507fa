"""The edges of a phone: what it tells of cutouts and bars, as far as they lie over what the app draws on."""

from __future__ import annotations

from typing import Any

import pytest

from app.device import insets as module
from app.device.insets import NONE, VARIABLE, Insets, beyond_content, insets, read_insets
from tests.app.device.java import JavaException, install, java


def test_the_environment_says_them_in_dp() -> None:
    assert insets(2.0, {VARIABLE: "30, 0,0 ,12.5"}) == Insets(60.0, 0.0, 0.0, 25.0)
    assert insets(2.0, {}) == NONE


@pytest.mark.parametrize(
    "text", ["30", "1,2,3", "1,2,3,4,5", "a,b,c,d", "-1,0,0,0", "nan,0,0,0", "0,0,0,1e9"]
)
def test_anything_else_is_said_with_its_value_and_takes_nothing(
    text: str, caplog: pytest.LogCaptureFixture
) -> None:
    with pytest.raises(ValueError, match="four numbers of 0 to 200 dp") as told:
        read_insets(text, 1.0)
    assert repr(text) in str(told.value)
    assert insets(1.0, {VARIABLE: text}) == NONE
    assert "four numbers" in caplog.text


def test_what_the_content_keeps_clear_of_already_is_not_kept_twice() -> None:
    safe = Insets(90, 0, 0, 40)
    assert beyond_content(safe, (2400, 1080), (0, 0, 2400, 1080)) == safe
    assert beyond_content(safe, (2400, 1080), (90, 0, 2310, 1080)) == Insets(0, 0, 0, 40)
    assert beyond_content(safe, (2400, 1080), (50, 0, 2350, 1040)) == Insets(40, 0, 0, 0)


def place(at: list[int]) -> None:
    at[:] = [0, 0]


def phone(monkeypatch: pytest.MonkeyPatch, told: Any) -> None:
    content = java("android.view.View", getLocationInWindow=place, getWidth=2400, getHeight=1080)
    view = java(
        "android.view.View", getRootWindowInsets=told, getWidth=2400, getHeight=1080, findViewById=content
    )
    window = java("android.view.Window", getDecorView=view)
    activity = java("android.app.Activity", getWindow=window)
    install(
        monkeypatch,
        java("org.kivy.android.PythonActivity", mActivity=activity),
        java("android.R$id", content=7),
    )
    monkeypatch.setattr(module, "is_android", lambda: True)


def sides(kind: str, left: int, top: int, right: int, bottom: int) -> dict[str, Any]:
    values = dict(zip(("Left", "Top", "Right", "Bottom"), (left, top, right, bottom), strict=True))
    return {f"get{kind}Inset{side}": value for side, value in values.items()}


def test_on_a_phone_the_larger_of_cutout_and_bars_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    cutout = java("android.view.DisplayCutout", **sides("Safe", 90, 0, 0, 0))
    told = java("android.view.WindowInsets", **sides("SystemWindow", 60, 0, 0, 48), getDisplayCutout=cutout)
    phone(monkeypatch, told)
    assert insets(2.625, {}) == Insets(90, 0, 0, 48)
    phone(
        monkeypatch,
        java("android.view.WindowInsets", **sides("SystemWindow", 0, 63, 0, 0), getDisplayCutout=None),
    )
    assert insets(2.625, {}) == Insets(0, 63, 0, 0)


def too_old() -> None:
    raise JavaException("no method getDisplayCutout")


@pytest.mark.parametrize("kind", ["nothing yet", "an older system"])
def test_a_phone_that_does_not_tell_has_all_of_its_glass(monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    old = java("android.view.WindowInsets", **sides("SystemWindow", 0, 63, 0, 0), getDisplayCutout=too_old)
    phone(monkeypatch, None if kind == "nothing yet" else old)
    assert insets(2.625, {}) == NONE
