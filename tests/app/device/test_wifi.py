"""Locks of a phone's Wi-Fi: held while they are wanted and never longer, and done without where a phone refuses."""

from __future__ import annotations

from typing import Any

import pytest

from app.device import wifi as module
from app.device.wifi import WifiLock, sees_broadcasts
from tests.app.device.java import JavaException, install, java

LOW_LATENCY, HIGH_PERFORMANCE = 4, 3


class Phone:
    """Its WifiManager, and what happened to its locks."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, version: int = 34, *, there: bool = True) -> None:
        self.done: list[Any] = []
        self.problem = ""
        manager = java(
            "android.net.wifi.WifiManager",
            createWifiLock=lambda mode, name: self._lock("android.net.wifi.WifiManager$WifiLock", mode),
            createMulticastLock=lambda name: self._lock(
                "android.net.wifi.WifiManager$MulticastLock", "multicast"
            ),
            WIFI_MODE_FULL_LOW_LATENCY=LOW_LATENCY,
            WIFI_MODE_FULL_HIGH_PERF=HIGH_PERFORMANCE,
        )
        context = java("android.content.Context", getSystemService=lambda _: manager if there else None)
        install(
            monkeypatch,
            java(
                "org.kivy.android.PythonActivity",
                mActivity=java("android.app.Activity", getApplicationContext=context),
            ),
            java("android.os.Build$VERSION", SDK_INT=version),
            manager,
        )
        monkeypatch.setattr(module, "is_android", lambda: True)

    def _lock(self, kind: str, what: Any) -> Any:
        return java(
            kind,
            setReferenceCounted=lambda counted: self.done.append(("counted", counted)),
            acquire=lambda: self._do(("held", what)),
            release=lambda: self._do(("let go", what)),
        )

    def _do(self, what: Any) -> None:
        if self.problem:
            raise JavaException(self.problem)
        self.done.append(what)


@pytest.mark.parametrize(("version", "mode"), [(34, LOW_LATENCY), (29, LOW_LATENCY), (28, HIGH_PERFORMANCE)])
def test_it_does_not_doze_from_hold_to_let_go(
    monkeypatch: pytest.MonkeyPatch, version: int, mode: int
) -> None:
    phone, lock = Phone(monkeypatch, version), WifiLock()
    lock.hold()
    lock.hold()
    lock.let_go()
    lock.let_go()
    assert phone.done == [("counted", False), ("held", mode), ("let go", mode)]


def test_broadcasts_are_seen_within(monkeypatch: pytest.MonkeyPatch) -> None:
    phone = Phone(monkeypatch)
    with sees_broadcasts():
        assert phone.done[-1] == ("held", "multicast")
    assert phone.done[-1] == ("let go", "multicast")


def test_a_phone_that_refuses_is_logged_and_asked_again_the_next_time(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    phone, lock = Phone(monkeypatch), WifiLock()
    phone.problem = "no permission"
    lock.hold()
    assert "does not do as it was asked: no permission" in caplog.text
    phone.problem = ""
    lock.hold()
    phone.problem = "gone"
    lock.let_go()
    assert "does not take its lock back: gone" in caplog.text


def test_a_device_without_wifi_goes_without(monkeypatch: pytest.MonkeyPatch) -> None:
    phone = Phone(monkeypatch, there=False)
    with sees_broadcasts():
        WifiLock().hold()
    assert phone.done == []


def test_on_a_computer_nothing_happens() -> None:
    with sees_broadcasts():
        WifiLock().hold()
