"""Permissions: none too few, none too many, none misspelled."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.android.failure import Failed
from scripts.android.java_names import stubs_folder
from scripts.android.permissions import check_permissions, check_queries

CODE = (
    '"""Needs no LocationManager."""\nimport socket\nwifi.createMulticastLock("x")  # nor a CameraManager\n'
)
ASKED = ["android.permission.INTERNET", "android.permission.CHANGE_WIFI_MULTICAST_STATE"]


def judged(folder: Path, asked: list[str], code: str = CODE) -> str:
    (folder / "main.py").write_text(code)
    return check_permissions(asked, [Path("main.py")], folder, stubs_folder())


def test_what_the_code_does_and_not_what_it_says_needs_permissions(tmp_path):
    assert judged(tmp_path, ASKED).startswith("permissions: 2,")


@pytest.mark.parametrize(
    ("asked", "code", "why"),
    [
        ([*ASKED, "android.permission.VIBRATES"], CODE, "no permission android.permission.VIBRATES"),
        (ASKED[:1], CODE, "lacks android.permission.CHANGE_WIFI_MULTICAST_STATE"),
        ([*ASKED, "android.permission.CAMERA"], CODE, "asks for android.permission.CAMERA, which nothing"),
        (ASKED, CODE + "from plyer import vibrator\n", "lacks android.permission.VIBRATE"),
    ],
)
def test_a_planted_fault_is_told(tmp_path, asked, code, why):
    with pytest.raises(Failed, match=why):
        judged(tmp_path, asked, code)


def test_services_of_other_apps_are_looked_for_by_name(tmp_path):
    (tmp_path / "main.py").write_text('autoclass("android.speech.SpeechRecognizer")\n')
    files = [Path("main.py")]
    check_queries('<action android:name="android.speech.RecognitionService" />', files, tmp_path)
    with pytest.raises(Failed, match="RecognitionService"):
        check_queries("", files, tmp_path)
