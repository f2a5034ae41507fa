"""`python -m widgets [NAME]` opens the gallery; with `--pictures DIR` it writes PNG files and needs no display."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from widgets.core.language import LANGUAGES, language

OFFSCREEN = {
    "SDL_VIDEODRIVER": "offscreen",
    "SDL_AUDIODRIVER": "dummy",
    "KIVY_CLIPBOARD": "dummy",
    "KIVY_GL_BACKEND": "sdl2",
    "KIVY_METRICS_DENSITY": "1",
    "KIVY_METRICS_FONTSCALE": "1",
    "KIVY_DPI": "96",
    "LP_NUM_THREADS": "1",
}


def main(arguments: list[str] | None = None) -> int:
    """Show the gallery or write its pictures; 2 for a widget that there is not."""
    parser = argparse.ArgumentParser(
        prog="python -m widgets", description="Show every widget in every state."
    )
    parser.add_argument("name", nargs="?", default="", help="name of one widget, as in Compass; default: all")
    parser.add_argument(
        "--pictures", "--out", type=Path, metavar="DIR", help="folder for PNG files and index.html"
    )
    parser.add_argument(
        "--language", default="en", choices=LANGUAGES, help="of what the widgets say; en_XA is longer English"
    )
    options = parser.parse_args(arguments)
    language.name = options.language
    prepare(offscreen=options.pictures is not None)
    from widgets import gallery

    try:
        gallery.modules(options.name)
    except KeyError as error:
        print(error.args[0], file=sys.stderr)
        return 2
    if options.pictures:
        return write(options.pictures, options.name)
    from kivy.base import runTouchApp

    runTouchApp(gallery.Gallery(options.name))
    return 0


def prepare(*, offscreen: bool) -> None:
    """Set Kivy up before it is imported."""
    os.environ.update(KIVY_NO_ARGS="1", KIVY_NO_CONFIG="1", KIVY_NO_FILELOG="1", KIVY_LOG_MODE="PYTHON")
    if offscreen:
        os.environ.pop("DISPLAY", None)
        os.environ.update(OFFSCREEN)
    from kivy.config import Config

    Config.set("graphics", "multisamples", "0" if offscreen else "2")
    Config.set("graphics", "width", "1280")
    Config.set("graphics", "height", "800")
    Config.set("input", "mouse", "mouse,disable_multitouch")


def write(folder: Path, name: str) -> int:
    """Write the pictures and say how many and where."""
    from kivy.base import EventLoop

    from widgets.gallery import write_pictures

    EventLoop.start()
    pictures = write_pictures(folder, name)
    print(f"{len(pictures)} pictures in {folder}, to look at: {folder / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
