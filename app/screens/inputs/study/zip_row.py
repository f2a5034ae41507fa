"""Exported zips on this handheld: how many, where, handed to another app, or deleted."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path

from kivy.uix.boxlayout import BoxLayout

from widgets.parts.kit import Column, QuietButton, Remark

__all__ = ["SURE", "ZipRow"]

SURE = 4.0
"""A second press on what deletes counts within so long [s]."""
INSIDE = "in the app's own folder, which nothing else can look into"


class ZipRow(Column):
    """Dispatches `on_share`, and `on_delete` after a second press; empty without zips."""

    __events__ = ("on_share", "on_delete")

    def __init__(self, now: Callable[[], float], where: str | None, **kwargs: object) -> None:
        """`where` copies go that are shared, in words; None where a file manager finds the zips themselves."""
        super().__init__(spacing="8dp", **kwargs)
        self._now, self._where, self._sure, self._zips = now, where, -math.inf, 0
        self.remark = Remark(font_size="15sp")
        self.share = QuietButton(text="Share the newest", icon="send")
        self.share.bind(on_release=lambda _: self.dispatch("on_share"))
        self.away = QuietButton(icon="delete")
        self.away.bind(on_release=lambda _: self._delete())
        self._buttons = BoxLayout(size_hint_y=None, spacing="10dp")
        self.away.bind(height=self._buttons.setter("height"))
        self._buttons.height = self.away.height
        for button in (self.share, self.away) if where is not None else (self.away,):
            self._buttons.add_widget(button)

    def show(self, zips: Sequence[Path]) -> None:
        """These are there."""
        self._zips = len(zips)
        many = f"{len(zips)} zips lie" if len(zips) > 1 else "1 zip lies"
        if zips and self._where is None:
            self.remark.text = f"{many} in {zips[0].parent}."
        elif zips:
            self.remark.text = f"{many} {INSIDE}; shared zips are copied to {self._where}."
        if bool(zips) != bool(self.children):
            self.clear_widgets()
            for widget in (self.remark, self._buttons) if zips else ():
                self.add_widget(widget)
        self.tick()

    def tick(self) -> None:
        """Ask no longer whether they shall go, after a while."""
        sure = self._now() - self._sure < SURE
        what = "the zip" if self._zips == 1 else f"{self._zips} zips"
        self.away.text = "Press again: delete" if sure else f"Delete {what}"

    def _delete(self) -> None:
        if self._now() - self._sure >= SURE:
            self._sure = self._now()
        else:
            self._sure = -math.inf
            self.dispatch("on_delete")
        self.tick()

    def on_share(self) -> None:
        """A finger asked to hand the newest to another app."""

    def on_delete(self) -> None:
        """A finger asked twice to delete all of them."""
