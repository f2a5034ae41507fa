"""Choosing files, as Android's own classes would be called, and as plyer is on a desktop."""

from __future__ import annotations

import os
import sys
import threading
from types import ModuleType, SimpleNamespace

import pytest

from app.device import file_picking as module
from app.device.file_picking import REQUEST, AndroidPicking, DesktopPicking, file_picking
from tests.app.device.java import Handle, JavaException, install, java

INTENT = "android.content.Intent"


class Intent:
    """What was put into one."""

    def __init__(self, action):
        self.action, self.extras = action, {}
        self.java = java(
            INTENT,
            addCategory=lambda name: setattr(self, "category", name),
            setType=lambda kind: setattr(self, "kind", kind),
            putExtra=self.extras.__setitem__,
        )


@pytest.fixture(autouse=True)
def at_once(monkeypatch):
    monkeypatch.setattr(module, "mainthread", lambda told: told)


class Phone:
    """Documents by their names, one of which cannot be read."""

    def __init__(self, monkeypatch, folder):
        self.asked, self.bound, self.folder = [], [], folder
        resolver = java(
            "android.content.ContentResolver",
            openFileDescriptor=self._open,
            query=lambda uri, *_: self._row(uri),
        )
        android = ModuleType("android")
        android.activity = SimpleNamespace(
            bind=lambda on_activity_result: self.bound.append(on_activity_result),  # noqa: PLW0108 - by that name
            unbind=lambda on_activity_result: self.bound.remove(on_activity_result),  # noqa: PLW0108 - same
        )
        activity = java(
            "android.app.Activity",
            getContentResolver=resolver,
            startActivityForResult=lambda intent, request: self.asked.append((self.intents[-1], request)),
        )
        self.intents = []
        install(
            monkeypatch,
            java("org.kivy.android.PythonActivity", mActivity=activity),
            java(INTENT, new=self._intent),
        )
        monkeypatch.setitem(sys.modules, "android", android)

    def _intent(self, action):
        self.intents.append(Intent(action))
        return self.intents[-1].java

    @staticmethod
    def _row(uri):
        return java("android.database.Cursor", moveToFirst=True, getString=lambda _: uri, close=None)

    def _open(self, uri, _):
        if uri == "locked":
            raise JavaException("no permission")
        path = self.folder / "source"
        path.write_text(uri)
        return java("android.os.ParcelFileDescriptor", detachFd=lambda: os.open(path, os.O_RDONLY))

    def answer(self, *uris, request=REQUEST):
        clip = java(
            "android.content.ClipData",
            getItemCount=len(uris),
            getItemAt=lambda index: java("android.content.ClipData$Item", getUri=Handle(uris[index])),
        )
        intent = java(
            INTENT, getClipData=clip if len(uris) > 1 else None, getData=Handle(uris[0]) if uris else None
        )
        for bound in list(self.bound):
            bound(request, -1, intent if uris else None)
        for thread in threading.enumerate():
            if thread.name == "file copies":
                thread.join()


@pytest.fixture
def told():
    return []


@pytest.fixture
def phone(monkeypatch, tmp_path, told):
    made = Phone(monkeypatch, tmp_path)
    AndroidPicking().pick(tmp_path / "files", lambda *given: told.append(given))
    return made


def test_what_is_chosen_on_a_phone_is_copied_into_the_apps_folder(phone, tmp_path, told):
    ((ask, request),) = phone.asked
    assert (ask.action, ask.kind, ask.extras, request) == (
        f"{INTENT}.ACTION_OPEN_DOCUMENT",
        "*/*",
        {f"{INTENT}.EXTRA_ALLOW_MULTIPLE": True},
        REQUEST,
    )
    phone.answer("hall.yaml", "hall.pgm", request=17)
    assert not told, "the answer to another question"
    phone.answer("hall.yaml", "hall.pgm")
    assert told == [([tmp_path / "files/hall.yaml", tmp_path / "files/hall.pgm"], "")]
    assert (tmp_path / "files/hall.pgm").read_text() == "hall.pgm"
    assert not phone.bound, "nothing more is listened to"


def test_a_name_is_no_way_out_of_the_folder(phone, tmp_path, told):
    phone.answer("../../.settings.json")
    assert told == [([tmp_path / "files/settings.json"], "")]


def test_choosing_nothing_tells_nothing_and_what_cannot_be_read_is_said(phone, tmp_path, told):
    phone.answer()
    assert told == [([], "")]
    AndroidPicking().pick(tmp_path / "files", lambda *given: told.append(given))
    phone.answer("locked")
    assert told[1] == ([], "The file cannot be read: no permission.")


def test_a_desktop_asks_by_plyer_and_where_that_cannot_says_what_can_be_done(monkeypatch, tmp_path, told):
    chooser = SimpleNamespace(open_file=lambda **_: ["/maps/town.mbtiles"])
    plyer = ModuleType("plyer")
    plyer.filechooser = chooser
    monkeypatch.setitem(sys.modules, "plyer", plyer)
    picking = file_picking()
    assert isinstance(picking, DesktopPicking)
    picking.pick(tmp_path, lambda *given: told.append(given))
    picking._thread.join()
    assert [path.name for path in told[0][0]] == ["town.mbtiles"]
    monkeypatch.delattr(plyer, "filechooser")
    picking.pick(tmp_path, lambda *given: told.append(given))
    picking._thread.join()
    assert told[1] == ([], "This desktop has no file dialogue; type the file's path.")
