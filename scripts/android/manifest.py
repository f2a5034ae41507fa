"""What Android is told of the app: its manifest, strings and Gradle file, rendered by python-for-android's own templates.

`aapt` reads the manifest as Android's own tool does. Its framework is Android 10's: attributes that are newer are taken out for it, and
nothing else. What it makes is no package: it has neither code nor libraries.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree as ET

from scripts.android.failure import Failed, run

__all__ = ["FRAMEWORK", "Rendered", "check_badging", "check_gradle", "check_manifest", "packed", "rendered"]

TOOLCHAIN = Path(__file__).parent / "toolchain"
FRAMEWORK = Path("/usr/share/android-framework-res/framework-res.apk")
NEWER = ("enableOnBackInvokedCallback", "usesPermissionFlags", "localeConfig", "dataExtractionRules",
         "foregroundServiceType")  # fmt: skip
"""Attributes that Android 10 did not know."""
ANDROID = "{http://schemas.android.com/apk/res/android}"
EVERYWHERE = frozenset({"android.hardware.faketouch", "android.hardware.touchscreen"})
"""What every device has that the app is for; whatever else is asked for must not be required, or a shop hides the app."""


class Rendered(NamedTuple):
    """A tree of files that a build would begin with."""

    dist: Path
    package: str

    @property
    def manifest(self) -> Path:
        """AndroidManifest.xml."""
        return self.dist / "src/main/AndroidManifest.xml"


def rendered(python: Path, spec: Path, folder: Path) -> Rendered:
    """By the Python that has buildozer and python-for-android; Failed with what they said."""
    told = run(
        str(python), str(TOOLCHAIN / "render.py"), str(spec), str(folder), where=spec.parent, limit=300.0
    )
    return Rendered(folder / "dist", told.splitlines()[-1])


def check_manifest(text: str, permissions: list[str], api: int, least: int) -> None:
    """The manifest asks for what the spec says, each once, and for the versions of Android that it says."""
    root = ET.fromstring(text)  # noqa: S314 - of our own making
    asked = [node.get(f"{ANDROID}name", "") for node in root.iter("uses-permission")]
    twice = sorted({name for name in asked if asked.count(name) > 1})
    if twice:
        raise Failed(f"the manifest asks twice for {', '.join(twice)}.")
    if odd := sorted(set(asked) ^ set(permissions)):
        raise Failed(f"the manifest and android.permissions differ in {', '.join(odd)}.")
    sdk = root.find("uses-sdk")
    versions = [
        sdk.get(f"{ANDROID}{which}SdkVersion") if sdk is not None else None for which in ("min", "target")
    ]
    if versions != [str(least), str(api)]:
        raise Failed(f"the manifest is for Android {versions}, the spec for {[least, api]}.")
    _check_activities(root)


def _check_activities(root: ET.Element) -> None:
    for activity in (*root.iter("activity"), *root.iter("service"), *root.iter("receiver")):
        name = activity.get(f"{ANDROID}name", "?")
        if activity.find("intent-filter") is not None and activity.get(f"{ANDROID}exported") is None:
            raise Failed(
                f"{name} has an intent filter and does not say android:exported: Android 12 refuses it."
            )
    main = root.find("application/activity")
    changes = set((main.get(f"{ANDROID}configChanges") or "").split("|")) if main is not None else set()
    if lost := {"orientation", "screenSize", "keyboard", "smallestScreenSize", "density"} - changes:
        raise Failed(f"Android would end the app and start it anew on a change of {', '.join(sorted(lost))}.")


def check_gradle(text: str, api: int, least: int) -> None:
    """The build's own description is of the same versions."""
    for name, value in (("compileSdkVersion", api), ("targetSdkVersion", api), ("minSdkVersion", least)):
        found = re.search(rf"{name} (\d+)", text)
        if not found or int(found[1]) != value:
            raise Failed(f"build.gradle has {name} {found and found[1]}, the spec {value}.")


def packed(tree: Rendered, folder: Path) -> Path:
    """A zip of manifest and resources that `aapt` made; Failed without `aapt` or its framework."""
    if not shutil.which("aapt") or not FRAMEWORK.is_file():
        raise Failed("aapt, which reads a manifest, is not installed (Debian: aapt android-framework-res).")
    text = tree.manifest.read_text()
    if "package=" not in text.partition("<manifest ")[2].partition(">")[0]:
        # Gradle puts in its namespace
        text = text.replace("<manifest ", f'<manifest package="{tree.package}" ', 1)
    text = re.sub(rf'android:({"|".join(NEWER)})="[^"]*"', "", text)
    manifest, made = folder / "AndroidManifest.xml", folder / "manifest-check.zip"
    manifest.write_text(text)
    run("aapt", "package", "-f", "-M", str(manifest), "-I", str(FRAMEWORK), "-S", "src/main/res",
        "-A", "src/main/assets", "-F", str(made), where=tree.dist)  # fmt: skip
    return made


def check_badging(told: str, tree: Rendered, permissions: list[str]) -> None:
    """What `aapt dump badging` says is the app that was meant, and no device is shut out by what it could do without."""
    name = re.search(r"^package: name='([^']*)'", told, re.MULTILINE)
    if not name or name[1] != tree.package:
        raise Failed(f"aapt reads the package {name and name[1]}, not {tree.package}.")
    if not re.search(r"^launchable-activity: name='org\.kivy\.android\.PythonActivity'", told, re.MULTILINE):
        raise Failed("aapt finds no activity to launch.")
    asked = set(re.findall(r"^uses-permission: name='([^']*)'", told, re.MULTILINE))
    if lost := set(permissions) - asked:
        raise Failed(f"aapt does not read {', '.join(sorted(lost))}.")
    required = set(re.findall(r"^ *uses-feature: name='([^']*)'", told, re.MULTILINE)) - EVERYWHERE
    if required:
        raise Failed(
            f'{", ".join(sorted(required))} would be required of a device; say required="false" in '
            "android_xml/manifest_extra.xml."
        )
