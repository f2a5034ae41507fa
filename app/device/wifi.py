"""What a phone's Wi-Fi does for the app: it hands over broadcasts, and does not doze between two packets while a robot is connected.

Asleep between beacons of the access point, a packet to the phone waits for up to a few hundred milliseconds. Elsewhere, and on a phone
that refuses, nothing happens.
"""

from __future__ import annotations

import logging
from typing import Any

from app.device import is_android

__all__ = ["WifiLock", "sees_broadcasts"]

log = logging.getLogger(__name__)

NAME = "pilothouse"
LOW_LATENCY_SINCE = 29
"""Android's version with a mode for it (10); before that the one without power saving is the nearest."""


def _service() -> Any:
    """Android's WifiManager; None where a device has none."""
    from jnius import autoclass

    context = autoclass("org.kivy.android.PythonActivity").mActivity.getApplicationContext()
    return context.getSystemService(autoclass("android.content.Context").WIFI_SERVICE)


class _Held:
    """A lock of the phone's Wi-Fi, which a phone may refuse."""

    def __init__(self) -> None:
        self._lock: Any = None

    def _make(self, wifi: Any) -> Any:
        raise NotImplementedError

    def hold(self) -> None:
        """From now on; nothing where it is held."""
        if self._lock is not None or not is_android():
            return
        try:
            wifi = _service()
            if wifi is not None:
                lock = self._make(wifi)
                lock.setReferenceCounted(False)
                lock.acquire()
                self._lock = lock
        except Exception as problem:  # noqa: BLE001 - whatever a phone answers, the app works without it
            log.warning("The phone's Wi-Fi does not do as it was asked: %s", problem)

    def let_go(self) -> None:
        """No longer; nothing where it is not held."""
        lock, self._lock = self._lock, None
        if lock is not None:
            try:
                lock.release()
            except Exception as problem:  # noqa: BLE001 - same; the system takes it back with the process
                log.warning("The phone's Wi-Fi does not take its lock back: %s", problem)


class WifiLock(_Held):
    """Held while a robot is connected and the app is on the glass."""

    def _make(self, wifi: Any) -> Any:
        from jnius import autoclass

        manager = autoclass("android.net.wifi.WifiManager")
        new = autoclass("android.os.Build$VERSION").SDK_INT >= LOW_LATENCY_SINCE
        mode = manager.WIFI_MODE_FULL_LOW_LATENCY if new else manager.WIFI_MODE_FULL_HIGH_PERF
        return wifi.createWifiLock(mode, NAME)


class sees_broadcasts(_Held):  # noqa: N801 - used as a word in `with`
    """While it is entered, the phone's Wi-Fi hands broadcasts to the app."""

    def _make(self, wifi: Any) -> Any:
        return wifi.createMulticastLock(NAME)

    def __enter__(self) -> None:
        self.hold()

    def __exit__(self, *_: object) -> None:
        self.let_go()
