"""Links that the system opens with this app: the phone's camera reads the QR code of a robot or a layout, and Android starts the app with it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from app.device import is_android

__all__ = ["link_of", "watch_links"]

MAX_LINK = 100_000
"""Characters of a link; longer ones are none of ours. Who reads it bounds it further."""


def link_of(intent: Any) -> str:
    """The link that an `android.content.Intent` was sent to view; empty for any other intent."""
    if intent is None or intent.getAction() != "android.intent.action.VIEW":
        return ""
    link = str(intent.getDataString() or "")
    return link if len(link) <= MAX_LINK else ""


def watch_links(on_link: Callable[[str], object]) -> None:
    """Call `on_link` with the link that the app was started with, and later, in Android's thread, with each that is opened.

    Elsewhere than on a phone it does nothing.
    """
    if not is_android():
        return
    from android import activity
    from jnius import autoclass

    def take(intent: Any) -> None:
        link = link_of(intent)
        if link:
            on_link(link)

    take(autoclass("org.kivy.android.PythonActivity").mActivity.getIntent())
    activity.bind(on_new_intent=take)
