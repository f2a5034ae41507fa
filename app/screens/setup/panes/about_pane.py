"""What this app is: version, what it keeps of people, licences, the tour and the simulator."""

from __future__ import annotations

from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, distributions, version
from pathlib import Path

from kivy.uix.widget import Widget

from app.screens.parts.guide_text import GuideText
from app.screens.setup.panes.settings_pane import SettingsPane
from widgets.core.language import tr
from widgets.core.theme import FONTS
from widgets.parts.kit import QuietButton, Text

__all__ = ["AboutPane", "app_version"]

OWN = "pilothouse"
LICENCE = Path(__file__).parents[4] / "LICENSE"


def app_version() -> str:
    """That of the installed package; `development` where it runs from its sources alone."""
    try:
        return version(OWN)
    except PackageNotFoundError:
        return tr("development")


class AboutPane(SettingsPane):
    """Sentences, and buttons that unroll what is long."""

    def fill(self) -> Iterable[Widget]:
        """From the version to the licences."""
        self.text = GuideText()
        self.buttons = {
            "tour": self._button("explore", tr("See the tour again"), self.app.tour.begin),
            "licences": self._button("list", tr("Licences of fonts and libraries"), self._unroll),
        }
        yield Text(
            text=tr("Pilothouse {app_version}").format(app_version=app_version()), bold=True, font_size="20sp"
        )
        yield self.remark(
            tr("It sends nothing to its makers or to any service on the internet. What it keeps lies on this")
            + " "
            + tr("handheld and on your robots; the settings never leave it.")
        )
        if self.app.simulating.possible:
            yield self.remark(tr("A robot to try everything on is built in: start it on the first screen."))
        yield from self.buttons.values()
        yield self.text

    def _button(self, icon: str, words: str, act: object) -> QuietButton:
        button = QuietButton(text=words, icon=icon, size_hint_y=None, height="52dp")
        button.bind(on_release=lambda _: act())  # type: ignore[operator]
        return button

    def _unroll(self) -> None:
        self.text.show("" if self.text.children else licences())


def licences() -> str:
    """Every library in use with its version and licence, then the texts of the fonts' and the app's own."""
    rows = []
    for one in distributions():
        name = one.metadata["Name"]
        if name and name.lower() != OWN:
            rows.append(f"{name} {one.version}: {_licence(one.metadata)}")
    texts = [
        f"{path.stem}\n\n{path.read_text(encoding='utf-8')}" for path in sorted(FONTS.glob("*LICENSE*.txt"))
    ]
    if LICENCE.is_file():
        texts.append(LICENCE.read_text(encoding="utf-8"))
    return "\n\n".join(["\n".join(sorted(set(rows), key=str.lower)), *texts])


def _licence(metadata: object) -> str:
    """As its makers name it, in a few words."""
    get = metadata.get  # type: ignore[attr-defined]
    named = get("License-Expression") or get("License") or ""
    if named and len(named) < 80 and "\n" not in named:
        return str(named)
    classes = [one for one in metadata.get_all("Classifier") or () if one.startswith("License ::")]  # type: ignore[attr-defined]
    return classes[-1].rpartition(" :: ")[2] if classes else tr("see its package")
