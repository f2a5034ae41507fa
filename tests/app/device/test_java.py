"""The Java of these tests knows what Android has, and nothing else."""

from __future__ import annotations

import pytest

from tests.app.device.java import NotJava, install, java


@pytest.fixture
def jnius(monkeypatch):
    def beep(milliseconds: int) -> str:
        return f"{milliseconds} ms"

    install(
        monkeypatch,
        java("android.os.Vibrator", vibrate=beep, hasVibrator=True),
        java("android.content.Intent", new=lambda action: java("android.content.Intent", getAction=action)),
    )
    import jnius

    return jnius


def test_what_the_test_says_is_done_and_constants_have_their_names(jnius):
    assert jnius.autoclass("android.os.Vibrator").vibrate(20) == "20 ms"
    assert jnius.autoclass("android.os.Vibrator").hasVibrator() is True
    assert jnius.autoclass("android.content.Intent")("view").getAction() == "view"
    assert jnius.autoclass("android.content.Context").WIFI_SERVICE == "android.content.Context.WIFI_SERVICE"


def test_what_a_class_inherits_is_its_own(jnius):
    activity = java("org.kivy.android.PythonActivity", getSystemService="service", mActivity=3)
    assert (activity.getSystemService("wifi"), activity.mActivity) == ("service", 3)


@pytest.mark.parametrize(
    ("asks", "why"),
    [
        (lambda j: j.autoclass("android.os.Vibrater"), "no class android.os.Vibrater"),
        (lambda j: j.cast("android.os.Parcelabel", 1), "no class android.os.Parcelabel"),
        (lambda j: j.autoclass("android.os.Vibrator").buzz, "has no buzz"),
        (lambda j: j.autoclass("android.os.Vibrator").vibrate(), r"does not take \(\)"),
        (lambda j: j.autoclass("android.os.Vibrator").vibrate("long"), "does not take"),
        (lambda j: j.autoclass("android.os.Vibrator").cancel(), "does not say what"),
        (lambda j: j.autoclass("android.content.Intent")(1, 2, 3, 4, 5, 6, 7), "is not made of"),
        (lambda j: java("android.os.Vibrator", buzz=1), "has no buzz"),
        (lambda j: j.java_method("(I"), "no signature"),
        (lambda j: j.java_method("(Landroid/os/Bundles;)V"), "no class android.os.Bundles"),
        (lambda j: j.java_method("(I)V")(lambda self: None), "is handed 1 arguments"),
    ],
)
def test_what_java_does_not_have_is_told(jnius, asks, why):
    with pytest.raises(NotJava, match=why):
        asks(jnius)


def test_an_interface_is_stood_in_for_in_whole(jnius):
    with pytest.raises(NotJava, match="wants onAccuracyChanged with 2 arguments"):
        type(
            "Listener", (jnius.PythonJavaClass,),
            {
                "__javainterfaces__": ("android/hardware/SensorEventListener",),
                "onSensorChanged": jnius.java_method("(Landroid/hardware/SensorEvent;)V")(lambda self, event: None),
            },
        )  # fmt: skip
