"""Permissions: each that the code needs is asked for, each that is asked for is needed, and Android knows them all."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from pathlib import Path

from scripts.android.failure import Failed
from scripts.android.java_names import java_class

__all__ = ["NEEDS", "check_permissions", "check_queries", "needed"]

PREFIX = "android.permission."
NEEDS = {
    r"\bsocket\b|\bwebsockets\b": ("INTERNET",),
    r"createMulticastLock": ("CHANGE_WIFI_MULTICAST_STATE",),
    r"createWifiLock|newWakeLock": ("WAKE_LOCK",),
    r"ConnectivityManager|getActiveNetwork|registerNetworkCallback": ("ACCESS_NETWORK_STATE",),
    r"getConnectionInfo|getScanResults|WifiInfo": ("ACCESS_WIFI_STATE",),
    r"plyer import (\w+, )*vibrator|android\.os\.Vibrat|VibrationEffect|VIBRATOR_SERVICE": ("VIBRATE",),
    r"SpeechRecognizer|AudioRecord|MediaRecorder": ("RECORD_AUDIO",),
    r"LocationManager|plyer import (\w+, )*gps": ("ACCESS_COARSE_LOCATION", "ACCESS_FINE_LOCATION"),
    r"CameraManager|android\.hardware\.Camera|kivy\.(core|uix)\.camera": ("CAMERA",),
    r"startForeground\b|start_service|startForegroundService": (
        "FOREGROUND_SERVICE",
        "FOREGROUND_SERVICE_CONNECTED_DEVICE",
    ),
    r"NotificationManager|plyer import (\w+, )*notification": ("POST_NOTIFICATIONS",),
    r"BluetoothAdapter|BluetoothManager": ("BLUETOOTH_CONNECT",),
}
"""What in the code needs which permission of Android's."""
HIDDEN = {
    r"SpeechRecognizer": "android.speech.RecognitionService",
    r"TextToSpeech": "android.intent.action.TTS_SERVICE",
}
"""Services of other apps, which Android 11 and later hide from whoever does not say that it looks for them."""


def _text(files: Iterable[Path], root: Path) -> str:
    """The code without its comments and docstrings, which may name what is not done."""
    parts = []
    for path in files:
        if path.suffix == ".py":
            tree = ast.parse((root / path).read_text())
            for node in ast.walk(tree):
                body = getattr(node, "body", None)
                if isinstance(body, list):
                    node.body = [one for one in body if not _is_text(one)] or [ast.Pass()]  # type: ignore[attr-defined]
            parts.append(ast.unparse(tree))
    return "\n".join(parts)


def _is_text(node: ast.stmt) -> bool:
    return (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
    )


def needed(files: Iterable[Path], root: Path) -> set[str]:
    """Permissions that the code needs, with their whole names."""
    text = _text(files, root)
    return {PREFIX + one for pattern, names in NEEDS.items() if re.search(pattern, text) for one in names}


def check_permissions(asked: list[str], files: list[Path], root: Path, stubs: Path) -> str:
    """Failed where one is unknown to Android, is not asked for, or is asked for in vain."""
    known = java_class("android.Manifest$permission", stubs)
    names = {
        one.target.id
        for one in (known.body if known else ())
        if isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name)
    }
    for permission in asked:
        if permission.removeprefix(PREFIX) not in names:
            raise Failed(f"Android has no permission {permission}.")
    need = needed(files, root)
    if lacking := sorted(need - set(asked)):
        raise Failed(f"android.permissions lacks {', '.join(lacking)}, which the code needs.")
    if idle := sorted(set(asked) - need):
        raise Failed(f"android.permissions asks for {', '.join(idle)}, which nothing in the code needs.")
    return f"permissions: {len(asked)}, each known to Android, needed by the code and asked for"


def check_queries(manifest: str, files: list[Path], root: Path) -> None:
    """Failed where the code looks for a service of another app and the manifest does not say so."""
    text = _text(files, root)
    for pattern, service in HIDDEN.items():
        if re.search(pattern, text) and service not in manifest:
            raise Failed(
                f"the manifest does not ask for {service} in <queries>: Android 11 and later hide it."
            )
