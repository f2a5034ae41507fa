"""What Android is told: faults that a build would only show on a device, or in a shop."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.android import manifest
from scripts.android.failure import Failed

INTERNET, VIBRATE = "android.permission.INTERNET", "android.permission.VIBRATE"
TEXT = f"""<manifest xmlns:android="http://schemas.android.com/apk/res/android">
  <uses-sdk android:minSdkVersion="24" android:targetSdkVersion="36" />
  <uses-permission android:name="{INTERNET}" />
  <uses-permission android:name="{VIBRATE}" />
  <application>
    <activity android:name="org.kivy.android.PythonActivity" android:exported="true"
      android:configChanges="keyboard|orientation|screenSize|smallestScreenSize|density">
      <intent-filter />
    </activity>
  </application>
</manifest>"""
GRADLE = "compileSdkVersion 36\nminSdkVersion 24\ntargetSdkVersion 36\n"
BADGING = f"""package: name='io.pilothouse.pilothouse' versionCode='1'
uses-permission: name='{INTERNET}'
launchable-activity: name='org.kivy.android.PythonActivity'  label='Pilothouse'
  uses-feature-not-required: name='android.hardware.microphone'
  uses-feature: name='android.hardware.faketouch'
"""
TREE = manifest.Rendered(Path(), "io.pilothouse.pilothouse")


def judged(text: str = TEXT) -> None:
    manifest.check_manifest(text, [INTERNET, VIBRATE], 36, 24)


def test_what_the_spec_says_holds():
    judged()
    manifest.check_gradle(GRADLE, 36, 24)
    manifest.check_badging(BADGING, TREE, [INTERNET])


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        (VIBRATE, INTERNET, f"asks twice for {INTERNET}"),
        (VIBRATE, "android.permission.CAMERA", "differ in android.permission.CAMERA, android.permission.VIBRATE"),
        ('targetSdkVersion="36"', 'targetSdkVersion="33"', r"for Android \['24', '33'\], the spec for \[24, 36\]"),
        ('android:exported="true"', "", "does not say android:exported"),
        ("|screenSize", "", "start it anew on a change of screenSize"),
    ],
)  # fmt: skip
def test_a_planted_fault_in_the_manifest_is_told(old, new, why):
    with pytest.raises(Failed, match=why):
        judged(TEXT.replace(old, new))


def test_the_build_is_of_the_same_versions():
    with pytest.raises(Failed, match="compileSdkVersion 35, the spec 36"):
        manifest.check_gradle(GRADLE.replace("compileSdkVersion 36", "compileSdkVersion 35"), 36, 24)


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("name='io.pilothouse", "name='org.test", "reads the package org.test.pilothouse"),
        ("launchable-activity", "activity", "no activity to launch"),
        ("uses-permission", "uses-nothing", f"does not read {INTERNET}"),
        ("feature-not-required", "feature", "android.hardware.microphone would be required"),
    ],
)
def test_a_planted_fault_in_what_aapt_reads_is_told(old, new, why):
    with pytest.raises(Failed, match=why):
        manifest.check_badging(BADGING.replace(old, new), TREE, [INTERNET])


def test_nothing_is_packed_without_aapt(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(Failed, match="aapt"):
        manifest.packed(TREE, tmp_path)
