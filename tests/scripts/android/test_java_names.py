"""Names that Java does not have are found before a phone finds them."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.android.failure import Failed
from scripts.android.java_names import check_java_names, stubs_folder

LISTENER = """
class Listener(PythonJavaClass):
    __javainterfaces__ = ("android/hardware/SensorEventListener",)

    @java_method("(Landroid/hardware/SensorEvent;)V")
    def onSensorChanged(self, event):
        pass

    @java_method("(Landroid/hardware/Sensor;I)V")
    def onAccuracyChanged(self, sensor, accuracy):
        pass
"""


def judged(folder: Path, text: str, sources: Path | None = None) -> str:
    (folder / "main.py").write_text(text)
    return check_java_names([Path("main.py")], folder, stubs_folder(), sources)


def test_what_java_has_is_counted(tmp_path):
    text = 'autoclass("android.content.Context").WIFI_SERVICE\nautoclass("java.util.Locale")\n'
    assert judged(tmp_path, text + LISTENER).startswith("Java: 2 classes asked for and 1 interfaces")


def test_a_cast_of_python_is_none_of_javas(tmp_path):
    assert judged(tmp_path, 'cast("Session", one)').startswith("Java: 0 classes")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ('autoclass("android.os.Vibrater")', "main.py:1: there is no Java class android.os.Vibrater"),
        ('cast("android.os.Parcelabel", it)', "no Java class android.os.Parcelabel"),
        ('autoclass("android.os.Build$VERSIONS")', "no Java class"),
        ('autoclass("android.content.Context").WIFI', "android.content.Context has no WIFI"),
        (LISTENER.replace("SensorEventListener", "SensorEventListening"), "no Java class"),
        (
            LISTENER.replace("onAccuracyChanged", "onAccuracyChange"),
            "wants onAccuracyChanged with 2 arguments",
        ),
        (LISTENER.replace("Sensor;I)", "Sensor;)"), "wants onAccuracyChanged with 2 arguments"),
        (LISTENER.replace("SensorEvent;", "SensorEvents;"), "no Java class android.hardware.SensorEvents"),
        (LISTENER.replace("Sensor;I)V", "Sensor;I"), "no signature of Java's"),
    ],
)
def test_a_planted_fault_is_told_with_its_place(tmp_path, text, why):
    with pytest.raises(Failed, match=why):
        judged(tmp_path, text)


def test_a_method_that_the_interface_does_not_have_would_never_be_called(tmp_path):
    more = LISTENER + '\n    @java_method("()V")\n    def onShaken(self):\n        pass\n'
    with pytest.raises(Failed, match="has no onShaken"):
        judged(tmp_path, more)


def test_the_apps_own_java_is_looked_up_in_its_sources(tmp_path):
    place = tmp_path / "src/main/java/org/kivy/android"
    place.mkdir(parents=True)
    (place / "PythonActivity.java").write_text("")
    assert judged(tmp_path, 'autoclass("org.kivy.android.PythonActivity").mActivity', tmp_path)
    with pytest.raises(Failed, match="PythonActivities"):
        judged(tmp_path, 'autoclass("org.kivy.android.PythonActivities")', tmp_path)
