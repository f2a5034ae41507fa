"""The only package that knows whether it runs on a phone."""

from __future__ import annotations

import ctypes
import os
import platform
import re
import sys
from collections.abc import Callable
from pathlib import Path

__all__ = [
    "device_name",
    "input_devices",
    "is_android",
    "own_folder",
    "rotation",
    "sdl_library",
]


def is_android() -> bool:
    """It runs in an APK."""
    return hasattr(sys, "getandroidapilevel")


def device_name() -> str:
    """What to call this handheld to others, as in `tablet-B`: the phone's model or the computer's host name."""
    if is_android():
        from jnius import autoclass

        return str(autoclass("android.os.Build").MODEL)
    return platform.node().partition(".")[0] or "handheld"


def own_folder(ask: Callable[[], str]) -> str:
    """Where the system wants this app's files, as `ask` tells: Kivy, who makes only the last folder of the way there."""
    if not is_android():
        config = os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config"
        Path(config).mkdir(parents=True, exist_ok=True)
    return ask()


def sdl_library() -> ctypes.CDLL | None:
    """The SDL that Kivy's window stands on; None where none is loaded or it is not found."""
    if is_android():
        name = "libSDL2.so"
    elif sys.platform == "win32":
        name = "SDL2.dll"
    else:
        try:
            mapped = Path("/proc/self/maps").read_text(encoding="utf-8", errors="replace")
        except OSError:
            return None
        found = re.search(r"(/\S*/libSDL2-2\S*)$", mapped, re.MULTILINE)
        if found is None:
            return None
        name = found[1]
    try:
        return ctypes.CDLL(name)
    except OSError:
        return None


def input_devices() -> frozenset[int]:
    """Numbers of the keyboards, screens and gamepads that Android has now; elsewhere none.

    SDL looks for a gamepad that went only every 3 s there.
    """
    if not is_android():
        return frozenset()
    from jnius import autoclass

    return frozenset(autoclass("android.view.InputDevice").getDeviceIds())


def rotation() -> int:
    """How the screen is turned, in quarters, as Android tells; 0 elsewhere.

    A device turned upside down keeps the window's size, so that Kivy does not tell.
    """
    if not is_android():
        return 0
    from jnius import autoclass

    activity = autoclass("org.kivy.android.PythonActivity").mActivity
    return int(activity.getWindowManager().getDefaultDisplay().getRotation())
